#pragma once
// YART's command line (lxs 12.8): yat -i scene.lxs -o out.png -pathtracer -s 100 ...

#include <cstdint>
#include <optional>
#include <string>

namespace yat {

struct YartArguments {
  std::string scene;
  std::string output;  ///< empty: the picture is not saved
  bool path_tracer = false;
  uint32_t samples = 4;               ///< paths per pixel of the path tracer
  uint32_t trace_depth = 10;          ///< vertices of the path tracer's paths
  uint32_t antialiasing = 4;          ///< camera rays per pixel of the ray tracer
  std::optional<uint32_t> ray_depth;  ///< mirrors and glass of the ray tracer; without -d: 10
  uint32_t threads = 0;               ///< 0: one per processor
  uint32_t bucket_size = 128;         ///< [pixels]
  bool stamp = false;                 ///< render time and triangles into the picture
  bool heart_beat = false;            ///< a character per finished bucket
  uint32_t benchmark = 0;             ///< renders; 0: a normal run
  std::string remarks;                ///< one line each: what is given and does nothing
};

/// Whether the arguments are meant so: no subcommand, and one of YART's flags.
bool is_yart_command_line(int argc, const char* const* argv);

/// Throws Error (exit code 1) with a message that names the flag. Words that belong to no flag are
/// ignored, as YART does, and named in `remarks`.
YartArguments parse_yart_command_line(int argc, const char* const* argv);

/// The flags and what they do, for --help and docs/command-line.md.
std::string yart_help();

/// A time as YART prints it: to 5000 ms in ms, else hours, minutes and seconds without blanks.
std::string yart_time(double seconds);

}  // namespace yat

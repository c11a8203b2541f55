#pragma once
// The command line: one table of options, from which the parser, --help and the documentation's
// tables are made, and the values it was read into.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/diff.h"
#include "app/yart_options.h"
#include "film/features.h"
#include "film/settings.h"
#include "scene/colour_model.h"
#include "scene/compile.h"
#include "wavefront/plan.h"

namespace yat {

/// One option as people see it.
struct OptionText {
  std::string_view flags;     ///< "-o,--output"
  std::string_view value;     ///< "FILE"; empty for a flag
  std::string_view fallback;  ///< what holds without it
  std::string_view text;      ///< what it does, one sentence
};

std::span<const OptionText> render_option_texts();
std::span<const OptionText> info_option_texts();
std::span<const OptionText> diff_option_texts();

/// What --help prints for a command.
std::string option_help(std::string_view usage, std::string_view text,
                        std::span<const OptionText> options);

/// The options as rows of a Markdown table, one line each: what docs and README must hold.
std::string option_table(std::span<const OptionText> options);

enum class ProgressKind { kAuto, kBar, kPlain, kJson, kSilent };
enum class Verbosity { kQuiet, kNormal, kVerbose };

/// Whether blocks of pixels get samples by their noise; kAuto: where that pays.
enum class Adaptive { kAuto, kOn, kOff };

/// Half-open range of sample indices of every pixel.
struct SampleRange {
  uint32_t first = 0, end = 0;
};

/// What was asked for. An empty optional: as the scene says.
struct Arguments {
  std::string scene;
  std::vector<std::string> outputs;
  std::optional<uint32_t> samples_per_pixel;
  std::optional<SampleRange> samples_range;
  std::optional<double> time_limit;    ///< of rendering [s]
  std::optional<double> noise_target;  ///< relMSE at which to stop
  Adaptive adaptive = Adaptive::kOff;  ///< with a noise target
  uint32_t threads = 0;                ///< 0: one per processor
  std::optional<Integrator> integrator;
  std::optional<uint32_t> max_depth;
  std::optional<SamplerKind> sampler;
  std::optional<uint32_t> sample_set;
  std::optional<ColourMode> colour;  ///< empty: as the dialect says
  Dialect dialect = Dialect::kLuxRender;
  uint32_t seed = 0;
  uint32_t width = 0, height = 0;            ///< 0: as the film says [pixels]
  std::optional<std::array<float, 4>> crop;  ///< fractions x0 x1 y0 y1
  TreeChoice tree = TreeChoice::kFromScene;
  InstanceMode instances = InstanceMode::kAuto;
  LightChoosing light_choice = LightChoosing::kAuto;
  LightSampling light_sampling = LightSampling::kBoth;
  uint32_t roulette_depth = TransportOptions{}.roulette_depth;
  uint64_t image_bytes = ImageStore::kDefaultLimit;  ///< --texture-cache
  EnergyCompensation compensation = EnergyCompensation::kAuto;
  std::string isa;
  std::optional<ToneMap> tone_map;
  float exposure_stops = 0;
  FeatureSet features = 0;
  std::string stats_file, trace_file;
  ProgressKind progress = ProgressKind::kAuto;
  Verbosity verbosity = Verbosity::kNormal;
};

enum class Command { kRender, kInfo, kDiff, kConverge, kYart, kHelp };

struct CommandLine {
  Command command = Command::kHelp;
  Arguments arguments;
  YartArguments yart;
  DiffArguments diff;
  std::vector<std::string> converge;  ///< words for parse_converge_arguments()
  std::string text;                   ///< kHelp: what --help or --version prints
};

/// Reads the command line. Throws UsageError with a message that names the option; for YART's
/// command line see parse_yart_command_line().
CommandLine parse_command_line(int argc, const char* const* argv);

/// Names as on the command line.
std::string_view integrator_name(Integrator integrator);
std::string_view sampler_name(SamplerKind sampler);
std::string_view colour_name(ColourMode colour);
std::string_view light_choice_name(LightChoosing choosing);
std::string_view light_sampling_name(LightSampling ways);
std::string_view dialect_name(Dialect dialect);
std::string_view tone_map_name(ToneMap tone_map);

}  // namespace yat

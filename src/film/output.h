#pragma once
// Writing pictures: EXR scene-linear with metadata, PNG and JPEG through tone mapping. Each file is
// written beside its name and renamed, so that a crash leaves no half file.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "film/settings.h"

namespace yat {

/// What goes into the header of an EXR (and, where the format can, of the others).
struct PictureMetadata {
  std::string scene;
  uint64_t scene_hash = 0;
  uint32_t seed = 0;
  double samples_per_pixel = 0;
  double render_seconds = 0;
  std::string isa, version;
  std::string stamp;  ///< written into .png and .jpg (stamp.h); empty: nothing
  /// The error that the picture was found to have, where it was to have one (film/halves.h).
  struct Noise {
    double rel_mse, low, high;  ///< with the ends of the 95 % interval
    double epsilon;             ///< of relMSE
    double target;
  };
  std::optional<Noise> noise = {};
};

/// Whether the extension is one that write_picture knows (.exr .png .jpg .jpeg .tga).
bool is_picture_name(std::string_view path);
/// Whether files of this name can hold more than the picture (.exr).
bool keeps_features(std::string_view path);

/// Further channels of a picture, interleaved: width * height * (number of names) floats.
struct PictureLayer {
  std::string channels;  ///< names, comma-separated
  std::vector<float> values;
};

/// rgb: width * height * 3, linear Rec.709. layers: written into .exr only, after R, G and B.
/// Missing folders are made. Throws ResourceError when the file cannot be written, UsageError for
/// an unknown extension. file: how the scene wants it; without one .exr is scene-linear Rec.709 in
/// floats, the others RGB of 8 bits. There is no coverage: alpha is 1 everywhere. Returns whether a
/// stamp is there if it was wanted.
bool write_picture(const std::string& path, std::span<const float> rgb, uint32_t width,
                   uint32_t height, const FilmSettings& settings, const PictureMetadata& metadata,
                   std::span<const PictureLayer> layers = {}, const PictureFile* file = nullptr);

}  // namespace yat

#pragma once
// What the scene's Film statement asks for, defaults filled in (lxs 4.1, 4.3, 4.4).

#include <cstdint>
#include <string>
#include <vector>

namespace yat {

enum class ToneMap {
  kLinear,
  kReinhard,
  kAutoLinear,
  kMaxWhite,
  kContrast,
  kFalseColors,
  // YART's (lxs 12.3): on linear Rec.709 as it is, whatever the film's colour space.
  kYartLinear,
  kYartReinhard,
  kOutOfGamut,
};
enum class ClampMethod { kCut, kLum, kHue, kDarken };
enum class FalseColorScale { kStd, kLmk, kRed, kWhite, kYellow, kSpeos };
enum class FalseColorMethod {
  kLinear,  ///< place = share of the way from least to most
  kLog,     ///< log10(1 + 9 share): the first tenth takes a third
  kLog3,    ///< log10(1 + 999 share) / 3: each of three decades takes a third
};

/// One picture that the scene asks for by write_png, write_tga or write_exr (lxs 4.1).
struct PictureFile {
  enum class Channels { kY, kYA, kRgb, kRgba };
  std::string extension;  ///< ".png", ".tga", ".exr"
  Channels channels = Channels::kRgb;
  bool deep = false;        ///< 16 bits a channel (.png)
  bool half = true;         ///< 16-bit floats (.exr)
  bool tone_mapped = true;  ///< without gamma (.exr)
  std::string compression;  ///< as OpenEXR calls it (.exr)
};

struct FilmSettings {
  uint32_t width = 800, height = 600;  ///< full image [pixels]
  uint32_t crop_x0 = 0, crop_x1 = 800, crop_y0 = 0,
           crop_y1 = 600;           ///< pixels rendered, end exclusive
  std::string filename = "luxout";  ///< base name without extension

  ToneMap tone_map = ToneMap::kAutoLinear;
  float gamma = 2.2f;  ///< display exponent
  float linear_sensitivity = 50, linear_exposure = 1, linear_fstop = 2.8f, linear_gamma = 1;
  float reinhard_prescale = 1, reinhard_postscale = 1, reinhard_burn = 6;
  float contrast_ywa = 1;
  float out_of_gamut[3] = {1, 0, 0};  ///< outofgamut_color: of pixels above 1, not gamma-encoded
  FalseColorScale false_scale = FalseColorScale::kStd;
  FalseColorMethod false_method = FalseColorMethod::kLinear;
  float false_min = 0, false_max = 0;  ///< luminance [cd/m2]; max 0: the picture's own range
  float exposure_stops = 0;            ///< --exposure: 2^stops before tone mapping
  ClampMethod clamp = ClampMethod::kCut;

  float red[2] = {.63f, .34f}, green[2] = {.31f, .595f}, blue[2] = {.155f, .07f};  ///< xy
  float white[2] = {.314275f, .329411f};  ///< xy; SMPTE-C by default

  std::vector<PictureFile> files;  ///< what is written where the command line names nothing

  int32_t halt_spp = -1, halt_time = -1;  ///< haltspp, halttime [s]; -1: not given

  uint32_t crop_width() const { return crop_x1 - crop_x0; }
  uint32_t crop_height() const { return crop_y1 - crop_y0; }
};

}  // namespace yat

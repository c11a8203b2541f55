#include "film/tonemap.h"

#include <algorithm>
#include <cmath>

#include "film/colour.h"
#include "film/falsecolors.h"
#include "film/tonemap_yart.h"

namespace yat {

namespace {

/// Over the pixels with luminance > 0.
struct Luminance {
  uint64_t lit = 0;
  double mean = 0, log_mean = 1, least = 0, largest = 0;
};

Luminance measure(std::span<const Colour> xyz) {
  Luminance out;
  double sum = 0, log_sum = 0;
  for (const Colour& c : xyz) {
    const double y = c[1];
    if (!(y > 0)) continue;
    ++out.lit;
    sum += y;
    log_sum += std::log(std::max(y, 1e-6));
    out.least = out.lit == 1 ? y : std::min(out.least, y);
    out.largest = std::max(out.largest, y);
  }
  if (out.lit) {
    out.mean = sum / double(out.lit);
    out.log_mean = std::exp(log_sum / double(out.lit));
  }
  return out;
}

/// 8-bit level 118 is the grey of 18 % in LuxRender's display model.
constexpr double kGrey = 118.0 / 255.0;

/// The factor of each kernel that does not depend on the pixel.
double common_factor(const Luminance& picture, const FilmSettings& s) {
  switch (s.tone_map) {
    case ToneMap::kLinear:
      return double(s.linear_exposure) / (double(s.linear_fstop) * double(s.linear_fstop)) *
             double(s.linear_sensitivity) * (0.65 / 10) * std::pow(kGrey, double(s.linear_gamma));
    case ToneMap::kAutoLinear:
      return picture.lit ? 1.25 / picture.mean * std::pow(kGrey, double(s.gamma)) : 1;
    case ToneMap::kMaxWhite:
      return picture.lit ? 1 / picture.largest : 1;
    case ToneMap::kContrast: {
      const double ratio = (1.219 + std::pow(double(s.contrast_ywa), 0.4)) /
                           (1.219 + std::pow(picture.log_mean, 0.4));
      return std::pow(ratio, 2.5) / 100;
    }
    case ToneMap::kReinhard:
      return 0.1 / picture.log_mean * double(s.reinhard_postscale);
    case ToneMap::kFalseColors:
    case ToneMap::kYartLinear:
    case ToneMap::kYartReinhard:
    case ToneMap::kOutOfGamut:
      break;
  }
  return 1;
}

/// Reinhard et al. 2002, equation 4, as a factor on a pixel of luminance `y` (already scaled).
double reinhard_factor(double y, double inverse_burn2) {
  return (1 + y * inverse_burn2) / (1 + y);
}

/// Moves c towards `grey` (all channels alike) as far as keeps every channel within the limit.
void towards_grey(Colour& c, double grey, double farthest, double limit) {
  const double t = (limit - grey) / (farthest - grey);
  for (double& channel : c) channel = grey + t * (channel - grey);
}

/// lxs 4.2, step 5. On the line from a colour to the white of its luminance, xy and RGB agree.
void constrain_to_gamut(Colour& c, double luminance) {
  const double smallest = std::min({c[0], c[1], c[2]});
  if (smallest >= 0) return;
  if (luminance <= 0) {
    c = {};
    return;
  }
  towards_grey(c, luminance, smallest, 0);
  for (double& channel : c) channel = std::max(channel, 0.0);
}

/// lxs 4.4.
void clamp_bright(Colour& c, double luminance, ClampMethod method) {
  const double largest = std::max({c[0], c[1], c[2]});
  if (largest <= 1) return;
  switch (method) {
    case ClampMethod::kCut:
      break;
    case ClampMethod::kDarken:
      for (double& channel : c) channel /= largest;
      break;
    case ClampMethod::kLum:
    case ClampMethod::kHue: {
      const double grey = method == ClampMethod::kLum ? luminance : (c[0] + c[1] + c[2]) / 3;
      if (grey >= 1)
        c = {1, 1, 1};
      else
        towards_grey(c, grey, largest, 1);
      break;
    }
  }
  for (double& channel : c) channel = std::clamp(channel, 0.0, 1.0);
}

/// falsecolors: without colour space, clamping and gamma.
std::vector<float> paint_luminance(std::span<const Colour> xyz, const Luminance& picture,
                                   const FilmSettings& settings) {
  const bool automatic = !(settings.false_max > 0);
  const double least = automatic ? picture.least : double(settings.false_min);
  const double most = automatic ? picture.largest : double(settings.false_max);
  std::vector<float> out;
  out.reserve(xyz.size() * 3);
  for (const Colour& c : xyz)
    for (const double channel : false_color(
             false_color_place(c[1], least, most, settings.false_method), settings.false_scale))
      out.push_back(float(channel));
  return out;
}

}  // namespace

std::vector<float> tone_map(std::span<const float> rgb, const FilmSettings& settings) {
  if (is_yart(settings.tone_map)) return yart_tone_map(rgb, settings);
  const size_t pixels = rgb.size() / 3;
  const ColourMatrix from_rec709 = rec709_to_xyz();
  const ColourMatrix film_xyz = film_to_xyz(settings);
  const ColourMatrix to_film = inverse(film_xyz);
  const Colour weights = film_xyz[1];  // luminance of film RGB

  const double exposure = std::exp2(double(settings.exposure_stops));
  std::vector<Colour> xyz(pixels);
  for (size_t i = 0; i < pixels; ++i) {
    Colour c{double(rgb[3 * i]), double(rgb[3 * i + 1]), double(rgb[3 * i + 2])};
    if (!std::isfinite(c[0]) || !std::isfinite(c[1]) || !std::isfinite(c[2])) continue;
    c = from_rec709 * c;
    for (int k = 0; k < 3; ++k) xyz[i][k] = std::max(c[k] * exposure, 0.0);
  }

  const Luminance picture = measure(xyz);
  if (settings.tone_map == ToneMap::kFalseColors) return paint_luminance(xyz, picture, settings);
  const double factor = common_factor(picture, settings);
  const bool reinhard = settings.tone_map == ToneMap::kReinhard;
  const double burn = double(settings.reinhard_burn);
  const double inverse_burn2 = burn > 0 ? 1 / (burn * burn) : 1e5;
  const double reinhard_scale = 0.1 / picture.log_mean / double(settings.reinhard_prescale);
  const double exponent = 1 / double(settings.gamma);

  std::vector<float> out(rgb.size());
  for (size_t i = 0; i < pixels; ++i) {
    double f = factor;
    if (reinhard) f *= reinhard_factor(xyz[i][1] * reinhard_scale, inverse_burn2);
    Colour c = to_film * Colour{xyz[i][0] * f, xyz[i][1] * f, xyz[i][2] * f};
    constrain_to_gamut(c, xyz[i][1] * f);
    clamp_bright(c, weights[0] * c[0] + weights[1] * c[1] + weights[2] * c[2], settings.clamp);
    for (int k = 0; k < 3; ++k)
      out[3 * i + k] = c[k] > 0 ? float(std::pow(std::min(c[k], 1.0), exponent)) : 0.f;
  }
  return out;
}

std::vector<float> tone_map_linear(std::span<const float> rgb, FilmSettings settings) {
  // autolinear's factor depends on gamma: it is taken out again afterwards.
  const float gamma = settings.gamma;
  std::vector<float> out = tone_map(rgb, settings);
  for (float& c : out) c = std::pow(c, gamma);
  return out;
}

}  // namespace yat

#include "film/tonemap_yart.h"

#include <algorithm>
#include <cmath>

namespace yat {

std::vector<float> yart_tone_map(std::span<const float> rgb, const FilmSettings& settings) {
  const double exposure = std::exp2(double(settings.exposure_stops));
  const double exponent = 1 / double(settings.gamma);
  std::vector<float> out(rgb.size());
  for (size_t i = 0; i + 2 < rgb.size(); i += 3) {
    double c[3];
    bool finite = true;
    for (size_t k = 0; k < 3; ++k) {
      c[k] = std::max(double(rgb[i + k]) * exposure, 0.0);
      finite = finite && std::isfinite(rgb[i + k]);
    }
    if (!finite) continue;
    const double largest = std::max({c[0], c[1], c[2]});
    if (settings.tone_map == ToneMap::kOutOfGamut && largest > 1) {
      for (size_t k = 0; k < 3; ++k) out[i + k] = std::clamp(settings.out_of_gamut[k], 0.f, 1.f);
      continue;
    }
    for (size_t k = 0; k < 3; ++k) {
      if (settings.tone_map == ToneMap::kYartReinhard)
        c[k] /= 1 + c[k];
      else if (largest > 1)
        c[k] /= largest;
      out[i + k] = float(std::pow(c[k], exponent));
    }
  }
  return out;
}

}  // namespace yat

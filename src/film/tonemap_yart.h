#pragma once
// YART's tone mapping (lxs 12.3). See tone_map() for what goes in and out.

#include <span>
#include <vector>

#include "film/settings.h"

namespace yat {

inline bool is_yart(ToneMap kernel) {
  return kernel == ToneMap::kYartLinear || kernel == ToneMap::kYartReinhard ||
         kernel == ToneMap::kOutOfGamut;
}

std::vector<float> yart_tone_map(std::span<const float> rgb, const FilmSettings& settings);

}  // namespace yat

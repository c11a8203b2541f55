#pragma once
// Scene-linear picture -> display picture, by LuxRender's rules (lxs 4.2, 4.3, 4.4, section 9).

#include <cstdint>
#include <span>
#include <vector>

#include "film/settings.h"

namespace yat {

/// rgb: 3 floats a pixel, linear Rec.709. Returns 3 floats a pixel in [0, 1], film colour space,
/// gamma-encoded: what is quantised by truncation to 8 or 16 bits. Non-finite input counts as 0.
std::vector<float> tone_map(std::span<const float> rgb, const FilmSettings& settings);

}  // namespace yat

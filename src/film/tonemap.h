#pragma once
// Scene-linear picture -> display picture, by LuxRender's rules (lxs 4.2, 4.3, 4.4, section 9).

#include <cstdint>
#include <span>
#include <vector>

#include "film/settings.h"

namespace yat {

/// Steps, in this order: exposure; negative XYZ to 0; tone map (a factor that depends on
/// luminance); film colour space, colours outside its gamut pulled towards white at their
/// luminance; channels above 1 brought back by the clamp method; power law.
///
/// rgb      3 floats a pixel, linear Rec.709. A pixel with a non-finite channel counts as black.
/// returns  3 floats a pixel in [0, 1], film colour space, gamma-encoded: what is quantised by
///          truncation to 8 or 16 bits.
///
/// falsecolors instead: exposure; luminance to a place between false_min and false_max (the least
/// and the largest of the lit pixels where false_max is not above 0), and that to a colour.
///
/// YART's kernels instead: exposure; negative channels to 0; linear: divided by the largest channel
/// where that is above 1; reinhard: c / (1 + c); outofgamut: as linear, but painted in one colour
/// where a channel is above 1; power law.
///
/// Statistics that a tone map needs (mean, logarithmic mean, maximum of the luminance) are over the
/// pixels with luminance > 0 and summed in pixel order. Throws UsageError for a film colour space
/// without volume.
std::vector<float> tone_map(std::span<const float> rgb, const FilmSettings& settings);
/// The same before the power law, in [0, 1].
std::vector<float> tone_map_linear(std::span<const float> rgb, FilmSettings settings);

/// c in [0, 1] -> 0..levels by truncation, as LuxRender writes its files (lxs 4.2, step 9).
inline uint32_t quantise(float c, uint32_t levels) {
  return uint32_t(c * float(levels));
}

}  // namespace yat

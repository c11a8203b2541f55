#pragma once
// Daylight from formulas: the sun's disc and the clear sky (lxs 6.5, A.2).

#include <array>
#include <glm/vec3.hpp>
#include <optional>

#include "scene/compiled.h"

namespace yat {

/// Sine of the sun's angular radius: its radius over its distance.
inline constexpr double kSunSine = 695500. / 149600000.;
/// With "relsize" beyond this the disc would fill half the sky.
inline constexpr double kLargestSun = 215;

/// Radiance of the sun's disc through the atmosphere, linear Rec.709 [cd/m2].
/// cos_zenith in (0, 1], turbidity >= 1. Channels outside the gamut are negative.
/// Source: Preetham, Shirley, Smits 1999 (after Iqbal 1983), with LuxRender's numbers.
glm::dvec3 sun_radiance(double cos_zenith, double turbidity);

struct SkySettings {
  double turbidity = 2, gain = 1;
  std::array<double, 5> factor = {1, 1, 1, 1, 1};  ///< aconst to econst
};
/// The sky for a sun in direction `sun` (unit, light space, +z the zenith). Empty if a number in it
/// is not finite.
std::optional<SkyRow<Value>> make_sky(const SkySettings& settings, const glm::dvec3& sun);

}  // namespace yat

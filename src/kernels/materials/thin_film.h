#pragma once
// LuxRender's thin film: a reflectance times cos^2(4 pi d / lambda sqrt(index^2 - sin^2) + pi), of
// one wavelength per band (lxs 7.2). A film of thickness 0 changes nothing.

#include "kernels/material.h"

namespace yat {

/// What stands for the red, green and blue band [nm].
inline constexpr float kBandWavelengths[3] = {610, 550, 465};

#if defined(YAT_ISA)
namespace YAT_ISA {

/// thickness in nm, >= 0; index >= 1; cos of the angle to the normal.
template <class A>
YAT_INLINE Spectrum<A> film_factor(const Float<A>& thickness, const Float<A>& index,
                                   const Float<A>& cos) {
  const Float<A> one(1.f), two(2.f);
  const Float<A> inside = index * index - (one - cos * cos);
  const Float<A> way = two * thickness * xsimd::sqrt(xsimd::max(inside, Float<A>(0.f)));
  const auto band = [&](int b) {
    const Float<A> turns = way * Float<A>(1 / kBandWavelengths[b]);
    const Float<A> c = sin_cos_turns<A>(turns - xsimd::floor(turns)).cos;
    return c * c;
  };
  return {band(0), band(1), band(2)};
}

}  // namespace YAT_ISA
#endif

}  // namespace yat

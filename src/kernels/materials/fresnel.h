#pragma once
// Fresnel reflectances for unpolarised light, of one band. cos is that of the angle between the ray
// and the surface it meets, in [0, 1]; results are in [0, 1]. The approximations are LuxRender's
// (lxs 7.1), kept for its colours.

#if defined(YAT_ISA)
#include "kernels/math.h"

namespace yat::YAT_ISA {

/// x^5.
template <class A>
YAT_INLINE Float<A> fifth_power(const Float<A>& x) {
  const Float<A> x2 = x * x;
  return x2 * x2 * x;
}

/// Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994.
/// r0 = reflectance head-on.
template <class A>
YAT_INLINE Float<A> fresnel_schlick(const Float<A>& r0, const Float<A>& cos) {
  const Float<A> one(1.f);
  return r0 + (one - r0) * fifth_power<A>(xsimd::max(one - cos, Float<A>(0.f)));
}

/// Between two dielectrics (Born, Wolf, Principles of Optics, 1.5). eta = n_o / n_i for the side o
/// of the ray; cos_i on the other side, 0 where reflection is total.
template <class A>
YAT_INLINE Float<A> fresnel_dielectric(const Float<A>& cos_o, const Float<A>& cos_i,
                                       const Float<A>& eta) {
  const Float<A> zero(0.f), one(1.f);
  const Float<A> s = (eta * cos_o - cos_i) / (eta * cos_o + cos_i);
  const Float<A> p = (cos_o - eta * cos_i) / (cos_o + eta * cos_i);
  const Float<A> f = Float<A>(.5f) * (s * s + p * p);
  return xsimd::select((cos_i > zero) & (cos_o > zero), xsimd::min(f, one), one);
}

/// Good conductors, where n^2 + k^2 is much more than 1: what is refracted goes straight in.
template <class A>
YAT_INLINE Float<A> fresnel_conductor(const Float<A>& n, const Float<A>& k, const Float<A>& cos) {
  const Float<A> one(1.f), q = n * n + k * k, c2 = cos * cos, b = Float<A>(2.f) * n * cos;
  const Float<A> p = (q * c2 - b + one) / (q * c2 + b + one);
  const Float<A> s = (q - b + c2) / (q + b + c2);
  return Float<A>(.5f) * (p + s);
}

/// Anything between dielectric (k = 0: exact, for n >= 1) and conductor.
template <class A>
YAT_INLINE Float<A> fresnel_general(const Float<A>& n, const Float<A>& k, const Float<A>& cos) {
  const Float<A> zero(0.f), one(1.f), two(2.f), n2 = n * n, q = n2 + k * k, c2 = cos * cos;
  const Float<A> x = (one - c2) / n2;  // sin^2 in the material, were it a dielectric
  // 1 - x, without cancelling where n is near 1.
  const Float<A> rest = xsimd::max(((n2 - one) + c2) / n2, zero), a = two * k * k * x;
  const Float<A> t2 = Float<A>(.5f) * (rest + xsimd::sqrt(rest * rest + a * a));
  const Float<A> b = two * n * cos * xsimd::sqrt(t2);
  const Float<A> p = (q * c2 - b + t2) / (q * c2 + b + t2);
  const Float<A> s = (q * t2 - b + c2) / (q * t2 + b + c2);
  // Head-on at n = 1, k = 0 and edge-on at total reflection: 0 / 0.
  const Float<A> f = Float<A>(.5f) * (p + s);
  return xsimd::select(t2 + c2 > zero, xsimd::min(xsimd::max(f, zero), one), one);
}

/// What LuxRender makes of a colour that is to be the reflectance of a metal: n and k, each of
/// which alone would give that reflectance head-on. Together they give more (.2 becomes .257, .5
/// .540, .8 .809).
template <class A>
struct IndexOfColour {
  Float<A> n, k;
  static YAT_INLINE IndexOfColour of(const Float<A>& reflectance) {
    const Float<A> one(1.f);
    const Float<A> r = xsimd::min(xsimd::max(reflectance, Float<A>(0.f)), Float<A>(.999f));
    const Float<A> root = xsimd::sqrt(r);
    return {(one + root) / (one - root), Float<A>(2.f) * root / xsimd::sqrt(one - r)};
  }
};

}  // namespace yat::YAT_ISA
#endif

#pragma once
// The Oren-Nayar factor that matte, matte_translucent and glossy share. Source: Oren, Nayar,
// "Generalization of Lambert's Reflectance Model", 1994, the short form that LuxRender uses
// (lxs 7.2):
//   f = Kd/pi (A + B max(0, cos(phi_i - phi_o)) sin(alpha) tan(beta)),
//   A = 1 - s^2 / (2 (s^2 + .33)), B = .45 s^2 / (s^2 + .09), s in radians.
// Its albedo passes 1 by up to 1.3 % at grazing angles for small sigma: the model's own fault, kept
// for agreement with LuxRender.

#include "kernels/material.h"

#if defined(YAT_ISA)
namespace yat::YAT_ISA {

/// f pi / Kd; 1 for sigma = 0. Both directions on the side of z, sigma in degrees (clamped to
/// 0..90, as a texture may leave it). No trigonometry: sin(alpha) tan(beta) = sin_i sin_o /
/// max(cos_i, cos_o), and the sines with the cosine of the azimuths are the dot product of the
/// tangential parts.
template <class A>
YAT_INLINE Float<A> oren_nayar(const Float<A>& sigma, const Vec3<A>& wo, const Vec3<A>& wi) {
  const Float<A> zero(0.f);
  const Float<A> s = Float<A>(kPi / 180) * xsimd::min(xsimd::max(sigma, zero), Float<A>(90.f));
  const Float<A> s2 = s * s;
  const Float<A> a = Float<A>(1.f) - s2 / (Float<A>(2.f) * (s2 + Float<A>(.33f)));
  const Float<A> b = Float<A>(.45f) * s2 / (s2 + Float<A>(.09f));
  const Float<A> tangential = xsimd::max(wo.x * wi.x + wo.y * wi.y, zero);
  const Float<A> steeper = xsimd::max(wo.z, wi.z);
  return a + b * xsimd::select(steeper > zero, tangential / steeper, zero);
}

}  // namespace yat::YAT_ISA
#endif

#pragma once
// A coat over any material: what it takes of the light that the material scatters (lxs 7.3). With
// S = Schlick(R0, i.h) and a = exp(-Ka d (1/cos_i + 1/cos_o)), seen from the side of the coat
//   f = f_base a (1 - S)                                       reflected
//   f = f_base a' sqrt(1 - S), a' for the leg through it       transmitted, either way
// and f = f_base for what is reflected behind it.

#include "kernels/exponential.h"
#include "kernels/material.h"
#include "kernels/materials/fresnel.h"
#include "soa/records.h"

namespace yat::YAT_ISA {

/// S, by the reflectance head-on.
template <class A>
YAT_INLINE Spectrum<A> coat_fresnel(const Spectrum<A>& r0, const Float<A>& cos) {
  return {fresnel_schlick<A>(r0.r, cos), fresnel_schlick<A>(r0.g, cos),
          fresnel_schlick<A>(r0.b, cos)};
}
/// exp(-Ka d way), way the sum of the inverse cosines.
template <class A>
YAT_INLINE Spectrum<A> coat_absorption(const Spectrum<A>& ka, const Float<A>& depth,
                                       const Float<A>& way) {
  // Edge-on no light is left where anything absorbs, and all where nothing does.
  const Float<A> path = -(depth * xsimd::min(way, Float<A>(1e30f)));
  return {exponential<A>(path * ka.r), exponential<A>(path * ka.g), exponential<A>(path * ka.b)};
}
template <class A>
YAT_INLINE Spectrum<A> one_minus(const Spectrum<A>& c) {
  const Float<A> one(1.f);
  return {one - c.r, one - c.g, one - c.b};
}

/// f over f_base for row i; wo and wi local to the material below. 0 exactly edge-on. Not inlined:
/// few scenes have coats.
template <class A>
__attribute__((noinline)) Spectrum<A> coat_passes(const Coat<ConstColumn>& coats, uint32_t i,
                                                  const Vec3<A>& wo, const Vec3<A>& wi) {
  const Float<A> one(1.f), zero(0.f);
  const Coat<Lanes<A>::template Of> c = load<A>(coats, i);
  const Mask<A> outside = mask_of<A>(c.outside != UInt<A>(0u)), reflected = wi.z > zero;
  const Float<A> cos_i = xsimd::abs(wi.z);
  const Vec3<A> h = normalize(Vec3<A>{wo.x + wi.x, wo.y + wi.y, wo.z + cos_i});
  const Spectrum<A> rest = one_minus<A>(coat_fresnel<A>({c.r0_r, c.r0_g, c.r0_b}, dot(wo, h)));
  const Float<A> to_eye = xsimd::select(outside, one / wo.z, zero);
  const Float<A> from_light = xsimd::select(reflected == outside, one / cos_i, zero);
  const Spectrum<A> legs =
      coat_absorption<A>({c.absorbs_r, c.absorbs_g, c.absorbs_b}, one, to_eye + from_light);
  const Spectrum<A> root{xsimd::sqrt(rest.r), xsimd::sqrt(rest.g), xsimd::sqrt(rest.b)};
  const Spectrum<A> through = legs * select<A>(reflected, rest, root);
  return only<A>((wo.z > zero) & (cos_i > zero),
                 select<A>(reflected & !outside, Spectrum<A>{one, one, one}, through));
}

}  // namespace yat::YAT_ISA

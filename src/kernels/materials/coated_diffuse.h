#pragma once
// LuxRender's coating of a diffuse base (lxs 7.3): with R0 = Ks, times ((index - 1)/(index + 1))^2
// where index > 0, S = Schlick(R0, i.h) and the absorption a = exp(-Ka d (1/cos_i + 1/cos_o)),
//   f = S D G(o) G(i) / (4 cos_o cos_i) + a (1 - S) f_base.
// The rational G lets a smooth coat reflect more at grazing angles than it receives
// (microfacet.h): the look that scenes were made for.

#include "kernels/material.h"
#include "kernels/materials/rough_diffuse.h"

#if defined(YAT_ISA)
#include "kernels/exponential.h"
#include "kernels/materials/fresnel.h"
#include "kernels/materials/microfacet.h"

namespace yat::YAT_ISA {

/// Reflectance head-on of a coat.
template <class A>
YAT_INLINE Spectrum<A> coat_reflectance(const Spectrum<A>& ks, const Float<A>& index) {
  const Float<A> one(1.f), zero(0.f);
  const Float<A> root = (index - one) / (index + one);
  return xsimd::select(index > zero, root * root, one) * ks;
}
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
template <class A>
YAT_INLINE Spectrum<A> sum(const Spectrum<A>& a, const Spectrum<A>& b) {
  return {a.r + b.r, a.g + b.g, a.b + b.b};
}
/// The light between the facets of a coat: min((1 - G(o) G(i)) / (4 spread cos_o cos_i), 1).
template <class A>
YAT_INLINE Float<A> between_facets(const MicrofacetLobe<A>& lobe, const Vec3<A>& wo,
                                   const Vec3<A>& wi, float spread) {
  const Float<A> one(1.f), shadowed = one - lobe.shadowing(wo.z) * lobe.shadowing(wi.z);
  const Float<A> cosines = Float<A>(4 * spread) * wo.z * wi.z;
  return xsimd::select(shadowed >= cosines, one, xsimd::max(shadowed, Float<A>(0.f)) / cosines);
}

/// f and the density of a direction.
template <class A>
struct Scattered {
  Spectrum<A> f;
  Float<A> pdf;
};

/// One sample of two lobes by their exact mixture: a microfacet lobe, chosen with `chance`, and a
/// cosine. both(wi) says what a direction has of them together; `smooth` is what a lobe without
/// width reflects.
template <class A, class Both>
YAT_INLINE BsdfSample<A> sample_coated(const MicrofacetLobe<A>& lobe, const Float<A>& chance,
                                       const Spectrum<A>& smooth, const Vec3<A>& wo,
                                       const Float<A>& u_lobe, const Float<A>& u, const Float<A>& v,
                                       Both&& both) {
  const Float<A> one(1.f), zero(0.f);
  const Mask<A> coat = u_lobe < chance;
  BsdfSample<A> s;
  s.wi = select(coat, lobe.sample(wo, u, v).wi, square_to_cosine_hemisphere<A>(u, v));
  const Scattered<A> value = both(s.wi);
  // Below it, no sample ever comes; f / pdf may not fit.
  const Mask<A> seen = value.pdf > Float<A>(1e-30f);
  const Float<A> cos_by_pdf = s.wi.z / value.pdf;
  const Mask<A> mirrors = coat & lobe.smooth;
  const Mask<A> fits = seen & (largest(value.f) * cos_by_pdf <= Float<A>(1e30f));
  s.weight = select(mirrors, (one / chance) * smooth, only<A>(fits, cos_by_pdf * value.f));
  s.pdf = xsimd::select(mirrors, zero, value.pdf);
  return s;
}

/// The share of samples that the coat gets: what it brings, of all, but an eighth is left to a base
/// that brings anything, as these are estimates. Where nothing brings anything: 0.
template <class A>
YAT_INLINE Float<A> coat_chance(const Spectrum<A>& coat, const Spectrum<A>& base) {
  const Float<A> zero(0.f), c = largest(coat), b = largest(base), total = c + b;
  const Float<A> share = xsimd::select(total > zero, c / total, zero);
  return xsimd::select(b > zero, xsimd::min(share, Float<A>(.875f)), share);
}

}  // namespace yat::YAT_ISA
#endif

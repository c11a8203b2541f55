#pragma once
// LuxRender's coating of a diffuse base (lxs 7.3): with R0 = Ks, times ((index - 1)/(index + 1))^2
// where index > 0, S = Schlick(R0, i.h) and the absorption a = exp(-Ka d (1/cos_i + 1/cos_o)),
//   f = S D G(o) G(i) / (4 cos_o cos_i) + a (1 - S) f_base.
// Seen exactly edge-on there is no light: f = pdf = weight = 0.
// The rational G lets a smooth coat reflect more at grazing angles than it receives
// (microfacet.h): the look that scenes were made for.

#include "kernels/material.h"
#include "kernels/materials/rough_diffuse.h"

#if defined(YAT_ISA)
#include "kernels/coat.h"
#include "kernels/materials/microfacet.h"

namespace yat::YAT_ISA {

/// Reflectance head-on of a coat.
template <class A>
YAT_INLINE Spectrum<A> coat_reflectance(const Spectrum<A>& ks, const Float<A>& index) {
  const Float<A> one(1.f), zero(0.f);
  const Float<A> root = (index - one) / (index + one);
  return xsimd::select(index > zero, root * root, one) * ks;
}
/// The light between the facets of a coat: min((1 - G(o) G(i)) / (4 spread cos_o cos_i), 1).
template <class A>
YAT_INLINE Float<A> between_facets(const MicrofacetLobe<A>& lobe, const Vec3<A>& wo,
                                   const Vec3<A>& wi, float spread) {
  const Float<A> one(1.f), shadowed = one - lobe.shadowing(wo.z) * lobe.shadowing(wi.z);
  const Float<A> cosines = Float<A>(4 * spread) * wo.z * wi.z;
  return xsimd::select(shadowed >= cosines, one, xsimd::max(shadowed, Float<A>(0.f)) / cosines);
}

/// About what a lobe of white facets gives back, by its roughness alone: 1/(1 + 3 u v), within .08
/// for equal roughnesses at cosines from .1 on. Smooth ones give more at grazing angles.
template <class A>
YAT_INLINE Float<A> lobe_albedo(const MicrofacetLobe<A>& lobe) {
  const Float<A> one(1.f);
  return one / (one + Float<A>(3.f) * lobe.x * lobe.y);
}

/// The share of samples that the coat gets: what it brings, of all, but an eighth is left to a base
/// that brings anything, as these are estimates. Where nothing brings anything: 0.
template <class A>
YAT_INLINE Float<A> coat_chance(const Spectrum<A>& coat, const Spectrum<A>& base) {
  const Float<A> zero(0.f), c = largest(coat), b = largest(base), total = c + b;
  const Float<A> share = xsimd::select(total > zero, c / total, zero);
  return xsimd::select(b > zero, xsimd::min(share, Float<A>(.875f)), share);
}

/// f and the density of a direction.
template <class A>
struct Scattered {
  Spectrum<A> f;
  Float<A> pdf;
};

/// evaluate and pdf of a material that makes both at once:
///   Material::Parts::of(parameters, view)                  what does not depend on wi
///   Material::both(parameters, view, parts, wi)            Scattered
template <class A, class Material, class P>
struct EvaluateByParts {
  using Parameters = P;
  static YAT_INLINE Spectrum<A> evaluate(const P& p, const BsdfView<A>& view, const Vec3<A>& wi) {
    return Material::both(p, view, Material::Parts::of(p, view), wi).f;
  }
  static YAT_INLINE Float<A> pdf(const P& p, const BsdfView<A>& view, const Vec3<A>& wi) {
    return Material::both(p, view, Material::Parts::of(p, view), wi).pdf;
  }
};

/// A coat over a diffuse base, sampled by the exact mixture of lobe and cosine. Material, which
/// derives from it, says with P as of GlossyParameters:
///   kLeastRoughness     less is brought up to it
///   kCoatInside         whether the coat is there for those who look from the inside
///   kShadowed           whether its facets shadow each other
///   base_share(p, parts, wo, fresnel, covered)   what the base may bring; covered: absorption
///   value(p, view, parts, wi, h)                 f, both directions above the surface
template <class A, class Material, class P>
struct CoatedDiffuse : EvaluateByParts<A, Material, P> {
  struct Parts {
    MicrofacetLobe<A> lobe;
    Spectrum<A> r0, kd, ka;
    Float<A> chance;  ///< of the coat
    static YAT_INLINE Parts of(const P& p, const BsdfView<A>& view) {
      const Float<A> one(1.f), zero(0.f), least(Material::kLeastRoughness), cos = view.wo.z;
      Parts s{
          MicrofacetLobe<A>::of(xsimd::max(p.uroughness, least), xsimd::max(p.vroughness, least)),
          coat_reflectance<A>({p.ks_r, p.ks_g, p.ks_b}, p.index),
          {p.kd_r, p.kd_g, p.kd_b},
          {p.ka_r, p.ka_g, p.ka_b},
          zero};
      const Spectrum<A> fresnel = coat_fresnel<A>(s.r0, cos);
      Spectrum<A> coat = fresnel;
      if constexpr (Material::kShadowed) coat = lobe_albedo<A>(s.lobe) * coat;
      s.chance = coat_chance<A>(
          coat, Material::base_share(p, s, view.wo, fresnel,
                                     coat_absorption<A>(s.ka, p.depth, one + one / cos)));
      if constexpr (!Material::kCoatInside) s.chance = only<A>(view.outside, s.chance);
      return s;
    }
  };

  static YAT_INLINE Scattered<A> both(const P& p, const BsdfView<A>& view, const Parts& parts,
                                      const Vec3<A>& wi) {
    const Float<A> one(1.f), zero(0.f);
    const Vec3<A> h = MicrofacetLobe<A>::half_vector(view.wo, wi);
    const Mask<A> above = (wi.z > zero) & (view.wo.z > zero);
    return {only<A>(above, Material::value(p, view, parts, wi, h)),
            only<A>(above, parts.chance * parts.lobe.pdf(view.wo, h) +
                               (one - parts.chance) * cosine_hemisphere_pdf<A>(wi.z))};
  }

  static YAT_INLINE BsdfSample<A> sample(const P& p, const BsdfView<A>& view,
                                         const Float<A>& u_lobe, const Float<A>& u,
                                         const Float<A>& v) {
    const Float<A> one(1.f), zero(0.f);
    const Vec3<A>& wo = view.wo;
    const Parts parts = Parts::of(p, view);
    const Mask<A> coat = u_lobe < parts.chance;
    BsdfSample<A> s;
    s.wi = select(coat, parts.lobe.sample(wo, u, v).wi, square_to_cosine_hemisphere<A>(u, v));
    const Scattered<A> value = both(p, view, parts, s.wi);
    s.pdf = value.pdf;
    s.weight = only<A>(value.pdf > zero, (s.wi.z / value.pdf) * value.f);
    // A lobe without width has no density, and reflects what Fresnel's formula says.
    const Mask<A> mirrors = coat & parts.lobe.smooth & (wo.z > zero);
    s.weight = select(mirrors, (one / parts.chance) * coat_fresnel<A>(parts.r0, wo.z), s.weight);
    s.pdf = only<A>(!mirrors, s.pdf);
    return s;
  }
};

}  // namespace yat::YAT_ISA
#endif

#pragma once
// LuxRender's roughglass: facets that reflect Kr F and refract Kt (1 - F), F the exact dielectric
// reflectance (lxs 7.3). Source: Walter, Marschner, Li, Torrance, "Microfacet Models for Refraction
// through Rough Surfaces", 2007; distribution and shadowing are those of microfacet.h.
// Outside is the side of the normal. Radiance changes by (n_o / n_i)^2 across the surface.

#include "kernels/materials/fresnel.h"
#include "kernels/materials/microfacet.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct RoughGlassParameters {
  Of<float> kr_r, kr_g, kr_b;        ///< tint of reflection, 0..1
  Of<float> kt_r, kt_g, kt_b;        ///< tint of refraction, 0..1, at every interface
  Of<float> index;                   ///< inside over outside, > 0, not 1: |index - 1| >= .001
  Of<float> uroughness, vroughness;  ///< along dp/du and across it; used from .006 to 1
  YAT_FIELDS(kr_r, kr_g, kr_b, kt_r, kt_g, kt_b, index, uroughness, vroughness)
};
static_assert(all_fields_listed<RoughGlassParameters>);

inline constexpr TexturedField kRoughGlassTextured[] = {
    textured_colour<RoughGlassParameters>("Kr", "kr_r"),
    textured_colour<RoughGlassParameters>("Kt", "kt_r"),
    textured_number<RoughGlassParameters>("uroughness", "uroughness", 0, 1),
    textured_number<RoughGlassParameters>("vroughness", "vroughness", 0, 1),
    textured_number<RoughGlassParameters>("index", "index", 1.001f, 100)};
inline constexpr MaterialTraits kRoughGlassTraits{.name = "rough_glass",
                                                  .delta = false,
                                                  .see_through = false,
                                                  .needs_lobe = true,
                                                  .needs_direction = true,
                                                  .all_around = true,
                                                  .textured = kRoughGlassTextured};

/// LuxRender's own clamp.
inline constexpr float kLeastGlassRoughness = .006f;

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct RoughGlass {
  using Parameters = RoughGlassParameters<Lanes<A>::template Of>;

  static YAT_INLINE MicrofacetLobe<A> lobe_of(const Parameters& p) {
    const Float<A> least(kLeastGlassRoughness);
    return MicrofacetLobe<A>::of(xsimd::max(p.uroughness, least), xsimd::max(p.vroughness, least));
  }
  static YAT_INLINE Float<A> relative_index(const Parameters& p, const BsdfView<A>& view) {
    return xsimd::select(view.outside, Float<A>(1.f) / p.index, p.index);  // n_o / n_i
  }

  /// A facet at which wo meets the other side at cos_o.
  struct Facet {
    Float<A> cos_i;  ///< of the refracted direction; 0: total reflection
    Spectrum<A> reflected, refracted;
    Float<A> chance;  ///< of choosing reflection: by what each brings
    static YAT_INLINE Float<A> refracted_cos(const Float<A>& cos_o, const Float<A>& eta) {
      const Float<A> zero(0.f), one(1.f);
      return xsimd::sqrt(xsimd::max(one - eta * eta * (one - cos_o * cos_o), zero));
    }
    static YAT_INLINE Facet of(const Parameters& p, const Float<A>& cos_o, const Float<A>& cos_i,
                               const Float<A>& eta) {
      const Float<A> zero(0.f), one(1.f);
      Facet f;
      f.cos_i = cos_i;
      const Float<A> fresnel = fresnel_dielectric<A>(cos_o, f.cos_i, eta);
      f.reflected = fresnel * Spectrum<A>{p.kr_r, p.kr_g, p.kr_b};
      f.refracted = (one - fresnel) * Spectrum<A>{p.kt_r, p.kt_g, p.kt_b};
      const Float<A> share = largest(f.reflected), total = share + largest(f.refracted);
      f.chance = xsimd::select(total == zero, total, share / total);
      return f;
    }
  };

  /// f and pdf are made of the same parts.
  struct Value {
    Spectrum<A> f;
    Float<A> pdf;
  };
  static YAT_INLINE Value value(const Parameters& p, const BsdfView<A>& view, const Vec3<A>& wi) {
    const Float<A> zero(0.f), one(1.f);
    const MicrofacetLobe<A> lobe = lobe_of(p);
    const Float<A> eta = relative_index(p, view);
    const Mask<A> reflects = wi.z > zero, refracts = wi.z < zero;
    const Float<A> weight_o = xsimd::select(reflects, one, eta);
    const Vec3<A> sum = weight_o * view.wo + wi;
    // The facet's normal is on the upper side.
    const Float<A> length2 = dot(sum, sum);
    const Vec3<A> h = (xsimd::copysign(one, sum.z) / xsimd::sqrt(length2)) * sum;
    const Float<A> o_h = dot(view.wo, h), i_h = dot(wi, h);
    // Near total reflection the direction itself is the better source of its cosine.
    const Facet facet = Facet::of(
        p, o_h, xsimd::select(reflects, Facet::refracted_cos(o_h, eta), xsimd::abs(i_h)), eta);
    // Refraction leaves on the facet's other side.
    const Mask<A> possible = (o_h > zero) & (reflects | (refracts & (i_h < zero)));
    const Float<A> visible = lobe.visible_distribution(view.wo, h);
    const Float<A> common = lobe.distribution(h) * lobe.shadowing_per_cos(view.wo.z) *
                            lobe.shadowing_per_cos(xsimd::abs(wi.z));
    // dh / dwi, times o.h.
    const Float<A> jacobian =
        xsimd::select(reflects, Float<A>(.25f), o_h * xsimd::abs(i_h) / length2);
    const Float<A> scale = xsimd::select(reflects, one, eta * eta) * jacobian * common;
    Value v;
    v.f = only<A>(possible, scale * select(reflects, facet.reflected, facet.refracted));
    v.pdf = only<A>(possible,
                    visible * jacobian * xsimd::select(reflects, facet.chance, one - facet.chance));
    return v;
  }
  static YAT_INLINE Spectrum<A> evaluate(const Parameters& p, const BsdfView<A>& view,
                                         const Vec3<A>& wi) {
    return value(p, view, wi).f;
  }
  static YAT_INLINE Float<A> pdf(const Parameters& p, const BsdfView<A>& view, const Vec3<A>& wi) {
    return value(p, view, wi).pdf;
  }

  static YAT_INLINE BsdfSample<A> sample(const Parameters& p, const BsdfView<A>& view,
                                         const Float<A>& u_lobe, const Float<A>& u,
                                         const Float<A>& v) {
    const Float<A> zero(0.f), one(1.f);
    const MicrofacetLobe<A> lobe = lobe_of(p);
    const Float<A> eta = relative_index(p, view);
    const Vec3<A>& wo = view.wo;
    const Vec3<A> h = lobe.visible_normal(wo, u, v);
    const Float<A> o_h = xsimd::max(dot(wo, h), zero);
    const Facet facet = Facet::of(p, o_h, Facet::refracted_cos(o_h, eta), eta);
    const Mask<A> reflects = u_lobe < facet.chance;
    BsdfSample<A> s;
    s.wi = select(reflects, (o_h + o_h) * h - wo, (eta * o_h - facet.cos_i) * h - eta * wo);
    const Mask<A> possible = (o_h > zero) & ((s.wi.z > zero) == reflects) & (s.wi.z != zero);
    const Float<A> chance = xsimd::select(reflects, facet.chance, one - facet.chance);
    const Float<A> visible = lobe.visible_distribution(wo, h);
    const Float<A> root = eta * o_h - facet.cos_i;  // |eta wo + wi|, with its sign
    const Float<A> jacobian =
        xsimd::select(reflects, Float<A>(.25f), o_h * facet.cos_i / (root * root));
    s.pdf = only<A>(possible, visible * jacobian * chance);
    // D G G |o.h| / (cos_o pdf of h), with what is in both left out.
    const Float<A> scale = lobe.distribution(h) * lobe.shadowing_per_cos(wo.z) *
                           lobe.shadowing(xsimd::abs(s.wi.z)) / (visible * chance);
    s.weight =
        only<A>(possible & (s.pdf > zero), (scale * xsimd::select(reflects, one, eta * eta)) *
                                               select(reflects, facet.reflected, facet.refracted));
    return s;
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

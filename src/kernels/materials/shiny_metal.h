#pragma once
// LuxRender's shinymetal: a mirror with the Fresnel reflectance of the colour Kr, under a thin
// film, plus a microfacet lobe with that of Ks. The sum may be more than 1: that is its definition.

#include "kernels/materials/metal_colour.h"
#include "kernels/materials/thin_film.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct ShinyMetalParameters {
  Of<float> kr_r, kr_g, kr_b;        ///< colour of the mirror, 0..1
  Of<float> ks_r, ks_g, ks_b;        ///< colour of the lobe, 0..1
  Of<float> uroughness, vroughness;  ///< along dp/du and across it, 0..1
  Of<float> film;                    ///< thickness [nm], >= 0
  Of<float> filmindex;               ///< >= 1
  YAT_FIELDS(kr_r, kr_g, kr_b, ks_r, ks_g, ks_b, uroughness, vroughness, film, filmindex)
};
static_assert(all_fields_listed<ShinyMetalParameters>);

inline constexpr TexturedField kShinyMetalTextured[] = {
    textured_colour<ShinyMetalParameters>("Kr", "kr_r"),
    textured_colour<ShinyMetalParameters>("Ks", "ks_r"),
    textured_number<ShinyMetalParameters>("uroughness", "uroughness", 0, 1),
    textured_number<ShinyMetalParameters>("vroughness", "vroughness", 0, 1)};
inline constexpr MaterialTraits kShinyMetalTraits{.name = "shiny_metal",
                                                  .delta = false,
                                                  .see_through = false,
                                                  .needs_lobe = true,
                                                  .needs_direction = true,
                                                  .textured = kShinyMetalTextured};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct ShinyMetal {
  using Parameters = ShinyMetalParameters<Lanes<A>::template Of>;

  /// What the mirror brings, and how often it is chosen.
  struct Parts {
    Spectrum<A> mirror;
    Float<A> chance;
    static YAT_INLINE Parts of(const Parameters& p, const BsdfView<A>& view) {
      const Float<A> cos = view.wo.z;
      Parts parts;
      parts.mirror = film_factor<A>(p.film, p.filmindex, cos) *
                     fresnel_of_colour<A>({p.kr_r, p.kr_g, p.kr_b}, cos);
      const Float<A> mirror = largest(parts.mirror);
      const Float<A> lobe = largest(fresnel_of_colour<A>({p.ks_r, p.ks_g, p.ks_b}, cos));
      const Float<A> total = mirror + lobe;
      parts.chance = xsimd::select(total == Float<A>(0.f), total, mirror / total);
      return parts;
    }
  };

  static YAT_INLINE Spectrum<A> evaluate(const Parameters& p, const BsdfView<A>& view,
                                         const Vec3<A>& wi) {
    const auto lobe = MicrofacetLobe<A>::of(p.uroughness, p.vroughness);
    const Vec3<A> h = lobe.half_vector(view.wo, wi);
    return only<A>(wi.z > Float<A>(0.f),
                   lobe.evaluate(view.wo, wi, h) *
                       fresnel_of_colour<A>({p.ks_r, p.ks_g, p.ks_b}, dot(view.wo, h)));
  }
  static YAT_INLINE Float<A> pdf(const Parameters& p, const BsdfView<A>& view, const Vec3<A>& wi) {
    const auto lobe = MicrofacetLobe<A>::of(p.uroughness, p.vroughness);
    const Float<A> share = Float<A>(1.f) - Parts::of(p, view).chance;
    return only<A>(wi.z > Float<A>(0.f), share * lobe.pdf(view.wo, lobe.half_vector(view.wo, wi)));
  }
  static YAT_INLINE BsdfSample<A> sample(const Parameters& p, const BsdfView<A>& view,
                                         const Float<A>& u_lobe, const Float<A>& u,
                                         const Float<A>& v) {
    const Float<A> one(1.f), zero(0.f);
    const Parts parts = Parts::of(p, view);
    const auto rough = MicrofacetLobe<A>::of(p.uroughness, p.vroughness).sample(view.wo, u, v);
    const Spectrum<A> lobe = (rough.weight / (one - parts.chance)) *
                             fresnel_of_colour<A>({p.ks_r, p.ks_g, p.ks_b}, rough.cos_h);
    const Spectrum<A> mirror = (one / parts.chance) * parts.mirror;
    const Mask<A> mirrors = u_lobe < parts.chance;
    BsdfSample<A> s;
    s.wi = select(mirrors, Vec3<A>{-view.wo.x, -view.wo.y, view.wo.z}, rough.wi);
    s.weight = select(mirrors, mirror, lobe);
    s.pdf = xsimd::select(mirrors, zero, (one - parts.chance) * rough.pdf);
    return s;
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

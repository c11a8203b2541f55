#pragma once
// LuxRender's glossy, "separable" (lxs 7.3): a coat on the outside of a Lambert or Oren-Nayar base,
// which is bare on the inside. "multibounce" adds S min((1 - G(o) G(i)) / (4 cos_o cos_i), 1).

#include "kernels/materials/coated_diffuse.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct GlossyParameters {
  Of<float> kd_r, kd_g, kd_b;        ///< reflectance of the base, 0..1
  Of<float> ks_r, ks_g, ks_b;        ///< of the coat, head-on, 0..1
  Of<float> ka_r, ka_g, ka_b;        ///< absorption of the coat [1/m], >= 0
  Of<float> depth;                   ///< thickness of the coat [m], >= 0
  Of<float> index;                   ///< refractive index that Ks counts times; 0: in full
  Of<float> uroughness, vroughness;  ///< 0..1
  Of<float> sigma;                   ///< of the base, as OrenNayarParameters [degrees]
  Of<float> multibounce;             ///< 1 or 0
  YAT_FIELDS(kd_r, kd_g, kd_b, ks_r, ks_g, ks_b, ka_r, ka_g, ka_b, depth, index, uroughness,
             vroughness, sigma, multibounce)
};
static_assert(all_fields_listed<GlossyParameters>);

inline constexpr TexturedField kGlossyTextured[] = {
    textured_colour<GlossyParameters>("Kd", "kd_r"),
    textured_colour<GlossyParameters>("Ks", "ks_r"),
    textured_colour<GlossyParameters>("Ka", "ka_r"),
    textured_number<GlossyParameters>("d", "depth", 0, 1e6f),
    textured_number<GlossyParameters>("index", "index", 0, 100),
    textured_number<GlossyParameters>("uroughness", "uroughness", 1e-6f, 1),
    textured_number<GlossyParameters>("vroughness", "vroughness", 1e-6f, 1),
    textured_number<GlossyParameters>("sigma", "sigma", 0, 90)};
inline constexpr MaterialTraits kGlossyTraits{.name = "glossy",
                                              .delta = false,
                                              .see_through = false,
                                              .needs_lobe = true,
                                              .needs_direction = true,
                                              .textured = kGlossyTextured};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct Glossy {
  using Parameters = GlossyParameters<Lanes<A>::template Of>;

  /// What does not depend on wi.
  struct Parts {
    MicrofacetLobe<A> lobe;
    Spectrum<A> r0, kd, ka;
    Float<A> chance;  ///< of the coat
    static YAT_INLINE Parts of(const Parameters& p, const BsdfView<A>& view) {
      const Float<A> one(1.f), zero(0.f), cos = view.wo.z;
      Parts s{MicrofacetLobe<A>::of(p.uroughness, p.vroughness),
              coat_reflectance<A>({p.ks_r, p.ks_g, p.ks_b}, p.index),
              {p.kd_r, p.kd_g, p.kd_b},
              {p.ka_r, p.ka_g, p.ka_b},
              zero};
      const Spectrum<A> fresnel = coat_fresnel<A>(s.r0, cos);
      Spectrum<A> base =
          coat_absorption<A>(s.ka, p.depth, one + one / cos) * (one_minus<A>(fresnel) * s.kd);
      // The light between the facets goes everywhere, as the base's does.
      base = sum<A>(base, p.multibounce * fresnel);
      s.chance = xsimd::select(view.outside, coat_chance<A>(fresnel, base), zero);
      return s;
    }
  };

  static YAT_INLINE Scattered<A> both(const Parameters& p, const BsdfView<A>& view,
                                      const Parts& parts, const Vec3<A>& wi) {
    const Float<A> one(1.f), zero(0.f);
    const Vec3<A>& wo = view.wo;
    const Vec3<A> h = MicrofacetLobe<A>::half_vector(wo, wi);
    const Spectrum<A> fresnel = coat_fresnel<A>(parts.r0, dot(wi, h));
    const Float<A> coat =
        parts.lobe.evaluate(wo, wi, h) + p.multibounce * between_facets<A>(parts.lobe, wo, wi, 1);
    const Spectrum<A> bare = (Float<A>(kInvPi) * oren_nayar<A>(p.sigma, wo, wi)) * parts.kd;
    const Spectrum<A> covered = coat_absorption<A>(parts.ka, p.depth, one / wo.z + one / wi.z) *
                                (one_minus<A>(fresnel) * bare);
    const Mask<A> above = wi.z > zero;
    return {only<A>(above, select<A>(view.outside, sum<A>(coat * fresnel, covered), bare)),
            only<A>(above, parts.chance * parts.lobe.pdf(wo, h) +
                               (one - parts.chance) * cosine_hemisphere_pdf<A>(wi.z))};
  }

  static YAT_INLINE Spectrum<A> evaluate(const Parameters& p, const BsdfView<A>& view,
                                         const Vec3<A>& wi) {
    return both(p, view, Parts::of(p, view), wi).f;
  }
  static YAT_INLINE Float<A> pdf(const Parameters& p, const BsdfView<A>& view, const Vec3<A>& wi) {
    return both(p, view, Parts::of(p, view), wi).pdf;
  }
  static YAT_INLINE BsdfSample<A> sample(const Parameters& p, const BsdfView<A>& view,
                                         const Float<A>& u_lobe, const Float<A>& u,
                                         const Float<A>& v) {
    const Parts parts = Parts::of(p, view);
    return sample_coated<A>(parts.lobe, parts.chance, coat_fresnel<A>(parts.r0, view.wo.z), view.wo,
                            u_lobe, u, v,
                            [&](const Vec3<A>& wi) { return both(p, view, parts, wi); });
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

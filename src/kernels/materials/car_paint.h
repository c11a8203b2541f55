#pragma once
// LuxRender's carpaint (lxs 7.2, 7.3): a Lambert base Kd under a coat that absorbs, and on the
// outside three microfacet lobes on top of it, each Ks_j times Schlick's reflectance from R_j, of
// roughness M_j. Nothing is taken from the base for what the lobes reflect.

#include "kernels/materials/coated_diffuse.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct CarPaintParameters {
  Of<float> kd_r, kd_g, kd_b;     ///< reflectance of the base, 0..1
  Of<float> ks1_r, ks1_g, ks1_b;  ///< weight of the first lobe, 0..1
  Of<float> ks2_r, ks2_g, ks2_b;  ///< of the second
  Of<float> ks3_r, ks3_g, ks3_b;  ///< of the third
  Of<float> r1, r2, r3;           ///< reflectance of each lobe head-on, 0..1
  Of<float> m1, m2, m3;           ///< roughness of each, 0..1; 0: it is not there
  Of<float> ka_r, ka_g, ka_b;     ///< absorption over the base [1/m], >= 0
  Of<float> depth;                ///< thickness of what absorbs [m], >= 0
  YAT_FIELDS(kd_r, kd_g, kd_b, ks1_r, ks1_g, ks1_b, ks2_r, ks2_g, ks2_b, ks3_r, ks3_g, ks3_b, r1,
             r2, r3, m1, m2, m3, ka_r, ka_g, ka_b, depth)
};
static_assert(all_fields_listed<CarPaintParameters>);

inline constexpr MaterialTraits kCarPaintTraits{.name = "car_paint",
                                                .delta = false,
                                                .see_through = false,
                                                .needs_lobe = true,
                                                .needs_direction = true};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct CarPaint : EvaluateByParts<A, CarPaint<A>, CarPaintParameters<Lanes<A>::template Of>> {
  using Parameters = CarPaintParameters<Lanes<A>::template Of>;
  static constexpr int kLobes = 3;

  /// What does not depend on wi. Lobes are never so smooth that they have no width.
  struct Parts {
    MicrofacetLobe<A> lobe[kLobes];
    Spectrum<A> ks[kLobes], kd, ka;
    Float<A> r[kLobes];
    Float<A> chance[kLobes];  ///< of each lobe; the rest is the base's
    static YAT_INLINE Parts of(const Parameters& p, const BsdfView<A>& view) {
      const Float<A> one(1.f), zero(0.f), cos = view.wo.z, least(kMirrorRoughness);
      const Float<A> m[kLobes] = {p.m1, p.m2, p.m3};
      Parts s{
          {},
          {{p.ks1_r, p.ks1_g, p.ks1_b}, {p.ks2_r, p.ks2_g, p.ks2_b}, {p.ks3_r, p.ks3_g, p.ks3_b}},
          {p.kd_r, p.kd_g, p.kd_b},
          {p.ka_r, p.ka_g, p.ka_b},
          {p.r1, p.r2, p.r3},
          {}};
      Float<A> total = largest(coat_absorption<A>(s.ka, p.depth, one + one / cos) * s.kd);
      for (int k = 0; k < kLobes; ++k) {
        const Float<A> rough = xsimd::max(m[k], least);
        s.lobe[k] = MicrofacetLobe<A>::of(rough, rough);
        s.ks[k] = only<A>(view.outside & (m[k] > zero), s.ks[k]);
        s.chance[k] =
            lobe_albedo<A>(s.lobe[k]) * (largest(s.ks[k]) * fresnel_schlick<A>(s.r[k], cos));
        total = total + s.chance[k];
      }
      for (int k = 0; k < kLobes; ++k)
        s.chance[k] = xsimd::select(total > zero, s.chance[k] / total, zero);
      return s;
    }
  };

  static YAT_INLINE Scattered<A> both(const Parameters& p, const BsdfView<A>& view,
                                      const Parts& parts, const Vec3<A>& wi) {
    const Float<A> one(1.f);
    const Vec3<A>& wo = view.wo;
    const Vec3<A> h = MicrofacetLobe<A>::half_vector(wo, wi);
    const Float<A> cos_h = dot(wi, h);
    Spectrum<A> f = coat_absorption<A>(parts.ka, p.depth, one / wo.z + one / wi.z) *
                    (Float<A>(kInvPi) * parts.kd);
    Float<A> base = one, pdf(0.f);
    for (int k = 0; k < kLobes; ++k) {
      const Float<A> lobe =
          parts.lobe[k].evaluate(wo, wi, h) * fresnel_schlick<A>(parts.r[k], cos_h);
      f = f + lobe * parts.ks[k];
      pdf = pdf + parts.chance[k] * parts.lobe[k].pdf(wo, h);
      base = base - parts.chance[k];
    }
    pdf = pdf + xsimd::max(base, Float<A>(0.f)) * cosine_hemisphere_pdf<A>(wi.z);
    const Mask<A> above = (wi.z > Float<A>(0.f)) & (wo.z > Float<A>(0.f));
    return {only<A>(above, f), only<A>(above, pdf)};
  }

  static YAT_INLINE BsdfSample<A> sample(const Parameters& p, const BsdfView<A>& view,
                                         const Float<A>& u_lobe, const Float<A>& u,
                                         const Float<A>& v) {
    const Parts parts = Parts::of(p, view);
    const Float<A> zero(0.f);
    // The lobes lie side by side in [0, 1), the base after them.
    MicrofacetLobe<A> chosen = parts.lobe[0];
    Float<A> end = parts.chance[0];
    for (int k = 1; k < kLobes; ++k) {
      const Mask<A> beyond = u_lobe >= end;
      chosen.x = xsimd::select(beyond, parts.lobe[k].x, chosen.x);
      chosen.y = xsimd::select(beyond, parts.lobe[k].y, chosen.y);
      end = end + parts.chance[k];
    }
    BsdfSample<A> s;
    s.wi =
        select(u_lobe < end, chosen.sample(view.wo, u, v).wi, square_to_cosine_hemisphere<A>(u, v));
    const Scattered<A> value = both(p, view, parts, s.wi);
    s.pdf = value.pdf;
    s.weight = only<A>(value.pdf > zero, (s.wi.z / value.pdf) * value.f);
    return s;
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

#pragma once
// LuxRender's glossytranslucent (lxs 7.2): a diffuse sheet with a coat on each side. Reflection is
// that of glossy that is not separable, with the coat of the side that is seen; with a multibounce
// term S min((1 - G(o) G(i)) / (4 pi cos_o cos_i), 1). Transmission is
//   Kt/pi (1 - Kd) sqrt((1 - S1) (1 - S2)) a,
// the S taken for the half vector with the direction behind mirrored at the surface, the absorption
// a by each coat over its own leg.

#include "kernels/materials/coated_diffuse.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct GlossyTranslucentParameters {
  Of<float> kd_r, kd_g, kd_b;  ///< diffuse reflectance, 0..1
  Of<float> kt_r, kt_g, kt_b;  ///< diffuse transmittance, 0..1, of what is not reflected
  // The coat outside; as GlossyParameters.
  Of<float> ks_r, ks_g, ks_b, ka_r, ka_g, ka_b, depth, index, uroughness, vroughness, multibounce;
  // The coat inside.
  Of<float> back_ks_r, back_ks_g, back_ks_b, back_ka_r, back_ka_g, back_ka_b, back_depth,
      back_index, back_uroughness, back_vroughness, back_multibounce;
  YAT_FIELDS(kd_r, kd_g, kd_b, kt_r, kt_g, kt_b, ks_r, ks_g, ks_b, ka_r, ka_g, ka_b, depth, index,
             uroughness, vroughness, multibounce, back_ks_r, back_ks_g, back_ks_b, back_ka_r,
             back_ka_g, back_ka_b, back_depth, back_index, back_uroughness, back_vroughness,
             back_multibounce)
};
static_assert(all_fields_listed<GlossyTranslucentParameters>);

inline constexpr TexturedField kGlossyTranslucentTextured[] = {
    textured_colour<GlossyTranslucentParameters>("Kd", "kd_r"),
    textured_colour<GlossyTranslucentParameters>("Kt", "kt_r"),
    textured_colour<GlossyTranslucentParameters>("Ks", "ks_r"),
    textured_colour<GlossyTranslucentParameters>("Ka", "ka_r"),
    textured_number<GlossyTranslucentParameters>("d", "depth", 0, 1e6f),
    textured_number<GlossyTranslucentParameters>("index", "index", 0, 100),
    textured_number<GlossyTranslucentParameters>("uroughness", "uroughness", .006f, 1),
    textured_number<GlossyTranslucentParameters>("vroughness", "vroughness", .006f, 1)};
inline constexpr MaterialTraits kGlossyTranslucentTraits{.name = "glossy_translucent",
                                                         .delta = false,
                                                         .see_through = false,
                                                         .needs_lobe = true,
                                                         .needs_direction = true,
                                                         .all_around = true,
                                                         .textured = kGlossyTranslucentTextured};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct GlossyTranslucent
    : EvaluateByParts<A, GlossyTranslucent<A>, GlossyTranslucentParameters<Lanes<A>::template Of>> {
  using Parameters = GlossyTranslucentParameters<Lanes<A>::template Of>;

  struct Coat {
    Spectrum<A> r0, ka;
    Float<A> depth;
  };
  /// What does not depend on wi.
  struct Parts {
    MicrofacetLobe<A> lobe;
    Coat here, there;  ///< on the side that is seen, and on the other
    Spectrum<A> kd, kt;
    Float<A> multibounce;
    Float<A> coat, through;  ///< chances of the lobe and of transmission
    static YAT_INLINE Parts of(const Parameters& p, const BsdfView<A>& view) {
      const Float<A> one(1.f), zero(0.f), cos = view.wo.z, least(.006f);
      const Mask<A>& out = view.outside;
      const auto rough = [&](const Float<A>& front, const Float<A>& back) {
        return xsimd::max(xsimd::select(out, front, back), least);
      };
      const Coat front{coat_reflectance<A>({p.ks_r, p.ks_g, p.ks_b}, p.index),
                       {p.ka_r, p.ka_g, p.ka_b},
                       p.depth};
      const Coat back{coat_reflectance<A>({p.back_ks_r, p.back_ks_g, p.back_ks_b}, p.back_index),
                      {p.back_ka_r, p.back_ka_g, p.back_ka_b},
                      p.back_depth};
      Parts s{MicrofacetLobe<A>::of(rough(p.uroughness, p.back_uroughness),
                                    rough(p.vroughness, p.back_vroughness)),
              {select<A>(out, front.r0, back.r0), select<A>(out, front.ka, back.ka),
               xsimd::select(out, front.depth, back.depth)},
              {select<A>(out, back.r0, front.r0), select<A>(out, back.ka, front.ka),
               xsimd::select(out, back.depth, front.depth)},
              {p.kd_r, p.kd_g, p.kd_b},
              {p.kt_r * (one - p.kd_r), p.kt_g * (one - p.kd_g), p.kt_b * (one - p.kd_b)},
              xsimd::select(out, p.multibounce, p.back_multibounce),
              zero,
              zero};
      const Spectrum<A> fresnel = coat_fresnel<A>(s.here.r0, cos);
      const Spectrum<A> enters =
          coat_absorption<A>(s.here.ka, s.here.depth, one + one / cos) * one_minus<A>(fresnel);
      const Float<A> reflected = largest(fresnel), coat = lobe_albedo<A>(s.lobe) * reflected;
      const Float<A> through = largest(enters * s.kt);
      const Float<A> total = coat + through + largest(enters * s.kd) + s.multibounce * reflected;
      // Estimates: the lobe leaves an eighth to the others, if they bring anything.
      const Float<A> share = xsimd::select(total > zero, coat / total, zero);
      s.coat = xsimd::select(total > coat, xsimd::min(share, Float<A>(.875f)), share);
      s.through = xsimd::select(total > coat, (one - s.coat) * through / (total - coat), zero);
      return s;
    }
  };

  static YAT_INLINE Scattered<A> both(const Parameters&, const BsdfView<A>& view,
                                      const Parts& parts, const Vec3<A>& wi) {
    const Float<A> one(1.f), zero(0.f), inverse_pi(kInvPi);
    const Vec3<A>& wo = view.wo;
    const Mask<A> seen = wo.z > zero, above = wi.z > zero;
    const Float<A> cos_i = xsimd::abs(wi.z);
    const Vec3<A> h = MicrofacetLobe<A>::half_vector(wo, {wi.x, wi.y, cos_i});
    const Float<A> cos_h = dot(wo, h);
    const Spectrum<A> here = coat_fresnel<A>(parts.here.r0, cos_h);
    const Spectrum<A> there = coat_fresnel<A>(parts.there.r0, cos_h);

    // Without a coat the lobe is black, and so is what is between its facets.
    const Float<A> lobe =
        parts.lobe.evaluate(wo, {wi.x, wi.y, cos_i}, h) +
        parts.multibounce * between_facets<A>(parts.lobe, wo, {wi.x, wi.y, cos_i}, kPi);
    const Spectrum<A> reflected = lobe * here + coat_absorption<A>(parts.here.ka, parts.here.depth,
                                                                   one / wo.z + one / cos_i) *
                                                    (one_minus<A>(here) * (inverse_pi * parts.kd));
    const Spectrum<A> enters = one_minus<A>(here) * one_minus<A>(there);
    const Spectrum<A> legs = coat_absorption<A>(parts.here.ka, parts.here.depth, one / wo.z) *
                             coat_absorption<A>(parts.there.ka, parts.there.depth, one / cos_i);
    const Spectrum<A> transmitted =
        legs * (Spectrum<A>{xsimd::sqrt(enters.r), xsimd::sqrt(enters.g), xsimd::sqrt(enters.b)} *
                (inverse_pi * parts.kt));
    const Float<A> cosine = inverse_pi * cos_i;
    const Float<A> base = xsimd::max(one - parts.coat - parts.through, zero);
    return {only<A>(seen & (cos_i > zero), select<A>(above, reflected, transmitted)),
            only<A>(seen, xsimd::select(above, parts.coat * parts.lobe.pdf(wo, h) + base * cosine,
                                        parts.through * cosine))};
  }

  static YAT_INLINE BsdfSample<A> sample(const Parameters& p, const BsdfView<A>& view,
                                         const Float<A>& u_lobe, const Float<A>& u,
                                         const Float<A>& v) {
    const Parts parts = Parts::of(p, view);
    const Float<A> zero(0.f);
    const Mask<A> coat = u_lobe < parts.coat;
    const Mask<A> through = (u_lobe >= parts.coat) & (u_lobe < parts.coat + parts.through);
    const Vec3<A> w = square_to_cosine_hemisphere<A>(u, v);
    BsdfSample<A> s;
    s.wi = select(coat, parts.lobe.sample(view.wo, u, v).wi,
                  Vec3<A>{w.x, w.y, xsimd::select(through, -w.z, w.z)});
    const Scattered<A> value = both(p, view, parts, s.wi);
    // A facet may reflect below the horizon: that is no transmission.
    const Mask<A> kept = (value.pdf > zero) & !(coat & (s.wi.z <= zero));
    s.pdf = only<A>(kept, value.pdf);
    s.weight = only<A>(kept, (xsimd::abs(s.wi.z) / value.pdf) * value.f);
    return s;
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

#pragma once
// LuxRender's glossy, not "separable" (lxs 7.3): a coat on the outside of a Lambert base; what it
// takes from the base it takes on the inside too. "multibounce" adds
// S min((1 - G(o) G(i)) / (4 pi cos_o cos_i), 1).

#include "kernels/materials/coated_diffuse.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct GlossySingleParameters {
  Of<float> kd_r, kd_g, kd_b;        ///< reflectance of the base, 0..1
  Of<float> ks_r, ks_g, ks_b;        ///< of the coat, head-on, 0..1
  Of<float> ka_r, ka_g, ka_b;        ///< absorption of the coat [1/m], >= 0
  Of<float> depth;                   ///< thickness of the coat [m], >= 0
  Of<float> index;                   ///< refractive index that Ks counts times; 0: in full
  Of<float> uroughness, vroughness;  ///< at least .006 is used
  Of<float> multibounce;             ///< 1 or 0
  YAT_FIELDS(kd_r, kd_g, kd_b, ks_r, ks_g, ks_b, ka_r, ka_g, ka_b, depth, index, uroughness,
             vroughness, multibounce)
};
static_assert(all_fields_listed<GlossySingleParameters>);

inline constexpr TexturedField kGlossySingleTextured[] = {
    textured_colour<GlossySingleParameters>("Kd", "kd_r"),
    textured_colour<GlossySingleParameters>("Ks", "ks_r"),
    textured_colour<GlossySingleParameters>("Ka", "ka_r"),
    textured_number<GlossySingleParameters>("d", "depth", 0, 1e6f),
    textured_number<GlossySingleParameters>("index", "index", 0, 100),
    textured_number<GlossySingleParameters>("uroughness", "uroughness", .006f, 1),
    textured_number<GlossySingleParameters>("vroughness", "vroughness", .006f, 1)};
inline constexpr MaterialTraits kGlossySingleTraits{.name = "glossy_single",
                                                    .delta = false,
                                                    .see_through = false,
                                                    .needs_lobe = true,
                                                    .needs_direction = true,
                                                    .textured = kGlossySingleTextured};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct GlossySingle
    : CoatedDiffuse<A, GlossySingle<A>, GlossySingleParameters<Lanes<A>::template Of>> {
  using Parameters = GlossySingleParameters<Lanes<A>::template Of>;
  using Parts = typename CoatedDiffuse<A, GlossySingle, Parameters>::Parts;
  static constexpr float kLeastRoughness = .006f;
  static constexpr bool kCoatInside = false;
  static constexpr bool kShadowed = true;

  static YAT_INLINE Spectrum<A> base_share(const Parameters& p, const Parts& parts, const Vec3<A>&,
                                           const Spectrum<A>& fresnel, const Spectrum<A>& covered) {
    // The light between the facets goes everywhere, as the base's does.
    return covered * (one_minus<A>(fresnel) * parts.kd) + p.multibounce * fresnel;
  }
  static YAT_INLINE Spectrum<A> value(const Parameters& p, const BsdfView<A>& view,
                                      const Parts& parts, const Vec3<A>& wi, const Vec3<A>& h) {
    const Float<A> one(1.f);
    const Vec3<A>& wo = view.wo;
    const Spectrum<A> fresnel = coat_fresnel<A>(parts.r0, dot(wi, h));
    const Float<A> coat =
        parts.lobe.evaluate(wo, wi, h) + p.multibounce * between_facets<A>(parts.lobe, wo, wi, kPi);
    const Spectrum<A> covered = coat_absorption<A>(parts.ka, p.depth, one / wo.z + one / wi.z) *
                                (one_minus<A>(fresnel) * (Float<A>(kInvPi) * parts.kd));
    return covered + only<A>(view.outside, coat * fresnel);
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

#pragma once
// LuxRender's glossy_lossy, substrate and plastic (lxs 7.3; Ashikhmin, Shirley, "An Anisotropic
// Phong BRDF Model", 2000), on both sides: with R0 and the absorption a of coated_diffuse.h,
//   f = 28/(23 pi) Kd (1 - R0) (1 - (1 - cos_i/2)^5) (1 - (1 - cos_o/2)^5) a
//       + D(h) Schlick(R0, i.h) / (4 (i.h) max(cos_i, cos_o)).

#include "kernels/materials/coated_diffuse.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct GlossyLossyParameters {
  Of<float> kd_r, kd_g, kd_b;        ///< reflectance of the base, 0..1
  Of<float> ks_r, ks_g, ks_b;        ///< of the coat, head-on, 0..1
  Of<float> ka_r, ka_g, ka_b;        ///< absorption of the coat [1/m], >= 0
  Of<float> depth;                   ///< thickness of the coat [m], >= 0
  Of<float> index;                   ///< refractive index that Ks counts times; 0: in full
  Of<float> uroughness, vroughness;  ///< 0..1
  YAT_FIELDS(kd_r, kd_g, kd_b, ks_r, ks_g, ks_b, ka_r, ka_g, ka_b, depth, index, uroughness,
             vroughness)
};
static_assert(all_fields_listed<GlossyLossyParameters>);

inline constexpr TexturedField kGlossyLossyTextured[] = {
    textured_colour<GlossyLossyParameters>("Kd", "kd_r"),
    textured_colour<GlossyLossyParameters>("Ks", "ks_r"),
    textured_colour<GlossyLossyParameters>("Ka", "ka_r"),
    textured_number<GlossyLossyParameters>("d", "depth", 0, 1e6f),
    textured_number<GlossyLossyParameters>("index", "index", 0, 100),
    textured_number<GlossyLossyParameters>("uroughness", "uroughness", 1e-6f, 1),
    textured_number<GlossyLossyParameters>("vroughness", "vroughness", 1e-6f, 1)};
inline constexpr MaterialTraits kGlossyLossyTraits{.name = "glossy_lossy",
                                                   .delta = false,
                                                   .see_through = false,
                                                   .needs_lobe = true,
                                                   .needs_direction = true,
                                                   .textured = kGlossyLossyTextured};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct GlossyLossy
    : CoatedDiffuse<A, GlossyLossy<A>, GlossyLossyParameters<Lanes<A>::template Of>> {
  using Parameters = GlossyLossyParameters<Lanes<A>::template Of>;
  using Parts = typename CoatedDiffuse<A, GlossyLossy, Parameters>::Parts;
  static constexpr float kLeastRoughness = 0;
  static constexpr bool kCoatInside = true;
  static constexpr bool kShadowed = false;

  /// Reflectance of the base but for what depends on wi: 28/23 Kd (1 - R0) (1 - (1 - cos_o/2)^5).
  static YAT_INLINE Spectrum<A> base(const Parts& parts, const Vec3<A>& wo) {
    return (Float<A>(28.f / 23) * rim(wo.z)) * (one_minus<A>(parts.r0) * parts.kd);
  }
  /// 1 - (1 - cos/2)^5.
  static YAT_INLINE Float<A> rim(const Float<A>& cos) {
    return Float<A>(1.f) - fifth_power<A>(Float<A>(1.f) - Float<A>(.5f) * cos);
  }
  static YAT_INLINE Spectrum<A> base_share(const Parameters&, const Parts& parts, const Vec3<A>& wo,
                                           const Spectrum<A>&, const Spectrum<A>& covered) {
    return covered * base(parts, wo);
  }
  static YAT_INLINE Spectrum<A> value(const Parameters& p, const BsdfView<A>& view,
                                      const Parts& parts, const Vec3<A>& wi, const Vec3<A>& h) {
    const Float<A> one(1.f), cos_h = dot(wi, h);
    const Vec3<A>& wo = view.wo;
    const Float<A> coat = only<A>(!parts.lobe.smooth, Float<A>(.25f) * parts.lobe.distribution(h) /
                                                          (cos_h * xsimd::max(wi.z, wo.z)));
    return coat * coat_fresnel<A>(parts.r0, cos_h) +
           coat_absorption<A>(parts.ka, p.depth, one / wo.z + one / wi.z) *
               ((Float<A>(kInvPi) * rim(wi.z)) * base(parts, wo));
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

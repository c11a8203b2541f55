#pragma once
// Rough diffuse reflection on both sides (kernels/materials/rough_diffuse.h).

#include "kernels/materials/rough_diffuse.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct OrenNayarParameters {
  Of<float> kd_r, kd_g, kd_b;  ///< reflectance, 0..1
  Of<float> sigma;             ///< standard deviation of the facets' slope angle [degrees], 0..90
  YAT_FIELDS(kd_r, kd_g, kd_b, sigma)
};
static_assert(all_fields_listed<OrenNayarParameters>);

inline constexpr TexturedField kOrenNayarTextured[] = {
    textured_colour<OrenNayarParameters>("Kd", "kd_r"),
    textured_number<OrenNayarParameters>("sigma", "sigma", 0, 90)};
inline constexpr MaterialTraits kOrenNayarTraits{.name = "oren_nayar",
                                                 .delta = false,
                                                 .see_through = false,
                                                 .needs_lobe = false,
                                                 .needs_direction = true,
                                                 .textured = kOrenNayarTextured};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct OrenNayar {
  using Parameters = OrenNayarParameters<Lanes<A>::template Of>;

  static YAT_INLINE Spectrum<A> evaluate(const Parameters& p, const BsdfView<A>& view,
                                         const Vec3<A>& wi) {
    const Float<A> f = Float<A>(kInvPi) * oren_nayar<A>(p.sigma, view.wo, wi);
    return only<A>(wi.z > Float<A>(0.f), f * Spectrum<A>{p.kd_r, p.kd_g, p.kd_b});
  }
  static YAT_INLINE Float<A> pdf(const Parameters&, const BsdfView<A>&, const Vec3<A>& wi) {
    return cosine_hemisphere_pdf<A>(wi.z);
  }
  static YAT_INLINE BsdfSample<A> sample(const Parameters& p, const BsdfView<A>& view,
                                         const Float<A>&, const Float<A>& u, const Float<A>& v) {
    BsdfSample<A> s;
    s.wi = square_to_cosine_hemisphere<A>(u, v);
    s.pdf = cosine_hemisphere_pdf<A>(s.wi.z);
    s.weight = only<A>(s.pdf > Float<A>(0.f),
                       oren_nayar<A>(p.sigma, view.wo, s.wi) * Spectrum<A>{p.kd_r, p.kd_g, p.kd_b});
    return s;
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

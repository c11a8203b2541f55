#pragma once
// Rough diffuse reflection on both sides. Source: Oren, Nayar, "Generalization of Lambert's
// Reflectance Model", 1994, the short form that LuxRender uses (lxs 7.2):
//   f = Kd/pi (A + B max(0, cos(phi_i - phi_o)) sin(alpha) tan(beta)),
//   A = 1 - s^2 / (2 (s^2 + .33)), B = .45 s^2 / (s^2 + .09).
// Its albedo passes 1 by up to 1.3 % at grazing angles for small sigma: the model's own fault, kept
// for agreement with LuxRender.

#include "kernels/material.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct OrenNayarParameters {
  Of<float> kd_r, kd_g, kd_b;  ///< reflectance, 0..1
  Of<float> sigma;             ///< standard deviation of the facets' slope angle [rad], 0..pi/2
  YAT_FIELDS(kd_r, kd_g, kd_b, sigma)
};
static_assert(all_fields_listed<OrenNayarParameters>);

inline constexpr MaterialTraits kOrenNayarTraits{.name = "oren_nayar",
                                                 .delta = false,
                                                 .see_through = false,
                                                 .needs_lobe = false,
                                                 .needs_direction = true};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct OrenNayar {
  using Parameters = OrenNayarParameters<Lanes<A>::template Of>;

  /// f pi / Kd. No trigonometry: sin(alpha) tan(beta) = sin_i sin_o / max(cos_i, cos_o), and the
  /// sines with the cosine of the azimuths are the dot product of the tangential parts.
  static YAT_INLINE Float<A> roughness_term(const Parameters& p, const Vec3<A>& wo,
                                            const Vec3<A>& wi) {
    const Float<A> zero(0.f), s2 = p.sigma * p.sigma;
    const Float<A> a = Float<A>(1.f) - s2 / (Float<A>(2.f) * (s2 + Float<A>(.33f)));
    const Float<A> b = Float<A>(.45f) * s2 / (s2 + Float<A>(.09f));
    const Float<A> tangential = xsimd::max(wo.x * wi.x + wo.y * wi.y, zero);
    const Float<A> steeper = xsimd::max(wo.z, wi.z);
    return a + b * xsimd::select(steeper > zero, tangential / steeper, zero);
  }
  static YAT_INLINE Spectrum<A> evaluate(const Parameters& p, const BsdfView<A>& view,
                                         const Vec3<A>& wi) {
    const Float<A> f = Float<A>(kInvPi) * roughness_term(p, view.wo, wi);
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
                       roughness_term(p, view.wo, s.wi) * Spectrum<A>{p.kd_r, p.kd_g, p.kd_b});
    return s;
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

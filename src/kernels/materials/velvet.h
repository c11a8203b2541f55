#pragma once
// LuxRender's velvet (lxs 7.2): a layer of fibres that scatters once, on both sides. With
// c = -wo.wi and the phase function
//   P = (1 + p1 c + p2 (3 c^2 - 1) / 2 + p3 (5 c^3 - 3 c) / 2) / (4 pi)
// it is f cos_i = Kd clamp(P thickness / cos_o, 0, 1). The clamp makes it one-way at grazing
// angles, and with a thick layer its albedo passes 1 (by the definition up to 2 pi Kd): kept for
// agreement with LuxRender.

#include "kernels/material.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct VelvetParameters {
  Of<float> kd_r, kd_g, kd_b;  ///< 0..1
  Of<float> p1, p2, p3;        ///< weights of the phase function's Legendre polynomials
  Of<float> thickness;         ///< 0..1
  YAT_FIELDS(kd_r, kd_g, kd_b, p1, p2, p3, thickness)
};
static_assert(all_fields_listed<VelvetParameters>);

inline constexpr TexturedField kVelvetTextured[] = {
    textured_colour<VelvetParameters>("Kd", "kd_r"),
    textured_number<VelvetParameters>("p1", "p1", -1e6f, 1e6f),
    textured_number<VelvetParameters>("p2", "p2", -1e6f, 1e6f),
    textured_number<VelvetParameters>("p3", "p3", -1e6f, 1e6f),
    textured_number<VelvetParameters>("thickness", "thickness", 0, 1)};
inline constexpr MaterialTraits kVelvetTraits{.name = "velvet",
                                              .delta = false,
                                              .see_through = false,
                                              .needs_lobe = false,
                                              .needs_direction = true,
                                              .textured = kVelvetTextured};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct Velvet {
  using Parameters = VelvetParameters<Lanes<A>::template Of>;

  /// f cos_i / Kd, wi on the side of z.
  static YAT_INLINE Float<A> fibres(const Parameters& p, const Vec3<A>& wo, const Vec3<A>& wi) {
    const Float<A> zero(0.f), one(1.f), half(.5f), three(3.f);
    const Float<A> c = -dot(wo, wi), c2 = c * c;
    const Float<A> series = one + p.p1 * c + p.p2 * half * (three * c2 - one) +
                            p.p3 * half * c * (Float<A>(5.f) * c2 - three);
    const Float<A> scattered = series * p.thickness * Float<A>(kInvPi / 4);
    // wo.z may be -0.
    return xsimd::select(scattered > zero, xsimd::min(scattered / xsimd::abs(wo.z), one), zero);
  }

  static YAT_INLINE Spectrum<A> evaluate(const Parameters& p, const BsdfView<A>& view,
                                         const Vec3<A>& wi) {
    const Float<A> f = fibres(p, view.wo, wi) / wi.z;
    return only<A>(wi.z > Float<A>(0.f), f * Spectrum<A>{p.kd_r, p.kd_g, p.kd_b});
  }
  static YAT_INLINE Float<A> pdf(const Parameters&, const BsdfView<A>&, const Vec3<A>& wi) {
    return only<A>(wi.z > Float<A>(0.f), Float<A>(1 / kTwoPi));
  }
  /// Uniform: light from every height counts alike.
  static YAT_INLINE BsdfSample<A> sample(const Parameters& p, const BsdfView<A>& view,
                                         const Float<A>&, const Float<A>& u, const Float<A>& v) {
    BsdfSample<A> s;
    s.wi = square_to_cone<A>(Float<A>(1.f), u, v);
    s.pdf = pdf(p, view, s.wi);
    s.weight = only<A>(s.pdf > Float<A>(0.f), (Float<A>(kTwoPi) * fibres(p, view.wo, s.wi)) *
                                                  Spectrum<A>{p.kd_r, p.kd_g, p.kd_b});
    return s;
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

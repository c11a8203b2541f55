#pragma once
// A diffuse sheet (lxs 7.2): reflection Kr/pi and transmission Kt/pi, both rough by Oren-Nayar's
// factor, the transmitted direction mirrored at the surface for it. Where energy is conserved the
// transmission is Kt (1 - Kr); else the sum is as large as the scene says, beyond 1 too, as in
// LuxRender.

#include "kernels/materials/rough_diffuse.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct MatteTranslucentParameters {
  Of<float> kr_r, kr_g, kr_b;  ///< reflectance, 0..1
  Of<float> kt_r, kt_g, kt_b;  ///< transmittance, 0..1
  Of<float> sigma;             ///< as OrenNayarParameters [degrees]
  Of<float> conserve;          ///< 1: Kt counts times 1 - Kr; 0: in full
  YAT_FIELDS(kr_r, kr_g, kr_b, kt_r, kt_g, kt_b, sigma, conserve)
};
static_assert(all_fields_listed<MatteTranslucentParameters>);

inline constexpr TexturedField kMatteTranslucentTextured[] = {
    textured_colour<MatteTranslucentParameters>("Kr", "kr_r"),
    textured_colour<MatteTranslucentParameters>("Kt", "kt_r"),
    textured_number<MatteTranslucentParameters>("sigma", "sigma", 0, 90)};
inline constexpr MaterialTraits kMatteTranslucentTraits{.name = "matte_translucent",
                                                        .delta = false,
                                                        .see_through = false,
                                                        .needs_lobe = true,
                                                        .needs_direction = true,
                                                        .all_around = true,
                                                        .textured = kMatteTranslucentTextured};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct MatteTranslucent {
  using Parameters = MatteTranslucentParameters<Lanes<A>::template Of>;

  /// Albedos of the two sides, and the chance with which a sample is reflected.
  struct Sides {
    Spectrum<A> reflected, transmitted;
    Float<A> chance;
  };
  static YAT_INLINE Sides sides(const Parameters& p) {
    const Float<A> one(1.f);
    Sides s;
    s.reflected = {p.kr_r, p.kr_g, p.kr_b};
    s.transmitted = {p.kt_r * (one - p.conserve * p.kr_r), p.kt_g * (one - p.conserve * p.kr_g),
                     p.kt_b * (one - p.conserve * p.kr_b)};
    const Float<A> here = largest(s.reflected), total = here + largest(s.transmitted);
    s.chance = xsimd::select(total > Float<A>(0.f), here / total, one);
    return s;
  }

  static YAT_INLINE Spectrum<A> evaluate(const Parameters& p, const BsdfView<A>& view,
                                         const Vec3<A>& wi) {
    const Float<A> zero(0.f);
    const Sides s = sides(p);
    const Float<A> f =
        Float<A>(kInvPi) * oren_nayar<A>(p.sigma, view.wo, {wi.x, wi.y, xsimd::abs(wi.z)});
    return only<A>(wi.z != zero, f * select<A>(wi.z > zero, s.reflected, s.transmitted));
  }
  static YAT_INLINE Float<A> pdf(const Parameters& p, const BsdfView<A>&, const Vec3<A>& wi) {
    const Sides s = sides(p);
    return xsimd::select(wi.z > Float<A>(0.f), s.chance, Float<A>(1.f) - s.chance) *
           cosine_hemisphere_pdf<A>(xsimd::abs(wi.z));
  }
  static YAT_INLINE BsdfSample<A> sample(const Parameters& p, const BsdfView<A>& view,
                                         const Float<A>& u_lobe, const Float<A>& u,
                                         const Float<A>& v) {
    const Float<A> one(1.f);
    const Sides side = sides(p);
    const Mask<A> reflects = u_lobe < side.chance;
    const Vec3<A> w = square_to_cosine_hemisphere<A>(u, v);
    const Float<A> chance = xsimd::select(reflects, side.chance, one - side.chance);
    BsdfSample<A> s;
    s.pdf = chance * cosine_hemisphere_pdf<A>(w.z);
    s.weight = (oren_nayar<A>(p.sigma, view.wo, w) / chance) *
               select<A>(reflects, side.reflected, side.transmitted);
    s.weight = only<A>(s.pdf > Float<A>(0.f), s.weight);
    s.wi = {w.x, w.y, xsimd::select(reflects, w.z, -w.z)};
    return s;
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

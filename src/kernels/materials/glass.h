#pragma once
// Smooth glass: reflection Kr F and refraction Kt (1 - F), F the exact unpolarised Fresnel
// reflectance. Outside is the side of the normal. Radiance changes by (n_o / n_i)^2 from the side i
// it comes from to the side o it leaves to, as the solid angle does (lxs 7.3).

#include "kernels/material.h"
#include "kernels/materials/fresnel.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct GlassParameters {
  Of<float> kr_r, kr_g, kr_b;  ///< tint of reflection, 0..1
  Of<float> kt_r, kt_g, kt_b;  ///< tint of refraction, 0..1, at every interface
  Of<float> index;             ///< refractive index inside over outside, > 0
  YAT_FIELDS(kr_r, kr_g, kr_b, kt_r, kt_g, kt_b, index)
};
static_assert(all_fields_listed<GlassParameters>);

inline constexpr TexturedField kGlassTextured[] = {
    textured_colour<GlassParameters>("Kr", "kr_r"), textured_colour<GlassParameters>("Kt", "kt_r"),
    textured_number<GlassParameters>("index", "index", .01f, 100)};
inline constexpr MaterialTraits kGlassTraits{.name = "glass",
                                             .delta = true,
                                             .see_through = false,
                                             .needs_lobe = true,
                                             .needs_direction = false,
                                             .textured = kGlassTextured};

#if defined(YAT_ISA)
namespace YAT_ISA {

/// Smooth glass of these colours; the lobe is chosen by what each would bring: its weight then
/// hardly varies.
template <class A>
YAT_INLINE BsdfSample<A> sample_glass(const Spectrum<A>& kr, const Spectrum<A>& kt,
                                      const Float<A>& index, const BsdfView<A>& view,
                                      const Float<A>& u_lobe) {
  const Float<A> zero(0.f), one(1.f);
  const Vec3<A>& wo = view.wo;
  const Float<A> eta = xsimd::select(view.outside, one / index, index);
  // From the tangential part, which is exact near the normal.
  const Float<A> sin2_i = eta * eta * (wo.x * wo.x + wo.y * wo.y);
  const Float<A> cos_i = xsimd::sqrt(xsimd::max(one - sin2_i, zero));
  const Float<A> f = fresnel_dielectric<A>(wo.z, cos_i, eta);

  const Spectrum<A> reflected = f * kr, refracted = (one - f) * kt;
  const Float<A> reflect_share = largest(reflected), refract_share = largest(refracted);
  const Float<A> total = reflect_share + refract_share;
  const Float<A> threshold = reflect_share / total;
  const Mask<A> reflects = u_lobe < threshold;
  const Float<A> chance = xsimd::select(reflects, threshold, one - threshold);
  const Float<A> scale = xsimd::select(reflects, one, eta * eta) / chance;

  BsdfSample<A> s;
  s.wi = {xsimd::select(reflects, -wo.x, -eta * wo.x), xsimd::select(reflects, -wo.y, -eta * wo.y),
          xsimd::select(reflects, wo.z, -cos_i)};
  s.weight = {scale * xsimd::select(reflects, reflected.r, refracted.r),
              scale * xsimd::select(reflects, reflected.g, refracted.g),
              scale * xsimd::select(reflects, reflected.b, refracted.b)};
  // Black glass brings nothing: 0 / 0 above. `!=` so that a NaN stays one and is counted.
  s.weight = only<A>(total != zero, s.weight);
  s.pdf = zero;
  return s;
}

template <class A>
struct Glass : Delta<A> {
  using Parameters = GlassParameters<Lanes<A>::template Of>;

  static YAT_INLINE BsdfSample<A> sample(const Parameters& p, const BsdfView<A>& view,
                                         const Float<A>& u_lobe, const Float<A>&, const Float<A>&) {
    return sample_glass<A>({p.kr_r, p.kr_g, p.kr_b}, {p.kt_r, p.kt_g, p.kt_b}, p.index, view,
                           u_lobe);
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

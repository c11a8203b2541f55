#pragma once
// LuxRender's glass with "architectural": a pane that does not bend light (lxs 7.3). It reflects
// Kr F on the outside only; straight through goes Kt, times 1 - F (1 + (1 - F)^2) where light
// enters by the outside, which stands for the whole pane. Single crossings may bring more than they
// got: the pane, entered and left, does not. Shadow rays pass likewise: it is a veil.

#include "kernels/materials/fresnel.h"
#include "kernels/materials/thin_film.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct ArchitecturalGlassParameters {
  Of<float> kr_r, kr_g, kr_b;  ///< tint of reflection, 0..1
  Of<float> kt_r, kt_g, kt_b;  ///< tint of what goes through, 0..1, at every crossing
  Of<float> index;             ///< refractive index inside over outside, > 0
  Of<float> film;              ///< thickness of a thin film [nm], 0: none
  Of<float> filmindex;         ///< >= 1
  YAT_FIELDS(kr_r, kr_g, kr_b, kt_r, kt_g, kt_b, index, film, filmindex)
};
static_assert(all_fields_listed<ArchitecturalGlassParameters>);

inline constexpr TexturedField kArchitecturalGlassTextured[] = {
    textured_colour<ArchitecturalGlassParameters>("Kr", "kr_r"),
    textured_colour<ArchitecturalGlassParameters>("Kt", "kt_r"),
    textured_number<ArchitecturalGlassParameters>("index", "index", .01f, 100)};
inline constexpr MaterialTraits kArchitecturalGlassTraits{.name = "architectural_glass",
                                                          .delta = true,
                                                          .see_through = false,
                                                          .needs_lobe = true,
                                                          .needs_direction = false,
                                                          .veil = true,
                                                          .textured = kArchitecturalGlassTextured};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct ArchitecturalGlass : Delta<A> {
  using Parameters = ArchitecturalGlassParameters<Lanes<A>::template Of>;

  /// F, by the angle at which the pane is met from the outside, whichever side is seen.
  static YAT_INLINE Float<A> fresnel(const Parameters& p, const Vec3<A>& wo) {
    const Float<A> zero(0.f), one(1.f), eta = one / p.index;
    const Float<A> cos_i =
        xsimd::sqrt(xsimd::max(one - eta * eta * (wo.x * wo.x + wo.y * wo.y), zero));
    return fresnel_dielectric<A>(wo.z, cos_i, eta);
  }
  static YAT_INLINE Spectrum<A> through(const Parameters& p, const BsdfView<A>& view,
                                        const Float<A>& f) {
    // Seen from the outside, the light comes from the inside.
    const Float<A> one(1.f), rest = one - f, enters = one - f * (one + rest * rest);
    return xsimd::select(view.outside, one, enters) * Spectrum<A>{p.kt_r, p.kt_g, p.kt_b};
  }
  static YAT_INLINE Spectrum<A> transmittance(const Parameters& p, const BsdfView<A>& view) {
    return through(p, view, fresnel(p, view.wo));
  }

  static YAT_INLINE BsdfSample<A> sample(const Parameters& p, const BsdfView<A>& view,
                                         const Float<A>& u_lobe, const Float<A>&, const Float<A>&) {
    const Float<A> zero(0.f), one(1.f);
    const Vec3<A>& wo = view.wo;
    const Float<A> f = fresnel(p, wo);
    const Spectrum<A> reflected = only<A>(
        view.outside,
        f * (film_factor<A>(p.film, p.filmindex, wo.z) * Spectrum<A>{p.kr_r, p.kr_g, p.kr_b}));
    const Spectrum<A> passed = through(p, view, f);
    const Float<A> share = largest(reflected), total = share + largest(passed);
    const Float<A> threshold = share / total;
    const Mask<A> reflects = u_lobe < threshold;
    const Float<A> chance = xsimd::select(reflects, threshold, one - threshold);
    BsdfSample<A> s;
    s.wi = {-wo.x, -wo.y, xsimd::select(reflects, wo.z, -wo.z)};
    s.weight = only<A>(total != zero, (one / chance) * select(reflects, reflected, passed));
    s.pdf = zero;
    return s;
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

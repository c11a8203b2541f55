#pragma once
// Smooth glass under a thin film, which colours its reflection.

#include "kernels/materials/glass.h"
#include "kernels/materials/thin_film.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct GlassFilmParameters {
  Of<float> kr_r, kr_g, kr_b;  ///< tint of reflection, 0..1
  Of<float> kt_r, kt_g, kt_b;  ///< tint of refraction, 0..1, at every interface
  Of<float> index;             ///< refractive index inside over outside, > 0
  Of<float> film;              ///< thickness [nm], >= 0
  Of<float> filmindex;         ///< >= 1
  YAT_FIELDS(kr_r, kr_g, kr_b, kt_r, kt_g, kt_b, index, film, filmindex)
};
static_assert(all_fields_listed<GlassFilmParameters>);

inline constexpr TexturedField kGlassFilmTextured[] = {
    textured_colour<GlassFilmParameters>("Kr", "kr_r"),
    textured_colour<GlassFilmParameters>("Kt", "kt_r"),
    textured_number<GlassFilmParameters>("index", "index", .01f, 100)};
inline constexpr MaterialTraits kGlassFilmTraits{.name = "glass_film",
                                                 .delta = true,
                                                 .see_through = false,
                                                 .needs_lobe = true,
                                                 .needs_direction = false,
                                                 .textured = kGlassFilmTextured};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct GlassFilm : Delta<A> {
  using Parameters = GlassFilmParameters<Lanes<A>::template Of>;

  static YAT_INLINE BsdfSample<A> sample(const Parameters& p, const BsdfView<A>& view,
                                         const Float<A>& u_lobe, const Float<A>&, const Float<A>&) {
    const Spectrum<A> kr =
        film_factor<A>(p.film, p.filmindex, view.wo.z) * Spectrum<A>{p.kr_r, p.kr_g, p.kr_b};
    return sample_glass<A>(kr, {p.kt_r, p.kt_g, p.kt_b}, p.index, view, u_lobe);
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

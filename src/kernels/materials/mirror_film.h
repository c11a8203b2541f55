#pragma once
// A mirror under a thin film.

#include "kernels/material.h"
#include "kernels/materials/thin_film.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct MirrorFilmParameters {
  Of<float> kr_r, kr_g, kr_b;  ///< reflectance, 0..1
  Of<float> film;              ///< thickness [nm], >= 0
  Of<float> filmindex;         ///< >= 1
  YAT_FIELDS(kr_r, kr_g, kr_b, film, filmindex)
};
static_assert(all_fields_listed<MirrorFilmParameters>);

inline constexpr TexturedField kMirrorFilmTextured[] = {
    textured_colour<MirrorFilmParameters>("Kr", "kr_r")};
inline constexpr MaterialTraits kMirrorFilmTraits{.name = "mirror_film",
                                                  .delta = true,
                                                  .see_through = false,
                                                  .needs_lobe = false,
                                                  .needs_direction = false,
                                                  .textured = kMirrorFilmTextured};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct MirrorFilm : Delta<A> {
  using Parameters = MirrorFilmParameters<Lanes<A>::template Of>;

  static YAT_INLINE BsdfSample<A> sample(const Parameters& p, const BsdfView<A>& view,
                                         const Float<A>&, const Float<A>&, const Float<A>&) {
    return {{-view.wo.x, -view.wo.y, view.wo.z},
            film_factor<A>(p.film, p.filmindex, view.wo.z) * Spectrum<A>{p.kr_r, p.kr_g, p.kr_b},
            Float<A>(0.f)};
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

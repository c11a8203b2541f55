#pragma once
// Smooth glass that is filled with an absorbing volume: what comes from the inside has lost
// 1 - e^(-sigma l) on its way of length l (Beer, Lambert). A path pays at the end of each way, when
// it meets the glass from within: exact for bodies that hold nothing else.

#include "kernels/materials/glass.h"
#include "soa/fields.h"

#if defined(YAT_ISA)
#include "kernels/exponential.h"
#endif

namespace yat {

template <template <class> class Of>
struct AbsorbingGlassParameters {
  Of<float> kr_r, kr_g, kr_b;           ///< tint of reflection, 0..1
  Of<float> kt_r, kt_g, kt_b;           ///< tint of refraction, 0..1, at every interface
  Of<float> index;                      ///< refractive index inside over outside, > 0
  Of<float> sigma_r, sigma_g, sigma_b;  ///< absorption inside [1/m], >= 0
  YAT_FIELDS(kr_r, kr_g, kr_b, kt_r, kt_g, kt_b, index, sigma_r, sigma_g, sigma_b)
};
static_assert(all_fields_listed<AbsorbingGlassParameters>);

inline constexpr MaterialTraits kAbsorbingGlassTraits{.name = "absorbing_glass",
                                                      .delta = true,
                                                      .see_through = false,
                                                      .needs_lobe = true,
                                                      .needs_direction = false};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct AbsorbingGlass : Delta<A> {
  using Parameters = AbsorbingGlassParameters<Lanes<A>::template Of>;
  /// Ways begin at the surface, not where rays start off it.
  static constexpr bool kFilled = true;

  static YAT_INLINE BsdfSample<A> sample(const Parameters& p, const BsdfView<A>& view,
                                         const Float<A>& u_lobe, const Float<A>&, const Float<A>&) {
    BsdfSample<A> s =
        sample_glass<A>({p.kr_r, p.kr_g, p.kr_b}, {p.kt_r, p.kt_g, p.kt_b}, p.index, view, u_lobe);
    const Float<A> way = xsimd::select(view.outside, Float<A>(0.f), -view.distance);
    s.weight = Spectrum<A>{exponential<A>(way * p.sigma_r), exponential<A>(way * p.sigma_g),
                           exponential<A>(way * p.sigma_b)} *
               s.weight;
    return s;
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

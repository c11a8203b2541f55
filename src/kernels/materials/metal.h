#pragma once
// Metals by refractive index and extinction: LuxRender's metal. The conductor approximation.

#include "kernels/materials/rough_reflection.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct MetalParameters {
  Of<float> n_r, n_g, n_b;           ///< refractive index, > 0
  Of<float> k_r, k_g, k_b;           ///< extinction, >= 0
  Of<float> uroughness, vroughness;  ///< along dp/du and across it, 0..1
  YAT_FIELDS(n_r, n_g, n_b, k_r, k_g, k_b, uroughness, vroughness)
};
static_assert(all_fields_listed<MetalParameters>);

inline constexpr TexturedField kMetalTextured[] = {
    textured_number<MetalParameters>("uroughness", "uroughness", 0, 1),
    textured_number<MetalParameters>("vroughness", "vroughness", 0, 1)};
inline constexpr MaterialTraits kMetalTraits{.name = "metal",
                                             .delta = false,
                                             .see_through = false,
                                             .needs_lobe = false,
                                             .needs_direction = true,
                                             .textured = kMetalTextured};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct Metal : RoughReflection<A, Metal<A>, MetalParameters<Lanes<A>::template Of>> {
  using Parameters = MetalParameters<Lanes<A>::template Of>;
  static YAT_INLINE Spectrum<A> fresnel(const Parameters& p, const Float<A>& cos) {
    return {fresnel_conductor<A>(p.n_r, p.k_r, cos), fresnel_conductor<A>(p.n_g, p.k_g, cos),
            fresnel_conductor<A>(p.n_b, p.k_b, cos)};
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

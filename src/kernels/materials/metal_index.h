#pragma once
// LuxRender's metal2 with a fresnel texture that is an index (a dielectric) or index and extinction
// too small for the conductor approximation.

#include "kernels/materials/rough_reflection.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct MetalIndexParameters {
  Of<float> n_r, n_g, n_b;           ///< refractive index, > 0
  Of<float> k_r, k_g, k_b;           ///< extinction, >= 0
  Of<float> uroughness, vroughness;  ///< along dp/du and across it, 0..1
  YAT_FIELDS(n_r, n_g, n_b, k_r, k_g, k_b, uroughness, vroughness)
};
static_assert(all_fields_listed<MetalIndexParameters>);

inline constexpr TexturedField kMetalIndexTextured[] = {
    textured_number<MetalIndexParameters>("uroughness", "uroughness", 0, 1),
    textured_number<MetalIndexParameters>("vroughness", "vroughness", 0, 1)};
inline constexpr MaterialTraits kMetalIndexTraits{.name = "metal_index",
                                                  .delta = false,
                                                  .see_through = false,
                                                  .needs_lobe = false,
                                                  .needs_direction = true,
                                                  .textured = kMetalIndexTextured};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct MetalIndex : RoughReflection<A, MetalIndex<A>, MetalIndexParameters<Lanes<A>::template Of>> {
  using Parameters = MetalIndexParameters<Lanes<A>::template Of>;
  static YAT_INLINE Spectrum<A> fresnel(const Parameters& p, const Float<A>& cos) {
    return {fresnel_general<A>(p.n_r, p.k_r, cos), fresnel_general<A>(p.n_g, p.k_g, cos),
            fresnel_general<A>(p.n_b, p.k_b, cos)};
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

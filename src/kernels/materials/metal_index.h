#pragma once
// LuxRender's metal2 with a fresnel texture that is an index (a dielectric) or index and extinction
// too small for the conductor approximation.

#include "kernels/materials/metal.h"

namespace yat {

template <template <class> class Of>
struct MetalIndexParameters : MetalParameters<Of> {};
static_assert(all_fields_listed<MetalIndexParameters>);

inline constexpr MaterialTraits kMetalIndexTraits = [] {
  MaterialTraits traits = kMetalTraits;
  traits.name = "metal_index";
  return traits;
}();

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

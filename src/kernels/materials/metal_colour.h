#pragma once
// LuxRender's metal2 with a fresnelcolor texture: a metal of a colour.

#include "kernels/materials/rough_reflection.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct MetalColourParameters {
  Of<float> kr_r, kr_g, kr_b;        ///< colour, 0..1, used up to .999 (IndexOfColour)
  Of<float> uroughness, vroughness;  ///< along dp/du and across it, 0..1
  YAT_FIELDS(kr_r, kr_g, kr_b, uroughness, vroughness)
};
static_assert(all_fields_listed<MetalColourParameters>);

inline constexpr TexturedField kMetalColourTextured[] = {
    textured_colour<MetalColourParameters>("Kr", "kr_r"),
    textured_colour<MetalColourParameters>("fresnel", "kr_r"),
    textured_number<MetalColourParameters>("uroughness", "uroughness", 0, 1),
    textured_number<MetalColourParameters>("vroughness", "vroughness", 0, 1)};
inline constexpr MaterialTraits kMetalColourTraits{.name = "metal_colour",
                                                   .delta = false,
                                                   .see_through = false,
                                                   .needs_lobe = false,
                                                   .needs_direction = true,
                                                   .textured = kMetalColourTextured};

#if defined(YAT_ISA)
namespace YAT_ISA {

/// Reflectance of the metals of a colour, in three bands.
template <class A>
YAT_INLINE Spectrum<A> fresnel_of_colour(const Spectrum<A>& colour, const Float<A>& cos) {
  const auto r = IndexOfColour<A>::of(colour.r), g = IndexOfColour<A>::of(colour.g),
             b = IndexOfColour<A>::of(colour.b);
  return {fresnel_general<A>(r.n, r.k, cos), fresnel_general<A>(g.n, g.k, cos),
          fresnel_general<A>(b.n, b.k, cos)};
}

template <class A>
struct MetalColour
    : RoughReflection<A, MetalColour<A>, MetalColourParameters<Lanes<A>::template Of>> {
  using Parameters = MetalColourParameters<Lanes<A>::template Of>;
  static YAT_INLINE Spectrum<A> fresnel(const Parameters& p, const Float<A>& cos) {
    return fresnel_of_colour<A>({p.kr_r, p.kr_g, p.kr_b}, cos);
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

#pragma once
// Perfect reflection on both sides, times Kr.

#include "kernels/material.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct MirrorParameters {
  Of<float> kr_r, kr_g, kr_b;  ///< reflectance, 0..1
  YAT_FIELDS(kr_r, kr_g, kr_b)
};
static_assert(all_fields_listed<MirrorParameters>);

inline constexpr TexturedField kMirrorTextured[] = {
    textured_colour<MirrorParameters>("Kr", "kr_r")};
inline constexpr MaterialTraits kMirrorTraits{.name = "mirror",
                                              .delta = true,
                                              .see_through = false,
                                              .needs_lobe = false,
                                              .needs_direction = false,
                                              .textured = kMirrorTextured};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct Mirror : Delta<A> {
  using Parameters = MirrorParameters<Lanes<A>::template Of>;

  static YAT_INLINE BsdfSample<A> sample(const Parameters& p, const BsdfView<A>& view,
                                         const Float<A>&, const Float<A>&, const Float<A>&) {
    return {{-view.wo.x, -view.wo.y, view.wo.z}, {p.kr_r, p.kr_g, p.kr_b}, Float<A>(0.f)};
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

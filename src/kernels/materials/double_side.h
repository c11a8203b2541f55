#pragma once
// One material for each side of a surface (lxs 7.2): the first outside, the second inside.

#include "kernels/material.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct DoubleSideParameters {
  Of<uint32_t> first, second;  ///< rows of the children's own tables
  YAT_FIELDS(first, second)
};
static_assert(all_fields_listed<DoubleSideParameters>);

inline constexpr MaterialTraits kDoubleSideTraits{.name = "double_side",
                                                  .delta = false,
                                                  .see_through = false,
                                                  .needs_lobe = false,
                                                  .needs_direction = false,
                                                  .splits = true};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct DoubleSide {
  using Parameters = DoubleSideParameters<Lanes<A>::template Of>;
  static YAT_INLINE Float<A> share(const Parameters&, const BsdfView<A>& view) {
    return xsimd::select(view.outside, Float<A>(0.f), Float<A>(1.f));
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

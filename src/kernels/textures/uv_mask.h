#pragma once
// In 0: s, t; in 1: where both are in 0..1; in 2: elsewhere.

#include "kernels/texture.h"

namespace yat {

template <template <class> class Of>
struct UvMaskParameters {
  Of<uint32_t> unused;
  YAT_FIELDS(unused)
};
static_assert(all_fields_listed<UvMaskParameters>);

inline constexpr TextureTraits kUvMaskTraits{.name = "uv_mask"};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct UvMask {
  template <uint32_t kForm>
  static YAT_INLINE void evaluate(const UvMaskParameters<Lanes<A>::template Of>&,
                                  const TextureRow<A>& row) {
    const Float<A> zero(0.f), one(1.f), s = row.in(0, 0), t = row.in(0, 1);
    const Mask<A> inside = (s >= zero) & (s <= one) & (t >= zero) & (t <= one);
    for (uint32_t k = 0; k < 3 && row.wants(k); ++k)
      row.out(k, xsimd::select(inside, row.in(1, k), row.in(2, k)));
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

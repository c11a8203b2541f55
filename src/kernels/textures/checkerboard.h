#pragma once
// In 0: s, t or x, y, z; in 1, 2: the two textures. The first where the sum of the coordinates'
// floors is even.

#include "kernels/texture.h"

namespace yat {

template <template <class> class Of>
struct CheckerboardParameters {
  Of<uint32_t> unused;
  YAT_FIELDS(unused)
};
static_assert(all_fields_listed<CheckerboardParameters>);

inline constexpr TextureTraits kCheckerboardTraits{.name = "checkerboard", .forms = 2};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct Checkerboard {
  template <uint32_t kForm>  // 0: two dimensions, 1: three
  static YAT_INLINE void evaluate(const CheckerboardParameters<Lanes<A>::template Of>&,
                                  const TextureRow<A>& row) {
    Float<A> sum = xsimd::floor(row.in(0, 0)) + xsimd::floor(row.in(0, 1));
    if constexpr (kForm == 1) sum = sum + xsimd::floor(row.in(0, 2));
    const Float<A> half = Float<A>(.5f) * sum;
    const Mask<A> even = half == xsimd::floor(half);
    for (uint32_t k = 0; k < 3 && row.wants(k); ++k)
      row.out(k, xsimd::select(even, row.in(1, k), row.in(2, k)));
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

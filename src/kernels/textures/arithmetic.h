#pragma once
// Arithmetic of textures, channel by channel for as many as the step has outputs (lxs 8.4):
//   0 scale a b, 1 add a + b, 2 subtract a - b, 3 mix a + c (b - a), 4 weighted sum a + weight b

#include "kernels/texture.h"

namespace yat {

template <template <class> class Of>
struct ArithmeticParameters {
  Of<float> weight;  ///< form 4
  YAT_FIELDS(weight)
};
static_assert(all_fields_listed<ArithmeticParameters>);

inline constexpr TextureTraits kArithmeticTraits{.name = "arithmetic", .forms = 5};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct Arithmetic {
  template <uint32_t kForm>
  static YAT_INLINE void evaluate(const ArithmeticParameters<Lanes<A>::template Of>& p,
                                  const TextureRow<A>& row) {
    for (uint32_t k = 0; k < 3 && row.wants(k); ++k) {
      const Float<A> a = row.in(0, k), b = row.in(1, k);
      if constexpr (kForm == 0) row.out(k, a * b);
      if constexpr (kForm == 1) row.out(k, a + b);
      if constexpr (kForm == 2) row.out(k, a - b);
      // Equal to b where c is 1, as to a where it is 0.
      if constexpr (kForm == 3) row.out(k, (Float<A>(1.f) - row.in(2)) * a + row.in(2) * b);
      if constexpr (kForm == 4) row.out(k, a + p.weight * b);
    }
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

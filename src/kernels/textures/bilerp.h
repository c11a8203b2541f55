#pragma once
// In 0: s, t; in 1..4: the values at (0, 0), (0, 1), (1, 0), (1, 1) of every unit square.

#include "kernels/texture.h"

namespace yat {

template <template <class> class Of>
struct BilerpParameters {
  Of<uint32_t> unused;
  YAT_FIELDS(unused)
};
static_assert(all_fields_listed<BilerpParameters>);

inline constexpr TextureTraits kBilerpTraits{.name = "bilerp"};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct Bilerp {
  template <uint32_t kForm>
  static YAT_INLINE void evaluate(const BilerpParameters<Lanes<A>::template Of>&,
                                  const TextureRow<A>& row) {
    const Float<A> one(1.f), s = row.in(0, 0) - xsimd::floor(row.in(0, 0)),
                             t = row.in(0, 1) - xsimd::floor(row.in(0, 1));
    for (uint32_t k = 0; k < 3 && row.wants(k); ++k)
      row.out(k, (one - s) * ((one - t) * row.in(1, k) + t * row.in(2, k)) +
                     s * ((one - t) * row.in(3, k) + t * row.in(4, k)));
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

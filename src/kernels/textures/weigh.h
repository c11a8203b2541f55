#pragma once
// A number from a colour: the sum of its channels, weighted.

#include "kernels/texture.h"

namespace yat {

template <template <class> class Of>
struct WeighParameters {
  Of<float> r, g, b;
  YAT_FIELDS(r, g, b)
};
static_assert(all_fields_listed<WeighParameters>);

inline constexpr TextureTraits kWeighTraits{.name = "weigh"};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct Weigh {
  template <uint32_t kForm>
  static YAT_INLINE void evaluate(const WeighParameters<Lanes<A>::template Of>& p,
                                  const TextureRow<A>& row) {
    const Spectrum<A> c = row.colour(0);
    row.out(0, p.r * c.r + p.g * c.g + p.b * c.b);
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

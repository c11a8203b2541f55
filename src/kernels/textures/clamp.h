#pragma once
// Numbers into the range of the parameter that takes them: unit times what is clamped to
// least..most. A NaN stays one, so that the path is dropped and counted (invariant 6).

#include "kernels/texture.h"

namespace yat {

template <template <class> class Of>
struct ClampParameters {
  Of<float> least, most, unit;
  YAT_FIELDS(least, most, unit)
};
static_assert(all_fields_listed<ClampParameters>);

inline constexpr TextureTraits kClampTraits{.name = "clamp"};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct Clamp {
  template <uint32_t kForm>
  static YAT_INLINE void evaluate(const ClampParameters<Lanes<A>::template Of>& p,
                                  const TextureRow<A>& row) {
    for (uint32_t k = 0; k < 3 && row.wants(k); ++k) {
      const Float<A> x = row.in(0, k);
      row.out(k,
              p.unit * xsimd::select(x < p.least, p.least, xsimd::select(x > p.most, p.most, x)));
    }
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

#pragma once
// How far a number is on its way between two: 0 up to the first, 1 from the second on.

#include "kernels/texture.h"

namespace yat {

template <template <class> class Of>
struct RampParameters {
  Of<float> start, end;  ///< start <= end
  YAT_FIELDS(start, end)
};
static_assert(all_fields_listed<RampParameters>);

inline constexpr TextureTraits kRampTraits{.name = "ramp"};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct Ramp {
  template <uint32_t kForm>
  static YAT_INLINE void evaluate(const RampParameters<Lanes<A>::template Of>& p,
                                  const TextureRow<A>& row) {
    const Float<A> zero(0.f), one(1.f), x = row.in(0);
    const Float<A> inside = (x - p.start) / (p.end - p.start);
    row.out(0, xsimd::select(x >= p.end, one, xsimd::select(x <= p.start, zero, inside)));
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

#pragma once
// Constants of a material as columns: what other steps of a program take as inputs.

#include "kernels/texture.h"

namespace yat {

template <template <class> class Of>
struct ConstantParameters {
  Of<float> r, g, b;  ///< as many of them as the step has outputs
  YAT_FIELDS(r, g, b)
};
static_assert(all_fields_listed<ConstantParameters>);

inline constexpr TextureTraits kConstantTraits{.name = "constant"};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct Constant {
  template <uint32_t kForm>
  static YAT_INLINE void evaluate(const ConstantParameters<Lanes<A>::template Of>& p,
                                  const TextureRow<A>& row) {
    row.out(0, p.r);
    if (row.wants(1)) row.out(1, p.g);
    if (row.wants(2)) row.out(2, p.b);
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

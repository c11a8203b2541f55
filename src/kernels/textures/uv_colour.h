#pragma once
// In 0: s, t. Out: their fractions as red and green, and 0 (the texture "uv").

#include "kernels/texture.h"

namespace yat {

template <template <class> class Of>
struct UvColourParameters {
  Of<uint32_t> unused;
  YAT_FIELDS(unused)
};
static_assert(all_fields_listed<UvColourParameters>);

inline constexpr TextureTraits kUvColourTraits{.name = "uv_colour"};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct UvColour {
  template <uint32_t kForm>
  static YAT_INLINE void evaluate(const UvColourParameters<Lanes<A>::template Of>&,
                                  const TextureRow<A>& row) {
    row.out(Spectrum<A>{row.in(0, 0) - xsimd::floor(row.in(0, 0)),
                        row.in(0, 1) - xsimd::floor(row.in(0, 1)), Float<A>(0.f)});
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

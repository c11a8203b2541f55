#pragma once
// A colour per primitive, by its row: out: linear Rec.709. LuxRender takes them from where its
// objects lie in memory.

#include "kernels/texture.h"

namespace yat {

/// Bits of channel k of a primitive's colour, the highest 8 the best; for a number or a register.
template <class Number>
YAT_INLINE Number harlequin_bits(const Number& prim, const Number& k) {
  Number x = prim * Number(0x9e3779b9u) + k * Number(0x85ebca6bu) + Number(0x27d4eb2fu);
  x = x ^ (x >> 15);
  x = x * Number(0x2c1b3c6du);
  x = x ^ (x >> 12);
  return x * Number(0x297a2d39u);
}

template <template <class> class Of>
struct HarlequinParameters {
  Of<uint32_t> unused;
  YAT_FIELDS(unused)
};
static_assert(all_fields_listed<HarlequinParameters>);

inline constexpr TextureTraits kHarlequinTraits{.name = "harlequin"};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct Harlequin {
  template <uint32_t kForm>
  static YAT_INLINE void evaluate(const HarlequinParameters<Lanes<A>::template Of>&,
                                  const TextureRow<A>& row) {
    const UInt<A> prim = load<A>(row.input.surfaces.prim, row.first);
    const auto channel = [&](uint32_t k) {
      const UInt<A> bits = harlequin_bits(prim, UInt<A>(k));
      return xsimd::to_float(xsimd::bitwise_cast<int32_t>(bits >> 24)) * Float<A>(1.f / 255);
    };
    row.out(Spectrum<A>{channel(0), channel(1), channel(2)});
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

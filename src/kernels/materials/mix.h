#pragma once
// Two materials in one surface (lxs 7.2): (1 - amount) of the first, amount of the second.

#include "kernels/material.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct MixParameters {
  Of<float> amount;            ///< share of the second material, clamped to 0..1
  Of<float> ratio;             ///< brightness of the second over that of the first, > 0
  Of<uint32_t> first, second;  ///< rows of the children's own tables
  YAT_FIELDS(amount, ratio, first, second)
};
static_assert(all_fields_listed<MixParameters>);

inline constexpr TexturedField kMixTextured[] = {
    textured_number<MixParameters>("amount", "amount", 0, 1)};
inline constexpr MaterialTraits kMixTraits{.name = "mix",
                                           .delta = false,
                                           .see_through = false,
                                           .needs_lobe = false,
                                           .needs_direction = false,
                                           .splits = true,
                                           .textured = kMixTextured};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct Mix {
  using Parameters = MixParameters<Lanes<A>::template Of>;
  static YAT_INLINE Float<A> share(const Parameters& p, const BsdfView<A>&) {
    return xsimd::min(xsimd::max(p.amount, Float<A>(0.f)), Float<A>(1.f));
  }
  /// With which the second child is chosen where the children are unequal: in proportion to share
  /// times brightness.
  static YAT_INLINE Float<A> chance(const Parameters& p, const Float<A>& share) {
    const Float<A> second = share * p.ratio;
    return second / (Float<A>(1.f) - share + second);
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

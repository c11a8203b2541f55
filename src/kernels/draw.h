#pragma once
// The draw kernels: columns of random numbers for one named dimension (kernels/rng_words.h,
// kernels/strata.h).

#include "kernels/rng_words.h"
#include "kernels/strata.h"
#include "kernels/table.h"
#include "soa/simd.h"

namespace yat::YAT_ISA {

/// The top 24 bits as a number in [0, 1): all of them representable, none rounds to 1.
template <class A>
YAT_INLINE Float<A> unit_float(const UInt<A>& word) {
  return xsimd::to_float(xsimd::bitwise_cast<int32_t>(word >> 8)) * Float<A>(0x1p-24f);
}

/// What Strata needs, on registers.
template <class A>
struct StrataOps {
  using Word = UInt<A>;
  using Real = Float<A>;
  static YAT_INLINE Real real(const Word& w) {
    return xsimd::to_float(xsimd::bitwise_cast<int32_t>(w));
  }
  static YAT_INLINE Word truncate(const Real& x) {
    return xsimd::bitwise_cast<uint32_t>(xsimd::to_int(x));
  }
  template <class M>
  static YAT_INLINE Word pick(const M& where, const Word& yes, const Word& no) {
    return select<A>(mask_of<A>(where), yes, no);
  }
  template <class M>
  static YAT_INLINE bool any(const M& where) {
    return YAT_ISA::any<A>(mask_of<A>(where));
  }
  static YAT_INLINE Real least(const Real& a, const Real& b) { return xsimd::min(a, b); }
};

template <class A, SamplerKind kSampler>
void draw(DrawKey sets, Dimension dimension, const uint32_t* pixel, const uint32_t* sample,
          const uint32_t* depth, float* first, float* second, uint32_t n) noexcept {
  // A path may cross several surfaces at one vertex number, and each has numbers of its own.
  const UInt<A> counted(dimension == Dimension::kChild ? 0xffffffffu : 0xffffu);
  for (uint32_t row = 0; row < n; row += kLanes<A>) {
    const UInt<A> vertex = depth ? load<A>(depth, row) & counted : UInt<A>(0u);
    // zsobol: pixels share a sequence.
    const UInt<A> of_pixel = kSampler == SamplerKind::kZSobol ? UInt<A>(0u) : load<A>(pixel, row);
    const UInt<A> key = random_key(sets.seed, uint32_t(dimension), of_pixel, vertex);
    if constexpr (is_stratified(kSampler)) {
      // Padding may hold anything, but a division wants a number below 2^30.
      const UInt<A> index = load<A>(sample, row) & UInt<A>(0x3fffffffu);
      const auto pair =
          Strata<StrataOps<A>>::template pair<kSampler>(key, index, sets.columns, sets.rows);
      store<A>(pair.first, first, row);
      if (second) store<A>(pair.second, second, row);
    } else {
      const UInt<A> index = load<A>(sample, row);
      WordPair<UInt<A>> words;
      if constexpr (kSampler == SamplerKind::kSobol)
        words = sobol_words(key, index, [](const UInt<A>& x) { return reverse_bits<A>(x); });
      else if constexpr (kSampler == SamplerKind::kZSobol)
        words = zsobol_words(key, load<A>(pixel, row), index, bits_of(sets.columns) - 1,
                             [](const UInt<A>& x) { return reverse_bits<A>(x); });
      else
        words = independent_words(key, index);
      store<A>(unit_float<A>(words.first), first, row);
      if (second) store<A>(unit_float<A>(words.second), second, row);
    }
  }
}

}  // namespace yat::YAT_ISA

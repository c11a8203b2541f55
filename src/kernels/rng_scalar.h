#pragma once
// The random numbers of kernels/rng_words.h and strata.h for scalar code: the same bits as the draw
// kernels. Not for kernel sources.

#include <algorithm>
#include <utility>

#include "kernels/rng_words.h"
#include "kernels/strata.h"
#include "kernels/table.h"

namespace yat {

/// What Strata needs, one number at a time.
struct ScalarStrataOps {
  using Word = uint32_t;
  using Real = float;
  static Real real(Word w) { return float(int32_t(w)); }
  static Word truncate(Real x) { return uint32_t(int32_t(x)); }
  static Word pick(bool where, Word yes, Word no) { return where ? yes : no; }
  static bool any(bool where) { return where; }
  static Real least(Real a, Real b) { return std::min(a, b); }
};

/// Two numbers in [0, 1) for `dimension` of vertex `vertex` (below 2^16; 0 is the camera's).
inline std::pair<float, float> random_pair(SamplerKind sampler, DrawKey sets, Dimension dimension,
                                           uint32_t pixel, uint32_t sample, uint32_t vertex) {
  const auto reverse = [](uint32_t x) {
    uint32_t r = 0;
    for (int bit = 0; bit < 32; ++bit) r |= (x >> bit & 1u) << (31 - bit);
    return r;
  };
  const bool shared = sampler == SamplerKind::kZSobol;  // by all pixels
  const uint32_t key = random_key(sets.seed, uint32_t(dimension), shared ? 0 : pixel, vertex);
  // 24 bits: all of them representable, so that no number rounds to 1.
  const auto units = [](const WordPair<uint32_t>& words) {
    return std::pair(float(words.first >> 8) * 0x1p-24f, float(words.second >> 8) * 0x1p-24f);
  };
  const auto strata = [&]<SamplerKind kKind>(std::integral_constant<SamplerKind, kKind>) {
    const auto pair =
        Strata<ScalarStrataOps>::pair<kKind>(key, sample & 0x3fffffffu, sets.columns, sets.rows);
    return std::pair(pair.first, pair.second);
  };
  switch (sampler) {
    case SamplerKind::kSobol:
      return units(sobol_words(key, sample, reverse));
    case SamplerKind::kZSobol:
      return units(zsobol_words(key, pixel, sample, bits_of(sets.columns) - 1, reverse));
    case SamplerKind::kRegular:
      return strata(std::integral_constant<SamplerKind, SamplerKind::kRegular>{});
    case SamplerKind::kJittered:
      return strata(std::integral_constant<SamplerKind, SamplerKind::kJittered>{});
    case SamplerKind::kNRooks:
      return strata(std::integral_constant<SamplerKind, SamplerKind::kNRooks>{});
    case SamplerKind::kMultiJittered:
      return strata(std::integral_constant<SamplerKind, SamplerKind::kMultiJittered>{});
    case SamplerKind::kCorrelatedMultiJittered:
      return strata(std::integral_constant<SamplerKind, SamplerKind::kCorrelatedMultiJittered>{});
    case SamplerKind::kIndependent:
    case SamplerKind::kCount:
      break;
  }
  return units(independent_words(key, sample));
}

}  // namespace yat

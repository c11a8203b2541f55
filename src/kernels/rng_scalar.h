#pragma once
// The random numbers of kernels/rng_words.h for scalar code: the same bits as the draw kernels.
// Not for kernel sources.

#include <utility>

#include "kernels/rng_words.h"
#include "kernels/table.h"

namespace yat {

/// Two numbers in [0, 1) for `dimension` of vertex `vertex` (below 2^16; 0 is the camera's).
inline std::pair<float, float> random_pair(SamplerKind sampler, uint32_t seed, Dimension dimension,
                                           uint32_t pixel, uint32_t sample, uint32_t vertex) {
  const auto reverse = [](uint32_t x) {
    uint32_t r = 0;
    for (int bit = 0; bit < 32; ++bit) r |= (x >> bit & 1u) << (31 - bit);
    return r;
  };
  const uint32_t key = random_key(seed, uint32_t(dimension), pixel, vertex);
  const WordPair<uint32_t> words = sampler == SamplerKind::kSobol
                                       ? sobol_words(key, sample, reverse)
                                       : independent_words(key, sample);
  // 24 bits: all of them representable, so that no number rounds to 1.
  return {float(words.first >> 8) * 0x1p-24f, float(words.second >> 8) * 0x1p-24f};
}

}  // namespace yat

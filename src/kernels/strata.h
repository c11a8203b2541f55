#pragma once
// Stratified samplers, counter-based (invariant 2): the n = columns x rows samples of a set are
// spread over the unit square together, each set and each named pair anew. Written once for scalar
// code and kernels; `Ops` says what a word and a number are. All operations on numbers are single
// roundings, so both give the same bits.
//
//   regular                      middles of a columns x rows grid, in random order
//   jittered                     one random point in each cell of the grid
//   n-rooks                      one in each of n columns and each of n rows
//   multi-jittered               both at once (Chiu, Shirley, Wang 1994)
//   correlated multi-jittered    the same with one shuffle for all columns and one for all rows,
//                                so that neighbouring cells share their gaps (Kensler 2013)
//
// Source  Chiu, Shirley, Wang, "Multi-Jittered Sampling", Graphics Gems IV, 1994. Kensler,
//         "Correlated Multi-Jittered Sampling", Pixar technical memo 13-01, 2013. Departs: another
//         permutation, of multiplications and shifts modulo a power of two, walked along its cycle
//         until it is within range (Black, Rogaway 2002).

#include "kernels/rng_words.h"
#include "kernels/table.h"

namespace yat {

constexpr bool is_stratified(SamplerKind kind) {
  return kind != SamplerKind::kIndependent && kind != SamplerKind::kSobol &&
         kind != SamplerKind::kZSobol;
}
/// Numbers depend on the size of the set.
constexpr bool has_sets(SamplerKind kind) {
  return is_stratified(kind) || kind == SamplerKind::kZSobol;
}

/// Bits of x: 0 for 0.
YAT_INLINE constexpr int bits_of(uint32_t x) {
  return x ? 32 - __builtin_clz(x) : 0;
}

template <class Ops>
struct Strata {
  using Word = typename Ops::Word;
  using Real = typename Ops::Real;

  struct Pair {
    Real first, second;
  };
  struct Division {
    Word quotient, rest;
  };

  /// a / n for a < 2^30, 0 < n <= kLargestSet. In floats twice: the first quotient is off by up to
  /// 2^7, the second by one.
  static YAT_INLINE Division divide(Word a, uint32_t n) {
    if ((n & (n - 1)) == 0) return {a >> (bits_of(n) - 1), a & Word(n - 1)};
    const Real inverse(1.f / float(n));
    Word quotient = Ops::truncate(Ops::real(a) * inverse);
    Word rest = a - quotient * Word(n);
    const Word more = Ops::truncate(Ops::real(rest) * inverse);
    quotient = quotient + more;
    rest = rest - more * Word(n);
    // As signed numbers: a negative rest has its highest bit set.
    const Word low = Word(0u) - (rest >> 31);
    quotient = quotient + low;
    rest = rest + (low & Word(n));
    const auto high = rest >= Word(n);
    quotient = Ops::pick(high, quotient + Word(1u), quotient);
    rest = Ops::pick(high, rest - Word(n), rest);
    return {quotient, rest};
  }

  /// Place of i in a random permutation of 0 .. n - 1.
  static YAT_INLINE Word permute(Word i, uint32_t n, Word key) {
    const int bits = bits_of(n - 1), shift = bits > 3 ? bits / 2 : 1;
    const uint32_t mask = (uint32_t(1) << bits) - 1;
    // Four rounds: with three, some permutations of three to four places are seen to be rarer.
    constexpr int kRounds = 4;
    Word keys[kRounds];
    keys[0] = mix_word(key);
    for (int r = 1; r < kRounds; ++r) keys[r] = mix_word(keys[r - 1] + Word(0x9e3779b9u));
    const auto once = [&](Word x) {
      for (const Word& k : keys) {
        x = (x + (k >> 16)) & Word(mask);
        x = (x * ((k >> 4) | Word(1u))) & Word(mask);
        x = x ^ (x >> shift);
        x = (x ^ k) & Word(mask);
        x = (x * ((k >> 9) | Word(1u))) & Word(mask);
        x = x ^ (x >> shift);
      }
      return x;
    };
    Word x = once(i);
    for (auto outside = x >= Word(n); Ops::any(outside); outside = x >= Word(n))
      x = Ops::pick(outside, once(x), x);
    return x;
  }

  /// (place + offset) / n, below 1.
  static YAT_INLINE Real fraction(Real place, Real offset, uint32_t n) {
    return Ops::least((place + offset) / Real(float(n)), Real(0x1.fffffep-1f));
  }
  static YAT_INLINE Real unit(Word word) { return Ops::real(word >> 8) * Real(0x1p-24f); }

  template <SamplerKind kKind>
  static YAT_INLINE Pair pair(Word pair_key, Word sample, uint32_t columns, uint32_t rows) {
    const uint32_t n = columns * rows;
    const Division at = divide(sample, n);
    const Word key = mix_word(pair_key ^ (at.quotient * Word(0x9e3779b1u)));
    const Word noise = mix_word(key ^ (at.rest * Word(0x85ebca6bu)));
    const Real jitter_x = unit(noise), jitter_y = unit(mix_word(noise + Word(0xc2b2ae35u)));
    if constexpr (kKind == SamplerKind::kNRooks)
      return {fraction(Ops::real(permute(at.rest, n, key ^ Word(0x51ed270bu))), jitter_x, n),
              fraction(Ops::real(permute(at.rest, n, key ^ Word(0xa3b19c47u))), jitter_y, n)};
    const Division cell = divide(permute(at.rest, n, key ^ Word(0x2545f491u)), columns);
    const Word column = cell.rest, row = cell.quotient;
    const Real x = Ops::real(column), y = Ops::real(row);
    if constexpr (kKind == SamplerKind::kRegular)
      return {fraction(x, Real(.5f), columns), fraction(y, Real(.5f), rows)};
    if constexpr (kKind == SamplerKind::kJittered)
      return {fraction(x, jitter_x, columns), fraction(y, jitter_y, rows)};
    Word key_x = key ^ Word(0x6a09e667u), key_y = key ^ Word(0xbb67ae85u);
    if constexpr (kKind == SamplerKind::kMultiJittered) {
      key_x = mix_word(key_x + column);
      key_y = mix_word(key_y + row);
    }
    const Real sub_x = fraction(Ops::real(permute(row, rows, key_x)), jitter_x, rows);
    const Real sub_y = fraction(Ops::real(permute(column, columns, key_y)), jitter_y, columns);
    return {fraction(x, sub_x, columns), fraction(y, sub_y, rows)};
  }
};

/// The largest set: numbers of samples in it are exact as floats, with room.
inline constexpr uint32_t kLargestSet = 1u << 20;

}  // namespace yat

#pragma once
// Counter-based random numbers (invariant 2), written once for a word type: uint32_t in scalar
// code, a register of uint32_t in kernels. Only integer operations, so that both give the same
// bits on every machine.
//
// A number is named by (seed, pixel, sample, vertex, dimension), each dimension a pair of numbers.
//
//   independent  the name is hashed; 24 bits of each of two hashes.
//   sobol        the first two Sobol dimensions, for every named pair anew ("padded"): the sample
//                index is shuffled and the point is scrambled, both by hash-based Owen scrambling
//                under a key of (seed, pixel, vertex, dimension). Over aligned power-of-two runs of
//                samples every pair is a (0,2)-net, and different pairs are independent.
//   zsobol       the same, but pixels share one sequence: they follow each other in Morton order,
//                whose blocks of four are each put in a random order, 2^k samples a pixel. So the
//                samples of every aligned block of 2^n x 2^n pixels are a (0,2)-net together, and
//                errors of neighbours cancel. Blocks of more than 2^32 samples are independent.
//
// Source  Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020: padding, shuffling and
//         scrambling by the hash of Laine and Karras 2011; constants of the hash by Vegdahl,
//         "Building a Better LK Hash", 2021. The second Sobol dimension is the Pascal matrix
//         modulo 2, applied as a butterfly over the five index bits (cf. Ahmed 2024).
//         Departs: bit reversals that cancel between the steps are left out.
//         zsobol: Ahmed, Wonka, "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error
//         via Hierarchical Ordering of Pixels", 2020. Departs: orders come from Owen scrambling,
//         all levels at once, and from which half of a block's numbers goes first: a row of it
//         (half of the time), a column or a diagonal (a quarter each).

#include <cstdint>

#include "soa/fields.h"

namespace yat {

/// A permutation of 32-bit words in which every input bit changes every output bit.
/// Constants: Wellons, "Prospecting for Hash Functions", 2018.
template <class Word>
YAT_INLINE Word mix_word(Word x) {
  x = x ^ (x >> 16);
  x = x * Word(0x7feb352du);
  x = x ^ (x >> 15);
  x = x * Word(0x846ca68bu);
  return x ^ (x >> 16);
}

/// Key of a pair. `vertex` below 2^16.
template <class Word>
YAT_INLINE Word random_key(uint32_t seed, uint32_t dimension, Word pixel, Word vertex) {
  const Word seed_key = mix_word(Word(seed) + Word(0x9e3779b9u));
  const Word dimension_key = mix_word(seed_key + Word(dimension * 0x9e3779b9u + 0x3c6ef372u));
  const Word pixel_key = mix_word(pixel ^ seed_key);
  return mix_word(pixel_key ^ dimension_key ^ (vertex * Word(0x9e3779b1u)));
}

/// A random base-2 tree permutation of words written least significant digit first: bit k changes
/// only bits above k.
template <class Word>
YAT_INLINE Word scramble_reversed(Word x, Word seed) {
  x = x ^ (x * Word(0x3d20adeau));
  x = x + seed;
  x = x * ((seed >> 16) | Word(1u));
  x = x ^ (x * Word(0x05526c56u));
  return x ^ (x * Word(0x53a22864u));
}

/// The second Sobol generator (Pascal matrix modulo 2) applied to an index; bit 0 of the result is
/// the most significant digit of the point.
template <class Word>
YAT_INLINE Word pascal_butterfly(Word x) {
  x = x ^ ((x >> 1) & Word(0x55555555u));
  x = x ^ ((x >> 2) & Word(0x33333333u));
  x = x ^ ((x >> 4) & Word(0x0f0f0f0fu));
  x = x ^ ((x >> 8) & Word(0x00ff00ffu));
  return x ^ ((x >> 16) & Word(0x0000ffffu));
}

template <class Word>
struct WordPair {
  Word first, second;
};

template <class Word>
YAT_INLINE WordPair<Word> independent_words(Word key, Word sample) {
  const Word first = mix_word(key ^ (sample * Word(0x9e3779b1u)));
  return {first, mix_word(first + Word(0x85ebca6bu))};
}

/// Sample of a sequence, given as the bit reversal of its index. `reverse` is that for Word.
template <class Word, class Reverse>
YAT_INLINE WordPair<Word> sobol_words_reversed(Word key, Word reversed, Reverse reverse) {
  const Word index = reverse(scramble_reversed(reversed, key));
  const Word key_x = mix_word(key ^ Word(0xa511e9b3u));
  const Word key_y = (key_x * Word(0x63d83595u)) ^ (key_x >> 15);
  return {reverse(scramble_reversed(index, key_x)),
          reverse(scramble_reversed(pascal_butterfly(index), key_y))};
}
template <class Word, class Reverse>
YAT_INLINE WordPair<Word> sobol_words(Word key, Word sample, Reverse reverse) {
  return sobol_words_reversed(key, reverse(sample), reverse);
}

/// Morton index of x + 2^16 y: bits of x at even, those of y at odd places.
template <class Word>
YAT_INLINE Word morton_index(Word pixel) {
  Word m = pixel;
  m = (m & Word(0xff0000ffu)) | ((m & Word(0x00ff0000u)) >> 8) | ((m & Word(0x0000ff00u)) << 8);
  m = (m & Word(0xf00ff00fu)) | ((m & Word(0x0f000f00u)) >> 4) | ((m & Word(0x00f000f0u)) << 4);
  m = (m & Word(0xc3c3c3c3u)) | ((m & Word(0x30303030u)) >> 2) | ((m & Word(0x0c0c0c0cu)) << 2);
  return (m & Word(0x99999999u)) | ((m & Word(0x44444444u)) >> 1) | ((m & Word(0x22222222u)) << 1);
}

/// Of a Morton index with its bits reversed: in each block of four, what tells its halves apart is
/// y, x or their sum, by bits that depend on the block alone.
template <class Word>
YAT_INLINE Word turn_blocks(Word reversed, Word key) {
  const Word even(0x55555555u);
  // Bit k of these depends on bits below k only: on the blocks around.
  const Word turned = (scramble_reversed(reversed, key) ^ reversed) & even;
  const Word slanted =
      (scramble_reversed(reversed, mix_word(key + Word(0x6a09e667u))) ^ reversed) & turned;
  const Word y = reversed & even, x = (reversed >> 1) & even, change = (x ^ y) & turned;
  return (y ^ change ^ (y & slanted)) | ((x ^ change) << 1);
}

/// `key` without a pixel; pixel = x + 2^16 y; 2^bits samples of a pixel follow each other, bits <
/// 31.
template <class Word, class Reverse>
YAT_INLINE WordPair<Word> zsobol_words(Word key, Word pixel, Word sample, int bits,
                                       Reverse reverse) {
  const Word morton = morton_index(pixel);
  // Later sets of samples, and blocks that do not fit in 32 bits, have sequences of their own.
  // Whole blocks: x and y of a level belong together.
  const int above = (bits + 1) & ~1;
  const Word set = (sample >> bits) * Word(0x9e3779b1u) + ((morton >> 1) >> (31 - above));
  const Word set_key = mix_word(key + set);
  const Word within = reverse(sample & Word((uint32_t(1) << bits) - 1));
  const Word levels = reverse(morton) & Word(~uint32_t(0) << above);
  const Word blocks = turn_blocks(levels, mix_word(set_key + Word(0x3c6ef372u)));
  return sobol_words_reversed(set_key, (blocks >> bits) | within, reverse);
}

}  // namespace yat

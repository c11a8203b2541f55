#pragma once
// Part of soa/simd.h: bit tricks.

#if !defined(YAT_ISA) || !defined(YAT_ARCH)
#error "soa/simd_bits.h is part of soa/simd.h"
#endif

namespace yat::YAT_ISA::detail {

/// The bits of each byte in reverse order, and the bytes too: a 32-bit word back to front.
template <class A>
YAT_INLINE UInt<A> reverse_word_bits(const UInt<A>& x) {
#if defined(__SSSE3__)
  // Nibbles by table, bytes by the same shuffle.
  const UInt<A> low_bits(0x0f0f0f0fu);
  const UInt<A> low = x & low_bits, high = (x >> 4) & low_bits;
#if defined(__AVX512F__)
  const __m512i low_table = _mm512_broadcast_i32x4(
      _mm_setr_epi8(0, -128, 64, -64, 32, -96, 96, -32, 16, -112, 80, -48, 48, -80, 112, -16));
  const __m512i high_table =
      _mm512_broadcast_i32x4(_mm_setr_epi8(0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15));
  const __m512i bytes =
      _mm512_broadcast_i32x4(_mm_setr_epi8(3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12));
  const __m512i r =
      _mm512_or_si512(_mm512_shuffle_epi8(low_table, low), _mm512_shuffle_epi8(high_table, high));
  return UInt<A>(_mm512_shuffle_epi8(r, bytes));
#elif defined(__AVX2__)
  const __m256i low_table = _mm256_broadcastsi128_si256(
      _mm_setr_epi8(0, -128, 64, -64, 32, -96, 96, -32, 16, -112, 80, -48, 48, -80, 112, -16));
  const __m256i high_table = _mm256_broadcastsi128_si256(
      _mm_setr_epi8(0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15));
  const __m256i bytes = _mm256_broadcastsi128_si256(
      _mm_setr_epi8(3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12));
  const __m256i r =
      _mm256_or_si256(_mm256_shuffle_epi8(low_table, low), _mm256_shuffle_epi8(high_table, high));
  return UInt<A>(_mm256_shuffle_epi8(r, bytes));
#else
  const __m128i low_table =
      _mm_setr_epi8(0, -128, 64, -64, 32, -96, 96, -32, 16, -112, 80, -48, 48, -80, 112, -16);
  const __m128i high_table = _mm_setr_epi8(0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15);
  const __m128i bytes = _mm_setr_epi8(3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12);
  const __m128i r =
      _mm_or_si128(_mm_shuffle_epi8(low_table, low), _mm_shuffle_epi8(high_table, high));
  return UInt<A>(_mm_shuffle_epi8(r, bytes));
#endif
#else
  UInt<A> v = ((x >> 1) & UInt<A>(0x55555555u)) | ((x & UInt<A>(0x55555555u)) << 1);
  v = ((v >> 2) & UInt<A>(0x33333333u)) | ((v & UInt<A>(0x33333333u)) << 2);
  v = ((v >> 4) & UInt<A>(0x0f0f0f0fu)) | ((v & UInt<A>(0x0f0f0f0fu)) << 4);
  v = ((v >> 8) & UInt<A>(0x00ff00ffu)) | ((v & UInt<A>(0x00ff00ffu)) << 8);
  return (v >> 16) | (v << 16);
#endif
}

}  // namespace yat::YAT_ISA::detail

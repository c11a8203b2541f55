#pragma once
// Part of soa/simd.h: rows of words in memory <-> columns in registers, for W rows at once. A
// gather instruction fetches one word per row; where a row's words are wanted together, loading the
// rows in pieces of four or eight words and transposing them in registers takes a fraction of the
// time (on Zen 5 a 16-lane gather is about 20 cycles, the transpose of 8 columns about 20 in all).
//
// Every function gives the bits that the obvious form gives.

#if !defined(YAT_ISA) || !defined(YAT_ARCH)
#error "soa/simd_transpose.h is part of soa/simd.h"
#endif

#if defined(__SSE4_1__)
#include <immintrin.h>
#endif

namespace yat::YAT_ISA {

namespace detail {

#if defined(__SSE4_1__)
#define YAT_HAVE_QUADS 1

#if defined(__AVX512F__)
using QuadWord = __m512;
/// Words 0..3 of the rows of lanes k, k+4, k+8 and k+12, one row in each quarter.
YAT_INLINE QuadWord load_quads(const uint32_t* words, const uint32_t* at, uint32_t k) {
  const auto row = [&](uint32_t lane) {
    return _mm_loadu_ps(reinterpret_cast<const float*>(words + at[lane]));
  };
  __m512 r = _mm512_castps128_ps512(row(k));
  r = _mm512_mask_broadcast_f32x4(r, 0x00f0, row(k + 4));
  r = _mm512_mask_broadcast_f32x4(r, 0x0f00, row(k + 8));
  return _mm512_mask_broadcast_f32x4(r, 0xf000, row(k + 12));
}
YAT_INLINE void transpose_quads(QuadWord r0, QuadWord r1, QuadWord r2, QuadWord r3, QuadWord* out) {
  const __m512d a = _mm512_castps_pd(_mm512_unpacklo_ps(r0, r1));
  const __m512d b = _mm512_castps_pd(_mm512_unpacklo_ps(r2, r3));
  const __m512d c = _mm512_castps_pd(_mm512_unpackhi_ps(r0, r1));
  const __m512d d = _mm512_castps_pd(_mm512_unpackhi_ps(r2, r3));
  out[0] = _mm512_castpd_ps(_mm512_unpacklo_pd(a, b));
  out[1] = _mm512_castpd_ps(_mm512_unpackhi_pd(a, b));
  out[2] = _mm512_castpd_ps(_mm512_unpacklo_pd(c, d));
  out[3] = _mm512_castpd_ps(_mm512_unpackhi_pd(c, d));
}
#elif defined(__AVX2__)
using QuadWord = __m256;
YAT_INLINE QuadWord load_quads(const uint32_t* words, const uint32_t* at, uint32_t k) {
  const auto row = [&](uint32_t lane) {
    return _mm_loadu_ps(reinterpret_cast<const float*>(words + at[lane]));
  };
  return _mm256_insertf128_ps(_mm256_castps128_ps256(row(k)), row(k + 4), 1);
}
YAT_INLINE void transpose_quads(QuadWord r0, QuadWord r1, QuadWord r2, QuadWord r3, QuadWord* out) {
  const __m256d a = _mm256_castps_pd(_mm256_unpacklo_ps(r0, r1));
  const __m256d b = _mm256_castps_pd(_mm256_unpacklo_ps(r2, r3));
  const __m256d c = _mm256_castps_pd(_mm256_unpackhi_ps(r0, r1));
  const __m256d d = _mm256_castps_pd(_mm256_unpackhi_ps(r2, r3));
  out[0] = _mm256_castpd_ps(_mm256_unpacklo_pd(a, b));
  out[1] = _mm256_castpd_ps(_mm256_unpackhi_pd(a, b));
  out[2] = _mm256_castpd_ps(_mm256_unpacklo_pd(c, d));
  out[3] = _mm256_castpd_ps(_mm256_unpackhi_pd(c, d));
}
#else
using QuadWord = __m128;
YAT_INLINE QuadWord load_quads(const uint32_t* words, const uint32_t* at, uint32_t k) {
  return _mm_loadu_ps(reinterpret_cast<const float*>(words + at[k]));
}
YAT_INLINE void transpose_quads(QuadWord r0, QuadWord r1, QuadWord r2, QuadWord r3, QuadWord* out) {
  const __m128 a = _mm_unpacklo_ps(r0, r1), b = _mm_unpacklo_ps(r2, r3);
  const __m128 c = _mm_unpackhi_ps(r0, r1), d = _mm_unpackhi_ps(r2, r3);
  out[0] = _mm_movelh_ps(a, b);
  out[1] = _mm_movehl_ps(b, a);
  out[2] = _mm_movelh_ps(c, d);
  out[3] = _mm_movehl_ps(d, c);
}
#endif

/// The first `Fields` words of rows `index`, one register per word. Words past the last field, up
/// to a multiple of four, are read too: rows are padded.
template <class A, uint32_t Stride, uint32_t Fields>
YAT_INLINE void load_rows(const uint32_t* words, const UInt<A>& index, Float<A>* out) {
  static_assert(Stride % 4 == 0 && Fields <= Stride);
  alignas(64) uint32_t at[kLanes<A>];
  (index * UInt<A>(Stride)).store_aligned(at);
  QuadWord column[(Fields + 3) / 4 * 4];
  for (uint32_t f = 0; f < Fields; f += 4)
    transpose_quads(load_quads(words + f, at, 0), load_quads(words + f, at, 1),
                    load_quads(words + f, at, 2), load_quads(words + f, at, 3), column + f);
  for (uint32_t f = 0; f < Fields; ++f) out[f] = Float<A>(column[f]);
}
#endif

}  // namespace detail

/// Eight words of rows of floats; index: W valid rows, stride in words.
/// out[c] lane l = rows[index[l] * stride + c].
template <class A>
YAT_INLINE void load_rows8(const float* rows, const uint32_t* index, uint32_t stride,
                           Float<A> (&out)[8]) {
#if defined(__AVX512F__)
  const auto row = [&](uint32_t lane) { return rows + size_t(index[lane]) * stride; };
  // Register k holds two rows side by side, so chosen that the last step, which takes every second
  // quarter of two registers, leaves the rows in order.
  const auto two = [&](uint32_t low, uint32_t high) {
    return _mm512_insertf32x8(_mm512_castps256_ps512(_mm256_loadu_ps(row(low))),
                              _mm256_loadu_ps(row(high)), 1);
  };
  __m512 p[4], q[4];
  detail::transpose_quads(two(0, 4), two(1, 5), two(2, 6), two(3, 7), p);
  detail::transpose_quads(two(8, 12), two(9, 13), two(10, 14), two(11, 15), q);
  for (uint32_t c = 0; c < 4; ++c) {
    out[c] = Float<A>(_mm512_shuffle_f32x4(p[c], q[c], 0x88));
    out[c + 4] = Float<A>(_mm512_shuffle_f32x4(p[c], q[c], 0xdd));
  }
#elif defined(YAT_HAVE_QUADS)
  alignas(64) uint32_t at[kLanes<A>];
  for (uint32_t lane = 0; lane < kLanes<A>; ++lane) at[lane] = index[lane] * stride;
  const auto* words = reinterpret_cast<const uint32_t*>(rows);
  for (uint32_t half = 0; half < 8; half += 4) {
    detail::QuadWord column[4];
    detail::transpose_quads(
        detail::load_quads(words + half, at, 0), detail::load_quads(words + half, at, 1),
        detail::load_quads(words + half, at, 2), detail::load_quads(words + half, at, 3), column);
    for (uint32_t c = 0; c < 4; ++c) out[half + c] = Float<A>(column[c]);
  }
#else
  alignas(64) float column[8][kLanes<A>];
  for (uint32_t lane = 0; lane < kLanes<A>; ++lane)
    for (uint32_t c = 0; c < 8; ++c) column[c][lane] = rows[size_t(index[lane]) * stride + c];
  for (uint32_t c = 0; c < 8; ++c) out[c] = Float<A>::load_aligned(column[c]);
#endif
}

/// rows[index[l] * stride + c] = columns[c] lane l for c in 0..3. Rows that occur more than once
/// end up with any of their lanes.
template <class A>
YAT_INLINE void store_rows4(const Float<A>& c0, const Float<A>& c1, const Float<A>& c2,
                            const Float<A>& c3, float* rows, const uint32_t* index,
                            uint32_t stride) {
  const auto row = [&](uint32_t lane) { return rows + size_t(index[lane]) * stride; };
#if defined(YAT_HAVE_QUADS)
  detail::QuadWord s[4];
  detail::transpose_quads(c0, c1, c2, c3, s);
  for (uint32_t i = 0; i < 4; ++i) {
#if defined(__AVX512F__)
    _mm_storeu_ps(row(i), _mm512_castps512_ps128(s[i]));
    _mm_storeu_ps(row(i + 4), _mm512_extractf32x4_ps(s[i], 1));
    _mm_storeu_ps(row(i + 8), _mm512_extractf32x4_ps(s[i], 2));
    _mm_storeu_ps(row(i + 12), _mm512_extractf32x4_ps(s[i], 3));
#elif defined(__AVX2__)
    _mm_storeu_ps(row(i), _mm256_castps256_ps128(s[i]));
    _mm_storeu_ps(row(i + 4), _mm256_extractf128_ps(s[i], 1));
#else
    _mm_storeu_ps(row(i), s[i]);
#endif
  }
#else
  alignas(64) float column[4][kLanes<A>];
  c0.store_aligned(column[0]);
  c1.store_aligned(column[1]);
  c2.store_aligned(column[2]);
  c3.store_aligned(column[3]);
  for (uint32_t lane = 0; lane < kLanes<A>; ++lane)
    for (uint32_t c = 0; c < 4; ++c) row(lane)[c] = column[c][lane];
#endif
}

}  // namespace yat::YAT_ISA

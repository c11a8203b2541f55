#pragma once
// Rows of floats in memory <-> columns in registers, for W rows at once. A gather instruction
// fetches one word per row; where a row's words are wanted together, loading the rows whole and
// transposing them in registers takes a fraction of the time (a 16-lane gather is about 20 cycles
// on Zen, the transpose of 8 columns about 20 in all). For kernel sources, like simd.h.

#include "soa/simd.h"

#if defined(__SSE4_2__)
#include <immintrin.h>
#endif

namespace yat::YAT_ISA {

/// out[c] lane l = rows[index[l] * stride + c] for c in 0..7. index: W valid rows, stride in words.
template <class A>
YAT_INLINE void load_rows8(const float* rows, const uint32_t* index, uint32_t stride,
                           Float<A> (&out)[8]) {
  constexpr uint32_t W = kLanes<A>;
  const auto row = [&](uint32_t lane) { return rows + size_t(index[lane]) * stride; };
#if defined(__AVX512F__)
  if constexpr (W == 16) {
    // Register k holds two rows side by side, so chosen that the last step, which takes every
    // second 128-bit part of two registers, leaves the rows in order.
    const auto two = [&](uint32_t low, uint32_t high) {
      return _mm512_insertf32x8(_mm512_castps256_ps512(_mm256_loadu_ps(row(low))),
                                _mm256_loadu_ps(row(high)), 1);
    };
    const auto transpose4 = [](__m512 r0, __m512 r1, __m512 r2, __m512 r3, __m512(&s)[4]) {
      const __m512d a = _mm512_castps_pd(_mm512_unpacklo_ps(r0, r1));
      const __m512d b = _mm512_castps_pd(_mm512_unpackhi_ps(r0, r1));
      const __m512d c = _mm512_castps_pd(_mm512_unpacklo_ps(r2, r3));
      const __m512d d = _mm512_castps_pd(_mm512_unpackhi_ps(r2, r3));
      s[0] = _mm512_castpd_ps(_mm512_unpacklo_pd(a, c));
      s[1] = _mm512_castpd_ps(_mm512_unpackhi_pd(a, c));
      s[2] = _mm512_castpd_ps(_mm512_unpacklo_pd(b, d));
      s[3] = _mm512_castpd_ps(_mm512_unpackhi_pd(b, d));
    };
    __m512 p[4], q[4];
    transpose4(two(0, 4), two(1, 5), two(2, 6), two(3, 7), p);
    transpose4(two(8, 12), two(9, 13), two(10, 14), two(11, 15), q);
    for (uint32_t c = 0; c < 4; ++c) {
      out[c] = Float<A>(_mm512_shuffle_f32x4(p[c], q[c], 0x88));
      out[c + 4] = Float<A>(_mm512_shuffle_f32x4(p[c], q[c], 0xdd));
    }
    return;
  }
#endif
#if defined(__AVX__)
  if constexpr (W == 8) {
    const auto two = [&](uint32_t low, uint32_t high, uint32_t column) {
      return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(row(low) + column)),
                                  _mm_loadu_ps(row(high) + column), 1);
    };
    for (uint32_t half = 0; half < 8; half += 4) {
      const __m256 r0 = two(0, 4, half), r1 = two(1, 5, half), r2 = two(2, 6, half),
                   r3 = two(3, 7, half);
      const __m256d a = _mm256_castps_pd(_mm256_unpacklo_ps(r0, r1));
      const __m256d b = _mm256_castps_pd(_mm256_unpackhi_ps(r0, r1));
      const __m256d c = _mm256_castps_pd(_mm256_unpacklo_ps(r2, r3));
      const __m256d d = _mm256_castps_pd(_mm256_unpackhi_ps(r2, r3));
      out[half] = Float<A>(_mm256_castpd_ps(_mm256_unpacklo_pd(a, c)));
      out[half + 1] = Float<A>(_mm256_castpd_ps(_mm256_unpackhi_pd(a, c)));
      out[half + 2] = Float<A>(_mm256_castpd_ps(_mm256_unpacklo_pd(b, d)));
      out[half + 3] = Float<A>(_mm256_castpd_ps(_mm256_unpackhi_pd(b, d)));
    }
    return;
  }
#endif
#if defined(__SSE4_2__)
  if constexpr (W == 4) {
    for (uint32_t half = 0; half < 8; half += 4) {
      __m128 r0 = _mm_loadu_ps(row(0) + half), r1 = _mm_loadu_ps(row(1) + half),
             r2 = _mm_loadu_ps(row(2) + half), r3 = _mm_loadu_ps(row(3) + half);
      _MM_TRANSPOSE4_PS(r0, r1, r2, r3);
      out[half] = Float<A>(r0);
      out[half + 1] = Float<A>(r1);
      out[half + 2] = Float<A>(r2);
      out[half + 3] = Float<A>(r3);
    }
    return;
  }
#endif
  alignas(64) float column[8][W];
  for (uint32_t lane = 0; lane < W; ++lane)
    for (uint32_t c = 0; c < 8; ++c) column[c][lane] = row(lane)[c];
  for (uint32_t c = 0; c < 8; ++c) out[c] = Float<A>::load_aligned(column[c]);
}

/// rows[index[l] * stride + c] = columns[c] lane l for c in 0..3. Rows that occur more than once
/// end up with any of their lanes.
template <class A>
YAT_INLINE void store_rows4(const Float<A>& c0, const Float<A>& c1, const Float<A>& c2,
                            const Float<A>& c3, float* rows, const uint32_t* index,
                            uint32_t stride) {
  constexpr uint32_t W = kLanes<A>;
  const auto row = [&](uint32_t lane) { return rows + size_t(index[lane]) * stride; };
#if defined(__AVX512F__)
  if constexpr (W == 16) {
    const __m512d a = _mm512_castps_pd(_mm512_unpacklo_ps(c0, c1));
    const __m512d b = _mm512_castps_pd(_mm512_unpackhi_ps(c0, c1));
    const __m512d c = _mm512_castps_pd(_mm512_unpacklo_ps(c2, c3));
    const __m512d d = _mm512_castps_pd(_mm512_unpackhi_ps(c2, c3));
    const __m512 s[4] = {
        _mm512_castpd_ps(_mm512_unpacklo_pd(a, c)), _mm512_castpd_ps(_mm512_unpackhi_pd(a, c)),
        _mm512_castpd_ps(_mm512_unpacklo_pd(b, d)), _mm512_castpd_ps(_mm512_unpackhi_pd(b, d))};
    for (uint32_t i = 0; i < 4; ++i) {
      _mm_storeu_ps(row(i), _mm512_castps512_ps128(s[i]));
      _mm_storeu_ps(row(i + 4), _mm512_extractf32x4_ps(s[i], 1));
      _mm_storeu_ps(row(i + 8), _mm512_extractf32x4_ps(s[i], 2));
      _mm_storeu_ps(row(i + 12), _mm512_extractf32x4_ps(s[i], 3));
    }
    return;
  }
#endif
#if defined(__AVX__)
  if constexpr (W == 8) {
    const __m256d a = _mm256_castps_pd(_mm256_unpacklo_ps(c0, c1));
    const __m256d b = _mm256_castps_pd(_mm256_unpackhi_ps(c0, c1));
    const __m256d c = _mm256_castps_pd(_mm256_unpacklo_ps(c2, c3));
    const __m256d d = _mm256_castps_pd(_mm256_unpackhi_ps(c2, c3));
    const __m256 s[4] = {
        _mm256_castpd_ps(_mm256_unpacklo_pd(a, c)), _mm256_castpd_ps(_mm256_unpackhi_pd(a, c)),
        _mm256_castpd_ps(_mm256_unpacklo_pd(b, d)), _mm256_castpd_ps(_mm256_unpackhi_pd(b, d))};
    for (uint32_t i = 0; i < 4; ++i) {
      _mm_storeu_ps(row(i), _mm256_castps256_ps128(s[i]));
      _mm_storeu_ps(row(i + 4), _mm256_extractf128_ps(s[i], 1));
    }
    return;
  }
#endif
#if defined(__SSE4_2__)
  if constexpr (W == 4) {
    __m128 r0 = c0, r1 = c1, r2 = c2, r3 = c3;
    _MM_TRANSPOSE4_PS(r0, r1, r2, r3);
    _mm_storeu_ps(row(0), r0);
    _mm_storeu_ps(row(1), r1);
    _mm_storeu_ps(row(2), r2);
    _mm_storeu_ps(row(3), r3);
    return;
  }
#endif
  alignas(64) float column[4][W];
  c0.store_aligned(column[0]);
  c1.store_aligned(column[1]);
  c2.store_aligned(column[2]);
  c3.store_aligned(column[3]);
  for (uint32_t lane = 0; lane < W; ++lane)
    for (uint32_t c = 0; c < 4; ++c) row(lane)[c] = column[c][lane];
}

}  // namespace yat::YAT_ISA

#pragma once
// Part of soa/simd.h: memory operations that are worth more than their obvious form. Rows of a
// RowTable are fetched four words at a time and transposed in registers, rows of columns that lie
// near each other by permuting two registers: a gather costs about a load per lane and field.
//
// Every function gives the bits that the obvious form gives.

#if !defined(YAT_ISA) || !defined(YAT_ARCH)
#error "soa/simd_rows.h is part of soa/simd.h"
#endif

namespace yat::YAT_ISA::detail {

#if defined(__AVX512F__) || defined(__AVX2__) || defined(__SSE4_1__)
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

/// W values of `column` at base + offset, where offset < 2 W; `far` = base, or base + W where that
/// register is needed. base is a multiple of W.
#if defined(__AVX512F__)
inline constexpr bool kHasNear = true;
template <class A, class T>
YAT_INLINE xsimd::batch<T, A> permute_near(const T* column, uint32_t base, uint32_t far,
                                           const UInt<A>& offset) {
  const __m512i low = _mm512_loadu_si512(column + base), high = _mm512_loadu_si512(column + far);
  const UInt<A> v(_mm512_permutex2var_epi32(low, offset, high));
  return xsimd::bitwise_cast<T>(v);
}
#elif defined(__AVX2__)
inline constexpr bool kHasNear = true;
template <class A, class T>
YAT_INLINE xsimd::batch<T, A> permute_near(const T* column, uint32_t base, uint32_t far,
                                           const UInt<A>& offset) {
  const __m256 low = _mm256_loadu_ps(reinterpret_cast<const float*>(column + base));
  const __m256 high = _mm256_loadu_ps(reinterpret_cast<const float*>(column + far));
  const __m256i lane = offset;  // permutes use the low three bits, the fourth chooses the register
  const __m256 v =
      _mm256_blendv_ps(_mm256_permutevar8x32_ps(low, lane), _mm256_permutevar8x32_ps(high, lane),
                       _mm256_castsi256_ps(_mm256_slli_epi32(lane, 28)));
  return xsimd::bitwise_cast<T>(Float<A>(v));
}
#else
inline constexpr bool kHasNear = false;
template <class A, class T>
YAT_INLINE xsimd::batch<T, A> permute_near(const T* column, uint32_t, uint32_t, const UInt<A>&) {
  return xsimd::batch<T, A>::load_unaligned(column);  // never called
}
#endif

/// The bits of each byte in reverse order, and the bytes too: a 32-bit word back to front.
template <class A>
YAT_INLINE UInt<A> reverse_word_bits(const UInt<A>& x) {
#if defined(YAT_HAVE_QUADS)
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

namespace yat::YAT_ISA {

/// Rows index[0..W) of dense columns. Found once, used for every column. Consecutive rows of one
/// bin lie near each other, as sorting keeps their order: two registers then hold them all.
template <class A>
struct NearRows {
  UInt<A> index;      ///< every lane valid
  UInt<A> offset;     ///< index - base
  uint32_t base = 0;  ///< multiple of W
  uint32_t far = 0;
  bool near = false;
};

/// For the row numbers order[first...], ascending or not; `count` > 0 of them are valid, the lanes
/// after that repeat the first.
template <class A>
YAT_INLINE NearRows<A> near_rows(const uint32_t* order, uint32_t first, uint32_t count) {
  constexpr uint32_t W = kLanes<A>;
  NearRows<A> rows;
  rows.index = UInt<A>::load_unaligned(order + first);
  if (count < W) {
    const auto valid = lane_index<A>() < UInt<A>(count);
    rows.index = xsimd::select(valid, rows.index, UInt<A>(order[first]));
  }
  if constexpr (detail::kHasNear) {
    rows.base = order[first] / W * W;
    rows.offset = rows.index - UInt<A>(rows.base);
    // An index below base wraps to a large offset.
    rows.near = xsimd::all(rows.offset < UInt<A>(2 * W));
    rows.far = xsimd::all(rows.offset < UInt<A>(W)) ? rows.base : rows.base + W;
  }
  return rows;
}

template <class A, class T>
YAT_INLINE xsimd::batch<T, A> gather(const T* column, const NearRows<A>& rows) {
  if constexpr (detail::kHasNear)
    if (rows.near) return detail::permute_near<A>(column, rows.base, rows.far, rows.offset);
  return detail::gather_word<A, T>(column, rows.index);
}
template <class A, template <template <class> class> class Record, template <class> class Shape>
YAT_INLINE Record<Lanes<A>::template Of> gather(const Record<Shape>& columns,
                                                const NearRows<A>& rows) {
  Record<Lanes<A>::template Of> out;
  for_each_field(
      [&rows](auto, auto& to, const auto& from) {
        to = gather<A, element_t<decltype(from)>>(from, rows);
      },
      out, columns);
  return out;
}

}  // namespace yat::YAT_ISA

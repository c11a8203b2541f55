#pragma once
// Part of soa/simd.h: rows of columns that lie near each other, by permuting two registers; a
// gather costs about a load per lane and field. Every function gives the bits that the obvious form
// gives.

#if !defined(YAT_ISA) || !defined(YAT_ARCH)
#error "soa/simd_rows.h is part of soa/simd.h"
#endif

namespace yat::YAT_ISA::detail {

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

#pragma once
// The only include of xsimd: SIMD words, and the operations over records in registers. For kernel
// sources, which are compiled once per instruction set with YAT_ISA (its name, and the namespace
// of everything here) and YAT_ARCH (the xsimd architecture) defined.
//
// Lanes and rows. A kernel walks its rows W at a time. The last step may hold fewer than W valid
// rows: `tail_mask(first, n)` says which. Columns are padded (kRowPad), so loads and stores of
// whole registers are legal there; what padding rows hold is arbitrary, so an index loaded from a
// column must be masked before it is used to gather.

#if !defined(YAT_ISA) || !defined(YAT_ARCH)
#error "soa/simd.h is for kernel sources, which are built once per instruction set"
#endif

#include <xsimd/xsimd.hpp>

#include "soa/columns.h"
#include "soa/fields.h"

namespace yat::YAT_ISA {

/// The instruction set this source is being compiled for.
using NativeArch = YAT_ARCH;

/// The SIMD words of architecture A.
template <class A>
struct Lanes {
  template <class T>
  using Of = xsimd::batch<T, A>;
  static constexpr uint32_t W = Of<float>::size;
};

template <class A>
using Float = xsimd::batch<float, A>;
template <class A>
using UInt = xsimd::batch<uint32_t, A>;
template <class A>
using Int = xsimd::batch<int32_t, A>;
/// One truth value per lane, tied to float registers; mask_of() brings the integer kinds here.
template <class A>
using Mask = xsimd::batch_bool<float, A>;
template <class A>
inline constexpr uint32_t kLanes = Lanes<A>::W;

template <class A>
YAT_INLINE Mask<A> mask_of(const xsimd::batch_bool<uint32_t, A>& m) {
  return xsimd::batch_bool_cast<float>(m);
}
template <class A>
YAT_INLINE Mask<A> mask_of(const xsimd::batch_bool<int32_t, A>& m) {
  return xsimd::batch_bool_cast<float>(m);
}
template <class A>
YAT_INLINE xsimd::batch_bool<uint32_t, A> uint_mask(const Mask<A>& m) {
  return xsimd::batch_bool_cast<uint32_t>(m);
}

/// 0, 1, 2, ... W-1.
template <class A>
YAT_INLINE UInt<A> lane_index() {
  alignas(64) static constexpr uint32_t k[16] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                 8, 9, 10, 11, 12, 13, 14, 15};
  return UInt<A>::load_aligned(k);
}

/// Lanes whose row first + lane is below n.
template <class A>
YAT_INLINE Mask<A> tail_mask(uint32_t first, uint32_t n) {
  const uint32_t left = n - first;
  return mask_of<A>(lane_index<A>() < UInt<A>(left < kLanes<A> ? left : kLanes<A>));
}

template <class A>
YAT_INLINE uint32_t mask_bits(const Mask<A>& m) {
  return uint32_t(m.mask());
}
template <class A>
YAT_INLINE uint32_t count_true(const Mask<A>& m) {
  return uint32_t(__builtin_popcount(mask_bits<A>(m)));
}
template <class A>
YAT_INLINE bool any(const Mask<A>& m) {
  return xsimd::any(m);
}

template <class A>
YAT_INLINE Float<A> as_float(const UInt<A>& v) {
  return xsimd::bitwise_cast<float>(v);
}
template <class A>
YAT_INLINE UInt<A> as_uint(const Float<A>& v) {
  return xsimd::bitwise_cast<uint32_t>(v);
}

/// Lanes whose highest bit is set.
template <class A>
YAT_INLINE Mask<A> negative(const UInt<A>& v) {
  return mask_of<A>(xsimd::bitwise_cast<int32_t>(v) < Int<A>(0));
}

template <class A>
YAT_INLINE Float<A> select(const Mask<A>& m, const Float<A>& a, const Float<A>& b) {
  return xsimd::select(m, a, b);
}
template <class A>
YAT_INLINE UInt<A> select(const Mask<A>& m, const UInt<A>& a, const UInt<A>& b) {
  return xsimd::select(uint_mask<A>(m), a, b);
}

/// Masked lanes of `v`, 0 elsewhere: how an index column becomes safe to gather with.
template <class A>
YAT_INLINE UInt<A> only(const Mask<A>& m, const UInt<A>& v) {
  return xsimd::select(uint_mask<A>(m), v, UInt<A>(0u));
}
template <class A>
YAT_INLINE Float<A> only(const Mask<A>& m, const Float<A>& v) {
  return xsimd::select(m, v, Float<A>(0.f));
}

namespace detail {
template <class A, class T>
YAT_INLINE xsimd::batch<T, A> load_word(const T* p) {
  return xsimd::batch<T, A>::load_unaligned(p);
}
template <class A, class T>
YAT_INLINE xsimd::batch<T, A> gather_word(const T* p, const UInt<A>& index) {
  // 32-bit signed indices: tables of up to 2^31 words.
  return xsimd::batch<T, A>::gather(p, xsimd::bitwise_cast<int32_t>(index));
}
}  // namespace detail

}  // namespace yat::YAT_ISA

#include "soa/simd_bits.h"
#include "soa/simd_rows.h"
#include "soa/simd_transpose.h"

namespace yat::YAT_ISA {

/// The 32 bits of each lane in reverse order.
template <class A>
YAT_INLINE UInt<A> reverse_bits(const UInt<A>& x) {
  return detail::reverse_word_bits<A>(x);
}

/// W rows of columns, from row `first` on.
template <class A, template <template <class> class> class Record, template <class> class Shape>
YAT_INLINE Record<Lanes<A>::template Of> load(const Record<Shape>& columns, uint32_t first) {
  Record<Lanes<A>::template Of> out;
  for_each_field(
      [first](auto, auto& to, const auto& from) {
        to = detail::load_word<A, element_t<decltype(from)>>(from + first);
      },
      out, columns);
  return out;
}

/// Rows `index` of columns. Every lane's index must be valid (see `only`).
template <class A, template <template <class> class> class Record, template <class> class Shape>
YAT_INLINE Record<Lanes<A>::template Of> gather(const Record<Shape>& columns,
                                                const UInt<A>& index) {
  Record<Lanes<A>::template Of> out;
  for_each_field(
      [&index](auto, auto& to, const auto& from) {
        to = detail::gather_word<A, element_t<decltype(from)>>(from, index);
      },
      out, columns);
  return out;
}

/// Rows `index` of a row table. Every lane's index must be valid (see `only`).
template <class A, template <template <class> class> class Record>
YAT_INLINE Record<Lanes<A>::template Of> gather(const Rows<Record>& rows, const UInt<A>& index) {
  Record<Lanes<A>::template Of> out;
#if defined(YAT_HAVE_QUADS)
  Float<A> word[field_count<Record>];
  detail::load_rows<A, row_words<Record>, field_count<Record>>(rows.words, index, word);
  for_each_field(
      [&](auto field, auto& to) {
        using T = typename std::remove_reference_t<decltype(to)>::value_type;
        to = xsimd::bitwise_cast<T>(word[field]);
      },
      out);
#else
  const UInt<A> base = index * UInt<A>(row_words<Record>);
  for_each_field(
      [&](auto field, auto& to) {
        using T = typename std::remove_reference_t<decltype(to)>::value_type;
        to = detail::gather_word<A, T>(reinterpret_cast<const T*>(rows.words) + field, base);
      },
      out);
#endif
  return out;
}

/// Row `row` of a row table in every lane.
template <class A, template <template <class> class> class Record>
YAT_INLINE Record<Lanes<A>::template Of> broadcast(const Rows<Record>& rows, uint32_t row) {
  Record<Lanes<A>::template Of> out;
  const uint32_t* words = rows.words + size_t(row) * row_words<Record>;
  for_each_field(
      [&](auto field, auto& to) {
        using T = typename std::remove_reference_t<decltype(to)>::value_type;
        to = xsimd::bitwise_cast<T>(UInt<A>(words[field]));
      },
      out);
  return out;
}

/// Gathers from one column or plain array. Every lane's index must be valid.
template <class A, class T>
YAT_INLINE xsimd::batch<T, A> gather(const T* column, const UInt<A>& index) {
  return detail::gather_word<A, T>(column, index);
}

template <class A, class T>
YAT_INLINE xsimd::batch<T, A> load(const T* column, uint32_t first) {
  return detail::load_word<A, T>(column + first);
}

template <class A, class T>
YAT_INLINE void store(const xsimd::batch<T, A>& v, T* column, uint32_t first) {
  v.store_unaligned(column + first);
}

/// Writes W rows of columns, from row `first` on.
template <class A, template <template <class> class> class Record>
YAT_INLINE void store(const Record<Lanes<A>::template Of>& rows, const Record<Column>& columns,
                      uint32_t first) {
  for_each_field(
      [first](auto, const auto& from, const auto& to) { from.store_unaligned(to + first); }, rows,
      columns);
}

#if defined(__AVX2__) || defined(__SSSE3__)
/// For every 8-bit mask, the numbers of its set bits in front, then 0.
struct PackTable {
  uint8_t lane[256][8];
};
constexpr PackTable make_pack_table() {
  PackTable table{};
  for (uint32_t mask = 0; mask < 256; ++mask)
    for (uint32_t bit = 0, count = 0; bit < 8; ++bit)
      if (mask >> bit & 1) table.lane[mask][count++] = uint8_t(bit);
  return table;
}
alignas(64) inline constexpr PackTable kPackTable = make_pack_table();
/// The same for 4 lanes, as byte numbers for a byte shuffle.
struct PackTable4 {
  uint8_t byte[16][16];
};
constexpr PackTable4 make_pack_table4() {
  PackTable4 table{};
  for (uint32_t mask = 0; mask < 16; ++mask)
    for (uint32_t k = 0; k < 16; ++k)
      table.byte[mask][k] = uint8_t(make_pack_table().lane[mask][k / 4] * 4 + k % 4);
  return table;
}
alignas(64) inline constexpr PackTable4 kPackTable4 = make_pack_table4();
#endif

/// Lanes of `v` where `m` holds, packed to the front in lane order; the rest is arbitrary.
/// By table where there is no instruction for it: xsimd's general form computes the shuffle.
template <class A, class T>
YAT_INLINE xsimd::batch<T, A> pack_left(const xsimd::batch<T, A>& v, const Mask<A>& m) {
#if defined(__AVX2__)
  if constexpr (kLanes<A> == 8 && sizeof(T) == 4) {
    const __m256i lanes = _mm256_cvtepu8_epi32(
        _mm_loadl_epi64(reinterpret_cast<const __m128i*>(kPackTable.lane[mask_bits<A>(m)])));
    const UInt<A> packed(
        _mm256_permutevar8x32_epi32(__m256i(xsimd::bitwise_cast<uint32_t>(v)), lanes));
    return xsimd::bitwise_cast<T>(packed);
  } else
#endif
#if defined(__SSSE3__)
      if constexpr (kLanes<A> == 4 && sizeof(T) == 4) {
    const __m128i bytes =
        _mm_load_si128(reinterpret_cast<const __m128i*>(kPackTable4.byte[mask_bits<A>(m)]));
    const UInt<A> packed(_mm_shuffle_epi8(__m128i(xsimd::bitwise_cast<uint32_t>(v)), bytes));
    return xsimd::bitwise_cast<T>(packed);
  } else
#endif
    return xsimd::compress(v, xsimd::batch_bool_cast<T>(m));
}

/// Appends the active lanes at `column[row...]`, in lane order. Writes a whole register: the
/// column must have W words from `row` on. The caller advances by count_true(active).
template <class A, class T>
YAT_INLINE void store_packed(const xsimd::batch<T, A>& v, const Mask<A>& active, T* column,
                             uint32_t row) {
  pack_left<A>(v, active).store_unaligned(column + row);
}
template <class A, template <template <class> class> class Record>
YAT_INLINE void store_packed(const Record<Lanes<A>::template Of>& rows, const Mask<A>& active,
                             const Record<Column>& columns, uint32_t row) {
  for_each_field(
      [&](auto, const auto& from, const auto& to) { store_packed<A>(from, active, to, row); }, rows,
      columns);
}

/// Writes active lanes of `v` to column[index]. Active indices must differ.
template <class A, class T>
YAT_INLINE void scatter(const xsimd::batch<T, A>& v, const UInt<A>& index, const Mask<A>& active,
                        T* column) {
#if defined(__AVX512F__)
  const UInt<A> word = xsimd::bitwise_cast<uint32_t>(v);
  _mm512_mask_i32scatter_epi32(column, __mmask16(mask_bits<A>(active)), index, word, 4);
#else
  alignas(64) T value[kLanes<A>];
  alignas(64) uint32_t at[kLanes<A>];
  v.store_aligned(value);
  index.store_aligned(at);
  for (uint32_t bits = mask_bits<A>(active); bits; bits &= bits - 1) {
    const uint32_t lane = uint32_t(__builtin_ctz(bits));
    column[at[lane]] = value[lane];
  }
#endif
}

/// Adds active lanes of `v` to column[index]. Active indices must differ.
template <class A>
YAT_INLINE void scatter_add(const Float<A>& v, const UInt<A>& index, const Mask<A>& active,
                            float* column) {
#if defined(__AVX512F__)
  const __mmask16 m = __mmask16(mask_bits<A>(active));
  const __m512 old = _mm512_mask_i32gather_ps(_mm512_setzero_ps(), m, index, column, 4);
  _mm512_mask_i32scatter_ps(column, m, index, _mm512_add_ps(old, v), 4);
#else
  alignas(64) float value[kLanes<A>];
  alignas(64) uint32_t at[kLanes<A>];
  v.store_aligned(value);
  index.store_aligned(at);
  for (uint32_t bits = mask_bits<A>(active); bits; bits &= bits - 1) {
    const uint32_t lane = uint32_t(__builtin_ctz(bits));
    column[at[lane]] += value[lane];
  }
#endif
}

}  // namespace yat::YAT_ISA

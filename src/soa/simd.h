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
  const UInt<A> base = index * UInt<A>(row_words<Record>);
  for_each_field(
      [&](auto field, auto& to) {
        using T = typename std::remove_reference_t<decltype(to)>::value_type;
        to = detail::gather_word<A, T>(reinterpret_cast<const T*>(rows.words) + field, base);
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

/// Lanes of `v` where `m` holds, packed to the front in lane order; the rest is arbitrary.
template <class A, class T>
YAT_INLINE xsimd::batch<T, A> pack_left(const xsimd::batch<T, A>& v, const Mask<A>& m) {
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
  alignas(64) T value[kLanes<A>];
  alignas(64) uint32_t at[kLanes<A>];
  v.store_aligned(value);
  index.store_aligned(at);
  for (uint32_t bits = mask_bits<A>(active); bits; bits &= bits - 1) {
    const uint32_t lane = uint32_t(__builtin_ctz(bits));
    column[at[lane]] = value[lane];
  }
}

/// Adds active lanes of `v` to column[index]. Active indices must differ.
template <class A>
YAT_INLINE void scatter_add(const Float<A>& v, const UInt<A>& index, const Mask<A>& active,
                            float* column) {
  alignas(64) float value[kLanes<A>];
  alignas(64) uint32_t at[kLanes<A>];
  v.store_aligned(value);
  index.store_aligned(at);
  for (uint32_t bits = mask_bits<A>(active); bits; bits &= bits - 1) {
    const uint32_t lane = uint32_t(__builtin_ctz(bits));
    column[at[lane]] += value[lane];
  }
}

}  // namespace yat::YAT_ISA

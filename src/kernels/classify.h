#pragma once
// Hits -> bins.

#include "kernels/table.h"
#include "soa/simd.h"

namespace yat::YAT_ISA {

/// Bins of hits, once paths at their last vertex have been told from the others: those go on only
/// to bins from first_lasting on.
template <class A>
YAT_INLINE UInt<A> end_last_vertices(const UInt<A>& bin, const UInt<A>& depth, const Mask<A>& hit,
                                     uint32_t first_lasting, uint32_t max_depth) {
  const Mask<A> last = mask_of<A>((depth & UInt<A>(0xffffu)) >= UInt<A>(max_depth));
  if (!any<A>(last & hit)) return bin;
  const Mask<A> lasts = mask_of<A>(bin >= UInt<A>(first_lasting));
  return select<A>(last & !lasts, UInt<A>(0u), bin);
}

/// See KernelTable::classify_hits.
template <class A>
void classify_hits(const uint32_t* prim_bin, uint32_t first_lasting, uint32_t max_depth,
                   const Hit<ConstColumn>& hits, const uint32_t* depth, uint32_t* bin,
                   uint32_t n) noexcept {
  for (uint32_t row = 0; row < n; row += kLanes<A>) {
    const UInt<A> prim = load<A>(hits.prim, row);
    const Mask<A> hit = mask_of<A>(prim != UInt<A>(kNone)) & tail_mask<A>(row, n);
    UInt<A> b(0u);
    if (any<A>(hit)) {
      b = only<A>(hit, gather<A>(prim_bin, only<A>(hit, prim)));
      b = end_last_vertices<A>(b, load<A>(depth, row), hit, first_lasting, max_depth);
    }
    store<A>(b, bin, row);
  }
}

/// See KernelTable::classify_instance_hits.
template <class A>
void classify_instance_hits(const InstancesView& instances, const uint32_t* prim_bin,
                            uint32_t first_lasting, uint32_t max_depth,
                            const Hit<ConstColumn>& hits, const uint32_t* instance,
                            const uint32_t* depth, uint32_t* bin, uint32_t n) noexcept {
  const UInt<A> none(kNone);
  const uint32_t* const first_shape = instances.rows.words + kFirstShapeWord;
  for (uint32_t row = 0; row < n; row += kLanes<A>) {
    const UInt<A> prim = load<A>(hits.prim, row), place = load<A>(instance, row);
    const Mask<A> hit = mask_of<A>(prim != none) & tail_mask<A>(row, n);
    const Mask<A> placed = hit & mask_of<A>(place != none), once = hit & !placed;
    UInt<A> b(0u);
    if (any<A>(once)) b = only<A>(once, gather<A>(prim_bin, only<A>(once, prim)));
    if (any<A>(placed)) {
      const UInt<A> shape =
          gather<A>(first_shape, only<A>(placed, place * UInt<A>(row_words<InstanceRow>))) +
          gather<A>(instances.triangle_shape, only<A>(placed, prim));
      const UInt<A> of_shape = gather<A>(
          instances.shapes.words, only<A>(placed, shape * UInt<A>(row_words<InstanceShapeRow>)));
      b = select<A>(placed, of_shape, b);
    }
    if (any<A>(hit))
      b = end_last_vertices<A>(b, load<A>(depth, row), hit, first_lasting, max_depth);
    store<A>(b, bin, row);
  }
}

}  // namespace yat::YAT_ISA

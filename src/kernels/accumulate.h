#pragma once
// Free shadow rays -> samples.

#include "kernels/table.h"
#include "soa/simd.h"

namespace yat::YAT_ISA {

/// Adds (r, g, b) of active lanes to their slots, which must differ.
template <class A>
YAT_INLINE void add_to_samples(const Float<A>& r, const Float<A>& g, const Float<A>& b,
                               const UInt<A>& slot, const Mask<A>& active,
                               const SampleSum<Column>& sums) {
  scatter_add<A>(r, slot, active, sums.r);
  scatter_add<A>(g, slot, active, sums.g);
  scatter_add<A>(b, slot, active, sums.b);
}

/// See KernelTable::add_unoccluded.
template <class A>
void add_unoccluded(const ShadowRay<ConstColumn>& rays, const uint32_t* occluded,
                    const SampleSum<Column>& sums, uint32_t n) noexcept {
  for (uint32_t row = 0; row < n; row += kLanes<A>) {
    const Mask<A> active = mask_of<A>(load<A>(occluded, row) == UInt<A>(0u)) & tail_mask<A>(row, n);
    if (!any<A>(active)) continue;
    add_to_samples<A>(load<A>(rays.add_r, row), load<A>(rays.add_g, row), load<A>(rays.add_b, row),
                      load<A>(rays.slot, row), active, sums);
  }
}

}  // namespace yat::YAT_ISA

#pragma once
// Hits -> bins.

#include "kernels/table.h"
#include "soa/simd.h"

namespace yat::YAT_ISA {

/// See KernelTable::classify_hits.
template <class A>
void classify_hits(const uint32_t* prim_bin, uint64_t emissive_bins, uint32_t max_depth,
                   const Hit<ConstColumn>& hits, const uint32_t* depth, uint32_t* bin,
                   uint32_t n) noexcept {
  const UInt<A> low_bins{uint32_t(emissive_bins)}, high_bins{uint32_t(emissive_bins >> 32)};
  const UInt<A> none(kNone), zero(0u), one(1u);
  for (uint32_t row = 0; row < n; row += kLanes<A>) {
    const UInt<A> prim = load<A>(hits.prim, row);
    const Mask<A> hit = mask_of<A>(prim != none) & tail_mask<A>(row, n);
    UInt<A> b = zero;
    if (any<A>(hit)) {
      b = only<A>(hit, gather<A>(prim_bin, only<A>(hit, prim)));
      const Mask<A> last =
          mask_of<A>((load<A>(depth, row) & UInt<A>(0xffffu)) >= UInt<A>(max_depth));
      if (any<A>(last & hit)) {
        const UInt<A> set = select<A>(mask_of<A>(b < UInt<A>(32u)), low_bins, high_bins);
        const Mask<A> emits = mask_of<A>(((set >> (b & UInt<A>(31u))) & one) != zero);
        b = select<A>(last & !emits, zero, b);
      }
    }
    store<A>(b, bin, row);
  }
}

}  // namespace yat::YAT_ISA

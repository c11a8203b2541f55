#pragma once
// What is not finite or not positive is dropped, counted and logged (invariant 6).

#include "kernels/table.h"
#include "soa/simd.h"

namespace yat::YAT_ISA {

/// Logs the lanes of `dropped`. Out of line: it hardly ever runs.
template <class A>
[[gnu::noinline, gnu::cold]] void log_drops(DropCause cause, uint32_t dropped,
                                            const uint32_t* pixel, const uint32_t* sample,
                                            DropLog& log) noexcept {
  // DropLog::add, written out: an inline function shared with other instruction sets must not be
  // instantiated here.
  for (; dropped; dropped &= dropped - 1) {
    const uint32_t lane = uint32_t(__builtin_ctz(dropped));
    ++log.count[uint32_t(cause)];
    if (log.kept < DropLog::kKept)
      log.entry[log.kept++] = {pixel[lane], sample[lane], uint32_t(cause)};
  }
}

/// Removes `bad` lanes from `kept` and logs them. `pixel` and `sample` point at lane 0's row.
template <class A>
YAT_INLINE void drop_lanes(Mask<A>& kept, const Mask<A>& bad, DropCause cause,
                           const uint32_t* pixel, const uint32_t* sample, DropLog& log) {
  const Mask<A> dropped = kept & bad;
  if (any<A>(dropped)) [[unlikely]] {
    log_drops<A>(cause, mask_bits<A>(dropped), pixel, sample, log);
    kept = kept & !dropped;
  }
}

}  // namespace yat::YAT_ISA

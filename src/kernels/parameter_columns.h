#pragma once
// Parameter rows -> columns: the fields of a textured material that no texture gives.

#include "kernels/shade.h"
#include "kernels/table.h"

namespace yat::YAT_ISA {

/// See KernelTable::spread_parameters.
template <class A>
void spread_parameters(const ParameterView& view, uint32_t row_words, const uint32_t* row,
                       uint32_t* const* columns, uint32_t fields, uint32_t n) noexcept {
  for (uint32_t f = 0; f < fields; ++f) {
    if (!columns[f]) continue;
    for (uint32_t i = 0; i < n; i += kLanes<A>) {
      const UInt<A> at = only<A>(tail_mask<A>(i, n), load<A>(row, i)) * UInt<A>(row_words);
      store<A>(view.count == 1 ? UInt<A>(view.words[f]) : gather<A>(view.words + f, at), columns[f],
               i);
    }
  }
}

}  // namespace yat::YAT_ISA

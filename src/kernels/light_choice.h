#pragma once
// Which light is sampled, and the chance of each: the one place that both sides of multiple
// importance sampling ask.

#include "kernels/light.h"

namespace yat::YAT_ISA {

/// Alias method (Walker 1977, Vose 1991): one number chooses the interval and, by where in it the
/// number lies, the interval's own row or the other one.
template <class A>
YAT_INLINE UInt<A> choose_light(const LightView& lights, const Float<A>& u) {
  const Float<A> place = u * Float<A>(float(lights.rows.count));
  const Int<A> interval = xsimd::to_int(place);
  const UInt<A> row =
      xsimd::min(xsimd::bitwise_cast<uint32_t>(interval), UInt<A>(lights.rows.count - 1));
  const LightChoice<Lanes<A>::template Of> choice = gather<A>(lights.choice, row);
  return select<A>(place - xsimd::to_float(interval) < choice.threshold, row, choice.other);
}

/// With which choose_light() chooses the row.
template <class A>
YAT_INLINE Float<A> chance_of_light(const LightRowW<A>& row) {
  return row.probability;
}

}  // namespace yat::YAT_ISA

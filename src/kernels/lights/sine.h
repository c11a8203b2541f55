#pragma once

#include "kernels/math.h"

namespace yat::YAT_ISA {

/// sin x, 0 <= x <= pi. Relative error below 2e-7 up to pi / 2, absolute above. An odd minimax
/// polynomial of our own fit.
template <class A>
YAT_INLINE Float<A> sin_to_pi(const Float<A>& x) {
  const Float<A> a = xsimd::min(x, Float<A>(kPi) - x), z = a * a;
  Float<A> p(2.605780585e-06f);
  for (const float c : {-1.980960288e-04f, 8.333066246e-03f, -1.666665955e-01f})
    p = xsimd::fma(p, z, Float<A>(c));
  return xsimd::fma(p * z, a, a);
}

}  // namespace yat::YAT_ISA

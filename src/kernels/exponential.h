#pragma once
// Exponential and logarithm from + - * / and selects only (see math.h). Minimax polynomials of our
// own fit.

#include "kernels/math.h"

namespace yat::YAT_ISA {

/// e^x, x <= 88. Relative error below 2e-7; 0 below -87.
template <class A>
YAT_INLINE Float<A> exponential(const Float<A>& x) {
  const Float<A> least(-87.f);
  const Float<A> used = xsimd::max(x, least);
  // x = n ln 2 + r, |r| <= ln 2 / 2; ln 2 in two parts, so that r keeps its low bits.
  const Int<A> n = xsimd::to_int(xsimd::floor(used * Float<A>(1.44269504f) + Float<A>(.5f)));
  const Float<A> whole = xsimd::to_float(n);
  const Float<A> r = (used - whole * Float<A>(.693359375f)) - whole * Float<A>(-2.12194440e-4f);
  Float<A> p(1.381461121e-03f);
  for (const float c : {8.368710257e-03f, 4.166838742e-02f, 1.666652069e-01f, 4.999999345e-01f})
    p = p * r + Float<A>(c);
  const Float<A> fraction = p * r * r + r + Float<A>(1.f);
  const Float<A> result =
      as_float<A>(as_uint<A>(fraction) + (xsimd::bitwise_cast<uint32_t>(n) << 23));
  return xsimd::select(x < least, Float<A>(0.f), result);
}

/// ln x, x normal and > 0. Error below 1e-7 of the larger of 1 and |ln x|, relative near x = 1.
template <class A>
YAT_INLINE Float<A> natural_logarithm(const Float<A>& x) {
  // x = m 2^n, m in [sqrt 1/2, sqrt 2): 0x3f3504f3 is the float sqrt 1/2.
  const UInt<A> bits = as_uint<A>(x);
  const Int<A> n = xsimd::bitwise_cast<int32_t>(bits - UInt<A>(0x3f3504f3u)) >> 23;
  const Float<A> m = as_float<A>(bits - (xsimd::bitwise_cast<uint32_t>(n) << 23));
  const Float<A> one(1.f), s = (m - one) / (m + one), z = s * s, whole = xsimd::to_float(n);
  const Float<A> p = (Float<A>(2.987173841e-01f) * z + Float<A>(3.997754117e-01f)) * z +
                     Float<A>(6.666677639e-01f);
  const Float<A> fraction = p * z * s + (whole * Float<A>(-2.12194440e-4f) + s + s);
  return fraction + whole * Float<A>(.693359375f);
}

}  // namespace yat::YAT_ISA

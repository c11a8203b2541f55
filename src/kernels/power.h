#pragma once
// Powers of positive numbers, from + - * / and selects only (see math.h).

#include "kernels/math.h"

namespace yat::YAT_ISA {

/// Binary logarithm of a normal number > 0. Error below 2e-7 absolute near 1, else 1e-7 relative.
/// The mantissa in [sqrt(1/2), sqrt(2)) by the series of the inverse hyperbolic tangent.
template <class A>
YAT_INLINE Float<A> log2_positive(const Float<A>& x) {
  // Exponent so that the rest is between sqrt(1/2) and sqrt(2): 0x3f3504f3 is sqrt(1/2).
  const UInt<A> bits = as_uint<A>(x);
  const Int<A> exponent = xsimd::bitwise_cast<int32_t>(bits - UInt<A>(0x3f3504f3u)) >> 23;
  const Float<A> m = as_float<A>(bits - (xsimd::bitwise_cast<uint32_t>(exponent) << 23));
  const Float<A> one(1.f), z = (m - one) / (m + one), z2 = z * z;
  Float<A> p(.41219858311113240f);  // 2 / (7 ln 2)
  p = xsimd::fma(p, z2, Float<A>(.57707801635558535f));
  p = xsimd::fma(p, z2, Float<A>(.96179669392597556f));
  p = xsimd::fma(p, z2, Float<A>(2.8853900817779268f));
  return xsimd::fma(p, z, xsimd::to_float(exponent));
}

/// 2^x, x in [-126, 127]; clamped to that. Relative error below 3e-7.
template <class A>
YAT_INLINE Float<A> exp2_clamped(const Float<A>& x) {
  const Float<A> clamped = xsimd::min(xsimd::max(x, Float<A>(-126.f)), Float<A>(127.f));
  const Float<A> whole = xsimd::floor(clamped + Float<A>(.5f)), f = clamped - whole;
  // Taylor series of e^(f ln 2), |f| <= 1/2.
  Float<A> p(1.5252733804059841e-5f);
  for (const float c :
       {1.5403530393381609e-4f, 1.3333558146428443e-3f, 9.6181291076284772e-3f,
        5.5504108664821580e-2f, 2.4022650695910071e-1f, 6.9314718055994531e-1f, 1.f})
    p = xsimd::fma(p, f, Float<A>(c));
  return as_float<A>(as_uint<A>(p) + (xsimd::bitwise_cast<uint32_t>(xsimd::to_int(whole)) << 23));
}

/// x^y for x >= 0: 0 for x below the smallest normal number (also where y = 0), and where x is NaN
/// NaN. 1^y is 1 to the bit. Relative error below 1e-6 for results within 1e-6..1e6.
template <class A>
YAT_INLINE Float<A> power(const Float<A>& x, const Float<A>& y) {
  const Float<A> raised = exp2_clamped<A>(y * log2_positive<A>(x));
  const Float<A> least(1.17549435e-38f);
  return xsimd::select(x == x, xsimd::select(x >= least, raised, Float<A>(0.f)), x);
}

}  // namespace yat::YAT_ISA

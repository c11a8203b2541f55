#pragma once
// Elementary functions from + - * / sqrt and selects only: every instruction set rounds them alike.

#include "soa/simd.h"

namespace yat::YAT_ISA {

inline constexpr float kPi = 3.14159265358979324f;
inline constexpr float kTwoPi = 6.28318530717958648f;
inline constexpr float kInvPi = .318309886183790672f;
inline constexpr float kLargestFloat = 3.402823466e38f;
/// One unit of relative rounding error, half an ulp of 1.
inline constexpr float kRounding = 5.9604644775390625e-8f;

template <class A>
struct SinCos {
  Float<A> sin, cos;
};

/// |x| <= pi/4. Error below 1e-7. Odd and even minimax polynomials of our own fit.
template <class A>
YAT_INLINE SinCos<A> sin_cos_octant(const Float<A>& x) {
  const Float<A> z = x * x;
  const Float<A> s = ((Float<A>(-1.958800932e-04f) * z + Float<A>(8.332749002e-03f)) * z +
                      Float<A>(-1.666666467e-01f)) *
                         z * x +
                     x;
  const Float<A> c = ((Float<A>(2.454940650e-05f) * z + Float<A>(-1.388831416e-03f)) * z +
                      Float<A>(4.166666483e-02f)) *
                         z * z -
                     Float<A>(.5f) * z + Float<A>(1.f);
  return {s, c};
}

/// sin and cos of 2 pi t, t in [0, 1]. The reduction to an octant is exact.
template <class A>
YAT_INLINE SinCos<A> sin_cos_turns(const Float<A>& t) {
  const Int<A> quarter = xsimd::to_int(t * Float<A>(4.f) + Float<A>(.5f));
  const Float<A> rest = t - xsimd::to_float(quarter) * Float<A>(.25f);
  const SinCos<A> o = sin_cos_octant<A>(rest * Float<A>(kTwoPi));
  const UInt<A> q = xsimd::bitwise_cast<uint32_t>(quarter);
  const Mask<A> odd = mask_of<A>((q & UInt<A>(1u)) != UInt<A>(0u));
  // Quarter 1: (cos, -sin), 2: (-sin, -cos), 3: (-cos, sin).
  const UInt<A> sin_sign = (q & UInt<A>(2u)) << 30;
  const UInt<A> cos_sign = ((q + UInt<A>(1u)) & UInt<A>(2u)) << 30;
  return {as_float<A>(as_uint<A>(xsimd::select(odd, o.cos, o.sin)) ^ sin_sign),
          as_float<A>(as_uint<A>(xsimd::select(odd, o.sin, o.cos)) ^ cos_sign)};
}

/// Arc tangent, |x| <= 1. Error below 2e-7.
template <class A>
YAT_INLINE Float<A> atan_octant(const Float<A>& x) {
  const Float<A> z = x * x;
  Float<A> p(4.059952385e-03f);
  for (const float c : {-2.070678264e-02f, 4.985567486e-02f, -8.074396375e-02f, 1.088864535e-01f,
                        -1.426091102e-01f, 1.999892726e-01f, -3.333332568e-01f})
    p = p * z + Float<A>(c);
  return p * z * x + x;
}

/// The angle of (x, y) in turns, [0, 1); 0 at the origin.
template <class A>
YAT_INLINE Float<A> angle_in_turns(const Float<A>& x, const Float<A>& y) {
  const Float<A> zero(0.f), ax = xsimd::abs(x), ay = xsimd::abs(y);
  const Float<A> big = xsimd::max(ax, ay), small = xsimd::min(ax, ay);
  const Float<A> ratio = xsimd::select(big > zero, small / big, zero);
  Float<A> t = atan_octant<A>(ratio) * Float<A>(1.f / kTwoPi);
  t = xsimd::select(ay > ax, Float<A>(.25f) - t, t);
  t = xsimd::select(x < zero, Float<A>(.5f) - t, t);
  t = xsimd::select(y < zero, Float<A>(1.f) - t, t);
  return xsimd::select(t < Float<A>(1.f), t, zero);
}

/// 0 <= x <= largest float: false for NaN, infinities and negative numbers.
template <class A>
YAT_INLINE Mask<A> is_finite_positive(const Float<A>& x) {
  return (x >= Float<A>(0.f)) & (x <= Float<A>(kLargestFloat));
}
template <class A>
YAT_INLINE Mask<A> is_finite(const Float<A>& x) {
  return xsimd::abs(x) <= Float<A>(kLargestFloat);
}

}  // namespace yat::YAT_ISA

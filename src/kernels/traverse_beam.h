#pragma once
// What a beam of rays cannot hit: bounds of the rays' numbers against boxes and triangles.
//
// Exact, without a tolerance: every test here goes through the steps of the triangle test
// (traverse_leaf.h) with intervals for numbers. Rounding is monotone, and a difference and a
// product are monotone in each operand, so the interval of the rounded results is found by rounding
// the same steps at its ends. What comes out bounds the sheared coordinates to the bit, for every
// ray of the beam and every vertex in the box; where they all lie on one side, the triangle test of
// no ray reports a hit. (No fused multiply-add here, as there.)
//
// The beam with one origin is that of Reshetov, Soupikov, Hurley, "Multi-Level Ray Tracing
// Algorithm", 2005; bounds of origins are for lenses and for rays that start at the near plane.

#include "kernels/traverse_leaf.h"

namespace yat::YAT_ISA {

/// Bounds of rays that move most along the same axis and the same way along it; axes rotated as in
/// ShearedRay. F: a float, or a register (one beam in every lane, or a beam per lane).
template <class F>
struct Beam {
  F org_low[3], org_high[3];
  F shear_low[2], shear_high[2];
  F slope;  ///< distance per length along the main axis, a little less than that of any ray
  F t_max;  ///< largest distance at which a ray still takes a hit
};
/// Distances come from the vertices by ten roundings at most, each by a factor of 1 +- 2^-24.
inline constexpr float kSlopeMargin = 1 - 0x1p-19f;

/// One beam in every lane.
template <class B>
YAT_INLINE Beam<Float<B>> broadcast(const Beam<float>& beam) {
  Beam<Float<B>> out;
  for (int a = 0; a < 3; ++a) {
    out.org_low[a] = Float<B>(beam.org_low[a]);
    out.org_high[a] = Float<B>(beam.org_high[a]);
  }
  for (int a = 0; a < 2; ++a) {
    out.shear_low[a] = Float<B>(beam.shear_low[a]);
    out.shear_high[a] = Float<B>(beam.shear_high[a]);
  }
  out.slope = Float<B>(beam.slope);
  out.t_max = Float<B>(beam.t_max);
  return out;
}

template <class B>
struct Interval {
  Float<B> low, high;
};

/// Coordinates `p`, relative to the origins of a beam.
template <class B>
YAT_INLINE Interval<B> relative(const Interval<B>& p, const Beam<Float<B>>& beam, int axis) {
  return {p.low - beam.org_high[axis], p.high - beam.org_low[axis]};
}

/// x - shear z. kPoint: z is one number, z.low.
template <class B, bool kPoint>
YAT_INLINE Interval<B> sheared(const Interval<B>& x, const Interval<B>& z,
                               const Beam<Float<B>>& beam, int axis) {
  const Float<B> p = beam.shear_low[axis] * z.low, q = beam.shear_high[axis] * z.low;
  Float<B> low = xsimd::min(p, q), high = xsimd::max(p, q);
  if constexpr (!kPoint) {
    const Float<B> r = beam.shear_low[axis] * z.high, s = beam.shear_high[axis] * z.high;
    low = xsimd::min(low, xsimd::min(r, s));
    high = xsimd::max(high, xsimd::max(r, s));
  }
  return {x.low - high, x.high - low};
}

/// The depths of a hit, turned so that the beam goes towards larger ones: false where all vertices
/// lie behind the origins or farther than any ray of the beam goes. nearest: no ray takes a hit
/// nearer than this.
template <class B>
YAT_INLINE Mask<B> in_reach(const Interval<B>& z, const Beam<Float<B>>& beam, bool backwards,
                            Float<B>& nearest) {
  const Float<B> front = backwards ? -z.high : z.low, back = backwards ? -z.low : z.high;
  nearest = front * beam.slope;
  return (back > Float<B>(0.f)) & (nearest <= beam.t_max);
}

/// Lanes whose box (three intervals, axes rotated) may hold something that a ray of the beam hits.
template <class B>
YAT_INLINE Mask<B> meets_box(const Interval<B> (&box)[3], const Beam<Float<B>>& beam,
                             bool backwards, Float<B>& nearest) {
  const Float<B> zero(0.f);
  const Interval<B> z = relative<B>(box[2], beam, 2);
  Mask<B> meets = in_reach<B>(z, beam, backwards, nearest);
  for (int a = 0; a < 2; ++a) {
    const Interval<B> side = sheared<B, false>(relative<B>(box[a], beam, a), z, beam, a);
    meets = meets & (side.low <= zero) & (side.high >= zero);
  }
  return meets;
}

/// Lanes whose triangle (nine coordinates, axes rotated) may be hit by a ray of the beam.
/// kOneOrigin: org_low = org_high.
template <class A, bool kOneOrigin>
YAT_INLINE Mask<A> meets_triangle(const Float<A> (&vertex)[3][3], const Beam<Float<A>>& beam,
                                  bool backwards) {
  const Float<A> zero(0.f);
  Interval<A> all[3];
  for (int k = 0; k < 3; ++k) {
    Interval<A> at[3];
    for (int a = 0; a < 3; ++a)
      at[a] = relative<A>(Interval<A>{vertex[k][a], vertex[k][a]}, beam, a);
    for (int a = 0; a < 2; ++a) at[a] = sheared<A, kOneOrigin>(at[a], at[2], beam, a);
    for (int a = 0; a < 3; ++a) {
      all[a].low = k ? xsimd::min(all[a].low, at[a].low) : at[a].low;
      all[a].high = k ? xsimd::max(all[a].high, at[a].high) : at[a].high;
    }
  }
  Float<A> nearest;
  return in_reach<A>(all[2], beam, backwards, nearest) & (all[0].low <= zero) &
         (all[0].high >= zero) & (all[1].low <= zero) & (all[1].high >= zero);
}

}  // namespace yat::YAT_ISA

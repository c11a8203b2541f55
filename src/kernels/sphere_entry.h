#pragma once
// Where a ray comes near a bounding sphere: it starts anew there before it goes to another space.

#include "kernels/math.h"
#include "kernels/vec.h"

namespace yat::YAT_ISA {

template <class A>
struct SphereEntry {
  Float<A> skip;  ///< along dir, >= 0; 0 where the origin is inside
  Mask<A> meets;  ///< lanes whose ray meets the sphere in front of its origin
};

/// radius: with a hundredth of room for the arithmetic here.
///
/// First to the point nearest to the centre, by a distance with a rounding error of the way, then
/// back to the sphere from where that led. 64 roundings of the way keep the start outside.
template <class A>
YAT_INLINE SphereEntry<A> enter_sphere(const Vec3<A>& center, const Float<A>& radius,
                                       const Vec3<A>& org, const Vec3<A>& dir) {
  const Float<A> zero(0.f), one(1.f);
  const Float<A> inverse = one / dot(dir, dir);
  const Float<A> way = dot(center - org, dir) * inverse;
  const Vec3<A> nearest{xsimd::fma(way, dir.x, org.x) - center.x,
                        xsimd::fma(way, dir.y, org.y) - center.y,
                        xsimd::fma(way, dir.z, org.z) - center.z};
  const Float<A> room = radius * radius - dot(nearest, nearest);
  const Float<A> half = xsimd::sqrt(xsimd::max(room, zero) * inverse);
  const Float<A> begin = way * Float<A>(1.f - 64 * kRounding) - half;
  // A NaN (a direction whose square is no float) stays where it is.
  return {only<A>(begin > zero, begin), ~((room < zero) | (way + half < zero))};
}

/// org + skip * dir, the origin itself where skip is 0.
template <class A>
YAT_INLINE Vec3<A> start_at(const Vec3<A>& org, const Vec3<A>& dir, const Float<A>& skip) {
  return select(skip > Float<A>(0.f),
                {xsimd::fma(skip, dir.x, org.x), xsimd::fma(skip, dir.y, org.y),
                 xsimd::fma(skip, dir.z, org.z)},
                org);
}

}  // namespace yat::YAT_ISA

#pragma once
// Warps of the unit square, each with its density and its inverse: sample(u, v), pdf, invert.

#include "kernels/math.h"
#include "kernels/vec.h"

namespace yat::YAT_ISA {

template <class A>
struct Point2 {
  Float<A> x, y;
};

/// The unit disc with little distortion. Density 1/pi.
/// Source: Shirley, Chiu, "A Low Distortion Map Between Disk and Square", 1997.
template <class A>
YAT_INLINE Point2<A> square_to_disc(const Float<A>& u, const Float<A>& v) {
  const Float<A> zero(0.f);
  const Float<A> a = Float<A>(2.f) * u - Float<A>(1.f), b = Float<A>(2.f) * v - Float<A>(1.f);
  const Mask<A> wide = xsimd::abs(a) > xsimd::abs(b);
  const Float<A> radius = xsimd::select(wide, a, b), other = xsimd::select(wide, b, a);
  const Float<A> ratio = xsimd::select(radius != zero, other / radius, zero);
  const SinCos<A> angle = sin_cos_octant<A>(ratio * Float<A>(kPi / 4));
  return {radius * xsimd::select(wide, angle.cos, angle.sin),
          radius * xsimd::select(wide, angle.sin, angle.cos)};
}
template <class A>
YAT_INLINE Point2<A> disc_to_square(const Point2<A>& p) {
  const Float<A> zero(0.f), half(.5f);
  const Mask<A> wide = xsimd::abs(p.x) > xsimd::abs(p.y);
  const Float<A> major = xsimd::select(wide, p.x, p.y), minor = xsimd::select(wide, p.y, p.x);
  const Float<A> radius = xsimd::copysign(xsimd::sqrt(p.x * p.x + p.y * p.y), major);
  const Float<A> ratio = xsimd::select(major != zero, minor / major, zero);
  const Float<A> other = radius * atan_octant<A>(ratio) * Float<A>(4 / kPi);
  const Float<A> a = xsimd::select(wide, radius, other), b = xsimd::select(wide, other, radius);
  return {half * a + half, half * b + half};
}

/// Directions about +z with density cos / pi.
template <class A>
YAT_INLINE Vec3<A> square_to_cosine_hemisphere(const Float<A>& u, const Float<A>& v) {
  const Point2<A> p = square_to_disc<A>(u, v);
  const Float<A> left = Float<A>(1.f) - p.x * p.x - p.y * p.y;
  return {p.x, p.y, xsimd::sqrt(xsimd::max(left, Float<A>(0.f)))};
}
template <class A>
YAT_INLINE Float<A> cosine_hemisphere_pdf(const Float<A>& cos) {
  return xsimd::max(cos, Float<A>(0.f)) * Float<A>(kInvPi);
}
template <class A>
YAT_INLINE Point2<A> cosine_hemisphere_to_square(const Vec3<A>& w) {
  return disc_to_square<A>(Point2<A>{w.x, w.y});
}

/// The weights of vertices 1 and 2 of a uniform point of a triangle (density 1 / area).
/// Source: Heitz, "A Low-Distortion Map Between Triangle and Square", 2019.
template <class A>
YAT_INLINE Point2<A> square_to_triangle(const Float<A>& u, const Float<A>& v) {
  const Float<A> half(.5f);
  const Mask<A> above = v > u;
  const Float<A> x = half * u, y = half * v;
  return {xsimd::select(above, x, u - y), xsimd::select(above, v - x, y)};
}
template <class A>
YAT_INLINE Point2<A> triangle_to_square(const Point2<A>& b) {
  const Mask<A> above = b.y > b.x;
  const Float<A> two(2.f);
  return {xsimd::select(above, two * b.x, b.x + b.y), xsimd::select(above, b.x + b.y, two * b.y)};
}

/// A cone's measure is kept as 1 - cos, whose relative error stays small for narrow cones.
/// sin_squared = sin^2 of the half angle, at most a right angle.
template <class A>
YAT_INLINE Float<A> one_minus_cos(const Float<A>& sin_squared) {
  const Float<A> one(1.f);
  return sin_squared / (one + xsimd::sqrt(xsimd::max(one - sin_squared, Float<A>(0.f))));
}

/// Directions within a cone about +z, uniform in solid angle.
/// measure  1 - cos of the cone's half angle, in (0, 2].
template <class A>
YAT_INLINE Vec3<A> square_to_cone(const Float<A>& measure, const Float<A>& u, const Float<A>& v) {
  const Float<A> x = u * measure;  // 1 - cos
  const Float<A> sin = xsimd::sqrt(xsimd::max(x * (Float<A>(2.f) - x), Float<A>(0.f)));
  const SinCos<A> phi = sin_cos_turns<A>(v);
  return {sin * phi.cos, sin * phi.sin, Float<A>(1.f) - x};
}
template <class A>
YAT_INLINE Float<A> cone_pdf(const Float<A>& measure) {
  return Float<A>(1.f) / (Float<A>(kTwoPi) * measure);
}
template <class A>
YAT_INLINE Point2<A> cone_to_square(const Float<A>& measure, const Vec3<A>& w) {
  const Float<A> sin_squared = w.x * w.x + w.y * w.y;
  // Each form where it is accurate: the first cancels towards the equator, the second at the pole.
  const Float<A> x =
      xsimd::select(w.z > Float<A>(.5f), one_minus_cos<A>(sin_squared), Float<A>(1.f) - w.z);
  return {x / measure, angle_in_turns<A>(w.x, w.y)};
}

/// The unit sphere, density 1 / (4 pi).
template <class A>
YAT_INLINE Vec3<A> square_to_sphere(const Float<A>& u, const Float<A>& v) {
  return square_to_cone<A>(Float<A>(2.f), u, v);
}
template <class A>
YAT_INLINE Point2<A> sphere_to_square(const Vec3<A>& w) {
  return cone_to_square<A>(Float<A>(2.f), w);
}

/// 1 / (1 + (other / own)^2): the power heuristic (Veach 1997), without squares of large pdfs.
/// own > 0; an infinite ratio gives 0.
template <class A>
YAT_INLINE Float<A> power_heuristic(const Float<A>& own, const Float<A>& other) {
  const Float<A> ratio = other / own;
  return Float<A>(1.f) / (Float<A>(1.f) + ratio * ratio);
}

}  // namespace yat::YAT_ISA

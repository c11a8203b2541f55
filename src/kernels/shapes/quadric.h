#pragma once
// Quadrics of revolution: x^2 + y^2 = |g(z)|^2 + e z + s z^2 with g = (a + b z, c + d z).
//
// The right side stays a sum of squares where the surface is a line that goes round, so that near
// the tip of a cone it is as exact as the surface is small there; spheres and paraboloids, which
// have e or s, are nowhere steeper than a rounding of 1 can bear.

#include "kernels/shapes/common.h"

namespace yat::YAT_ISA {

template <class A>
struct ShapeOf<A, ShapeKind::kQuadric> {
  /// The line that goes round, at a height.
  static YAT_INLINE Point2<A> line(const ShapeRowW<A>& row, const Float<A>& z) {
    return {xsimd::fma(row.b, z, row.a), xsimd::fma(row.d, z, row.c)};
  }
  /// Left side minus right: below 0 inside.
  static YAT_INLINE Float<A> value(const ShapeRowW<A>& row, const Vec3<A>& p) {
    const Point2<A> g = line(row, p.z);
    return (p.x * p.x + p.y * p.y) - (g.x * g.x + g.y * g.y) - p.z * (row.e + row.s * p.z);
  }
  /// Half its gradient: outwards.
  static YAT_INLINE Vec3<A> half_gradient(const ShapeRowW<A>& row, const Vec3<A>& p) {
    const Point2<A> g = line(row, p.z);
    return {p.x, p.y, -((g.x * row.b + g.y * row.d) + (Float<A>(.5f) * row.e + row.s * p.z))};
  }
  /// A point's x and y seen from the line that goes round: its angle is phi.
  static YAT_INLINE Point2<A> turned(const ShapeRowW<A>& row, const Vec3<A>& p) {
    const Point2<A> g = line(row, p.z);
    return {g.x * p.x + g.y * p.y, g.x * p.y - g.y * p.x};
  }
  static YAT_INLINE Mask<A> is_on(const ShapeRowW<A>& row, const ShapeRay<A>& ray,
                                  const Float<A>& t) {
    const Vec3<A> p = ray.at(t);
    const Point2<A> q = turned(row, p);
    return (t > Float<A>(0.f)) & (p.z >= row.z_min) & (p.z <= row.z_max) &
           in_sweep<A>(q.x, q.y, row.phi_cos, row.phi_sin);
  }

  /// a t^2 + 2 b t + c = 0. c is the value at the origin itself, so that its sign is right for a
  /// ray that starts off the surface as far as shape_offset says; the root near the origin is
  /// c / q, with the signs of both: it lies behind a ray that leaves.
  static YAT_INLINE Float<A> distance(const ShapeRowW<A>& row, const ShapeRay<A>& ray) {
    const Vec3<A>&p = ray.org, &d = ray.dir;
    const Point2<A> slope{row.b * d.z, row.d * d.z};
    const Float<A> a =
        (d.x * d.x + d.y * d.y) - (slope.x * slope.x + slope.y * slope.y) - row.s * (d.z * d.z);
    const Float<A> b = dot(half_gradient(row, p), d);
    const Float<A> c = value(row, p);
    // The discriminant is the same from everywhere on the line. From where the line is nearest to
    // the axis (what rounding makes of that) nothing cancels, however far off and thin the surface
    // is (Haines, Guenther, Akenine-Moeller 2019 do so for spheres).
    const Float<A> reach = length(p) + Float<A>(2.f);
    const Float<A> to_nearest = xsimd::min(xsimd::max(-(b / a), -reach), reach);
    const Vec3<A> nearest = ray.at(select<A>(is_finite<A>(to_nearest), to_nearest, reach));
    const Float<A> b_there = dot(half_gradient(row, nearest), d);
    const Float<A> discriminant = b_there * b_there - a * value(row, nearest);
    const Float<A> zero(0.f);
    const Float<A> root = xsimd::sqrt(xsimd::max(discriminant, zero));
    const Float<A> q = -(b + xsimd::copysign(root, b));
    const Float<A> t0 = c / q, t1 = q / a;
    const Mask<A> meets = discriminant >= zero;
    return nearer_of<A>(t0, meets & is_on(row, ray, t0), t1, meets & is_on(row, ray, t1));
  }

  /// Newton steps along the gradient, from a tenth of the shape down to rounding.
  static YAT_INLINE Vec3<A> project(const ShapeRowW<A>& row, const Vec3<A>& near) {
    Vec3<A> p = near;
    for (int step = 0; step < 3; ++step) {
      const Vec3<A> g = half_gradient(row, p);
      const Float<A> squared = dot(g, g);
      const Float<A> by =
          only<A>(squared > Float<A>(0.f), Float<A>(-.5f) * value(row, p) / squared);
      p = p + by * g;
    }
    return p;
  }
  static YAT_INLINE Vec3<A> normal(const ShapeRowW<A>& row, const Vec3<A>& p) {
    const Vec3<A> g = half_gradient(row, p);
    const Float<A> squared = dot(g, g), zero(0.f);
    // The very tip of a cone has none.
    const Vec3<A> n = (Float<A>(1.f) / xsimd::sqrt(squared)) * g;
    return select(squared > zero, n, {zero, zero, Float<A>(1.f)});
  }
  static YAT_INLINE Point2<A> uv(const ShapeRowW<A>& row, const Vec3<A>& p) {
    const Point2<A> q = turned(row, p);
    Float<A> height = p.z;
    const Mask<A> round = row.s != Float<A>(0.f);
    if (any<A>(round)) {
      // Spheres count the angle from +z.
      const Float<A> theta = angle_in_turns<A>(p.z, xsimd::sqrt(p.x * p.x + p.y * p.y));
      height = select<A>(round, theta, height);
    }
    return {angle_in_turns<A>(q.x, q.y) * row.u_scale, height * row.v_scale + row.v_offset};
  }

  static YAT_INLINE Tangents<A> tangents(const ShapeRowW<A>& row, const Vec3<A>& p) {
    const Float<A> zero(0.f), one(1.f), tiny(1e-30f);
    const Point2<A> g = line(row, p.z);
    const Float<A> squared = p.x * p.x + p.y * p.y;
    // With height, the line turns and stretches by its own slope, or else the ring by the curve's.
    const Float<A> inverse = one / xsimd::max(g.x * g.x + g.y * g.y, tiny);
    const Float<A> bend =
        (Float<A>(.5f) * row.e + row.s * p.z) / xsimd::max(squared, Float<A>(kRounding));
    const Float<A> stretch = inverse * (g.x * row.b + g.y * row.d) + bend;
    const Float<A> twist = inverse * (g.x * row.d - g.y * row.b);
    const Float<A> step = one / row.v_scale;
    Vec3<A> dv = step * Vec3<A>{stretch * p.x - twist * p.y, stretch * p.y + twist * p.x, one};
    const Mask<A> round = row.s != zero;
    if (any<A>(round)) {
      // Spheres count the angle from +z.
      const Float<A> rho = xsimd::sqrt(squared), turn = Float<A>(kTwoPi) * step;
      const Float<A> out = turn * p.z / xsimd::max(rho, tiny);
      dv = select(round, {out * p.x, out * p.y, -turn * rho}, dv);
    }
    return {along_turn(row, p), dv};
  }

  /// Area of the ring at a height, per height and per radian: radius times the profile's length,
  /// which is the length of half the gradient.
  static YAT_INLINE Float<A> ring(const ShapeRowW<A>& row, const Float<A>& z) {
    const Point2<A> g = line(row, z);
    const Float<A> slope = (g.x * row.b + g.y * row.d) + (Float<A>(.5f) * row.e + row.s * z);
    const Float<A> squared = (g.x * g.x + g.y * g.y) + z * (row.e + row.s * z);
    return xsimd::sqrt(xsimd::max(squared, Float<A>(0.f)) + slope * slope);
  }
  /// Heights are drawn with a density linear between the rings at the ends: that is uniform by area
  /// on spheres, cylinders and cones, and nearly so on the others.
  static YAT_INLINE ShapeSample<A> sample(const ShapeRowW<A>& row, const Float<A>& u,
                                          const Float<A>& v) {
    const Float<A> one(1.f), zero(0.f);
    const Float<A> w0 = ring(row, row.z_first), w1 = ring(row, row.z_last);
    const Float<A> mean = xsimd::sqrt(w0 * w0 + v * (w1 * w1 - w0 * w0));
    const Float<A> place = xsimd::min(v * (w0 + w1) / (w0 + mean), one);
    const Float<A> z = only<A>(v > zero, place) * (row.z_last - row.z_first) + row.z_first;
    const Point2<A> g = line(row, z);
    const Float<A> curve = xsimd::sqrt(xsimd::max(one + z * (row.e + row.s * z), zero));
    const SinCos<A> phi = sin_cos_turns<A>(u / row.u_scale);
    const Vec3<A> p{curve * (g.x * phi.cos - g.y * phi.sin),
                    curve * (g.x * phi.sin + g.y * phi.cos), z};
    return {p, inverse_density(row, p)};
  }
  static YAT_INLINE Float<A> inverse_density(const ShapeRowW<A>& row, const Vec3<A>& p) {
    const Float<A> one(1.f), zero(0.f);
    const Float<A> w0 = ring(row, row.z_first), w1 = ring(row, row.z_last);
    const Float<A> length = row.z_last - row.z_first;
    const Float<A> place = xsimd::min(xsimd::max((p.z - row.z_first) / length, zero), one);
    const Float<A> linear = w0 + place * (w1 - w0);
    const Float<A> ratio = select<A>(linear > zero, ring(row, p.z) / linear, one);
    return Float<A>(kPi) * length * (w0 + w1) / row.u_scale * ratio;
  }
};

}  // namespace yat::YAT_ISA

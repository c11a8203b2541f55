#pragma once
// The torus about z: points at distance b from the circle of radius a, a >= b, a + b = 1.
//
// Along a ray, h(s) = squared distance to the circle = s^2 + m^2 + a^2 - 2 a rho(s), with s counted
// from the point nearest to the centre, m its distance, and rho the distance to the axis. rho is
// convex, with a slope that rises from -e to e once: so h falls, rises, and may fall and rise
// again, with its turning points where s = a rho'(s). Between those, h = b^2 has at most one
// solution, which bisection cannot miss. No polynomial of degree four is formed: the tube may be as
// thin as rounding lets it be.

#include "kernels/shapes/common.h"

namespace yat::YAT_ISA {

/// Its large functions are not inlined: they are called from many kernels.
template <class A>
struct ShapeOf<A, ShapeKind::kTorus> {
  /// What is needed of the line at one place.
  struct Place {
    Float<A> value;          ///< h - b^2
    Float<A> slope;          ///< of h / 2
    Float<A> turn, bending;  ///< s - a rho' and its derivative
  };
  static YAT_INLINE Float<A> axis_distance(const Vec3<A>& p) {
    return xsimd::sqrt(p.x * p.x + p.y * p.y);
  }
  static YAT_INLINE Float<A> value(const ShapeRowW<A>& row, const Vec3<A>& p) {
    const Float<A> out = axis_distance(p) - row.a;
    return (out * out + p.z * p.z) - row.b * row.b;
  }
  static YAT_INLINE Place look(const ShapeRowW<A>& row, const ShapeRay<A>& line,
                               const Float<A>& s) {
    const Vec3<A> p = line.at(s);
    const Vec3<A>& d = line.dir;
    // On the axis any slope will do: the smallest float keeps it finite.
    const Float<A> rho = xsimd::max(axis_distance(p), Float<A>(1e-30f));
    const Float<A> out = rho - row.a, rise = (p.x * d.x + p.y * d.y) / rho;
    const Float<A> across = (d.x * d.x + d.y * d.y) - rise * rise;
    return {(out * out + p.z * p.z) - row.b * row.b, out * rise + p.z * d.z, s - row.a * rise,
            Float<A>(1.f) - row.a * xsimd::max(across, Float<A>(0.f)) / rho};
  }

  /// Newton's method for a turning point, from s on in one direction; `sign` is that of the
  /// derivative on the way there, and the steps end at `last`. Where there is none it stops
  /// anywhere: a cut too many does no harm.
  static Float<A> turning_point(const ShapeRowW<A>& row, const ShapeRay<A>& line, Float<A> s,
                                const Float<A>& low, const Float<A>& high, float sign) {
    Mask<A> moving = low <= high;
    for (int i = 0; i < 12 && any<A>(moving); ++i) {
      const Place at = look(row, line, s);
      const Float<A> next = xsimd::min(xsimd::max(s - at.turn / at.bending, low), high);
      const Mask<A> right_way = at.bending * Float<A>(sign) > Float<A>(0.f);
      moving = moving & right_way & (xsimd::abs(next - s) > Float<A>(kRounding));
      s = select<A>(moving, next, s);
    }
    return s;
  }

  /// The solution between low and high, where the signs differ.
  static Float<A> solve(const ShapeRowW<A>& row, const ShapeRay<A>& line, Float<A> low,
                        Float<A> high, const Mask<A>& outside_low, const Mask<A>& wanted) {
    const Float<A> half(.5f), zero(0.f);
    Float<A> s = half * (low + high);
    Mask<A> moving = wanted;
    for (int i = 0; i < 40 && any<A>(moving); ++i) {
      const Place at = look(row, line, s);
      const Mask<A> outside = at.value > zero;
      const Mask<A> as_low = (outside & outside_low) | (~outside & ~outside_low);
      low = select<A>(as_low, s, low);
      high = select<A>(as_low, high, s);
      const Float<A> newton = s - half * at.value / at.slope;
      const Mask<A> inside = (newton > low) & (newton < high);
      const Float<A> next = select<A>(inside, newton, half * (low + high));
      moving = moving & (xsimd::abs(next - s) > Float<A>(kRounding));
      s = select<A>(moving, next, s);
    }
    return s;
  }

  static Float<A> distance(const ShapeRowW<A>& row, const ShapeRay<A>& ray) {
    const Float<A> zero(0.f), one(1.f), none(kLargestFloat);
    const Float<A> to_middle = -dot(ray.org, ray.dir);
    ShapeRay<A> line{ray.at(to_middle), ray.dir};
    // Beyond these the line has left the ball around the torus.
    const Float<A> end(1.0625f);
    if (!any<A>(dot(line.org, line.org) < end)) return Float<A>(-1.f);

    // Turned round if need be, so that the line is nearest to the axis at s >= 0.
    const Float<A> e2 = line.dir.x * line.dir.x + line.dir.y * line.dir.y;
    Float<A> nearest = -(line.org.x * line.dir.x + line.org.y * line.dir.y) / e2;
    nearest = only<A>(e2 > zero, nearest);
    const Mask<A> back = nearest < zero;
    const Float<A> sign = select<A>(back, Float<A>(-1.f), one);
    line.dir = sign * line.dir;
    nearest = xsimd::abs(nearest);
    const Float<A> reach = row.a * xsimd::sqrt(e2), right = xsimd::max(nearest, reach);
    // One turning point at the left, then none or two.
    const Float<A> first =
        turning_point(row, line, -reach, -reach, xsimd::min(nearest, reach), 1.f);
    const Float<A> last = turning_point(row, line, right, nearest, right, 1.f);
    const Float<A> middle = turning_point(row, line, nearest, nearest, last, -1.f);

    const Float<A> start = -(sign * to_middle);
    const Mask<A> outside_start = value(row, ray.org) > zero;
    const Float<A> cut[5] = {-end, first, xsimd::min(middle, end), xsimd::min(last, end), end};
    Mask<A> outside[5];
    outside[0] = outside[4] = one > zero;
    for (int i = 1; i < 4; ++i) outside[i] = look(row, line, cut[i]).value > zero;
    Float<A> best = none;
    for (int i = 0; i < 4; ++i) {
      // The part that the ray has before it. Its own origin says on which side it begins.
      const Mask<A> from_start = ~back & (cut[i] < start), to_start = back & (cut[i + 1] > start);
      const Float<A> low = select<A>(from_start, start, cut[i]);
      const Float<A> high = select<A>(to_start, start, cut[i + 1]);
      const Mask<A> outside_low = (from_start & outside_start) | (~from_start & outside[i]);
      const Mask<A> outside_high = (to_start & outside_start) | (~to_start & outside[i + 1]);
      const Mask<A> wanted =
          (low < high) & ((outside_low & ~outside_high) | (~outside_low & outside_high));
      if (!any<A>(wanted)) continue;
      const Float<A> s = solve(row, line, low, high, outside_low, wanted);
      const Float<A> t = sign * s + to_middle;
      const Vec3<A> p = line.at(s);
      const Mask<A> valid = wanted & (t > zero) & is_on(row, p);
      best = select<A>(valid, xsimd::min(best, t), best);
    }
    return select<A>(best < none, best, Float<A>(-1.f));
  }
  static YAT_INLINE Mask<A> is_on(const ShapeRowW<A>& row, const Vec3<A>& p) {
    const Point2<A> tube = in_tube(row, p);
    return in_sweep<A>(p.x, p.y, row.phi_cos, row.phi_sin) &
           in_sweep<A>(tube.x, tube.y, row.e, row.s);
  }
  /// The point in the plane of the tube, its angle counted from where theta begins.
  static YAT_INLINE Point2<A> in_tube(const ShapeRowW<A>& row, const Vec3<A>& p) {
    const Float<A> out = axis_distance(p) - row.a;
    return {row.c * out + row.d * p.z, row.c * p.z - row.d * out};
  }

  static YAT_INLINE Vec3<A> project(const ShapeRowW<A>& row, const Vec3<A>& p) {
    const Float<A> tiny(1e-30f);
    const Float<A> rho = xsimd::max(axis_distance(p), tiny), out = rho - row.a;
    const Float<A> scale = row.b / xsimd::max(xsimd::sqrt(out * out + p.z * p.z), tiny);
    const Float<A> wider = (row.a + scale * out) / rho;
    return {wider * p.x, wider * p.y, scale * p.z};
  }
  static YAT_INLINE Vec3<A> normal(const ShapeRowW<A>& row, const Vec3<A>& p) {
    const Float<A> rho = xsimd::max(axis_distance(p), Float<A>(1e-30f));
    const Float<A> out = (rho - row.a) / rho;
    return normalize(Vec3<A>{out * p.x, out * p.y, p.z});
  }
  static YAT_INLINE Point2<A> uv(const ShapeRowW<A>& row, const Vec3<A>& p) {
    const Point2<A> tube = in_tube(row, p);
    return {angle_in_turns<A>(p.x, p.y) * row.u_scale,
            angle_in_turns<A>(tube.x, tube.y) * row.v_scale + row.v_offset};
  }

  static YAT_INLINE Tangents<A> tangents(const ShapeRowW<A>& row, const Vec3<A>& p) {
    const Float<A> rho = xsimd::max(axis_distance(p), Float<A>(1e-30f));
    const Float<A> turn = Float<A>(kTwoPi) / row.v_scale, inwards = -turn * p.z / rho;
    return {along_turn(row, p), {inwards * p.x, inwards * p.y, turn * (rho - row.a)}};
  }

  /// Angles are uniform.
  static YAT_INLINE ShapeSample<A> sample(const ShapeRowW<A>& row, const Float<A>& u,
                                          const Float<A>& v) {
    const SinCos<A> phi = sin_cos_turns<A>(u / row.u_scale);
    const SinCos<A> swept = sin_cos_turns<A>(v / row.v_scale);
    const Float<A> cos = row.c * swept.cos - row.d * swept.sin,
                   sin = row.d * swept.cos + row.c * swept.sin;
    const Float<A> rho = row.a + row.b * cos;
    const Vec3<A> p{rho * phi.cos, rho * phi.sin, row.b * sin};
    return {p, inverse_density(row, p)};
  }
  static YAT_INLINE Float<A> inverse_density(const ShapeRowW<A>& row, const Vec3<A>& p) {
    return Float<A>(kTwoPi * kTwoPi) / (row.u_scale * row.v_scale) * row.b * axis_distance(p);
  }
};

}  // namespace yat::YAT_ISA

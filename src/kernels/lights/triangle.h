#pragma once
// A triangle that shines on the side of b x c. Receivers that see it large sample the solid angle
// in which they see it; others, and those next to its plane, where floats no longer hold that, its
// area.
//
// Source  Arvo, "Stratified Sampling of Spherical Triangles", 1995. Solid angle: Van Oosterom,
//         Strackee, "The Solid Angle of a Plane Triangle", 1983. Without angles of the triangle, as
//         vectors: Peters, "BRDF Importance Sampling for Polygonal Lights", 2021.
//         Departs: sin of the half solid angle is the volume over R, R^2 = 2 (1 + cos a)(1 + cos b)
//         (1 + cos c), which turns every difference of Peters' form into a sum of positive terms.
//         So the point comes out as barycentric coordinates, within some 1e-7 of the triangle's
//         size however small it is, and lies in the triangle whatever is rounded.

#include "kernels/light.h"
#include "kernels/lights/sine.h"
#include "kernels/surface.h"

namespace yat::YAT_ISA {

template <class A>
struct TriangleLight {
  /// How a receiver sees the triangle. With unit vectors v0, v1, v2 to its corners:
  struct View {
    Float<A> inverse0, inverse1, inverse2;  ///< 1 / distance of the corners
    Float<A> sum01, sum02, sum12;           ///< 1 + vi . vj, >= 0
    Float<A> turns;                         ///< solid angle / 4 pi
    Mask<A> by_angle;  ///< the solid angle is sampled, and what is above holds; else the area
  };

  /// Those in `active` that are not further away than kFar times the triangle's size.
  static YAT_INLINE Mask<A> near(const Mask<A>& active, const LightRowW<A>& row,
                                 const Vec3<A>& receiver) {
    const Vec3<A> e1{row.b_x, row.b_y, row.b_z}, e2{row.c_x, row.c_y, row.c_z};
    const Vec3<A> way = light_a<A>(row) - receiver;
    return active & (dot(way, way) <= Float<A>(kFar * kFar) * xsimd::max(dot(e1, e1), dot(e2, e2)));
  }

  /// tan(solid angle / 2) = volume / opening. Both are small next to an edge, and the opening is
  /// negative above the triangle: within a few thousandths of its size from either, roundings of
  /// vi . vj would be seen in the density.
  static YAT_INLINE View view(const Mask<A>& near, const LightRowW<A>& row,
                              const Vec3<A>& receiver) {
    const Float<A> zero(0.f), one(1.f);
    const Vec3<A> e1{row.b_x, row.b_y, row.b_z}, e2{row.c_x, row.c_y, row.c_z};
    const Vec3<A> way0 = light_a<A>(row) - receiver, way1 = way0 + e1, way2 = way0 + e2;
    View seen;
    seen.inverse0 = one / length(way0);
    seen.inverse1 = one / length(way1);
    seen.inverse2 = one / length(way2);
    const Vec3<A> v0 = seen.inverse0 * way0, v1 = seen.inverse1 * way1, v2 = seen.inverse2 * way2;
    seen.sum01 = xsimd::max(one + dot(v0, v1), zero);
    seen.sum02 = xsimd::max(one + dot(v0, v2), zero);
    seen.sum12 = xsimd::max(one + dot(v1, v2), zero);
    // By edges: the corners' directions may hardly differ.
    const Float<A> volume = -dot(v0, cross(seen.inverse1 * e1, seen.inverse2 * e2));
    const Float<A> opening = seen.sum01 + seen.sum02 + seen.sum12 - Float<A>(2.f);
    seen.turns = angle_in_turns<A>(opening, volume);
    seen.by_angle = near & (volume > zero) &
                    (volume + Float<A>(kOpeningShare) * opening > Float<A>(kLeastVolume));
    return seen;
  }

  /// Weights of corners 1 and 2 for u, v, where seen.by_angle. u cuts off a triangle (0, 1, q), q
  /// on the arc from 0 to 2, with this share of the solid angle; v goes along the arc from 1 to q.
  static YAT_INLINE Point2<A> square_to_view(const View& seen, const Float<A>& u,
                                             const Float<A>& v) {
    const Float<A> zero(0.f), one(1.f), two(2.f), tiny(1e-30f);
    const Float<A> radius = xsimd::sqrt(two * seen.sum01 * seen.sum02 * seen.sum12);
    const Float<A> whole = Float<A>(kTwoPi) * seen.turns;
    const Float<A> rest = radius * sin_to_pi<A>((one - u) * whole);
    const Float<A> cut = seen.sum01 * sin_to_pi<A>(u * whole);
    // q halves the angle between v0 and its mirror image about (rest + cut) v0 + cut v2.
    const Float<A> both = rest + cut,
                   inverse = one / xsimd::max(rest * rest + two * both * cut * seen.sum02, tiny);
    const Float<A> q0 = inverse * rest * (both + cut);
    const Float<A> q2 = inverse * two * cut * (rest + cut * seen.sum02);
    // 1 - v1 . q, and the share of q: a quotient of sines, above 1 on arcs over a quarter of a
    // turn.
    const Float<A> width =
        xsimd::min(xsimd::max(one + q0 * (one - seen.sum01) + q2 * (one - seen.sum12), zero), two);
    const Float<A> along = xsimd::sqrt(v * (two - v * width) / xsimd::max(two - width, tiny));
    const Float<A> w0 = along * q0 * seen.inverse0, w2 = along * q2 * seen.inverse2;
    const Float<A> w1 = xsimd::max((one - along) + width * (along - v), zero) * seen.inverse1;
    const Float<A> scale = one / (w0 + w1 + w2);
    return {scale * w1, scale * w2};
  }

  static YAT_INLINE LightPick<A> sample(const LightRowW<A>& row, const Vec3<A>& receiver,
                                        const Float<A>&, const Float<A>& u, const Float<A>& v) {
    const Vec3<A> p0 = light_a<A>(row), e1{row.b_x, row.b_y, row.b_z},
                  e2{row.c_x, row.c_y, row.c_z};
    const Float<A> zero(0.f), one(1.f);
    Point2<A> weight = square_to_triangle<A>(u, v);
    Float<A> angle = zero;  // 0: by area
    const Mask<A> close = near(zero == zero, row, receiver);
    if (any<A>(close)) {
      const View seen = view(close, row, receiver);
      const Point2<A> by_angle = square_to_view(seen, u, v);
      weight.x = select<A>(seen.by_angle, by_angle.x, weight.x);
      weight.y = select<A>(seen.by_angle, by_angle.y, weight.y);
      angle = only<A>(seen.by_angle, Float<A>(2 * kTwoPi) * seen.turns);
    }
    const Vec3<A> point = p0 + weight.x * e1 + weight.y * e2;
    const Vec3<A> normal = triangle_normal(e1, e2);
    const Vec3<A> way = point - receiver;
    const Float<A> squared = dot(way, way);
    LightPick<A> pick;
    pick.wi = (one / xsimd::sqrt(squared)) * way;
    const Float<A> cos = -dot(normal, pick.wi);
    const Mask<A> by_angle = angle > zero;
    const Mask<A> front = by_angle | ((cos > zero) & (squared > zero));
    pick.measure = only<A>(front, select<A>(by_angle, angle, row.extra * cos / squared));
    pick.pdf = only<A>(
        front, select<A>(by_angle, one, squared) / select<A>(by_angle, angle, row.extra * cos));
    // The corners' coordinates are at most these sums.
    const Float<A> extent =
        largest_magnitude(p0) + xsimd::max(largest_magnitude(e1), largest_magnitude(e2));
    pick.to = point + (surface_offset(extent, normal) + row.further) * normal;
    return pick;
  }

  /// Of active lanes; the others may hold anything.
  static YAT_INLINE Float<A> pdf(const LightRowW<A>& row, const Mask<A>& active,
                                 const Vec3<A>& receiver, const SeenLight<A>& at) {
    const Float<A> by_area = at.distance * at.distance / (row.extra * at.cos);
    const Mask<A> close = near(active, row, receiver);
    if (!any<A>(close)) return by_area;
    const View seen = view(close, row, receiver);
    return select<A>(seen.by_angle, Float<A>(1.f / (2 * kTwoPi)) / seen.turns, by_area);
  }

 private:
  /// Of twice that distance on, the cosine over the squared distance varies by a third or less.
  static constexpr float kFar = 2;
  static constexpr float kOpeningShare = 1.f / 32;  ///< up to 6.22 sr
  static constexpr float kLeastVolume = 1.f / 64;
};

}  // namespace yat::YAT_ISA

#pragma once
// A rectangle that shines on the side of b x c, c its longer side. Receivers that see it large
// sample the solid angle in which they see it; others, and those next to its plane, its area.
//
// Source  After Urena, Fajardo, King, "An Area-Preserving Parametrization for Spherical
//         Rectangles", 2013: u cuts off the part below a line across the rectangle, v goes along
//         that line.
//         Departs: no angle is a difference of others. The lines of the sides of length |c| meet at
//         infinity; what lies between them up to x is a spherical triangle with a corner there, and
//         by its excess E (L'Huilier) tan(E / 2) has a closed form in
//             q(x) = (d0 + x)(d1 + x),  di^2 = x^2 + ri^2,  ri the distance of line i:
//         with R = r0 r1, w = R cos and V = R sin of the angle at that corner,
//             tan(E / 2) = q V / (R^2 + q w).
//         The solid angle between two x follows as one arc tangent of sums of products, and u
//         mixes the ends of q with weights of sines, as slerp does. Then x follows from
//             2 x (d0 + d1) = q - R^2 / q,  (d0 + d1)^2 = r0^2 + r1^2 + q + R^2 / q.
//         So the point comes out as shares of the sides.

#include "kernels/light.h"
#include "kernels/lights/sine.h"
#include "kernels/sampling.h"
#include "kernels/surface.h"

namespace yat::YAT_ISA {

template <class A>
struct RectangleLight {
  /// What does not depend on the receiver.
  struct Placed {
    Vec3<A> p0, b, c, normal;
    Float<A> area;
    Float<A> lift;              ///< from the light to the ends of shadow rays [m]
    Float<A> per_area;          ///< 1 / area
    Float<A> per_c;             ///< 1 / |c|
    Float<A> width, per_width;  ///< |b| / |c|, in (0, 1], and its inverse
  };

  /// How a receiver sees the rectangle: it is the origin, x goes along b, y along c, the unit is
  /// |c|. The middle of the rectangle has x >= 0; where it had not, x is mirrored.
  struct View {
    Mask<A> mirrored;
    Float<A> x0, y0, height;  ///< of p0, or of p0 + b; and of the receiver above the plane
    Float<A> r0, r1;          ///< squared distances of the lines of the long sides
    Float<A> corner;          ///< w above
    Float<A> scale, q0, q1;   ///< what q is multiplied by at both ends, and the products
    Float<A> turns;           ///< solid angle / 4 pi
    Mask<A> by_angle;  ///< the solid angle is sampled, and what is above holds; else the area
  };

  static YAT_INLINE Placed place(const LightRowW<A>& row) {
    const Float<A> one(1.f);
    Placed at;
    at.p0 = light_a<A>(row);
    at.b = {row.b_x, row.b_y, row.b_z};
    at.c = {row.c_x, row.c_y, row.c_z};
    at.normal = triangle_normal(at.b, at.c);
    at.area = row.extra;
    // The corners' coordinates are at most this.
    const Float<A> extent =
        largest_magnitude(at.p0) + largest_magnitude(at.b) + largest_magnitude(at.c);
    at.lift = surface_offset(extent, at.normal) + row.further;
    const Float<A> c2 = dot(at.c, at.c);
    at.per_area = one / at.area;
    at.per_c = one / xsimd::sqrt(c2);
    at.width = at.area * at.per_c * at.per_c;
    at.per_width = c2 * at.per_area;
    return at;
  }

  /// Of active lanes.
  static YAT_INLINE View view(const Placed& at, const Mask<A>& active, const Vec3<A>& receiver) {
    const Float<A> zero(0.f), half(.5f);
    const Vec3<A> way = at.p0 - receiver;
    const Float<A> x = dot(way, at.b) * at.per_area;
    View seen;
    seen.y0 = dot(way, at.c) * at.per_c * at.per_c;
    seen.height = -dot(way, at.normal) * at.per_c;
    const Float<A> middle_x = x + half * at.width, middle_y = seen.y0 + half;
    seen.mirrored = middle_x < zero;
    seen.x0 = select<A>(seen.mirrored, -(x + at.width), x);
    seen.by_angle = active & (seen.height >= Float<A>(kLeastHeight)) &
                    (middle_x * middle_x + middle_y * middle_y + seen.height * seen.height <=
                     Float<A>(kFar * kFar));
    return seen;
  }

  /// The rest of the view, where seen.by_angle. Its solid angle has some ten roundings, many more
  /// only of narrow rectangles (|b| below a hundredth of |c|) from a few hundredths above.
  static YAT_INLINE void measure(const Placed& at, View& seen) {
    const Float<A> zero(0.f), one(1.f);
    const Float<A> x0 = seen.x0, x1 = x0 + at.width, y0 = seen.y0, y1 = y0 + one;
    const Float<A> h2 = seen.height * seen.height, a0 = x0 * x0, a1 = x1 * x1;
    const Float<A> r0 = xsimd::fma(y0, y0, h2), r1 = xsimd::fma(y1, y1, h2);
    // Distances of the corners, and x + them; x1 > 0.
    const Float<A> d00 = xsimd::sqrt(a0 + r0), d01 = xsimd::sqrt(a0 + r1);
    const Float<A> d10 = xsimd::sqrt(a1 + r0), d11 = xsimd::sqrt(a1 + r1);
    const Float<A> e10 = d10 + x1, e11 = d11 + x1;
    const Float<A> g0 = d00 + xsimd::abs(x0), g1 = d01 + xsimd::abs(x0);
    // q0 is a quotient where x0 < 0: all below is multiplied by what divides it.
    const Mask<A> below = x0 < zero;
    const Float<A> g = g0 * g1, rr = r0 * r1, scale = select<A>(below, g, one);
    const Float<A> e00 = select<A>(below, r0 * g1, g0);
    seen.r0 = r0;
    seen.r1 = r1;
    seen.scale = scale;
    seen.q0 = select<A>(below, rr, g);
    seen.q1 = scale * (e10 * e11);
    seen.corner = xsimd::fma(y0, y1, h2);
    // q1 - q0 by edges: the corners' directions may hardly differ.
    const Float<A> s0 = d10 + d00, s1 = d11 + d01, mixed = e00 * e11;
    const Float<A> rise = at.width * xsimd::fma(seen.q1 + mixed, s1, (mixed + seen.q0) * s0);
    const Float<A> opening =
        xsimd::fma(scale, rr, xsimd::fma(seen.q0, e10 * e11, (seen.q0 + seen.q1) * seen.corner));
    seen.turns = angle_in_turns<A>(s0 * s1 * opening, seen.height * rise);
  }

  /// Shares of b and c for u, v, where seen.by_angle.
  static YAT_INLINE Point2<A> square_to_view(const Placed& at, const View& seen, const Float<A>& u,
                                             const Float<A>& v) {
    const Float<A> zero(0.f), one(1.f), two(2.f);
    const Float<A> low = seen.q0, high = seen.q1, rr = seen.r0 * seen.r1;
    const Float<A> y0 = seen.y0, y1 = y0 + one;
    // q as a mixture: sines of the parts of E / 2, over sines of what is left to x = infinity.
    const Float<A> r = seen.scale * seen.scale * rr, w = two * seen.scale * seen.corner;
    const auto squared_weight = [&](const Float<A>& q) {
      return xsimd::max(xsimd::fma(q, q + w, r), zero);
    };
    const Float<A> low2 = squared_weight(low), high2 = squared_weight(high);
    const Float<A> cut = select<A>(seen.mirrored, one - u, u);
    // Sines of a narrow rectangle are small, and their fourth powers are to come.
    const Float<A> whole = Float<A>(kTwoPi) * seen.turns, grow = at.per_width;
    const Float<A> to_low = grow * high2 * sin_to_pi<A>(whole * (one - cut));
    const Float<A> to_high = xsimd::sqrt(low2 * high2) * (grow * sin_to_pi<A>(whole * cut));
    const Float<A> top = xsimd::fma(low, to_low, high * to_high);
    const Float<A> bottom = seen.scale * (to_low + to_high);
    const Float<A> top2 = top * top, bottom2 = rr * bottom * bottom, both = top * bottom;
    const Float<A> x =
        (top2 - bottom2) /
        xsimd::max(two * xsimd::sqrt(both * xsimd::fma(seen.r0 + seen.r1, both, top2 + bottom2)),
                   Float<A>(1e-30f));
    const Float<A> s = clamp_share((x - seen.x0) * at.per_width);
    // Along the line at x, the sine of the direction grows evenly (Archimedes). 1 - sine^2 is kept
    // as a sum; both times what divides the sines at the ends.
    const Float<A> d2 = xsimd::fma(x, x, seen.height * seen.height);
    const Float<A> m0 = xsimd::fma(y0, y0, d2), m1 = xsimd::fma(y1, y1, d2);
    const Float<A> l0 = xsimd::sqrt(m0), l1 = xsimd::sqrt(m1);
    const Float<A> rest = one - v, sine0 = y0 * l1, sine1 = y1 * l0, span = sine1 - sine0;
    const Float<A> cos2 = xsimd::fma(d2, rest * m1 + v * m0, v * rest * span * span);
    const Float<A> y = xsimd::fma(v, span, sine0) * xsimd::sqrt(d2 / cos2);
    return {select<A>(seen.mirrored, one - s, s), clamp_share(y - y0)};
  }

  static YAT_INLINE LightPick<A> sample(const Placed& at, const Vec3<A>& receiver,
                                        const Float<A>& u, const Float<A>& v) {
    const Float<A> zero(0.f), one(1.f);
    Point2<A> share{u, v};
    Float<A> angle = zero;
    View seen = view(at, zero == zero, receiver);
    if (any<A>(seen.by_angle)) {
      measure(at, seen);
      const Point2<A> by_angle = square_to_view(at, seen, u, v);
      share.x = select<A>(seen.by_angle, by_angle.x, u);
      share.y = select<A>(seen.by_angle, by_angle.y, v);
      angle = Float<A>(2 * kTwoPi) * seen.turns;
    }
    const Vec3<A> point = at.p0 + share.x * at.b + share.y * at.c;
    const Vec3<A> way = point - receiver;
    const Float<A> inverse = one / xsimd::sqrt(dot(way, way));
    LightPick<A> pick;
    pick.wi = inverse * way;
    const Float<A> cos = -dot(at.normal, pick.wi);
    pick.measure =
        select<A>(seen.by_angle, angle, only<A>(cos > zero, at.area * (cos * inverse * inverse)));
    pick.pdf = only<A>(pick.measure > zero, one / pick.measure);
    pick.to = point + at.lift * at.normal;
    return pick;
  }
  static YAT_INLINE LightPick<A> sample(const LightRowW<A>& row, const Vec3<A>& receiver,
                                        const Float<A>&, const Float<A>& u, const Float<A>& v) {
    return sample(place(row), receiver, u, v);
  }

  /// Of active lanes; the others may hold anything.
  static YAT_INLINE Float<A> pdf(const LightRowW<A>& row, const Mask<A>& active,
                                 const Vec3<A>& receiver, const SeenLight<A>& hit) {
    const Float<A> by_area = hit.distance * hit.distance / (row.extra * hit.cos);
    const Placed at = place(row);
    View seen = view(at, active, receiver);
    if (!any<A>(seen.by_angle)) return by_area;
    measure(at, seen);
    return select<A>(seen.by_angle, Float<A>(1.f / (2 * kTwoPi)) / seen.turns, by_area);
  }

 private:
  static YAT_INLINE Float<A> clamp_share(const Float<A>& x) {
    return xsimd::min(xsimd::max(x, Float<A>(0.f)), Float<A>(1.f));
  }

  /// Of the middle, in lengths of c. From there on, the cosine over the squared distance varies by
  /// a third or less.
  static constexpr float kFar = 2;
  /// Above the plane, in lengths of c: nearer, roundings of the receiver's place are seen in what
  /// is left of an edge.
  static constexpr float kLeastHeight = 1.f / 64;
};

}  // namespace yat::YAT_ISA

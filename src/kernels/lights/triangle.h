#pragma once
// A triangle that shines on the side of b x c, sampled by area.

#include "kernels/light.h"
#include "kernels/surface.h"

namespace yat::YAT_ISA {

template <class A>
struct TriangleLight {
  static YAT_INLINE LightPick<A> sample(const LightRowW<A>& row, const Vec3<A>& receiver,
                                        const Float<A>&, const Float<A>& u, const Float<A>& v) {
    const Vec3<A> p0 = light_a<A>(row), e1{row.b_x, row.b_y, row.b_z},
                  e2{row.c_x, row.c_y, row.c_z};
    const Float<A> zero(0.f), one(1.f);
    const Point2<A> weight = square_to_triangle<A>(u, v);
    const Vec3<A> point = p0 + weight.x * e1 + weight.y * e2;
    const Vec3<A> normal = triangle_normal(e1, e2);
    const Vec3<A> way = point - receiver;
    const Float<A> squared = dot(way, way);
    LightPick<A> pick;
    pick.wi = (one / xsimd::sqrt(squared)) * way;
    const Float<A> cos = -dot(normal, pick.wi);
    const Mask<A> front = (cos > zero) & (squared > zero);
    pick.measure = only<A>(front, row.extra * cos / squared);
    pick.pdf = only<A>(front, squared / (row.extra * cos));
    // The corners' coordinates are at most these sums.
    const Float<A> extent =
        largest_magnitude(p0) + xsimd::max(largest_magnitude(e1), largest_magnitude(e2));
    pick.to = point + (surface_offset(extent, normal) + row.further) * normal;
    return pick;
  }

  static YAT_INLINE Float<A> pdf(const LightRowW<A>& row, const Vec3<A>&,
                                 const SeenLight<A>& seen) {
    return seen.distance * seen.distance / (row.extra * seen.cos);
  }
};

}  // namespace yat::YAT_ISA

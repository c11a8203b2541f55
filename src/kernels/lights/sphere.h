#pragma once
// A whole sphere: the cone in which it is seen if it shines outwards, its area if it shines
// inwards.
//
// Which of the two follows from the light alone. A receiver on the sphere itself is inside or
// outside by rounding, and the two sides of multiple importance sampling, which round differently,
// must not take it for different things: what one leaves to the other would be lost.

#include "kernels/light.h"
#include "kernels/surface.h"

namespace yat::YAT_ISA {

template <class A>
struct SphereLight {
  /// How a receiver sees a sphere light.
  struct View {
    Vec3<A> way;       ///< to the centre
    Float<A> squared;  ///< |way|^2
    Mask<A> by_cone;   ///< the light shines outwards and the receiver is outside
    Mask<A> by_area;   ///< the light shines inwards; the cosine says from where it is seen
  };
  static YAT_INLINE View view(const LightRowW<A>& row, const Vec3<A>& receiver) {
    View v;
    v.way = light_a<A>(row) - receiver;
    v.squared = dot(v.way, v.way);
    v.by_area = row.b_x != Float<A>(0.f);
    v.by_cone = ~v.by_area & (v.squared > row.extra * row.extra);
    return v;
  }

  /// The cone with 1 - cos as sin^2 / (1 + cos), which keeps its accuracy for far lights.
  static YAT_INLINE LightPick<A> sample(const LightRowW<A>& row, const Vec3<A>& receiver,
                                        const Float<A>&, const Float<A>& u, const Float<A>& v) {
    const View seen = view(row, receiver);
    const Float<A> zero(0.f), one(1.f), radius = row.extra;
    const Vec3<A> center = light_a<A>(row);
    LightPick<A> pick;
    pick.wi = {zero, zero, one};
    pick.pdf = pick.measure = zero;
    Vec3<A> outward = pick.wi;

    const Mask<A> by_cone = seen.by_cone;
    if (any<A>(by_cone)) {
      const Frame<A> frame = Frame<A>::about((one / xsimd::sqrt(seen.squared)) * seen.way);
      const Float<A> sin2_max = radius * radius / seen.squared;
      const Float<A> measure = one_minus_cos<A>(sin2_max);
      const Vec3<A> w = square_to_cone<A>(measure, u, v);
      const Float<A> sin2 = w.x * w.x + w.y * w.y;
      const Vec3<A> wi = frame.to_scene(w);
      // Distance to the near side as product / far root: no cancellation close to the sphere. Past
      // the rim, where rounding may take a ray, the tangent point.
      const Float<A> distance = xsimd::sqrt(seen.squared);
      const Float<A> half_chord =
          xsimd::sqrt(xsimd::max(radius * radius - seen.squared * sin2, zero));
      const Float<A> near =
          (distance - radius) * (distance + radius) / (distance * w.z + half_chord);
      const Vec3<A> cone_outward = normalize(near * wi - seen.way);
      pick.wi = select(by_cone, wi, pick.wi);
      pick.measure = only<A>(by_cone, Float<A>(kTwoPi) * measure);
      pick.pdf = only<A>(by_cone, cone_pdf<A>(measure));
      outward = select(by_cone, cone_outward, outward);
    }
    const Mask<A> by_area = seen.by_area;
    if (any<A>(by_area)) {
      const Vec3<A> normal = square_to_sphere<A>(u, v);
      const Vec3<A> way = seen.way + radius * normal;
      const Float<A> squared = dot(way, way);
      const Vec3<A> wi = (one / xsimd::sqrt(squared)) * way;
      const Float<A> cos = dot(normal, wi);
      const Float<A> area = Float<A>(2 * kTwoPi) * radius * radius;
      const Mask<A> good = by_area & (cos > zero) & (squared > zero);
      pick.wi = select(good, wi, pick.wi);
      pick.measure = select<A>(good, area * cos / squared, pick.measure);
      pick.pdf = select<A>(good, squared / (area * cos), pick.pdf);
      outward = select(good, normal, outward);
    }
    const Float<A> offset = surface_offset(largest_magnitude(center) + radius, outward);
    const Float<A> reach = radius + select<A>(by_area, -offset, offset);
    pick.to = center + reach * outward;
    return pick;
  }

  static YAT_INLINE Float<A> pdf(const LightRowW<A>& row, const Vec3<A>& receiver,
                                 const SeenLight<A>& at) {
    const View seen = view(row, receiver);
    const Float<A> radius2 = row.extra * row.extra;
    const Float<A> cone = cone_pdf<A>(one_minus_cos<A>(radius2 / seen.squared));
    const Float<A> area = at.distance * at.distance / (Float<A>(2 * kTwoPi) * radius2 * at.cos);
    return only<A>(seen.by_cone | seen.by_area, select<A>(seen.by_area, area, cone));
  }
};

}  // namespace yat::YAT_ISA

#pragma once
// An analytic shape that shines on its outside, sampled over its own surface: a point there with a
// density known per area, which the map to the scene makes one per area in the scene.

#include "kernels/light.h"
#include "kernels/shapes/any.h"

namespace yat::YAT_ISA {

template <class A>
struct ShapeLight {
  static YAT_INLINE ShapeRowW<A> shape_of(const ShapesView& shapes, const Mask<A>& of_kind,
                                          const LightRowW<A>& row) {
    return gather<A>(shapes.rows, only<A>(of_kind, as_uint<A>(row.a_x)));
  }

  /// By how much an area of the shape's own space grows whose normal becomes `outside` long.
  static YAT_INLINE Float<A> area_scale(const ShapeRowW<A>& shape, const Float<A>& outside) {
    return (shape.stretch * outside) * (shape.stretch * shape.stretch);
  }

  template <ShapeKind kKind>
  static YAT_INLINE void pick_shape(const ShapeRowW<A>& shape, const Mask<A>& of_kind,
                                    const Vec3<A>& receiver, const Float<A>& u, const Float<A>& v,
                                    LightPick<A>& pick) {
    const Mask<A> mine = of_kind & mask_of<A>(shape.kind == UInt<A>(uint32_t(kKind)));
    if (!any<A>(mine)) return;
    using Shape = ShapeOf<A, kKind>;
    const Float<A> zero(0.f), one(1.f);
    const ShapeSample<A> at = Shape::sample(shape, u, v);
    const Vec3<A> n = Shape::normal(shape, at.p), outside = normal_to_scene(shape, n);
    const Float<A> stretch = length(outside), scale = one / stretch;
    const Vec3<A> outward = scale * outside;
    const Vec3<A> shining = select(mask_of<A>(shape.inward != UInt<A>(0u)), -outward, outward);
    const Vec3<A> point = vector_to_scene(shape, at.p) + shape_origin<A>(shape);
    const Vec3<A> way = point - receiver;
    const Float<A> squared = dot(way, way);
    const Vec3<A> wi = (one / xsimd::sqrt(squared)) * way;
    const Float<A> cos = -dot(shining, wi);
    const Float<A> area = at.inverse_density * area_scale(shape, stretch);
    const Mask<A> front = mine & (cos > zero) & (squared > zero) & (area > zero);
    pick.wi = select(front, wi, pick.wi);
    pick.measure = select<A>(front, area * cos / squared, pick.measure);
    pick.pdf = select<A>(front, squared / (area * cos), pick.pdf);
    const Float<A> offset = shape_offset(shape, n, outward, scale);
    pick.to = select(mine, point + offset * shining, pick.to);
  }

  /// of_kind: lanes whose row is a shape.
  static YAT_INLINE LightPick<A> sample(const ShapesView& shapes, const LightRowW<A>& row,
                                        const Mask<A>& of_kind, const Vec3<A>& receiver,
                                        const Float<A>& u, const Float<A>& v) {
    const ShapeRowW<A> shape = shape_of(shapes, of_kind, row);
    const Float<A> zero(0.f);
    LightPick<A> pick{{zero, zero, Float<A>(1.f)}, receiver, zero, zero};
    pick_shape<ShapeKind::kQuadric>(shape, of_kind, receiver, u, v, pick);
    pick_shape<ShapeKind::kDisk>(shape, of_kind, receiver, u, v, pick);
    pick_shape<ShapeKind::kTorus>(shape, of_kind, receiver, u, v, pick);
    return pick;
  }

  template <ShapeKind kKind>
  static YAT_INLINE void area_at(const ShapeRowW<A>& shape, const Mask<A>& of_kind,
                                 const Vec3<A>& p, Float<A>& area) {
    const Mask<A> mine = of_kind & mask_of<A>(shape.kind == UInt<A>(uint32_t(kKind)));
    if (!any<A>(mine)) return;
    using Shape = ShapeOf<A, kKind>;
    const Vec3<A> outside = normal_to_scene(shape, Shape::normal(shape, p));
    area = select<A>(mine, Shape::inverse_density(shape, p) * area_scale(shape, length(outside)),
                     area);
  }

  /// Where a path met the shape, at pos.
  static YAT_INLINE Float<A> pdf(const ShapesView& shapes, const LightRowW<A>& row,
                                 const Mask<A>& of_kind, const Vec3<A>& pos,
                                 const SeenLight<A>& seen) {
    const ShapeRowW<A> shape = shape_of(shapes, of_kind, row);
    const Vec3<A> p = to_shape(shape, pos - shape_origin<A>(shape));
    Float<A> area(1.f);
    area_at<ShapeKind::kQuadric>(shape, of_kind, p, area);
    area_at<ShapeKind::kDisk>(shape, of_kind, p, area);
    area_at<ShapeKind::kTorus>(shape, of_kind, p, area);
    return seen.distance * seen.distance / (area * seen.cos);
  }
};

}  // namespace yat::YAT_ISA

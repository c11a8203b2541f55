#pragma once
// Rays against analytic shapes. A ray starts anew where it enters the shape's bounding sphere, goes
// to the shape's own space by the stored map, and keeps its parameter: what it meets is known to
// roundings of the shape's size and place, however far away it began.

#include "kernels/quadrics.h"
#include "kernels/shapes/any.h"

namespace yat::YAT_ISA {

/// Where along the line (t as in the ray's columns) it first meets the shape; otherwise anything
/// that is not above 0.
template <class A, ShapeKind kKind>
YAT_INLINE Float<A> shape_distance(const ShapeRowW<A>& row, const RayLines<A>& line) {
  const Vec3<A> org{line.org_x, line.org_y, line.org_z}, dir{line.dir_x, line.dir_y, line.dir_z};
  const Vec3<A> center = shape_origin<A>(row);
  const SphereEntry<A> entry = enter_sphere<A>(center, row.radius, org, dir);
  if (!any<A>(entry.meets)) return Float<A>(-1.f);
  const Vec3<A> own_dir = to_shape(row, dir);
  const Float<A> inverse = Float<A>(1.f) / length(own_dir);
  const ShapeRay<A> ray{to_shape(row, start_at(org, dir, entry.skip) - center), inverse * own_dir};
  const Float<A> t = ShapeOf<A, kKind>::distance(row, ray);
  const Mask<A> hit = entry.meets & (t > Float<A>(0.f));
  return select<A>(hit, xsimd::fma(t, inverse, entry.skip), Float<A>(-1.f));
}

/// See KernelTable.
template <class A, ShapeKind kKind>
void intersect_shapes(const ShapesView& shapes, uint32_t first_prim, const Ray<ConstColumn>& rays,
                      const Hit<Column>& hits, uint32_t n) noexcept {
  const RowRange range = shapes.kinds[uint32_t(kKind)];
  for (uint32_t s = range.first; s < range.end; ++s) {
    const ShapeRowW<A> shape = broadcast<A>(shapes.rows, s);
    for (uint32_t row = 0; row < n; row += kLanes<A>)
      keep_nearer<A>(shape_distance<A, kKind>(shape, load_lines<A>(rays, row)), first_prim + s,
                     hits, row);
  }
}

template <class A, ShapeKind kKind>
void shadow_shapes(const ShapesView& shapes, const ShadowRay<ConstColumn>& rays, uint32_t* occluded,
                   uint32_t n) noexcept {
  const RowRange range = shapes.kinds[uint32_t(kKind)];
  for (uint32_t s = range.first; s < range.end; ++s) {
    if (!read_row(shapes.rows, s).occludes) continue;
    const ShapeRowW<A> shape = broadcast<A>(shapes.rows, s);
    for (uint32_t row = 0; row < n; row += kLanes<A>)
      add_occlusion<A>(shape_distance<A, kKind>(shape, load_lines<A>(rays, row)), occluded, row);
  }
}

}  // namespace yat::YAT_ISA

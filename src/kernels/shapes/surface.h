#pragma once
// Hits on analytic shapes -> surfaces.

#include "kernels/shapes/any.h"
#include "kernels/surface.h"

namespace yat::YAT_ISA {

/// The hit goes to the shape's own space and onto the surface there, so that the error of a long
/// ray does not stay in it.
template <class A, ShapeKind kKind>
YAT_INLINE LocalGeometry<A> shape_geometry(const ShapesView& shapes, const Vec3<A>& hit_point,
                                           const UInt<A>& index) {
  using Shape = ShapeOf<A, kKind>;
  const ShapeRowW<A> row = gather<A>(shapes.rows, index);
  const Vec3<A> org = shape_origin<A>(row);
  const Vec3<A> p = Shape::project(row, to_shape(row, hit_point - org));
  const Vec3<A> n = Shape::normal(row, p), outside = normal_to_scene(row, n);
  const Float<A> scale = Float<A>(1.f) / length(outside);
  LocalGeometry<A> g;
  g.pos = vector_to_scene(row, p) + org;
  const Vec3<A> outward = scale * outside;
  g.offset = shape_offset(row, n, outward, scale);
  g.ng = g.ns = select(mask_of<A>(row.inward != UInt<A>(0u)), -outward, outward);
  const Point2<A> uv = Shape::uv(row, p);
  g.u = uv.x;
  g.v = uv.y;
  g.parameter = row.parameter;
  g.light = row.light;
  return g;
}

/// See KernelTable::make_surfaces.
template <class A, ShapeKind kKind>
void make_shape_surfaces(const SceneView& scene, const uint32_t* order,
                         const Ray<ConstColumn>& rays, const Hit<ConstColumn>& hits,
                         const PathState<ConstColumn>& paths, const Surface<Column>& surfaces,
                         const PathState<Column>& paths_out, uint32_t n) noexcept {
  const GeometryView& geometry = scene.geometry;
  const UInt<A> first(first_shape(geometry));
  for (uint32_t row = 0; row < n; row += kLanes<A>) {
    const NearRows<A> from = near_rows<A>(order, row, n - row < kLanes<A> ? n - row : kLanes<A>);
    const Hit<Lanes<A>::template Of> hit = gather<A>(hits, from);
    const Vec3<A> org{gather<A>(rays.org_x, from), gather<A>(rays.org_y, from),
                      gather<A>(rays.org_z, from)};
    const Vec3<A> dir{gather<A>(rays.dir_x, from), gather<A>(rays.dir_y, from),
                      gather<A>(rays.dir_z, from)};
    const LocalGeometry<A> g =
        shape_geometry<A, kKind>(geometry.shapes, org + hit.t * dir, hit.prim - first);
    const PathState<Lanes<A>::template Of> path = gather<A>(paths, from);
    store<A>(surface_of<A>(g, hit, dir, path.passed), surfaces, row);
    store<A>(path, paths_out, row);
  }
}

}  // namespace yat::YAT_ISA

#pragma once
// Hits in instances -> surfaces: object space to scene space.

#include "kernels/surface.h"

namespace yat::YAT_ISA {

/// Triangles of shared objects. The outside stays outside whatever the map, mirrored or not:
/// normals go by the inverse transpose, which takes what points out of the object to what points
/// out of its image.
///
/// The next ray comes back to the triangle by the rounded inverse map. So it starts off by 32
/// roundings of the scene-space coordinates, as on any triangle, and as many of the object-space
/// numbers that its way there and the test in object space round (InstanceRow::inner), which along
/// the normal count in scene space 1 / |inverse transpose * unit normal| times.
template <class A, bool kVertexData>
YAT_INLINE LocalGeometry<A> instance_geometry(const InstancesView& instances,
                                              const Hit<Lanes<A>::template Of>& hit,
                                              const UInt<A>& instance) {
  const InstanceRow<Lanes<A>::template Of> row = gather<A>(instances.rows, instance);
  const TriangleRow<Lanes<A>::template Of> t = gather<A>(instances.triangles, hit.prim);
  const Vec3<A> p0{t.p0_x, t.p0_y, t.p0_z};
  const Vec3<A> e1{t.p1_x - t.p0_x, t.p1_y - t.p0_y, t.p1_z - t.p0_z};
  const Vec3<A> e2{t.p2_x - t.p0_x, t.p2_y - t.p0_y, t.p2_z - t.p0_z};
  const Vec3<A> p = p0 + hit.u * e1 + hit.v * e2;
  const Vec3<A> normal = triangle_normal(e1, e2);
  const auto outwards = [&row](const Vec3<A>& n) {
    return Vec3<A>{row.o_xx * n.x + row.o_yx * n.y + row.o_zx * n.z,
                   row.o_xy * n.x + row.o_yy * n.y + row.o_zy * n.z,
                   row.o_xz * n.x + row.o_yz * n.y + row.o_zz * n.z};
  };
  LocalGeometry<A> g;
  g.pos = {row.w_xx * p.x + row.w_xy * p.y + row.w_xz * p.z + row.org_x,
           row.w_yx * p.x + row.w_yy * p.y + row.w_yz * p.z + row.org_y,
           row.w_zx * p.x + row.w_zy * p.y + row.w_zz * p.z + row.org_z};
  const Vec3<A> outside = outwards(normal);
  const Float<A> scale = Float<A>(1.f) / length(outside);
  g.ng = g.ns = scale * outside;
  const Float<A> inner = xsimd::abs(normal.x) * row.inner_x + xsimd::abs(normal.y) * row.inner_y +
                         xsimd::abs(normal.z) * row.inner_z;
  g.offset = surface_offset(row.extent, g.ng) + Float<A>(32 * kRounding) * scale * inner;
  const InstanceShapeRow<Lanes<A>::template Of> shape =
      gather<A>(instances.shapes, row.first_shape + t.parameter);
  g.parameter = shape.parameter;
  g.light = select<A>(mask_of<A>(t.light == UInt<A>(kNone)), t.light, shape.light + t.light);
  g.u = g.v = Float<A>(0.f);
  if constexpr (kVertexData) {
    const TriangleVertexRow<Lanes<A>::template Of> w =
        gather<A>(instances.triangle_vertices, hit.prim);
    const Float<A> b0 = Float<A>(1.f) - hit.u - hit.v, zero(0.f);
    const Vec3<A> unit =
        normalize(outwards(Vec3<A>{b0 * w.n0_x + hit.u * w.n1_x + hit.v * w.n2_x,
                                   b0 * w.n0_y + hit.u * w.n1_y + hit.v * w.n2_y,
                                   b0 * w.n0_z + hit.u * w.n1_z + hit.v * w.n2_z}));
    // In object space vertex normals are on the outside; a map that is no similarity may turn one
    // behind its triangle, and it is laid into the plane. Normals that cancel: the geometric one.
    const Float<A> side = dot(unit, g.ng);
    const Vec3<A> level = normalize(unit - side * g.ng);
    const Vec3<A> ns = select(side < zero, level, unit);
    g.ns = select(is_finite<A>(sum_of_magnitudes(ns)), ns, g.ng);
    g.u = b0 * w.u0 + hit.u * w.u1 + hit.v * w.u2;
    g.v = b0 * w.v0 + hit.u * w.v1 + hit.v * w.v2;
  }
  return g;
}

/// See KernelTable::make_instance_surfaces.
template <class A, bool kVertexData>
void make_instance_surfaces(const SceneView& scene, const uint32_t* order,
                            const Ray<ConstColumn>& rays, const Hit<ConstColumn>& hits,
                            const uint32_t* instance, const PathState<ConstColumn>& paths,
                            const Surface<Column>& surfaces, const PathState<Column>& paths_out,
                            uint32_t n) noexcept {
  for (uint32_t row = 0; row < n; row += kLanes<A>) {
    const NearRows<A> from = near_rows<A>(order, row, n - row < kLanes<A> ? n - row : kLanes<A>);
    const Hit<Lanes<A>::template Of> hit = gather<A>(hits, from);
    const Vec3<A> dir{gather<A>(rays.dir_x, from), gather<A>(rays.dir_y, from),
                      gather<A>(rays.dir_z, from)};
    const LocalGeometry<A> g =
        instance_geometry<A, kVertexData>(scene.instances, hit, gather<A>(instance, from));
    const PathState<Lanes<A>::template Of> path = gather<A>(paths, from);
    store<A>(surface_of<A>(g, hit, dir, path.passed), surfaces, row);
    store<A>(path, paths_out, row);
  }
}

}  // namespace yat::YAT_ISA

#pragma once
// Hits -> surfaces: position, normals and offset of each hit, dense, with its path state.

#include "kernels/math.h"
#include "kernels/table.h"
#include "kernels/vec.h"

namespace yat::YAT_ISA {

/// How far off its surface a ray must start (invariant 4): 32 roundings of the largest coordinate
/// that entered the position, projected on the normal.
template <class A>
YAT_INLINE Float<A> surface_offset(const Float<A>& magnitude, const Vec3<A>& ng) {
  return Float<A>(32 * kRounding) * magnitude * sum_of_magnitudes(ng);
}

template <class A>
struct LocalGeometry {
  Vec3<A> pos, ng, ns;
  Float<A> offset, u, v;
  UInt<A> parameter, light;
};

/// Triangles. The position comes from the barycentrics, which keeps it within a few roundings of
/// the triangle however far away the ray started.
template <class A, bool kVertexData>
YAT_INLINE LocalGeometry<A> triangle_geometry(const GeometryView& geometry,
                                              const Hit<Lanes<A>::template Of>& hit,
                                              const UInt<A>& row) {
  const TriangleRow<Lanes<A>::template Of> t = gather<A>(geometry.triangles, row);
  const Vec3<A> p0{t.p0_x, t.p0_y, t.p0_z};
  const Vec3<A> e1{t.p1_x - t.p0_x, t.p1_y - t.p0_y, t.p1_z - t.p0_z};
  const Vec3<A> e2{t.p2_x - t.p0_x, t.p2_y - t.p0_y, t.p2_z - t.p0_z};
  LocalGeometry<A> g;
  g.pos = p0 + hit.u * e1 + hit.v * e2;
  g.ng = g.ns = triangle_normal(e1, e2);
  g.offset = surface_offset(t.extent, g.ng);
  g.u = g.v = Float<A>(0.f);
  g.parameter = t.parameter;
  g.light = t.light;
  if constexpr (kVertexData) {
    const TriangleVertexRow<Lanes<A>::template Of> w = gather<A>(geometry.triangle_vertices, row);
    const Float<A> b0 = Float<A>(1.f) - hit.u - hit.v, zero(0.f);
    const Vec3<A> ns{b0 * w.n0_x + hit.u * w.n1_x + hit.v * w.n2_x,
                     b0 * w.n0_y + hit.u * w.n1_y + hit.v * w.n2_y,
                     b0 * w.n0_z + hit.u * w.n1_z + hit.v * w.n2_z};
    // On the outside, whatever the file said. Normals that cancel or are broken: the geometric one.
    const Float<A> side = dot(ns, g.ng);
    const Vec3<A> unit = normalize(ns);
    const Vec3<A> outside = select(side < zero, -unit, unit);
    const Mask<A> usable = is_finite<A>(sum_of_magnitudes(unit)) & (side != zero);
    g.ns = select(usable, outside, g.ng);
    g.u = b0 * w.u0 + hit.u * w.u1 + hit.v * w.u2;
    g.v = b0 * w.v0 + hit.u * w.v1 + hit.v * w.v2;
  }
  return g;
}

/// Spheres. The hit is projected onto the sphere: the error of a long ray does not stay in it.
template <class A>
YAT_INLINE LocalGeometry<A> sphere_geometry(const Rows<SphereRow>& spheres,
                                            const Vec3<A>& hit_point, const UInt<A>& row) {
  const SphereRow<Lanes<A>::template Of> s = gather<A>(spheres, row);
  const Vec3<A> center{s.center_x, s.center_y, s.center_z};
  const Vec3<A> outward = normalize(hit_point - center);
  LocalGeometry<A> g;
  g.pos = center + s.radius * outward;
  g.ng = select(mask_of<A>(s.inward != UInt<A>(0u)), -outward, outward);
  g.ns = g.ng;
  g.offset = surface_offset(largest_magnitude(center) + s.radius, g.ng);
  const Vec3<A> x{s.x_x, s.x_y, s.x_z}, z{s.z_x, s.z_y, s.z_z};
  const Float<A> across = dot(outward, x), up = dot(outward, z);
  const Float<A> side = s.hand * dot(outward, cross(z, x));
  const Float<A> theta = angle_in_turns<A>(up, xsimd::sqrt(across * across + side * side));
  g.u = angle_in_turns<A>(across, side);
  g.v = Float<A>(1.f) - Float<A>(2.f) * theta;
  g.parameter = s.parameter;
  g.light = s.light;
  return g;
}

/// Planes, the hit projected likewise.
template <class A>
YAT_INLINE LocalGeometry<A> plane_geometry(const Rows<PlaneRow>& planes, const Vec3<A>& hit_point,
                                           const UInt<A>& row) {
  const PlaneRow<Lanes<A>::template Of> p = gather<A>(planes, row);
  LocalGeometry<A> g;
  g.ng = g.ns = {p.normal_x, p.normal_y, p.normal_z};
  g.pos = hit_point - (dot(g.ng, hit_point) - p.distance) * g.ng;
  g.offset = surface_offset(xsimd::max(largest_magnitude(hit_point), xsimd::abs(p.distance)), g.ng);
  g.u = dot(Vec3<A>{p.u_x, p.u_y, p.u_z}, g.pos) + p.u_0;
  g.v = dot(Vec3<A>{p.v_x, p.v_y, p.v_z}, g.pos) + p.v_0;
  g.parameter = p.parameter;
  g.light = UInt<A>(kNone);
  return g;
}

/// A surface as it is handed on; `passed`: see PathState.
template <class A>
YAT_INLINE Surface<Lanes<A>::template Of> surface_of(const LocalGeometry<A>& g,
                                                     const Hit<Lanes<A>::template Of>& hit,
                                                     const Vec3<A>& dir, const Float<A>& passed) {
  Surface<Lanes<A>::template Of> s;
  s.pos_x = g.pos.x;
  s.pos_y = g.pos.y;
  s.pos_z = g.pos.z;
  s.ng_x = g.ng.x;
  s.ng_y = g.ng.y;
  s.ng_z = g.ng.z;
  s.ns_x = g.ns.x;
  s.ns_y = g.ns.y;
  s.ns_z = g.ns.z;
  s.wo_x = -dir.x;
  s.wo_y = -dir.y;
  s.wo_z = -dir.z;
  s.offset = g.offset;
  s.distance = hit.t + passed;
  s.u = g.u;
  s.v = g.v;
  s.prim = hit.prim;
  s.parameter = g.parameter;
  s.light = g.light;
  return s;
}

/// Surfaces and path states of rows order[0..n): see KernelTable::make_surfaces.
template <class A, GeometryKind kKind>
void make_surfaces(const SceneView& scene, const uint32_t* order, const Ray<ConstColumn>& rays,
                   const Hit<ConstColumn>& hits, const PathState<ConstColumn>& paths,
                   const Surface<Column>& surfaces, const PathState<Column>& paths_out,
                   uint32_t n) noexcept {
  const GeometryView& geometry = scene.geometry;
  for (uint32_t row = 0; row < n; row += kLanes<A>) {
    const NearRows<A> from = near_rows<A>(order, row, n - row < kLanes<A> ? n - row : kLanes<A>);
    const Hit<Lanes<A>::template Of> hit = gather<A>(hits, from);
    const Vec3<A> dir{gather<A>(rays.dir_x, from), gather<A>(rays.dir_y, from),
                      gather<A>(rays.dir_z, from)};
    LocalGeometry<A> g;
    if constexpr (kKind == GeometryKind::kTriangleFlat || kKind == GeometryKind::kTriangleVertex) {
      g = triangle_geometry < A, kKind == GeometryKind::kTriangleVertex > (geometry, hit, hit.prim);
    } else {
      const Vec3<A> org{gather<A>(rays.org_x, from), gather<A>(rays.org_y, from),
                        gather<A>(rays.org_z, from)};
      const Vec3<A> hit_point = org + hit.t * dir;
      if constexpr (kKind == GeometryKind::kSphere)
        g = sphere_geometry<A>(geometry.spheres, hit_point,
                               hit.prim - UInt<A>(geometry.triangles.count));
      else
        g = plane_geometry<A>(
            geometry.planes, hit_point,
            hit.prim - UInt<A>(geometry.triangles.count + geometry.spheres.count));
    }
    const PathState<Lanes<A>::template Of> path = gather<A>(paths, from);
    const Surface<Lanes<A>::template Of> s = surface_of<A>(g, hit, dir, path.passed);
    store<A>(s, surfaces, row);
    store<A>(path, paths_out, row);
  }
}

}  // namespace yat::YAT_ISA

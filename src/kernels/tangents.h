#pragma once
// Surfaces -> tangents: the direction of dp/du, for materials that are not the same all around the
// normal. Runs in bins of such materials only.

#include "kernels/math.h"
#include "kernels/surface_axes.h"
#include "kernels/table.h"
#include "kernels/vec.h"

namespace yat::YAT_ISA {

/// A direction across n that depends on n alone: where texture coordinates give none. Which one it
/// is shows on brushed metal, so it is the one that LuxRender takes (the usual CoordinateSystem of
/// Pharr, Humphreys, Physically Based Rendering, 2004).
template <class A>
YAT_INLINE Vec3<A> arbitrary_tangent(const Vec3<A>& n) {
  const Float<A> zero(0.f);
  const Mask<A> wide = xsimd::abs(n.x) > xsimd::abs(n.y);
  return normalize(Vec3<A>{xsimd::select(wide, -n.z, zero), xsimd::select(wide, zero, n.z),
                           xsimd::select(wide, n.x, -n.y)});
}

/// dp/du of a triangle with edges e1, e2, of any length; 0 where the coordinates are degenerate.
template <class A>
YAT_INLINE Vec3<A> texture_direction(const Vec3<A>& e1, const Vec3<A>& e2,
                                     const TriangleVertexRow<Lanes<A>::template Of>& w) {
  const Float<A> du1 = w.u1 - w.u0, du2 = w.u2 - w.u0, dv1 = w.v1 - w.v0, dv2 = w.v2 - w.v0;
  const Float<A> zero(0.f), determinant = du1 * dv2 - dv1 * du2;
  const Vec3<A> along = dv2 * e1 - dv1 * e2;
  return select(determinant > zero, along,
                select(determinant < zero, -along, Vec3<A>{zero, zero, zero}));
}

/// `along` laid across ns and made unit; what LuxRender takes for ng where that cannot be done.
template <class A>
YAT_INLINE Vec3<A> tangent_across(const Vec3<A>& along, const Vec3<A>& ng, const Vec3<A>& ns) {
  const auto across = [&ns](const Vec3<A>& v) { return normalize(v - dot(v, ns) * ns); };
  // Scaled first: triangles of any size have a tangent.
  const Vec3<A> t = across((Float<A>(1.f) / largest_magnitude(along)) * along);
  return select(is_finite<A>(sum_of_magnitudes(t)), t, across(arbitrary_tangent<A>(ng)));
}

template <class A>
YAT_INLINE void store_tangent(const Vec3<A>& t, const Tangent<Column>& tangents, uint32_t row) {
  store<A>(t.x, tangents.x, row);
  store<A>(t.y, tangents.y, row);
  store<A>(t.z, tangents.z, row);
}

template <class A>
YAT_INLINE Vec3<A> position_of(const Surface<ConstColumn>& s, uint32_t row) {
  return {load<A>(s.pos_x, row), load<A>(s.pos_y, row), load<A>(s.pos_z, row)};
}

template <class A>
struct SurfaceNormals {
  Vec3<A> ng, ns;
  static YAT_INLINE SurfaceNormals load_rows(const Surface<ConstColumn>& s, uint32_t row) {
    return {{load<A>(s.ng_x, row), load<A>(s.ng_y, row), load<A>(s.ng_z, row)},
            {load<A>(s.ns_x, row), load<A>(s.ns_y, row), load<A>(s.ns_z, row)}};
  }
};

/// See KernelTable::make_tangents.
template <class A, GeometryKind kKind>
void make_tangents(const SceneView& scene, const Surface<ConstColumn>& surfaces,
                   const Tangent<Column>& tangents, uint32_t n) noexcept {
  const Float<A> zero(0.f);
  for (uint32_t row = 0; row < n; row += kLanes<A>) {
    const auto normals = SurfaceNormals<A>::load_rows(surfaces, row);
    Vec3<A> along{zero, zero, zero};
    if constexpr (kKind == GeometryKind::kTriangleVertex) {
      const UInt<A> prim = only<A>(tail_mask<A>(row, n), load<A>(surfaces.prim, row));
      const TriangleRow<Lanes<A>::template Of> t = gather<A>(scene.geometry.triangles, prim);
      along = texture_direction<A>(Vec3<A>{t.p1_x - t.p0_x, t.p1_y - t.p0_y, t.p1_z - t.p0_z},
                                   Vec3<A>{t.p2_x - t.p0_x, t.p2_y - t.p0_y, t.p2_z - t.p0_z},
                                   gather<A>(scene.geometry.triangle_vertices, prim));
    } else if constexpr (kKind == GeometryKind::kSphere) {
      const UInt<A> sphere = load<A>(surfaces.prim, row) - UInt<A>(scene.geometry.triangles.count);
      along = sphere_tangents<A>(scene.geometry.spheres, only<A>(tail_mask<A>(row, n), sphere),
                                 position_of<A>(surfaces, row))
                  .du;
    } else if constexpr (kKind == GeometryKind::kPlane) {
      const UInt<A> plane = load<A>(surfaces.prim, row) -
                            UInt<A>(scene.geometry.triangles.count + scene.geometry.spheres.count);
      along = plane_tangents<A>(scene.geometry.planes, only<A>(tail_mask<A>(row, n), plane)).du;
    }
    store_tangent<A>(tangent_across<A>(along, normals.ng, normals.ns), tangents, row);
  }
}

/// See KernelTable::make_instance_tangents.
template <class A, bool kVertexData>
void make_instance_tangents(const SceneView& scene, const uint32_t* order, const uint32_t* instance,
                            const Surface<ConstColumn>& surfaces, const Tangent<Column>& tangents,
                            uint32_t n) noexcept {
  const Float<A> zero(0.f);
  for (uint32_t row = 0; row < n; row += kLanes<A>) {
    const auto normals = SurfaceNormals<A>::load_rows(surfaces, row);
    Vec3<A> along{zero, zero, zero};
    if constexpr (kVertexData) {
      const NearRows<A> from = near_rows<A>(order, row, n - row < kLanes<A> ? n - row : kLanes<A>);
      const UInt<A> prim = only<A>(tail_mask<A>(row, n), load<A>(surfaces.prim, row));
      const TriangleRow<Lanes<A>::template Of> t = gather<A>(scene.instances.triangles, prim);
      const Vec3<A> d =
          texture_direction<A>(Vec3<A>{t.p1_x - t.p0_x, t.p1_y - t.p0_y, t.p1_z - t.p0_z},
                               Vec3<A>{t.p2_x - t.p0_x, t.p2_y - t.p0_y, t.p2_z - t.p0_z},
                               gather<A>(scene.instances.triangle_vertices, prim));
      const InstanceRow<Lanes<A>::template Of> placed =
          gather<A>(scene.instances.rows, gather<A>(instance, from));
      along = {placed.w_xx * d.x + placed.w_xy * d.y + placed.w_xz * d.z,
               placed.w_yx * d.x + placed.w_yy * d.y + placed.w_yz * d.z,
               placed.w_zx * d.x + placed.w_zy * d.y + placed.w_zz * d.z};
    }
    store_tangent<A>(tangent_across<A>(along, normals.ng, normals.ns), tangents, row);
  }
}

}  // namespace yat::YAT_ISA

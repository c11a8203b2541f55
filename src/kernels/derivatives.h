#pragma once
// How surfaces lie in texture space, and how widely their rays see them.

#include "kernels/shapes/tangents.h"
#include "kernels/texture_step.h"

namespace yat::YAT_ISA {

/// Of a triangle with these edges; zero where its texture coordinates span no area.
template <class A>
YAT_INLINE Tangents<A> triangle_tangents(const Vec3<A>& e1, const Vec3<A>& e2,
                                         const TriangleVertexRow<Lanes<A>::template Of>& w) {
  const Float<A> u1 = w.u1 - w.u0, v1 = w.v1 - w.v0, u2 = w.u2 - w.u0, v2 = w.v2 - w.v0;
  const Float<A> area = u1 * v2 - v1 * u2, zero(0.f);
  const Float<A> scale = xsimd::select(area != zero, Float<A>(1.f) / area, zero);
  return {scale * (v2 * e1 - v1 * e2), scale * (u1 * e2 - u2 * e1)};
}

template <class A>
YAT_INLINE Tangents<A> tangents_at(const SceneView& scene, const UInt<A>& prim) {
  const TriangleRow<Lanes<A>::template Of> t = gather<A>(scene.geometry.triangles, prim);
  return triangle_tangents<A>({t.p1_x - t.p0_x, t.p1_y - t.p0_y, t.p1_z - t.p0_z},
                              {t.p2_x - t.p0_x, t.p2_y - t.p0_y, t.p2_z - t.p0_z},
                              gather<A>(scene.geometry.triangle_vertices, prim));
}

template <class A>
YAT_INLINE Tangents<A> instance_tangents_at(const SceneView& scene, const UInt<A>& prim,
                                            const UInt<A>& instance) {
  const InstancesView& instances = scene.instances;
  const InstanceRow<Lanes<A>::template Of> row = gather<A>(instances.rows, instance);
  const TriangleRow<Lanes<A>::template Of> t = gather<A>(instances.triangles, prim);
  const Tangents<A> object =
      triangle_tangents<A>({t.p1_x - t.p0_x, t.p1_y - t.p0_y, t.p1_z - t.p0_z},
                           {t.p2_x - t.p0_x, t.p2_y - t.p0_y, t.p2_z - t.p0_z},
                           gather<A>(instances.triangle_vertices, prim));
  const auto to_scene = [&row](const Vec3<A>& v) {
    return Vec3<A>{row.w_xx * v.x + row.w_xy * v.y + row.w_xz * v.z,
                   row.w_yx * v.x + row.w_yy * v.y + row.w_yz * v.z,
                   row.w_zx * v.x + row.w_zy * v.y + row.w_zz * v.z};
  };
  return {to_scene(object.du), to_scene(object.dv)};
}

/// Rows [i, i + W) of a chunk, all of one kind; lanes that are not present have prim 0.
template <class A>
YAT_INLINE Tangents<A> tangents_of_rows(const SceneView& scene, GeometryKind kind,
                                        const Surface<ConstColumn>& surfaces,
                                        const Mask<A>& present, uint32_t i) {
  const GeometryView& geometry = scene.geometry;
  const UInt<A> prim = load<A>(surfaces.prim, i);
  const auto row = [&](uint32_t first) { return only<A>(present, prim - UInt<A>(first)); };
  const uint32_t first_sphere = geometry.triangles.count;
  const uint32_t first_plane = first_sphere + geometry.spheres.count;
  const Vec3<A> pos = position_of<A>(surfaces, i);
  const Float<A> zero(0.f);
  switch (kind) {
    case GeometryKind::kTriangleVertex:
      return tangents_at<A>(scene, row(0));
    case GeometryKind::kSphere:
      return sphere_tangents<A>(geometry.spheres, row(first_sphere), pos);
    case GeometryKind::kPlane:
      return plane_tangents<A>(geometry.planes, row(first_plane));
    case GeometryKind::kQuadric:
      return shape_tangents<A, ShapeKind::kQuadric>(geometry.shapes, row(first_shape(geometry)),
                                                    pos);
    case GeometryKind::kDisk:
      return shape_tangents<A, ShapeKind::kDisk>(geometry.shapes, row(first_shape(geometry)), pos);
    case GeometryKind::kTorus:
      return shape_tangents<A, ShapeKind::kTorus>(geometry.shapes, row(first_shape(geometry)), pos);
    case GeometryKind::kTriangleFlat:
    case GeometryKind::kCount:
      break;
  }
  return {{zero, zero, zero}, {zero, zero, zero}};
}

/// The part of a scattered ray's lobe that one ray stands for, as a share of the lobe's diameter:
/// what a texture is averaged over must stay small against what many samples of a pixel see.
inline constexpr float kScatterShare = 1.f / 16;

/// See KernelTable::make_derivatives.
template <class A>
void make_derivatives(const SceneView& scene, GeometryKind geometry, const uint32_t* order,
                      const uint32_t* instance, const Surface<ConstColumn>& surfaces,
                      const PathState<ConstColumn>& paths,
                      const SurfaceDerivatives<Column>& derivatives, uint32_t n) noexcept {
  const Float<A> zero(0.f), one(1.f);
  const float* dx = scene.camera.dx;
  const Float<A> pixel(__builtin_sqrtf(dx[0] * dx[0] + dx[1] * dx[1] + dx[2] * dx[2]));
  for (uint32_t i = 0; i < n; i += kLanes<A>) {
    const Mask<A> present = tail_mask<A>(i, n);
    const Tangents<A> t =
        instance && geometry == GeometryKind::kTriangleVertex
            ? instance_tangents_at<A>(
                  scene, only<A>(present, load<A>(surfaces.prim, i)),
                  only<A>(present, gather<A>(instance, only<A>(present, load<A>(order, i)))))
            : tangents_of_rows<A>(scene, geometry, surfaces, present, i);
    // A cone about the ray: a pixel wide from the camera, else a share of the solid angle 1 / pdf.
    // On the surface it is an ellipse, taken as the circle of its area.
    const Float<A> pdf = load<A>(paths.pdf, i);
    const Float<A> spread = xsimd::select(
        pdf > zero, xsimd::min(Float<A>(kScatterShare * 2) / xsimd::sqrt(Float<A>(kPi) * pdf), one),
        pixel);
    const Float<A> cosine = xsimd::abs(load<A>(surfaces.ng_x, i) * load<A>(surfaces.wo_x, i) +
                                       load<A>(surfaces.ng_y, i) * load<A>(surfaces.wo_y, i) +
                                       load<A>(surfaces.ng_z, i) * load<A>(surfaces.wo_z, i));
    const Float<A> width =
        spread * load<A>(surfaces.distance, i) / xsimd::sqrt(xsimd::max(cosine, Float<A>(1e-4f)));
    store<A>(SurfaceDerivatives<Lanes<A>::template Of>{t.du.x, t.du.y, t.du.z, t.dv.x, t.dv.y,
                                                       t.dv.z, width},
             derivatives, i);
  }
}

}  // namespace yat::YAT_ISA

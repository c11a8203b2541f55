#pragma once
// Lights whose emission varies, over the surface or with the direction. Both sides of multiple
// importance sampling come here: a path that found such a light, and a light sample.
//
//   sample_varying_lights ─> LightSample, light ─> make_light_points ─> [texture steps] ─> factor
//   Surface of a light that a path met ─────────────────────────────> [texture steps] ─> factor
//   factor, direction ─> apply_emission_maps ─> multiply_colours
//
// Densities stay those of an even light: chances go by its mean.

#include "kernels/light_sample.h"
#include "kernels/shapes/surface.h"

namespace yat::YAT_ISA {

template <class A>
using EmissionRowW = EmissionRow<Lanes<A>::template Of>;

/// See KernelTable::sample_varying_lights.
template <class A, bool kByTree>
void sample_varying_lights(const SceneView& scene, const Surface<ConstColumn>& surfaces,
                           const Randoms<ConstColumn>& randoms, bool all_around,
                           const LightSample<Column>& samples, uint32_t* light,
                           uint32_t n) noexcept {
  sample_chosen_lights<A, kAnyLights, kByTree, true>(scene, surfaces, randoms, all_around, samples,
                                                     n, light);
}

/// A point of a light by texture coordinates.
template <class A>
struct LightPoint {
  Vec3<A> pos, normal;
  Float<A> u, v;
};

/// The point of the triangle below or above `at`. What rounding takes beyond the edges comes back
/// to them.
template <class A>
YAT_INLINE LightPoint<A> point_of_triangle(const LightRowW<A>& row, const EmissionRowW<A>& e,
                                           const Vec3<A>& at) {
  const Float<A> zero(0.f), one(1.f);
  const Vec3<A> p0 = light_a<A>(row), e1{row.b_x, row.b_y, row.b_z}, e2{row.c_x, row.c_y, row.c_z};
  const Vec3<A> n = cross(e1, e2), way = at - p0;
  const Vec3<A> unit = triangle_normal(e1, e2);
  const Float<A> scale = one / dot(n, unit);
  const Float<A> b1 = xsimd::min(xsimd::max(dot(cross(way, e2), unit) * scale, zero), one);
  const Float<A> b2 = xsimd::min(xsimd::max(dot(cross(e1, way), unit) * scale, zero), one - b1);
  const Float<A> b0 = one - b1 - b2;
  return {p0 + b1 * e1 + b2 * e2, unit, b0 * e.u0 + b1 * e.u1 + b2 * e.u2,
          b0 * e.v0 + b1 * e.v1 + b2 * e.v2};
}

template <class A, ShapeKind kKind>
YAT_INLINE void merge_shape_point(const GeometryView& geometry, const UInt<A>& index,
                                  const UInt<A>& kind, const Mask<A>& of_kind, const Vec3<A>& at,
                                  LightPoint<A>& point) {
  const Mask<A> mine = of_kind & mask_of<A>(kind == UInt<A>(uint32_t(kKind)));
  if (!any<A>(mine)) return;
  const LocalGeometry<A> g = shape_geometry<A, kKind>(geometry.shapes, at, index);
  point.pos = select(mine, g.pos, point.pos);
  point.normal = select(mine, g.ng, point.normal);
  point.u = select<A>(mine, g.u, point.u);
  point.v = select<A>(mine, g.v, point.v);
}

/// See KernelTable::make_light_points. The shadow ray's end lies a few roundings off the light: the
/// point is what is nearest to it.
template <class A>
void make_light_points(const SceneView& scene, const uint32_t* light, const uint32_t* order,
                       const LightSample<ConstColumn>& samples, const Surface<Column>& points,
                       uint32_t n) noexcept {
  const GeometryView& geometry = scene.geometry;
  for (uint32_t i = 0; i < n; i += kLanes<A>) {
    const Mask<A> present = tail_mask<A>(i, n);
    const UInt<A> from = only<A>(present, load<A>(order, i));
    const UInt<A> number = only<A>(present, gather<A>(light, from));
    const LightRowW<A> row = gather<A>(scene.lights.rows, number);
    const EmissionRowW<A> e = gather<A>(scene.lights.emission, number);
    const Vec3<A> at{gather<A>(samples.to_x, from), gather<A>(samples.to_y, from),
                     gather<A>(samples.to_z, from)};
    const auto of_kind = [&](LightKind kind) {
      return present & mask_of<A>(row.kind == UInt<A>(uint32_t(kind)));
    };
    LightPoint<A> point = point_of_triangle<A>(row, e, at);
    const Mask<A> sphere = of_kind(LightKind::kSphere);
    if (any<A>(sphere)) {
      const UInt<A> index = only<A>(sphere, e.prim - UInt<A>(geometry.triangles.count));
      const LocalGeometry<A> g = sphere_geometry<A>(geometry.spheres, at, index);
      point.pos = select(sphere, g.pos, point.pos);
      point.normal = select(sphere, g.ng, point.normal);
      point.u = select<A>(sphere, g.u, point.u);
      point.v = select<A>(sphere, g.v, point.v);
    }
    const Mask<A> shape = of_kind(LightKind::kShape);
    if (any<A>(shape)) {
      const UInt<A> index = only<A>(shape, e.prim - UInt<A>(first_shape(geometry)));
      const UInt<A> kind = gather<A>(geometry.shapes.rows, index).kind;
      merge_shape_point<A, ShapeKind::kQuadric>(geometry, index, kind, shape, at, point);
      merge_shape_point<A, ShapeKind::kDisk>(geometry, index, kind, shape, at, point);
      merge_shape_point<A, ShapeKind::kTorus>(geometry, index, kind, shape, at, point);
    }
    store<A>(point.pos.x, points.pos_x, i);
    store<A>(point.pos.y, points.pos_y, i);
    store<A>(point.pos.z, points.pos_z, i);
    store<A>(point.normal.x, points.ns_x, i);
    store<A>(point.normal.y, points.ns_y, i);
    store<A>(point.normal.z, points.ns_z, i);
    store<A>(point.u, points.u, i);
    store<A>(point.v, points.v, i);
    store<A>(e.prim, points.prim, i);
    store<A>(e.parameter, points.parameter, i);
  }
}

/// See KernelTable::apply_emission_maps. A map holds intensities: what is seen of them is brighter
/// by how much smaller the surface looks.
template <class A>
void apply_emission_maps(const SceneView& scene, const uint32_t* light,
                         const float* const* direction, float sign, float* const* factor,
                         uint32_t n) noexcept {
  const LightView& lights = scene.lights;
  const Float<A> zero(0.f), one(1.f), side(sign);
  for (uint32_t i = 0; i < n; i += kLanes<A>) {
    const UInt<A> number = load<A>(light, i);
    const Mask<A> present = tail_mask<A>(i, n) & mask_of<A>(number != UInt<A>(kNone));
    const UInt<A> map_row = gather<A>(lights.emission, only<A>(present, number)).map;
    const Mask<A> mapped = present & mask_of<A>(map_row != UInt<A>(kNone));
    if (!any<A>(mapped)) continue;
    const LightMapW<A> map = gather<A>(lights.maps, only<A>(mapped, map_row));
    const Vec3<A> w{side * load<A>(direction[0], i), side * load<A>(direction[1], i),
                    side * load<A>(direction[2], i)};
    // Padding may hold anything, also what is no direction.
    const Vec3<A> l = select(mapped, to_map<A>(map, w).unit, Vec3<A>{zero, zero, one});
    const ColourTriple<Float<A>> texel = look_up<A>(lights, map, picture_place<A>(map, l));
    const Float<A> scale = only<A>(l.z > zero, one / l.z);
    const auto apply = [&](const Float<A>& channel, float* to) {
      const Float<A> old = load<A>(to, i);
      store<A>(select<A>(mapped, old * channel * scale, old), to, i);
    };
    apply(texel.r, factor[0]);
    apply(texel.g, factor[1]);
    apply(texel.b, factor[2]);
  }
}

/// See KernelTable::multiply_colours.
template <class A>
void multiply_colours(const float* const* a, const float* const* b, float* const* out,
                      uint32_t n) noexcept {
  for (uint32_t c = 0; c < 3; ++c)
    for (uint32_t i = 0; i < n; i += kLanes<A>)
      store<A>(load<A>(a[c], i) * load<A>(b[c], i), out[c], i);
}

}  // namespace yat::YAT_ISA

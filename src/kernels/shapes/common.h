#pragma once
// What the analytic shapes have in common. A shape is a struct of static functions over ShapeRow,
// chosen by its kind when a kernel is built:
//
//   distance(row, ray)           smallest t > 0 at which the ray meets the surface; otherwise
//                                anything that is not above 0
//   project(row, p)              the point of the whole surface near p, for p near it
//   normal(row, p)               unit, on the usual outside
//   uv(row, p)                   texture coordinates (lxs 5.3)
//   tangents(row, p)             dp/du, dp/dv
//   sample(row, u, v)            a point of the surface, and 1 / density there per area
//   inverse_density(row, p)      the same 1 / density for a point from elsewhere
//
// all in the shape's own space (scene/primitive_rows.h).

#include "kernels/sampling.h"
#include "kernels/sphere_entry.h"
#include "kernels/surface_axes.h"
#include "kernels/table.h"

namespace yat::YAT_ISA {

template <class A>
using ShapeRowW = ShapeRow<Lanes<A>::template Of>;

/// A ray in a shape's own space; dir is unit.
template <class A>
struct ShapeRay {
  Vec3<A> org, dir;
  YAT_INLINE Vec3<A> at(const Float<A>& t) const {
    return {xsimd::fma(t, dir.x, org.x), xsimd::fma(t, dir.y, org.y), xsimd::fma(t, dir.z, org.z)};
  }
};

template <class A>
struct ShapeSample {
  Vec3<A> p;
  Float<A> inverse_density;
};

/// Of what goes round z, by texture coordinates: dp/du.
template <class A>
YAT_INLINE Vec3<A> along_turn(const ShapeRowW<A>& row, const Vec3<A>& p) {
  const Float<A> turn = Float<A>(kTwoPi) / row.u_scale;
  return {-turn * p.y, turn * p.x, Float<A>(0.f)};
}

/// Lanes where the angle of (x, y) lies between 0 and that of (cos, sin).
template <class A>
YAT_INLINE Mask<A> in_sweep(const Float<A>& x, const Float<A>& y, const Float<A>& cos,
                            const Float<A>& sin) {
  const Float<A> zero(0.f);
  const Mask<A> after = y >= zero, before = cos * y - sin * x <= zero;
  const Mask<A> wide = sin < zero;
  return (wide & (after | before)) | (after & before);
}

/// Of two parameters those above 0 and valid: the smaller, or -1.
template <class A>
YAT_INLINE Float<A> nearer_of(const Float<A>& t0, const Mask<A>& valid0, const Float<A>& t1,
                              const Mask<A>& valid1) {
  const Float<A> none(kLargestFloat);
  const Float<A> t = xsimd::min(select<A>(valid0, t0, none), select<A>(valid1, t1, none));
  return select<A>(t < none, t, Float<A>(-1.f));
}

template <class A>
YAT_INLINE Vec3<A> to_shape(const ShapeRowW<A>& row, const Vec3<A>& v) {
  return {row.o_xx * v.x + row.o_xy * v.y + row.o_xz * v.z,
          row.o_yx * v.x + row.o_yy * v.y + row.o_yz * v.z,
          row.o_zx * v.x + row.o_zy * v.y + row.o_zz * v.z};
}
/// A normal of the shape's own space, not unit in the scene: its length there is by how much more
/// an area grows than a volume, or 1 / how much shorter lengths along it become.
template <class A>
YAT_INLINE Vec3<A> normal_to_scene(const ShapeRowW<A>& row, const Vec3<A>& n) {
  return {row.o_xx * n.x + row.o_yx * n.y + row.o_zx * n.z,
          row.o_xy * n.x + row.o_yy * n.y + row.o_zy * n.z,
          row.o_xz * n.x + row.o_yz * n.y + row.o_zz * n.z};
}
template <class A>
YAT_INLINE Vec3<A> vector_to_scene(const ShapeRowW<A>& row, const Vec3<A>& v) {
  return {row.w_xx * v.x + row.w_xy * v.y + row.w_xz * v.z,
          row.w_yx * v.x + row.w_yy * v.y + row.w_yz * v.z,
          row.w_zx * v.x + row.w_zy * v.y + row.w_zz * v.z};
}
template <class A>
YAT_INLINE Vec3<A> shape_origin(const ShapeRowW<A>& row) {
  return {row.org_x, row.org_y, row.org_z};
}

/// Primitive row of shape row 0.
YAT_INLINE uint32_t first_shape(const GeometryView& geometry) {
  return geometry.triangles.count + geometry.spheres.count + geometry.planes.count;
}

/// How far off along the unit scene normal `ng` a ray must start: 32 roundings of the scene's
/// numbers and 32 of the shape's own, which count scale = 1 / |normal_to_scene(n)| times along the
/// normal (kernels/surface_instance.h has the same rule).
template <class A>
YAT_INLINE Float<A> shape_offset(const ShapeRowW<A>& row, const Vec3<A>& n, const Vec3<A>& ng,
                                 const Float<A>& scale) {
  const Float<A> inner =
      xsimd::abs(n.x) * row.inner_x + xsimd::abs(n.y) * row.inner_y + xsimd::abs(n.z) * row.inner_z;
  return Float<A>(32 * kRounding) * (row.extent * sum_of_magnitudes(ng) + scale * inner);
}

template <class A, ShapeKind kKind>
struct ShapeOf;

}  // namespace yat::YAT_ISA

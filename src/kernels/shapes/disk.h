#pragma once
// The disk z = 0, a <= x^2 + y^2 <= 1, or a sector of it.

#include "kernels/shapes/common.h"

namespace yat::YAT_ISA {

template <class A>
struct ShapeOf<A, ShapeKind::kDisk> {
  static YAT_INLINE Float<A> distance(const ShapeRowW<A>& row, const ShapeRay<A>& ray) {
    const Float<A> t = -ray.org.z / ray.dir.z;
    const Vec3<A> p = ray.at(t);
    const Float<A> squared = p.x * p.x + p.y * p.y;
    const Mask<A> in = (squared >= row.a) & (squared <= Float<A>(1.f)) &
                       in_sweep<A>(p.x, p.y, row.phi_cos, row.phi_sin);
    return select<A>(in, t, Float<A>(-1.f));
  }
  static YAT_INLINE Vec3<A> project(const ShapeRowW<A>&, const Vec3<A>& p) {
    return {p.x, p.y, Float<A>(0.f)};
  }
  static YAT_INLINE Vec3<A> normal(const ShapeRowW<A>&, const Vec3<A>&) {
    const Float<A> zero(0.f);
    return {zero, zero, Float<A>(1.f)};
  }
  static YAT_INLINE Point2<A> uv(const ShapeRowW<A>& row, const Vec3<A>& p) {
    const Float<A> radius = xsimd::sqrt(p.x * p.x + p.y * p.y);
    return {angle_in_turns<A>(p.x, p.y) * row.u_scale, radius * row.v_scale + row.v_offset};
  }
  static YAT_INLINE Tangents<A> tangents(const ShapeRowW<A>& row, const Vec3<A>& p) {
    const Float<A> zero(0.f), radius = xsimd::sqrt(p.x * p.x + p.y * p.y);
    const Float<A> step = select<A>(radius > zero, Float<A>(1.f) / (radius * row.v_scale), zero);
    return {along_turn(row, p), {step * p.x, step * p.y, zero}};
  }
  static YAT_INLINE ShapeSample<A> sample(const ShapeRowW<A>& row, const Float<A>& u,
                                          const Float<A>& v) {
    const SinCos<A> phi = sin_cos_turns<A>(u / row.u_scale);
    const Float<A> radius = xsimd::sqrt(row.a + v * (Float<A>(1.f) - row.a));
    const Vec3<A> p{radius * phi.cos, radius * phi.sin, Float<A>(0.f)};
    return {p, inverse_density(row, p)};
  }
  static YAT_INLINE Float<A> inverse_density(const ShapeRowW<A>& row, const Vec3<A>&) {
    return Float<A>(kPi) * (Float<A>(1.f) - row.a) / row.u_scale;
  }
};

}  // namespace yat::YAT_ISA

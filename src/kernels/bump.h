#pragma once
// Bump and normal maps (lxs 7.6): shading normals bent by what a texture says.

#include "kernels/math.h"
#include "kernels/shade.h"
#include "kernels/table.h"
#include "kernels/vec.h"

namespace yat::YAT_ISA {

/// Two directions along the surface, and how far along each the height is looked up.
template <class A>
struct BumpFrame {
  Vec3<A> normal, du, dv;
  Float<A> step_u, step_v;  ///< in units of du and dv
  Mask<A> mapped;           ///< du and dv are derivatives by texture coordinates
};

template <class A>
YAT_INLINE BumpFrame<A> bump_frame(const Surface<ConstColumn>& surfaces,
                                   const SurfaceDerivatives<ConstColumn>& derivatives,
                                   const ParameterView& view, uint32_t i, const Mask<A>& present) {
  const auto p =
      load_parameters<A, BumpParameters>(view, only<A>(present, load<A>(surfaces.parameter, i)));
  const Float<A> zero(0.f);
  BumpFrame<A> f;
  f.normal = {load<A>(surfaces.ns_x, i), load<A>(surfaces.ns_y, i), load<A>(surfaces.ns_z, i)};
  f.du = {load<A>(derivatives.du_x, i), load<A>(derivatives.du_y, i), load<A>(derivatives.du_z, i)};
  f.dv = {load<A>(derivatives.dv_x, i), load<A>(derivatives.dv_y, i), load<A>(derivatives.dv_z, i)};
  f.mapped = length(cross(f.du, f.dv)) > zero;
  // Without texture coordinates any two directions do: the texture is one of positions.
  const Frame<A> any = Frame<A>::about(f.normal);
  f.du = select(f.mapped, f.du, any.x);
  f.dv = select(f.mapped, f.dv, any.y);
  f.step_u = xsimd::select(f.mapped & (p.step_u > zero), p.step_u, p.distance / length(f.du));
  f.step_v = xsimd::select(f.mapped & (p.step_v > zero), p.step_v, p.distance / length(f.dv));
  return f;
}

/// See KernelTable::move_surfaces.
template <class A>
void move_surfaces(const Surface<ConstColumn>& surfaces,
                   const SurfaceDerivatives<ConstColumn>& derivatives, const ParameterView& bump,
                   uint32_t axis, const Surface<Column>& moved, uint32_t n) noexcept {
  const Float<A> zero(0.f);
  for (uint32_t i = 0; i < n; i += kLanes<A>) {
    const BumpFrame<A> f = bump_frame<A>(surfaces, derivatives, bump, i, tail_mask<A>(i, n));
    const Float<A> step = axis == 0 ? f.step_u : f.step_v;
    const Vec3<A> way = step * (axis == 0 ? f.du : f.dv);
    store<A>(load<A>(surfaces.pos_x, i) + way.x, moved.pos_x, i);
    store<A>(load<A>(surfaces.pos_y, i) + way.y, moved.pos_y, i);
    store<A>(load<A>(surfaces.pos_z, i) + way.z, moved.pos_z, i);
    const Float<A> along = xsimd::select(f.mapped, step, zero);
    store<A>(load<A>(surfaces.u, i) + (axis == 0 ? along : zero), moved.u, i);
    store<A>(load<A>(surfaces.v, i) + (axis == 1 ? along : zero), moved.v, i);
  }
}

/// The new shading normal on the old one's side; the old one where the new is none.
template <class A>
YAT_INLINE void store_normal(const Vec3<A>& bent, const Vec3<A>& old,
                             const Surface<Column>& surfaces, uint32_t i) {
  const Float<A> side = dot(bent, old), zero(0.f);
  const Vec3<A> unit = normalize(select(side < zero, -bent, bent));
  const Vec3<A> n = select(is_finite<A>(sum_of_magnitudes(unit)) & (side != zero), unit, old);
  store<A>(n.x, surfaces.ns_x, i);
  store<A>(n.y, surfaces.ns_y, i);
  store<A>(n.z, surfaces.ns_z, i);
}

/// See KernelTable::bend_normals.
template <class A>
void bend_normals(const Surface<Column>& surfaces,
                  const SurfaceDerivatives<ConstColumn>& derivatives, const ParameterView& bump,
                  const float* height, const float* height_u, const float* height_v,
                  uint32_t n) noexcept {
  const Surface<ConstColumn> in = as_const_columns<Surface>(surfaces);
  for (uint32_t i = 0; i < n; i += kLanes<A>) {
    const BumpFrame<A> f = bump_frame<A>(in, derivatives, bump, i, tail_mask<A>(i, n));
    const Float<A> h = load<A>(height, i);
    const Float<A> by_u = (load<A>(height_u, i) - h) / f.step_u;
    const Float<A> by_v = (load<A>(height_v, i) - h) / f.step_v;
    store_normal<A>(cross(f.du + by_u * f.normal, f.dv + by_v * f.normal), f.normal, surfaces, i);
  }
}

/// See KernelTable::map_normals.
template <class A>
void map_normals(const Surface<Column>& surfaces,
                 const SurfaceDerivatives<ConstColumn>& derivatives, const ParameterView& bump,
                 const float* r, const float* g, const float* b, uint32_t n) noexcept {
  const Surface<ConstColumn> in = as_const_columns<Surface>(surfaces);
  const Float<A> one(1.f), two(2.f);
  for (uint32_t i = 0; i < n; i += kLanes<A>) {
    const BumpFrame<A> f = bump_frame<A>(in, derivatives, bump, i, tail_mask<A>(i, n));
    const Vec3<A> local{two * load<A>(r, i) - one, two * load<A>(g, i) - one,
                        two * load<A>(b, i) - one};
    const Vec3<A> bent = local.x * normalize(f.du) + local.y * normalize(f.dv) + local.z * f.normal;
    store_normal<A>(bent, f.normal, surfaces, i);
  }
}

}  // namespace yat::YAT_ISA

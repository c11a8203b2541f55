#pragma once
// Texture coordinates of the surface (lxs 8.1, "uv"): s = u uscale + udelta, t alike. Out: s, t,
// and where columns 2 and 3 are wanted the width of the footprint along s and t.

#include "kernels/texture.h"

namespace yat {

template <template <class> class Of>
struct MapSurfaceParameters {
  Of<float> s_scale, s_delta, t_scale, t_delta;
  YAT_FIELDS(s_scale, s_delta, t_scale, t_delta)
};
static_assert(all_fields_listed<MapSurfaceParameters>);

inline constexpr TextureTraits kMapSurfaceTraits{.name = "map_surface"};

#if defined(YAT_ISA)
namespace YAT_ISA {

/// Length of the gradient of u on a surface, from dp/du and dp/dv [1 / scene unit].
template <class A>
YAT_INLINE Float<A> gradient(const Vec3<A>& du, const Vec3<A>& dv) {
  // In the surface's plane, at right angles to dv, so that along dp/du it is 1.
  const Float<A> zero(0.f), area = length(cross(du, dv));
  return xsimd::select(area > zero, length(dv) / area, zero);
}

template <class A>
struct MapSurface {
  template <uint32_t kForm>
  static YAT_INLINE void evaluate(const MapSurfaceParameters<Lanes<A>::template Of>& p,
                                  const TextureRow<A>& row) {
    const uint32_t i = row.first;
    row.out(0, load<A>(row.input.surfaces.u, i) * p.s_scale + p.s_delta);
    row.out(1, load<A>(row.input.surfaces.v, i) * p.t_scale + p.t_delta);
    if (!row.wants(2)) return;
    const auto& d = row.input.derivatives;
    const Vec3<A> du{load<A>(d.du_x, i), load<A>(d.du_y, i), load<A>(d.du_z, i)};
    const Vec3<A> dv{load<A>(d.dv_x, i), load<A>(d.dv_y, i), load<A>(d.dv_z, i)};
    row.out(2, row.width() * gradient<A>(du, dv) * xsimd::abs(p.s_scale));
    row.out(3, row.width() * gradient<A>(dv, du) * xsimd::abs(p.t_scale));
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

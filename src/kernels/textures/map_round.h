#pragma once
// Spherical and cylindrical mapping (lxs 8.1). With p = the position in the texture's own space and
// phi, theta its angles about and from z:
//   spherical    s = phi / 2 pi uscale + udelta, t = theta / pi vscale + vdelta
//   cylindrical  s the same, t = 1/2 - z / 2
// Out: s, t, and where columns 2 and 3 are wanted the width of the footprint along s and t.

#if defined(YAT_ISA)
#include "kernels/math.h"
#endif
#include "kernels/texture.h"
namespace yat {

template <template <class> class Of>
struct MapRoundParameters {
  Of<float> m_xx, m_xy, m_xz, x;  ///< scene space to texture space: a row of the map, its offset
  Of<float> m_yx, m_yy, m_yz, y;
  Of<float> m_zx, m_zy, m_zz, z;
  Of<float> s_scale, s_delta, t_scale, t_delta;
  YAT_FIELDS(m_xx, m_xy, m_xz, x, m_yx, m_yy, m_yz, y, m_zx, m_zy, m_zz, z, s_scale, s_delta,
             t_scale, t_delta)
};
static_assert(all_fields_listed<MapRoundParameters>);

inline constexpr TextureTraits kMapRoundTraits{.name = "map_round", .forms = 2};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct MapRound {
  template <uint32_t kForm>  // 0: spherical, 1: cylindrical
  static YAT_INLINE void evaluate(const MapRoundParameters<Lanes<A>::template Of>& p,
                                  const TextureRow<A>& row) {
    const Vec3<A> at = row.position(), rx{p.m_xx, p.m_xy, p.m_xz}, ry{p.m_yx, p.m_yy, p.m_yz},
                  rz{p.m_zx, p.m_zy, p.m_zz};
    const Float<A> x = dot(rx, at) + p.x, y = dot(ry, at) + p.y, z = dot(rz, at) + p.z;
    const Float<A> zero(0.f), half(.5f), ring = xsimd::sqrt(x * x + y * y);
    row.out(0, angle_in_turns<A>(x, y) * p.s_scale + p.s_delta);
    if constexpr (kForm == 0)
      row.out(1, Float<A>(2.f) * angle_in_turns<A>(z, ring) * p.t_scale + p.t_delta);
    else
      row.out(1, half - half * z);
    if (!row.wants(2)) return;
    // One scale for all directions: the length of the map's rows.
    const Float<A> width =
        row.width() * xsimd::sqrt((dot(rx, rx) + dot(ry, ry) + dot(rz, rz)) * Float<A>(1.f / 3));
    const Float<A> per_ring = xsimd::select(ring > zero, Float<A>(1.f / kTwoPi) / ring, zero);
    row.out(2, width * per_ring * xsimd::abs(p.s_scale));
    const Float<A> radius = xsimd::sqrt(x * x + y * y + z * z);
    const Float<A> per_arc = xsimd::select(radius > zero, Float<A>(kInvPi) / radius, zero);
    row.out(3, kForm == 0 ? width * per_arc * xsimd::abs(p.t_scale) : width * half);
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

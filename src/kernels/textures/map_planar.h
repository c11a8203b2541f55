#pragma once
// Planar mapping (lxs 8.1): s = P v1 + udelta, t = P v2 + vdelta. Out: s, t, and where columns 2
// and 3 are wanted the width of the footprint along s and t.

#include "kernels/texture.h"

namespace yat {

template <template <class> class Of>
struct MapPlanarParameters {
  Of<float> s_x, s_y, s_z, s_delta;  ///< s of a scene-space position
  Of<float> t_x, t_y, t_z, t_delta;
  YAT_FIELDS(s_x, s_y, s_z, s_delta, t_x, t_y, t_z, t_delta)
};
static_assert(all_fields_listed<MapPlanarParameters>);

inline constexpr TextureTraits kMapPlanarTraits{.name = "map_planar"};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct MapPlanar {
  template <uint32_t kForm>
  static YAT_INLINE void evaluate(const MapPlanarParameters<Lanes<A>::template Of>& p,
                                  const TextureRow<A>& row) {
    const Vec3<A> at = row.position(), s{p.s_x, p.s_y, p.s_z}, t{p.t_x, p.t_y, p.t_z};
    row.out(0, dot(s, at) + p.s_delta);
    row.out(1, dot(t, at) + p.t_delta);
    if (!row.wants(2)) return;
    row.out(2, row.width() * length(s));
    row.out(3, row.width() * length(t));
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

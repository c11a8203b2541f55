#pragma once
// Three-dimensional coordinates (lxs 8.2): an affine map of the position, of (u, v, 0) or of the
// shading normal. Out: x, y, z.

#include "kernels/texture.h"

namespace yat {

template <template <class> class Of>
struct MapSolidParameters {
  Of<float> m_xx, m_xy, m_xz, x;  ///< row of the map, and its offset
  Of<float> m_yx, m_yy, m_yz, y;
  Of<float> m_zx, m_zy, m_zz, z;
  YAT_FIELDS(m_xx, m_xy, m_xz, x, m_yx, m_yy, m_yz, y, m_zx, m_zy, m_zz, z)
};
static_assert(all_fields_listed<MapSolidParameters>);

inline constexpr TextureTraits kMapSolidTraits{.name = "map_solid", .forms = 3};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct MapSolid {
  template <uint32_t kForm>  // 0: position, 1: texture coordinates, 2: shading normal
  static YAT_INLINE void evaluate(const MapSolidParameters<Lanes<A>::template Of>& p,
                                  const TextureRow<A>& row) {
    const auto& s = row.input.surfaces;
    const uint32_t i = row.first;
    Vec3<A> at;
    if constexpr (kForm == 0)
      at = row.position();
    else if constexpr (kForm == 1)
      at = {load<A>(s.u, i), load<A>(s.v, i), Float<A>(0.f)};
    else
      at = {load<A>(s.ns_x, i), load<A>(s.ns_y, i), load<A>(s.ns_z, i)};
    row.out(0, p.m_xx * at.x + p.m_xy * at.y + p.m_xz * at.z + p.x);
    row.out(1, p.m_yx * at.x + p.m_yy * at.y + p.m_yz * at.z + p.y);
    row.out(2, p.m_zx * at.x + p.m_zy * at.y + p.m_zz * at.z + p.z);
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

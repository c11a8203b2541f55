#pragma once
// An environment as a picture, bilinear between its texels (lxs 6.4), drawn by the map's cells.

#include "kernels/lights/map.h"

namespace yat::YAT_ISA {

template <class A>
struct ImageLight {
  static YAT_INLINE ShadedPick<A> sample(const LightView& lights, const LightRowW<A>& row,
                                         const Mask<A>& of_kind, const Vec3<A>& receiver,
                                         const Float<A>& far, const Float<A>& u,
                                         const Float<A>& v) {
    const LightMapW<A> map = load_map<A>(lights, row, of_kind);
    const CellPick<A> drawn = pick_by_cells<A>(lights, map, of_kind, receiver, far, u, v);
    return {drawn.pick, look_up<A>(lights, map, picture_place<A>(map, drawn.local))};
  }
  static YAT_INLINE SeenEnvironment<A> see(const LightView& lights, const LightRowW<A>& row,
                                           const Mask<A>& of_kind, const Vec3<A>& w, bool asked) {
    const LightMapW<A> map = load_map<A>(lights, row, of_kind);
    const MappedDirection<A> found = to_map<A>(map, w);
    return {look_up<A>(lights, map, picture_place<A>(map, found.unit)),
            asked ? pdf_by_cells<A>(lights, map, found) : Float<A>(0.f)};
  }
};

}  // namespace yat::YAT_ISA

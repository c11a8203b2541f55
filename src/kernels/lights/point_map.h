#pragma once
// A point whose intensity a map says: a goniometric picture or an IES profile, divided by its mean
// over the sphere (lxs 6.3).

#include "kernels/lights/map.h"

namespace yat::YAT_ISA {

template <class A>
struct PointMapLight {
  static YAT_INLINE ShadedPick<A> sample(const LightView& lights, const LightRowW<A>& row,
                                         const Mask<A>& of_kind, const Vec3<A>& receiver,
                                         const Float<A>&, const Float<A>&, const Float<A>&) {
    ShadedPick<A> pick{pick_point<A>(light_a<A>(row), receiver), {}};
    const LightMapW<A> map = load_map<A>(lights, row, of_kind);
    pick.shade = look_up<A>(lights, map, picture_place<A>(map, to_map<A>(map, -pick.wi).unit));
    return pick;
  }
};

}  // namespace yat::YAT_ISA

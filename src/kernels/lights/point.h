#pragma once
// A point that shines equally in all directions; LightRow says how it falls off.

#include "kernels/light.h"

namespace yat::YAT_ISA {

template <class A>
struct PointLight {
  static YAT_INLINE LightPick<A> sample(const LightRowW<A>& row, const Vec3<A>& receiver,
                                        const Float<A>&, const Float<A>&, const Float<A>&) {
    LightPick<A> pick = pick_point<A>(light_a<A>(row), receiver);
    const Vec3<A> way = pick.to - receiver;
    const Float<A> squared = dot(way, way);
    pick.measure =
        only<A>(squared > Float<A>(0.f), Float<A>(1.f) / xsimd::fma(row.b_x, squared, row.b_y));
    return pick;
  }
};

}  // namespace yat::YAT_ISA

#pragma once
// A point that shines equally in all directions. radiance holds its intensity [W/sr].

#include "kernels/light.h"

namespace yat::YAT_ISA {

template <class A>
struct PointLight {
  static YAT_INLINE LightPick<A> sample(const LightRowW<A>& row, const Vec3<A>& receiver,
                                        const Float<A>&, const Float<A>&, const Float<A>&) {
    const Float<A> zero(0.f), one(1.f);
    LightPick<A> pick;
    pick.to = light_a<A>(row);
    const Vec3<A> way = pick.to - receiver;
    const Float<A> squared = dot(way, way);
    pick.wi = (one / xsimd::sqrt(squared)) * way;
    pick.measure = only<A>(squared > zero, one / squared);
    pick.pdf = zero;
    return pick;
  }
};

}  // namespace yat::YAT_ISA

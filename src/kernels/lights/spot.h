#pragma once
// A point that shines into a cone, full inside and falling off towards its rim (lxs 6.3).

#include "kernels/light.h"

namespace yat::YAT_ISA {

template <class A>
struct SpotLight {
  static YAT_INLINE ShadedPick<A> sample(const LightView&, const LightRowW<A>& row, const Mask<A>&,
                                         const Vec3<A>& receiver, const Float<A>&, const Float<A>&,
                                         const Float<A>&) {
    const Vec3<A> axis{row.b_x, row.b_y, row.b_z};
    ShadedPick<A> pick{pick_point<A>(light_a<A>(row), receiver), {}};
    const Float<A> above = -dot(axis, pick.wi) - row.extra;
    const Float<A> zero(0.f), one(1.f);
    const Float<A> step = xsimd::min(xsimd::max(above * row.c_x, zero), one);
    const Float<A> squared = step * step;
    pick.shade.r = pick.shade.g = pick.shade.b = squared * squared;
    return pick;
  }
};

}  // namespace yat::YAT_ISA

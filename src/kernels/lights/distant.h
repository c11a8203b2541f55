#pragma once
// Light from one direction, or from a disc about it. No ray can hit it: it is seen by light
// sampling alone, so that its density does not enter MIS.

#include "kernels/light.h"

namespace yat::YAT_ISA {

template <class A>
struct DistantLight {
  /// far  how far away [m] from the receiver the shadow ray ends: beyond the scene.
  static YAT_INLINE LightPick<A> sample(const LightRowW<A>& row, const Vec3<A>& receiver,
                                        const Float<A>& far, const Float<A>& u, const Float<A>& v) {
    const Float<A> one(1.f), zero(0.f);
    const Vec3<A> axis = light_a<A>(row);
    // Exact for the cosines that matter (Sterbenz): the row's radiance must be made for this value.
    const Float<A> measure = one - row.extra;
    const Mask<A> disc = measure > zero;
    LightPick<A> pick;
    pick.wi = axis;
    pick.measure = one;
    if (any<A>(disc)) {
      const Vec3<A> w = Frame<A>::about(axis).to_scene(square_to_cone<A>(measure, u, v));
      pick.wi = select(disc, w, axis);
      pick.measure = xsimd::select(disc, Float<A>(kTwoPi) * measure, one);
    }
    pick.to = receiver + far * pick.wi;
    pick.pdf = zero;
    return pick;
  }
};

}  // namespace yat::YAT_ISA

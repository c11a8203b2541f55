#pragma once
// The same light from all directions. Drawn over the whole sphere: which half a receiver sees,
// light sampling may not ask, because the other side of multiple importance sampling, which finds
// the light long after, no longer knows the receiver's normal.

#include "kernels/light.h"

namespace yat::YAT_ISA {

template <class A>
struct ConstantLight {
  static YAT_INLINE ShadedPick<A> sample(const LightView&, const LightRowW<A>&, const Mask<A>&,
                                         const Vec3<A>& receiver, const Float<A>& far,
                                         const Float<A>& u, const Float<A>& v) {
    ShadedPick<A> pick;
    pick.wi = square_to_sphere<A>(u, v);
    pick.to = receiver + far * pick.wi;
    pick.measure = Float<A>(2 * kTwoPi);
    pick.pdf = Float<A>(.5f / kTwoPi);
    return pick;
  }
  static YAT_INLINE SeenEnvironment<A> see(const LightView&, const LightRowW<A>&, const Mask<A>&,
                                           const Vec3<A>&, bool) {
    const Float<A> one(1.f);
    return {{one, one, one}, Float<A>(.5f / kTwoPi)};
  }
};

}  // namespace yat::YAT_ISA

#pragma once
// A point that shines equally in all directions. radiance holds its intensity [W/sr].

#include "kernels/light.h"

namespace yat::YAT_ISA {

template <class A>
struct PointLight {
  static YAT_INLINE LightPick<A> sample(const LightRowW<A>& row, const Vec3<A>& receiver,
                                        const Float<A>&, const Float<A>&, const Float<A>&) {
    return pick_point<A>(light_a<A>(row), receiver);
  }
};

}  // namespace yat::YAT_ISA

#pragma once
// A disc infinitely far away, evenly bright: drawn within its cone, and seen there by rays.

#include "kernels/light.h"

namespace yat::YAT_ISA {

template <class A>
struct SunLight {
  static YAT_INLINE ShadedPick<A> sample(const LightView&, const LightRowW<A>& row, const Mask<A>&,
                                         const Vec3<A>& receiver, const Float<A>& far,
                                         const Float<A>& u, const Float<A>& v) {
    ShadedPick<A> pick;
    pick.wi = Frame<A>::about(light_a<A>(row)).to_scene(square_to_cone<A>(row.extra, u, v));
    pick.to = receiver + far * pick.wi;
    pick.measure = Float<A>(kTwoPi) * row.extra;
    pick.pdf = cone_pdf<A>(row.extra);
    return pick;
  }
  /// Inside by the chord, |w - axis|^2 = 2 (1 - cos): the cosine itself has not the digits to tell
  /// where a disc of a quarter of a degree ends.
  static YAT_INLINE SeenEnvironment<A> see(const LightView&, const LightRowW<A>& row,
                                           const Mask<A>&, const Vec3<A>& w, bool) {
    const Vec3<A> chord = w - light_a<A>(row);
    const Float<A> inside = only<A>(dot(chord, chord) <= Float<A>(2.f) * row.extra, Float<A>(1.f));
    return {{inside, inside, inside}, cone_pdf<A>(row.extra)};
  }
};

}  // namespace yat::YAT_ISA

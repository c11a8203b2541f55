#pragma once
// A slide projector at a point, along +z of light space (lxs 6.3). s grows with x, t with y.

#include "kernels/lights/map.h"

namespace yat::YAT_ISA {

template <class A>
struct ProjectionLight {
  static YAT_INLINE ShadedPick<A> sample(const LightView& lights, const LightRowW<A>& row,
                                         const Mask<A>& of_kind, const Vec3<A>& receiver,
                                         const Float<A>&, const Float<A>&, const Float<A>&) {
    const Float<A> zero(0.f), half(.5f), one(1.f);
    ShadedPick<A> pick{pick_point<A>(light_a<A>(row), receiver), {}};
    const LightMapW<A> map = load_map<A>(lights, row, of_kind);
    const Vec3<A> l = to_map<A>(map, -pick.wi).unit;
    const Float<A> x = l.x / l.z, y = l.y / l.z;
    const Mask<A> inside = (l.z > zero) & (xsimd::abs(x) <= row.b_x) & (xsimd::abs(y) <= row.b_y);
    TexelPlace<A> place;
    place.x = (half + half * x / row.b_x) * to_number<A>(map.width) - half;
    place.y = (half + half * y / row.b_y) * to_number<A>(map.height) - half;
    place.around = zero > one;
    const ColourTriple<Float<A>> slide = look_up<A>(lights, map, place);
    const Float<A> z2 = l.z * l.z, scale = only<A>(inside, row.extra / (z2 * z2));
    pick.shade = {scale * slide.r, scale * slide.g, scale * slide.b};
    return pick;
  }
};

}  // namespace yat::YAT_ISA

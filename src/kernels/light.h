#pragma once
// What every light kind gives: a point for a receiver, and for kinds that can be hit, the density
// with which sample() would have chosen the hit.
//
//   template <class A> struct NAMELight {
//     static LightPick<A> sample(row, receiver, far, u, v);
//     static Float<A> pdf(row, receiver, seen);   // kinds with a surface only
//   };
//
// Kinds beyond the first kPlainLightKinds look into the scene's tables and may shine in a colour
// that varies; `of_kind` says which lanes hold such a row (the others may hold anything):
//
//   template <class A> struct NAMELight {
//     static ShadedPick<A> sample(lights, row, of_kind, receiver, far, u, v);
//     static SeenEnvironment<A> see(lights, row, of_kind, direction, asked);  // environments only
//   };
//
// Densities are per solid angle at the receiver, without the choice of the light.

#include "kernels/sampling.h"
#include "kernels/table.h"
#include "kernels/vec.h"

namespace yat::YAT_ISA {

template <class A>
using LightRowW = LightRow<Lanes<A>::template Of>;

template <class A>
struct LightPick {
  Vec3<A> wi;        ///< unit, towards the light
  Vec3<A> to;        ///< end of the shadow ray
  Float<A> measure;  ///< what to multiply the row's radiance by: 1/pdf where there is one; 0: none
  Float<A> pdf;      ///< solid angle; 0 where a ray cannot hit the light
};

/// A pick whose light is the row's radiance times `shade`.
template <class A>
struct ShadedPick : LightPick<A> {
  ColourTriple<Float<A>> shade{Float<A>(1.f), Float<A>(1.f), Float<A>(1.f)};
};

/// What an environment shows in a direction, and the density with which sample() chooses that.
template <class A>
struct SeenEnvironment {
  ColourTriple<Float<A>> shade;
  Float<A> pdf;
};

/// A point of a light as a path hit it.
template <class A>
struct SeenLight {
  Float<A> distance;  ///< from the receiver [m]
  Float<A> cos;       ///< at the light, > 0
};

template <class A>
YAT_INLINE Vec3<A> light_a(const LightRowW<A>& row) {
  return {row.a_x, row.a_y, row.a_z};
}

/// Towards `position` [m], and the inverse square of how far it is; measure 0 at the point itself.
template <class A>
YAT_INLINE LightPick<A> pick_point(const Vec3<A>& position, const Vec3<A>& receiver) {
  const Float<A> zero(0.f), one(1.f);
  LightPick<A> pick;
  pick.to = position;
  const Vec3<A> way = position - receiver;
  const Float<A> squared = dot(way, way);
  pick.wi = (one / xsimd::sqrt(squared)) * way;
  pick.measure = only<A>(squared > zero, one / squared);
  pick.pdf = zero;
  return pick;
}

}  // namespace yat::YAT_ISA

#pragma once
// What every light kind gives: a point for a receiver, and for kinds that can be hit, the density
// with which sample() would have chosen the hit.
//
//   template <class A> struct NAMELight {
//     static LightPick<A> sample(row, receiver, far, u, v);
//     static Float<A> pdf(row, receiver, seen);   // kinds with a surface only
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

}  // namespace yat::YAT_ISA

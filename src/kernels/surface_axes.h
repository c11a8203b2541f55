#pragma once
// dp/du and dp/dv of spheres and planes, from where on them a point is.

#include "kernels/math.h"
#include "kernels/table.h"
#include "kernels/vec.h"

namespace yat::YAT_ISA {

template <class A>
struct Tangents {
  Vec3<A> du, dv;  ///< dp/du, dp/dv [scene units]; 0 where there are none
};

/// u is the angle around the sphere's own z, v the one from its south pole, both from 0 to 1
/// (lxs 5.3). At a pole both are 0.
template <class A>
YAT_INLINE Tangents<A> sphere_tangents(const Rows<SphereRow>& spheres, const UInt<A>& row,
                                       const Vec3<A>& pos) {
  const SphereRow<Lanes<A>::template Of> s = gather<A>(spheres, row);
  const Vec3<A> z{s.z_x, s.z_y, s.z_z};
  const Vec3<A> out = pos - Vec3<A>{s.center_x, s.center_y, s.center_z};
  const Vec3<A> round = cross(z, out);
  const Float<A> height = dot(z, out), ring = length(round), zero(0.f);
  const Float<A> inverse = select<A>(ring > zero, Float<A>(1.f) / ring, zero);
  // Towards the north pole, as long as the radius.
  const Vec3<A> up = (ring + height * height * inverse) * z - (height * inverse) * out;
  return {(s.hand * Float<A>(kTwoPi)) * round, Float<A>(kPi) * up};
}

/// What u and v of a plane grow along.
template <class A>
YAT_INLINE Tangents<A> plane_tangents(const Rows<PlaneRow>& planes, const UInt<A>& row) {
  const PlaneRow<Lanes<A>::template Of> p = gather<A>(planes, row);
  const Vec3<A> n{p.normal_x, p.normal_y, p.normal_z};
  const Vec3<A> u{p.u_x, p.u_y, p.u_z}, v{p.v_x, p.v_y, p.v_z};
  const Vec3<A> du = cross(v, n), dv = cross(n, u);
  return {(Float<A>(1.f) / dot(u, du)) * du, (Float<A>(1.f) / dot(v, dv)) * dv};
}

}  // namespace yat::YAT_ISA

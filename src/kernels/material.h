#pragma once
// What a material is to the kernels. A header of materials/ declares, for NAME:
//
//   NAMEParameters<Of>, kNAMETraits                        everywhere (compile and plan read them)
//   template <class A> struct NAME {                       where YAT_ISA is defined
//     static Float<A>-triple evaluate(parameters, view, wi)   f, without the cosine
//     static Float<A> pdf(parameters, view, wi)               per solid angle
//     static BsdfSample<A> sample(parameters, view, u_lobe, u, v)
//   };
//
// Frame. wo and wi are unit, local, away from the surface. z is the shading normal turned to the
// side of wo, so wo.z >= 0 always; `outside` tells which side that is. Where the shading normal
// puts wo below its horizon, the frame is about the geometric normal instead (KernelTable::shade):
// the shape looks as it is there, and no material has to know of the case.
//
// Delta materials (mirror, glass) have f = 0 and pdf = 0 for every pair; sample() gives weight and
// direction.

#include "scene/registry.h"

#if defined(YAT_ISA)
#include "kernels/sampling.h"
#include "kernels/vec.h"

namespace yat::YAT_ISA {

template <class A>
struct Spectrum {
  Float<A> r, g, b;
};
template <class A>
YAT_INLINE Spectrum<A> operator*(const Float<A>& s, const Spectrum<A>& c) {
  return {s * c.r, s * c.g, s * c.b};
}
template <class A>
YAT_INLINE Spectrum<A> operator*(const Spectrum<A>& a, const Spectrum<A>& b) {
  return {a.r * b.r, a.g * b.g, a.b * b.b};
}
template <class A>
YAT_INLINE Spectrum<A> operator+(const Spectrum<A>& a, const Spectrum<A>& b) {
  return {a.r + b.r, a.g + b.g, a.b + b.b};
}
template <class A>
YAT_INLINE Float<A> largest(const Spectrum<A>& c) {
  return xsimd::max(xsimd::max(c.r, c.g), c.b);
}
template <class A>
YAT_INLINE Spectrum<A> only(const Mask<A>& m, const Spectrum<A>& c) {
  return {only<A>(m, c.r), only<A>(m, c.g), only<A>(m, c.b)};
}
template <class A>
YAT_INLINE Spectrum<A> select(const Mask<A>& m, const Spectrum<A>& a, const Spectrum<A>& b) {
  return {xsimd::select(m, a.r, b.r), xsimd::select(m, a.g, b.g), xsimd::select(m, a.b, b.b)};
}

/// Where a surface is seen from.
template <class A>
struct BsdfView {
  Vec3<A> wo;       ///< local, wo.z >= 0
  Mask<A> outside;  ///< wo is on the shape's outside
  /// From where the light on its way to wo arrives at a surface, scattered or not, or the camera:
  /// the way through what is on wo's side [m].
  Float<A> distance;
};

template <class A>
struct BsdfSample {
  Vec3<A> wi;          ///< local, unit; z < 0: through the surface
  Spectrum<A> weight;  ///< f |cos| / pdf; 0 where nothing was chosen
  Float<A> pdf;        ///< solid angle; 0 for delta lobes
};

/// f and pdf of a material that scatters into single directions only.
template <class A>
struct Delta {
  template <class Parameters>
  static YAT_INLINE Spectrum<A> evaluate(const Parameters&, const BsdfView<A>&, const Vec3<A>&) {
    const Float<A> zero(0.f);
    return {zero, zero, zero};
  }
  template <class Parameters>
  static YAT_INLINE Float<A> pdf(const Parameters&, const BsdfView<A>&, const Vec3<A>&) {
    return Float<A>(0.f);
  }
};

}  // namespace yat::YAT_ISA
#endif

#pragma once
// Lambert reflection on both sides: f = Kd / pi.

#include "kernels/material.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct MatteParameters {
  Of<float> kd_r, kd_g, kd_b;  ///< reflectance, 0..1
  YAT_FIELDS(kd_r, kd_g, kd_b)
};
static_assert(all_fields_listed<MatteParameters>);

inline constexpr TexturedField kMatteTextured[] = {textured_colour<MatteParameters>("Kd", "kd_r")};
inline constexpr MaterialTraits kMatteTraits{.name = "matte",
                                             .delta = false,
                                             .see_through = false,
                                             .needs_lobe = false,
                                             .needs_direction = true,
                                             .textured = kMatteTextured};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct Matte {
  using Parameters = MatteParameters<Lanes<A>::template Of>;

  static YAT_INLINE Spectrum<A> evaluate(const Parameters& p, const BsdfView<A>&,
                                         const Vec3<A>& wi) {
    return only<A>(wi.z > Float<A>(0.f), Float<A>(kInvPi) * Spectrum<A>{p.kd_r, p.kd_g, p.kd_b});
  }
  static YAT_INLINE Float<A> pdf(const Parameters&, const BsdfView<A>&, const Vec3<A>& wi) {
    return cosine_hemisphere_pdf<A>(wi.z);
  }
  static YAT_INLINE BsdfSample<A> sample(const Parameters& p, const BsdfView<A>&, const Float<A>&,
                                         const Float<A>& u, const Float<A>& v) {
    BsdfSample<A> s;
    s.wi = square_to_cosine_hemisphere<A>(u, v);
    s.pdf = cosine_hemisphere_pdf<A>(s.wi.z);
    // A direction in the horizon has no density, and 0 means a delta lobe elsewhere.
    s.weight = only<A>(s.pdf > Float<A>(0.f), Spectrum<A>{p.kd_r, p.kd_g, p.kd_b});
    return s;
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

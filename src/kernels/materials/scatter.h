#pragma once
// LuxRender's scatter (lxs 7.2): a surface that scatters as a volume does, over the whole sphere,
// without a cosine: f |cos_i| = Kd p(theta), theta the angle by which light is turned, p the phase
// function of Schlick (Blasi, Le Saec, Schlick, "A Rendering Algorithm for Discrete Volume Density
// Objects", 1993) that stands for Henyey and Greenstein's of asymmetry g (lxs 7.5):
//   p = (1 - k^2) / (4 pi (1 - k cos theta)^2), k = g (1.55 - .55 g^2).
// Its albedo is Kd from everywhere; f cos_i is reciprocal, as phase functions are, and f is not.

#include "kernels/material.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct ScatterParameters {
  Of<float> kd_r, kd_g, kd_b;  ///< 0..1
  Of<float> g;                 ///< mean cosine of the deviation, -1..1
  YAT_FIELDS(kd_r, kd_g, kd_b, g)
};
static_assert(all_fields_listed<ScatterParameters>);

inline constexpr TexturedField kScatterTextured[] = {
    textured_colour<ScatterParameters>("Kd", "kd_r")};
inline constexpr MaterialTraits kScatterTraits{.name = "scatter",
                                               .delta = false,
                                               .see_through = false,
                                               .needs_lobe = false,
                                               .needs_direction = true,
                                               .all_around = true,
                                               .textured = kScatterTextured};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct Scatter {
  using Parameters = ScatterParameters<Lanes<A>::template Of>;

  /// Schlick's k, kept from where p is a single direction.
  static YAT_INLINE Float<A> asymmetry(const Parameters& p) {
    const Float<A> limit(.999f);
    const Float<A> g = xsimd::min(xsimd::max(p.g, -limit), limit);
    return g * (Float<A>(1.55f) - Float<A>(.55f) * g * g);
  }

  static YAT_INLINE Float<A> pdf(const Parameters& p, const BsdfView<A>& view, const Vec3<A>& wi) {
    const Float<A> one(1.f), k = asymmetry(p);
    const Float<A> rest = one + k * dot(view.wo, wi);
    return Float<A>(kInvPi / 4) * (one - k * k) / (rest * rest);
  }
  static YAT_INLINE Spectrum<A> evaluate(const Parameters& p, const BsdfView<A>& view,
                                         const Vec3<A>& wi) {
    const Float<A> f = pdf(p, view, wi) / xsimd::abs(wi.z);
    return only<A>(wi.z != Float<A>(0.f), f * Spectrum<A>{p.kd_r, p.kd_g, p.kd_b});
  }
  /// The distribution of cos theta inverted; 1 - cos theta is what stays exact ahead.
  static YAT_INLINE BsdfSample<A> sample(const Parameters& p, const BsdfView<A>& view,
                                         const Float<A>&, const Float<A>& u, const Float<A>& v) {
    const Float<A> zero(0.f), one(1.f), two(2.f), k = asymmetry(p);
    const Float<A> turn = two * (one - k) * (one - u) / (one - k + two * k * u);
    const Float<A> sin = xsimd::sqrt(xsimd::max(turn * (two - turn), zero));
    const SinCos<A> phi = sin_cos_turns<A>(v);
    const Frame<A> ahead = Frame<A>::about(-view.wo);
    BsdfSample<A> s;
    s.wi = normalize(ahead.to_scene({sin * phi.cos, sin * phi.sin, one - turn}));
    s.pdf = pdf(p, view, s.wi);
    s.weight = only<A>(s.wi.z != zero, Spectrum<A>{p.kd_r, p.kd_g, p.kd_b});
    return s;
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

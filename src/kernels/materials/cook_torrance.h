#pragma once
// A metal after Cook, Torrance, "A Reflectance Model for Computer Graphics", 1982: YART's metal2,
// normalised so that it conserves energy.
//   f = F D G / (4 cos_o cos_i), D Beckmann's with slope m, F Schlick's, G of V-cavities:
//   G = min(1, 2 cos_h cos_o / o.h, 2 cos_h cos_i / o.h)
// Sampled by visible normals: of two facets that face each other in a cavity, the one that is seen
// (Heitz, d'Eon, "Importance Sampling Microfacet-Based BSDFs using the Distribution of Visible
// Normals", 2014).
//
// Energy compensation: what facets throw onto others is lost in f. It is added back as a lobe that
// brings (1 - E(o)) (1 - E(i)) / (pi (1 - E_avg)) times what is left of its colour after all
// bounces (Kulla, Conty, "Revisiting Physically Based Shading at Imageworks", 2017). E(c) is the
// albedo for F = 1; 1 - E is a polynomial in c and m, of our own fit, that nowhere takes more than
// what is lost: what comes out for F = 1 is between .93 (m = .05, edge-on) and 1, without
// compensation .45.

#if defined(YAT_ISA)
#include "kernels/exponential.h"
#endif
#include "kernels/materials/fresnel.h"
#include "kernels/materials/microfacet.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct CookTorranceParameters {
  Of<float> kr_r, kr_g, kr_b;  ///< reflectance head-on, 0..1
  Of<float> roughness;         ///< root mean square slope m of the facets, 0..1
  YAT_FIELDS(kr_r, kr_g, kr_b, roughness)
};
static_assert(all_fields_listed<CookTorranceParameters>);
template <template <class> class Of>
struct CookTorranceSingleParameters : CookTorranceParameters<Of> {};
static_assert(all_fields_listed<CookTorranceSingleParameters>);

inline constexpr TexturedField kCookTorranceTextured[] = {
    textured_colour<CookTorranceParameters>("fresnel", "kr_r"),
    textured_number<CookTorranceParameters>("uroughness", "roughness", 0, 1)};
inline constexpr MaterialTraits kCookTorranceTraits{.name = "cook_torrance",
                                                    .delta = false,
                                                    .see_through = false,
                                                    .needs_lobe = true,
                                                    .needs_direction = true,
                                                    .textured = kCookTorranceTextured};
inline constexpr MaterialTraits kCookTorranceSingleTraits = [] {
  MaterialTraits traits = kCookTorranceTraits;
  traits.name = "cook_torrance_single";
  return traits;
}();

/// 1 - E(c) = max(0, c * sum of [i][j] c^i m^j - kCookTorranceMargin), and 1 - E_avg = sum of [j]
/// m^j, no less than twice the integral of (1 - E(c)) c.
inline constexpr float kCookTorranceLoss[6][5] = {
    {0.22318f, 6.22385f, -32.40952f, 48.79265f, -22.90447f},
    {-4.89197f, 15.42211f, 38.89207f, -106.02394f, 60.63159f},
    {20.21534f, -183.97147f, 440.74020f, -482.86534f, 191.07138f},
    {-34.07894f, 412.05236f, -1285.41085f, 1695.72124f, -761.38609f},
    {26.04676f, -369.40973f, 1276.12167f, -1786.59193f, 831.46280f},
    {-7.51171f, 119.58296f, -438.36660f, 633.99666f, -300.84630f}};
inline constexpr float kCookTorranceAverageLoss[6] = {0.00143f, -0.02805f, 0.41031f,
                                                      0.50218f, -0.92904f, 0.37199f};
inline constexpr float kCookTorranceMargin = .002f;

#if defined(YAT_ISA)
namespace YAT_ISA {

/// 1 - E of the model at one roughness: c times a polynomial in the cosine c.
template <class A>
struct CookTorranceLoss {
  Float<A> coefficient[6];
  Float<A> average;  ///< at least 2 * the integral of loss(c) c over 0..1

  static YAT_INLINE CookTorranceLoss of(const Float<A>& m) {
    CookTorranceLoss loss;
    for (int i = 0; i < 6; ++i) {
      Float<A> sum(kCookTorranceLoss[i][4]);
      for (int j = 3; j >= 0; --j) sum = sum * m + Float<A>(kCookTorranceLoss[i][j]);
      loss.coefficient[i] = sum;
    }
    loss.average = Float<A>(kCookTorranceAverageLoss[5]);
    for (int j = 4; j >= 0; --j)
      loss.average = loss.average * m + Float<A>(kCookTorranceAverageLoss[j]);
    return loss;
  }
  /// c in 0..1.
  YAT_INLINE Float<A> at(const Float<A>& c) const {
    Float<A> sum = coefficient[5];
    for (int i = 4; i >= 0; --i) sum = sum * c + coefficient[i];
    return xsimd::max(sum * c - Float<A>(kCookTorranceMargin), Float<A>(0.f));
  }
};

/// Both materials: with compensation or without.
template <class A, class P, bool kCompensated>
struct CookTorranceModel {
  using Parameters = P;

  static YAT_INLINE Spectrum<A> fresnel(const P& p, const Float<A>& cos) {
    return {fresnel_schlick<A>(p.kr_r, cos), fresnel_schlick<A>(p.kr_g, cos),
            fresnel_schlick<A>(p.kr_b, cos)};
  }

  struct Facets {
    Float<A> m;
    Mask<A> smooth;  ///< acts as a mirror
    static YAT_INLINE Facets of(const P& p) {
      const Float<A> least(kMirrorRoughness);
      return {xsimd::min(xsimd::max(p.roughness, least), Float<A>(1.f)), p.roughness < least};
    }
    YAT_INLINE Float<A> distribution(const Vec3<A>& h) const {
      const Float<A> m2 = m * m, c2 = xsimd::max(h.z * h.z, Float<A>(1e-12f));
      const Float<A> tan2 = (h.x * h.x + h.y * h.y) / c2;
      return exponential<A>(-tan2 / m2) / (Float<A>(kPi) * m2 * c2 * c2);
    }
    /// Half the facets of each cavity may be hidden from o: masking over cos_o.
    static YAT_INLINE Float<A> masking_per_cos(const Vec3<A>& h, const Float<A>& o_h,
                                               const Float<A>& cos_o) {
      const Float<A> lit = h.z + h.z;
      return xsimd::select(lit * cos_o < o_h, lit / o_h, Float<A>(1.f) / cos_o);
    }
    YAT_INLINE Float<A> pdf(const Vec3<A>& wo, const Vec3<A>& h, const Float<A>& o_h) const {
      return Float<A>(.25f) * distribution(h) * masking_per_cos(h, o_h, wo.z);
    }
  };

  /// The lobe that makes up for the loss.
  struct Compensation {
    CookTorranceLoss<A> loss;
    Spectrum<A> colour;  ///< of what is added
    Float<A> lost_o;     ///< 1 - E(o)
    Float<A> chance;     ///< of choosing it, by what each lobe brings
    static YAT_INLINE Compensation of(const P& p, const Float<A>& m, const Float<A>& cos_o) {
      const Float<A> one(1.f), zero(0.f);
      Compensation c;
      c.loss = CookTorranceLoss<A>::of(m);
      c.lost_o = c.loss.at(cos_o);
      const auto band = [&](const Float<A>& kr) {
        // The mean of Schlick's reflectance over the hemisphere, once and after all bounces.
        const Float<A> mean = kr + (one - kr) * Float<A>(1 / 21.f);
        return mean * mean * (one - c.loss.average) / (one - mean * c.loss.average);
      };
      c.colour = {band(p.kr_r), band(p.kr_g), band(p.kr_b)};
      const Float<A> added = c.lost_o * largest(c.colour);
      const Float<A> single = (one - c.lost_o) * largest(fresnel(p, cos_o));
      const Float<A> total = added + single;
      c.chance = xsimd::select(total == zero, total, added / total);
      return c;
    }
    YAT_INLINE Float<A> factor(const Float<A>& cos_i) const {
      return Float<A>(kInvPi) * lost_o * loss.at(cos_i) / loss.average;
    }
  };

  /// f and pdf are made of the same parts.
  static YAT_INLINE Spectrum<A> evaluate(const P& p, const BsdfView<A>& view, const Vec3<A>& wi) {
    const Float<A> zero(0.f);
    const Facets facets = Facets::of(p);
    const Vec3<A> h = MicrofacetLobe<A>::half_vector(view.wo, wi);
    // Of a zero without a sign, by which f is divided.
    const Float<A> cos_o = xsimd::abs(view.wo.z);
    const Float<A> o_h = dot(view.wo, h), lit = h.z + h.z;
    const Float<A> shadowed = xsimd::min(Float<A>(1.f) / (cos_o * xsimd::abs(wi.z)),
                                         xsimd::min(lit / (o_h * wi.z), lit / (o_h * cos_o)));
    Spectrum<A> f = (Float<A>(.25f) * facets.distribution(h) * shadowed) * fresnel(p, o_h);
    if constexpr (kCompensated) {
      const Compensation more = Compensation::of(p, facets.m, view.wo.z);
      f = f + more.factor(wi.z) * more.colour;
    }
    return only<A>((wi.z > zero) & !facets.smooth, f);
  }
  static YAT_INLINE Float<A> pdf(const P& p, const BsdfView<A>& view, const Vec3<A>& wi) {
    const Facets facets = Facets::of(p);
    const Vec3<A> h = MicrofacetLobe<A>::half_vector(view.wo, wi);
    Float<A> density = facets.pdf(view.wo, h, dot(view.wo, h));
    if constexpr (kCompensated) {
      const Compensation more = Compensation::of(p, facets.m, view.wo.z);
      density = density + more.chance * (cosine_hemisphere_pdf<A>(wi.z) - density);
    }
    return only<A>((wi.z > Float<A>(0.f)) & !facets.smooth, density);
  }

  static YAT_INLINE BsdfSample<A> sample(const P& p, const BsdfView<A>& view,
                                         const Float<A>& u_lobe, const Float<A>& u,
                                         const Float<A>& v) {
    const Float<A> zero(0.f), one(1.f);
    const Facets facets = Facets::of(p);
    const Vec3<A>& wo = view.wo;
    Float<A> side = u_lobe;
    Mask<A> diffuse(false);
    Compensation more;
    if constexpr (kCompensated) {
      more = Compensation::of(p, facets.m, wo.z);
      diffuse = u_lobe < more.chance;
      side = (u_lobe - more.chance) / (one - more.chance);
    }
    // A facet by Beckmann's distribution, then it or the one that faces it.
    const Float<A> tan2 = -facets.m * facets.m * natural_logarithm<A>(one - u);
    const Float<A> cos_h = one / xsimd::sqrt(one + tan2), sin_h = xsimd::sqrt(tan2) * cos_h;
    const SinCos<A> phi = sin_cos_turns<A>(v);
    Vec3<A> h{sin_h * phi.cos, sin_h * phi.sin, cos_h};
    const Float<A> along = wo.x * h.x + wo.y * h.y, up = wo.z * h.z;
    const Float<A> seen = xsimd::max(up + along, zero), faced = xsimd::max(up - along, zero);
    const Mask<A> other = side * (seen + faced) >= seen;
    h = {xsimd::select(other, -h.x, h.x), xsimd::select(other, -h.y, h.y), h.z};
    const Float<A> o_h = xsimd::select(other, faced, seen);
    BsdfSample<A> s;
    s.wi = (o_h + o_h) * h - wo;
    s.pdf = facets.pdf(wo, h, o_h);
    // G over masking of wo alone; F.
    const Float<A> lit = h.z + h.z, masked = xsimd::min(o_h, lit * xsimd::abs(wo.z));
    const Float<A> shadowed = xsimd::min(one, lit * s.wi.z / masked);
    s.weight = shadowed * fresnel(p, o_h);
    if constexpr (kCompensated) {
      // One sample of the sum of both lobes: what the other brings there counts too.
      s.wi = select(diffuse, square_to_cosine_hemisphere<A>(u, v), s.wi);
      s.pdf = pdf(p, view, s.wi);
      s.weight = (xsimd::max(s.wi.z, zero) / s.pdf) * evaluate(p, view, s.wi);
    }
    const Mask<A> above = (s.wi.z > zero) & ((o_h > zero) | diffuse) & (s.pdf > zero);
    s.weight = only<A>(above, s.weight);
    s.pdf = only<A>(above, s.pdf);
    s.wi = select(facets.smooth, Vec3<A>{-wo.x, -wo.y, wo.z}, s.wi);
    s.weight = select(facets.smooth, fresnel(p, wo.z), s.weight);
    s.pdf = only<A>(!facets.smooth, s.pdf);
    return s;
  }
};

template <class A>
struct CookTorrance : CookTorranceModel<A, CookTorranceParameters<Lanes<A>::template Of>, true> {};
template <class A>
struct CookTorranceSingle
    : CookTorranceModel<A, CookTorranceSingleParameters<Lanes<A>::template Of>, false> {};

}  // namespace YAT_ISA
#endif

}  // namespace yat

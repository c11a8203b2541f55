#pragma once
// LuxRender's microfacet lobe, as most of its rough materials have it (lxs 7.1). With u, v the
// roughnesses along the local x and y axes, r = u v, o and i the directions to eye and light:
//   f = R F(o.h) D(h) G(o) G(i) / (4 cos_o cos_i),
//   D(h) = A r / (pi (1 + (r - 1) cos_h^2)^2),    G(c) = c / (c (1 - r) + r),
//   A = sqrt(p / (p^2 + w^2 (1 - p^2))),  p = min(u, v)^2 / max(u, v)^2,
//   w = part along the smoother axis of h's tangential direction.
// For u = v D is GGX (Walter et al. 2007) with alpha = u. G is Schlick's rational form (1994) with
// r for its k: it shadows less than D's facets do, so that a smooth lobe seen at a grazing angle
// reflects more than it receives, up to 1 / (2 sqrt(r)) times; and a rough one loses much (3/4 at
// u = v = 1). Both are the look that scenes were made for.
//
// Sampling: visible normals of the GGX with alpha_x = u, alpha_y = v, of which D differs in the
// share that A gives to azimuths only: their quotient is 1 where u = v, and at most max(u, v) /
// min(u, v). Sources: Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 7(4), 2018;
// Dupuy, Benyoub, "Sampling Visible GGX Normals with Spherical Caps", 2023 (transmission needs all
// of them); Eto, Tokuyoshi, "Bounded VNDF Sampling for Smith-GGX Reflections", 2023 (reflection:
// fewer directions below the horizon).

#include "kernels/material.h"

namespace yat {

/// Roughness below this acts as a mirror: the cone that it scatters into is a tenth of a pixel of
/// most pictures, and single precision has no better half vectors.
inline constexpr float kMirrorRoughness = 2.5e-4f;

#if defined(YAT_ISA)
namespace YAT_ISA {

/// The lobe without R and F. A use in a material:
///   evaluate: h = half_vector(wo, wi); f = F(dot(wo, h)) * lobe.evaluate(wo, wi, h)
///   pdf:      lobe.pdf(wo, h), where wi is above the surface
///   sample:   s = lobe.sample(wo, u, v); weight = F(s.cos_h) * s.weight
/// Rows that are `smooth` have f = 0 and pdf = 0, and sample() gives the mirror direction with
/// weight 1 and pdf 0.
template <class A>
struct MicrofacetLobe {
  Float<A> x, y;   ///< roughness along the axes, kMirrorRoughness..1
  Mask<A> smooth;  ///< acts as a mirror

  /// Roughnesses may be any numbers: they are brought to 0..1.
  static YAT_INLINE MicrofacetLobe of(const Float<A>& uroughness, const Float<A>& vroughness) {
    const Float<A> least(kMirrorRoughness), one(1.f);
    MicrofacetLobe lobe;
    lobe.smooth = (uroughness < least) & (vroughness < least);
    lobe.x = xsimd::min(xsimd::max(uroughness, least), one);
    lobe.y = xsimd::min(xsimd::max(vroughness, least), one);
    return lobe;
  }

  struct Sample {
    Vec3<A> wi;       ///< unit
    Vec3<A> h;        ///< unit, h.z >= 0
    Float<A> cos_h;   ///< dot(wo, h), >= 0
    Float<A> weight;  ///< f cos / pdf without R and F; 0 below the horizon
    Float<A> pdf;     ///< solid angle of wi; 0 below the horizon, and for smooth rows
  };

  /// The normal of the facet that reflects wi to wo, both above the surface.
  static YAT_INLINE Vec3<A> half_vector(const Vec3<A>& wo, const Vec3<A>& wi) {
    return normalize(wo + wi);
  }

  /// D G(o) G(i) / (4 cos_o cos_i); 0 unless wi is above the surface.
  YAT_INLINE Float<A> evaluate(const Vec3<A>& wo, const Vec3<A>& wi, const Vec3<A>& h) const {
    const Float<A> f = Float<A>(.25f) * sampled_distribution(h) * quotient(h) *
                       shadowing_per_cos(wo.z) * shadowing_per_cos(wi.z);
    return only<A>((wi.z > Float<A>(0.f)) & !smooth, f);
  }
  /// Density of sample() for the direction that h reflects wo to, if that is above the surface.
  YAT_INLINE Float<A> pdf(const Vec3<A>& wo, const Vec3<A>& h) const {
    return only<A>(!smooth, sampled_distribution(h) * pdf_per_distribution(wo));
  }

  YAT_INLINE Sample sample(const Vec3<A>& wo, const Float<A>& u, const Float<A>& v) const {
    const Float<A> zero(0.f), one(1.f);
    // The cap of directions that the facets reflect to the upper side, cut off by the bound.
    const Vec3<A> std = normalize(Vec3<A>{x * wo.x, y * wo.y, wo.z});
    const Float<A> k = bound(wo);
    Sample s;
    s.h = normal_of_cap(std, k * std.z, (one - k) * std.z, u, v);
    s.cos_h = xsimd::max(dot(wo, s.h), zero);
    s.wi = (s.cos_h + s.cos_h) * s.h - wo;
    const Mask<A> above = s.wi.z > zero;
    const Float<A> per_distribution = pdf_per_distribution(wo);
    s.pdf = only<A>(above & !smooth, sampled_distribution(s.h) * per_distribution);
    // f cos_i / pdf with what is in both left out.
    s.weight = only<A>(above, Float<A>(.25f) * quotient(s.h) * shadowing_per_cos(wo.z) *
                                  shadowing(s.wi.z) / per_distribution);
    s.wi = select(smooth, Vec3<A>{-wo.x, -wo.y, wo.z}, s.wi);
    s.h = select(smooth, Vec3<A>{zero, zero, one}, s.h);
    s.cos_h = xsimd::select(smooth, wo.z, s.cos_h);
    s.weight = xsimd::select(smooth, one, s.weight);
    return s;
  }

  // -- For materials that transmit ----------------------------------------------------------------

  /// A facet that wo sees. Its density, per solid angle of h, is
  /// visible_distribution(wo, h) * dot(wo, h).
  YAT_INLINE Vec3<A> visible_normal(const Vec3<A>& wo, const Float<A>& u, const Float<A>& v) const {
    const Vec3<A> std = normalize(Vec3<A>{x * wo.x, y * wo.y, wo.z});
    return normal_of_cap(std, std.z, Float<A>(0.f), u, v);
  }
  /// D of GGX times its Smith masking of wo, over cos_o.
  YAT_INLINE Float<A> visible_distribution(const Vec3<A>& wo, const Vec3<A>& h) const {
    return sampled_distribution(h) * Float<A>(2.f) / (wo.z + stretched_length(wo));
  }
  /// D(h) of the lobe.
  YAT_INLINE Float<A> distribution(const Vec3<A>& h) const {
    return sampled_distribution(h) * quotient(h);
  }
  /// G(c), c >= 0.
  YAT_INLINE Float<A> shadowing(const Float<A>& c) const { return c * shadowing_per_cos(c); }
  /// G(c) / c, c >= 0: finite at 0.
  YAT_INLINE Float<A> shadowing_per_cos(const Float<A>& c) const {
    const Float<A> r = x * y;
    return Float<A>(1.f) / (c * (Float<A>(1.f) - r) + r);
  }
  /// D over that of the GGX which is sampled.
  YAT_INLINE Float<A> quotient(const Vec3<A>& h) const {
    const Float<A> one(1.f), r = x * y, x2 = x * x, y2 = y * y, hx2 = h.x * h.x, hy2 = h.y * h.y;
    const Float<A> s2 = hx2 + hy2, h2 = h.z * h.z;
    const Float<A> p = xsimd::min(x2, y2) / xsimd::max(x2, y2), p2 = p * p;
    const Float<A> along = xsimd::select(x < y, hx2, hy2);
    const Float<A> share = p * s2 / (p2 * s2 + along * (one - p2));
    const Float<A> ratio = (h2 + hx2 / x2 + hy2 / y2) / (h2 + s2 / r);
    return xsimd::select((x == y) | (s2 <= Float<A>(0.f)), one, xsimd::sqrt(share) * ratio * ratio);
  }

 private:
  /// D of GGX with alpha_x = x, alpha_y = y.
  YAT_INLINE Float<A> sampled_distribution(const Vec3<A>& h) const {
    const Float<A> a = h.x / x, b = h.y / y, q = a * a + b * b + h.z * h.z;
    return Float<A>(kInvPi) / (x * y * q * q);
  }
  /// |(x wo.x, y wo.y, wo.z)|.
  YAT_INLINE Float<A> stretched_length(const Vec3<A>& wo) const {
    const Float<A> a = x * wo.x, b = y * wo.y;
    return xsimd::sqrt(a * a + b * b + wo.z * wo.z);
  }
  /// Eto, Tokuyoshi 2023, eq. 5: how much of the cap's lower end is left away, 0..1.
  YAT_INLINE Float<A> bound(const Vec3<A>& wo) const {
    const Float<A> one(1.f), a = xsimd::min(x, y), a2 = a * a;
    const Float<A> s = one + xsimd::sqrt(wo.x * wo.x + wo.y * wo.y), s2 = s * s;
    return (one - a2) * s2 / (s2 + a2 * wo.z * wo.z);
  }
  /// pdf of sample() over D.
  YAT_INLINE Float<A> pdf_per_distribution(const Vec3<A>& wo) const {
    return Float<A>(.5f) / (bound(wo) * wo.z + stretched_length(wo));
  }
  /// The facet normal for a point of the spherical cap z > -lower about the stretched wo, `std`.
  /// rest = std.z - lower.
  YAT_INLINE Vec3<A> normal_of_cap(const Vec3<A>& std, const Float<A>& lower, const Float<A>& rest,
                                   const Float<A>& u, const Float<A>& v) const {
    const Float<A> one(1.f), zero(0.f);
    const Float<A> height = one + lower, below_top = v * height;  // 1 - z, which stays exact
    const Float<A> sin = xsimd::sqrt(xsimd::max(below_top * (one + one - below_top), zero));
    const SinCos<A> phi = sin_cos_turns<A>(u);
    return normalize(Vec3<A>{x * (sin * phi.cos + std.x), y * (sin * phi.sin + std.y),
                             (one - v) * height + rest});
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

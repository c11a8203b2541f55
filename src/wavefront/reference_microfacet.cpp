// Metals and rough glass of the oracle (lxs 7.1 to 7.3; Walter et al. 2007; Cook, Torrance 1982).

#include <algorithm>
#include <cmath>
#include <glm/exponential.hpp>
#include <numbers>

#include "wavefront/reference_materials.h"

namespace yat::reference {

namespace {

constexpr double kPi = std::numbers::pi;

// ---- Fresnel

double conductor(double n, double k, double c) {
  const double q = n * n + k * k;
  return ((q * c * c - 2 * n * c + 1) / (q * c * c + 2 * n * c + 1) +
          (q - 2 * n * c + c * c) / (q + 2 * n * c + c * c)) /
         2;
}

double general(double n, double k, double c) {
  const double sin2 = 1 - c * c, a = 2 * k * k * sin2 / (n * n);
  const double rest = std::fmax(1 - sin2 / (n * n), 0);
  const double t2 = (rest + std::sqrt(rest * rest + a * a)) / 2, b = 2 * n * c * std::sqrt(t2);
  const double q = n * n + k * k;
  if (t2 + c * c == 0) return 1;
  const double p = (q * c * c - b + t2) / (q * c * c + b + t2);
  const double s = (q * t2 - b + c * c) / (q * t2 + b + c * c);
  return std::clamp((p + s) / 2, 0.0, 1.0);
}

double of_colour(double colour, double c) {
  const double r = std::clamp(colour, 0.0, double(.999f)), root = std::sqrt(r);
  return general((1 + root) / (1 - root), 2 * std::sqrt(r / (1 - r)), c);
}
Vec of_colour(const Vec& colour, double c) {
  return {of_colour(colour.x, c), of_colour(colour.y, c), of_colour(colour.z, c)};
}

Vec fresnel(const MetalParameters<Value>& p, double c) {
  return {conductor(double(p.n_r), double(p.k_r), c), conductor(double(p.n_g), double(p.k_g), c),
          conductor(double(p.n_b), double(p.k_b), c)};
}
Vec fresnel(const MetalIndexParameters<Value>& p, double c) {
  return {general(double(p.n_r), double(p.k_r), c), general(double(p.n_g), double(p.k_g), c),
          general(double(p.n_b), double(p.k_b), c)};
}
Vec fresnel(const MetalColourParameters<Value>& p, double c) {
  return of_colour(Vec(p.kr_r, p.kr_g, p.kr_b), c);
}
template <class Parameters>
Vec schlick(const Parameters& p, double c) {
  const Vec r0(p.kr_r, p.kr_g, p.kr_b);
  return r0 + (1. - r0) * std::pow(std::fmax(1 - c, 0), 5);
}

/// In amplitudes; cos_i = 0: total.
double dielectric(double cos_o, double cos_i, double n_o, double n_i) {
  if (!(cos_i > 0) || !(cos_o > 0)) return 1;
  const double s = (n_o * cos_o - n_i * cos_i) / (n_o * cos_o + n_i * cos_i);
  const double p = (n_i * cos_o - n_o * cos_i) / (n_i * cos_o + n_o * cos_i);
  return (s * s + p * p) / 2;
}

// ---- The lobe of lxs 7.1

struct Lobe {
  double u, v;
  bool smooth;  ///< acts as a mirror

  Lobe(float uroughness, float vroughness, float least = kMirrorRoughness)
      : u(double(std::clamp(uroughness, least, 1.f))),
        v(double(std::clamp(vroughness, least, 1.f))),
        smooth(least <= kMirrorRoughness && uroughness < least && vroughness < least) {}

  double distribution(const Vec& h) const {
    const double r = u * v, across = std::hypot(h.x, h.y),
                 ratio = std::fmin(u, v) / std::fmax(u, v);
    double share = 1;
    if (u != v && across > 0) {
      const double p = ratio * ratio, w = (u < v ? h.x : h.y) / across;
      share = std::sqrt(p / (p * p + w * w * (1 - p * p)));
    }
    const double rest = across * across + r * h.z * h.z;
    return share * r / (kPi * rest * rest);
  }
  double shadowing(double c) const { return c / (c * (1 - u * v) + u * v); }
  /// f without R F; wi above the surface.
  double value(const Vec& wo, const Vec& wi, const Vec& h) const {
    return distribution(h) * shadowing(wo.z) * shadowing(wi.z) / (4 * wo.z * wi.z);
  }

  // What is sampled: visible normals of GGX (Heitz 2018), within Eto and Tokuyoshi's bound.
  double ggx(const Vec& h) const {
    const double q = h.x * h.x / (u * u) + h.y * h.y / (v * v) + h.z * h.z;
    return 1 / (kPi * u * v * q * q);
  }
  double stretched(const Vec& wo) const {
    return std::sqrt(u * u * wo.x * wo.x + v * v * wo.y * wo.y + wo.z * wo.z);
  }
  double bound(const Vec& wo) const {
    const double a2 = std::pow(std::fmin(u, v), 2), s = 1 + std::hypot(wo.x, wo.y);
    return (1 - a2) * s * s / (s * s + a2 * wo.z * wo.z);
  }
  double pdf(const Vec& wo, const Vec& h) const {
    return ggx(h) / (2 * (bound(wo) * wo.z + stretched(wo)));
  }
  Vec normal(const Vec& wo, double lower_share, double x, double y) const {
    const Vec top = glm::normalize(Vec(u * wo.x, v * wo.y, wo.z));
    const double lower = lower_share * top.z, z = 1 - y * (1 + lower);
    const double sin = std::sqrt(std::fmax(1 - z * z, 0)), phi = 2 * kPi * x;
    return glm::normalize(
        Vec(u * (sin * std::cos(phi) + top.x), v * (sin * std::sin(phi) + top.y), z + top.z));
  }
  Vec reflecting_normal(const Vec& wo, double x, double y) const {
    return normal(wo, bound(wo), x, y);
  }
  Vec visible_normal(const Vec& wo, double x, double y) const { return normal(wo, 1, x, y); }
  /// Density of visible_normal over o.h.
  double visible(const Vec& wo, const Vec& h) const { return ggx(h) * 2 / (wo.z + stretched(wo)); }
};

Vec reflected(const Vec& wo, const Vec& h) {
  return 2 * glm::dot(wo, h) * h - wo;
}

template <class Parameters>
Vec evaluate_metal(const Parameters& p, const LocalView& view, const Vec& wi) {
  const Lobe lobe(p.uroughness, p.vroughness);
  if (wi.z <= 0 || lobe.smooth) return Vec(0.0);
  const Vec h = glm::normalize(view.wo + wi);
  return lobe.value(view.wo, wi, h) * fresnel(p, glm::dot(view.wo, h));
}
template <class Parameters>
double pdf_metal(const Parameters& p, const LocalView& view, const Vec& wi) {
  const Lobe lobe(p.uroughness, p.vroughness);
  return wi.z > 0 && !lobe.smooth ? lobe.pdf(view.wo, glm::normalize(view.wo + wi)) : 0;
}
template <class Parameters>
Bounce sample_metal(const Parameters& p, const LocalView& view, double u, double v) {
  const Lobe lobe(p.uroughness, p.vroughness);
  if (lobe.smooth) return {mirrored(view.wo), fresnel(p, view.wo.z), 0};
  const Vec wi = reflected(view.wo, lobe.reflecting_normal(view.wo, u, v));
  const double density = pdf_metal(p, view, wi);
  if (!(density > 0)) return {wi, Vec(0.0), 0};
  return {wi, evaluate_metal(p, view, wi) * (wi.z / density), density};
}

}  // namespace

#define YAT_METAL(Type)                                                                    \
  Vec evaluate(const Type##Parameters<Value>& p, const LocalView& view, const Vec& wi) {   \
    return evaluate_metal(p, view, wi);                                                    \
  }                                                                                        \
  double pdf(const Type##Parameters<Value>& p, const LocalView& view, const Vec& wi) {     \
    return pdf_metal(p, view, wi);                                                         \
  }                                                                                        \
  Bounce sample(const Type##Parameters<Value>& p, const LocalView& view, double, double u, \
                double v) {                                                                \
    return sample_metal(p, view, u, v);                                                    \
  }
YAT_METAL(Metal)
YAT_METAL(MetalIndex)
YAT_METAL(MetalColour)
#undef YAT_METAL

// ---- Thin films

namespace {

Vec film_factor(float thickness, float index, double cos) {
  Vec c;
  for (int band = 0; band < 3; ++band)
    c[band] = std::cos(4 * kPi * double(thickness) / double(kBandWavelengths[band]) *
                       std::sqrt(double(index) * double(index) - (1 - cos * cos)));
  return c * c;
}

}  // namespace

Bounce sample(const MirrorFilmParameters<Value>& p, const LocalView& view, double, double, double) {
  return {mirrored(view.wo),
          film_factor(p.film, p.filmindex, view.wo.z) * Vec(p.kr_r, p.kr_g, p.kr_b), 0};
}

Bounce sample(const GlassFilmParameters<Value>& p, const LocalView& view, double lobe, double u,
              double v) {
  const Vec tint = film_factor(p.film, p.filmindex, view.wo.z);
  return sample(GlassParameters<Value>{p.kr_r * float(tint.x), p.kr_g * float(tint.y),
                                       p.kr_b * float(tint.z), p.kt_r, p.kt_g, p.kt_b, p.index},
                view, lobe, u, v);
}

Bounce sample(const AbsorbingGlassParameters<Value>& p, const LocalView& view, double lobe,
              double u, double v) {
  Bounce bounce =
      sample(GlassParameters<Value>{p.kr_r, p.kr_g, p.kr_b, p.kt_r, p.kt_g, p.kt_b, p.index}, view,
             lobe, u, v);
  if (!view.outside)
    bounce.weight *= glm::exp(-view.distance * Vec(p.sigma_r, p.sigma_g, p.sigma_b));
  return bounce;
}

namespace {

double pane_fresnel(const ArchitecturalGlassParameters<Value>& p, double cos) {
  const double n = double(p.index), sin2 = (1 - cos * cos) / (n * n);
  return dielectric(cos, std::sqrt(std::fmax(1 - sin2, 0)), 1, n);
}

}  // namespace

Vec transmittance(const ArchitecturalGlassParameters<Value>& p, double cos, bool outside) {
  const double f = pane_fresnel(p, cos);
  return (outside ? 1 : 1 - f * (1 + (1 - f) * (1 - f))) * Vec(p.kt_r, p.kt_g, p.kt_b);
}

Bounce sample(const ArchitecturalGlassParameters<Value>& p, const LocalView& view, double lobe,
              double, double) {
  const Vec& wo = view.wo;
  const double f = pane_fresnel(p, wo.z);
  const Vec reflection =
      view.outside ? f * film_factor(p.film, p.filmindex, wo.z) * Vec(p.kr_r, p.kr_g, p.kr_b)
                   : Vec(0.0);
  const Vec through = transmittance(p, wo.z, view.outside);
  const double total = largest(reflection) + largest(through);
  if (total == 0) return {-wo, Vec(0.0), 0};
  const double chance = largest(reflection) / total;
  if (lobe < chance) return {mirrored(wo), reflection / chance, 0};
  return {-wo, through / (1 - chance), 0};
}

// ---- shinymetal

namespace {

struct Shiny {
  Vec mirror;
  double chance = 0;
  Shiny(const ShinyMetalParameters<Value>& p, double cos)
      : mirror(film_factor(p.film, p.filmindex, cos) *
               of_colour(Vec(p.kr_r, p.kr_g, p.kr_b), cos)) {
    const double total = largest(mirror) + largest(of_colour(Vec(p.ks_r, p.ks_g, p.ks_b), cos));
    if (total > 0) chance = largest(mirror) / total;
  }
};
MetalColourParameters<Value> rough_part(const ShinyMetalParameters<Value>& p) {
  return {p.ks_r, p.ks_g, p.ks_b, p.uroughness, p.vroughness};
}

}  // namespace

Vec evaluate(const ShinyMetalParameters<Value>& p, const LocalView& view, const Vec& wi) {
  return evaluate(rough_part(p), view, wi);
}
double pdf(const ShinyMetalParameters<Value>& p, const LocalView& view, const Vec& wi) {
  return (1 - Shiny(p, view.wo.z).chance) * pdf(rough_part(p), view, wi);
}
Bounce sample(const ShinyMetalParameters<Value>& p, const LocalView& view, double lobe, double u,
              double v) {
  const Shiny parts(p, view.wo.z);
  if (lobe < parts.chance) return {mirrored(view.wo), parts.mirror / parts.chance, 0};
  Bounce bounce = sample(rough_part(p), view, lobe, u, v);
  bounce.weight /= 1 - parts.chance;
  bounce.pdf *= 1 - parts.chance;
  return bounce;
}

// ---- Rough glass

namespace {

/// A facet of rough glass that wo meets at cos_o.
struct GlassFacet {
  double n_o, n_i, cos_i;
  Vec reflected, refracted;
  double chance = 0;
  GlassFacet(const RoughGlassParameters<Value>& p, const LocalView& view, double cos_o)
      : n_o(view.outside ? 1 : double(p.index)), n_i(view.outside ? double(p.index) : 1) {
    const double sin2 = n_o * n_o / (n_i * n_i) * (1 - cos_o * cos_o);
    cos_i = std::sqrt(std::fmax(1 - sin2, 0));
    const double f = dielectric(cos_o, cos_i, n_o, n_i);
    reflected = f * Vec(p.kr_r, p.kr_g, p.kr_b);
    refracted = (1 - f) * Vec(p.kt_r, p.kt_g, p.kt_b);
    const double total = largest(reflected) + largest(refracted);
    if (total > 0) chance = largest(reflected) / total;
  }
};
struct GlassValue {
  Vec f{0.0};
  double pdf = 0;
};
GlassValue glass_value(const RoughGlassParameters<Value>& p, const LocalView& view, const Vec& wi) {
  if (wi.z == 0) return {};
  const Lobe lobe(p.uroughness, p.vroughness, kLeastGlassRoughness);
  const double n_o = view.outside ? 1 : double(p.index), n_i = view.outside ? double(p.index) : 1;
  const Vec sum = wi.z > 0 ? view.wo + wi : (n_o / n_i) * view.wo + wi;
  Vec h = glm::normalize(sum);
  if (h.z < 0) h = -h;
  const double o_h = glm::dot(view.wo, h), i_h = glm::dot(wi, h);
  if (o_h <= 0 || (wi.z < 0 && i_h >= 0)) return {};
  const GlassFacet facet(p, view, o_h);
  const double per_facet = wi.z > 0 ? .25 : o_h * std::fabs(i_h) / glm::dot(sum, sum);
  const double common = lobe.distribution(h) * lobe.shadowing(view.wo.z) *
                        lobe.shadowing(std::fabs(wi.z)) / (view.wo.z * std::fabs(wi.z)) * per_facet;
  const double density = lobe.visible(view.wo, h) * per_facet;
  if (wi.z > 0) return {facet.reflected * common, density * facet.chance};
  return {facet.refracted * (common * n_o * n_o / (n_i * n_i)), density * (1 - facet.chance)};
}

}  // namespace

Vec evaluate(const RoughGlassParameters<Value>& p, const LocalView& view, const Vec& wi) {
  return glass_value(p, view, wi).f;
}
double pdf(const RoughGlassParameters<Value>& p, const LocalView& view, const Vec& wi) {
  return glass_value(p, view, wi).pdf;
}
Bounce sample(const RoughGlassParameters<Value>& p, const LocalView& view, double lobe, double u,
              double v) {
  const Vec& wo = view.wo;
  const Vec h = Lobe(p.uroughness, p.vroughness, kLeastGlassRoughness).visible_normal(wo, u, v);
  const GlassFacet facet(p, view, std::fmax(glm::dot(wo, h), 0));
  const double eta = facet.n_o / facet.n_i;
  const bool reflects = lobe < facet.chance;
  const Vec wi = reflects ? reflected(wo, h) : (eta * glm::dot(wo, h) - facet.cos_i) * h - eta * wo;
  const GlassValue value = glass_value(p, view, wi);
  if (!(value.pdf > 0) || (wi.z > 0) != reflects) return {wi, Vec(0.0), 0};
  return {wi, value.f * (std::fabs(wi.z) / value.pdf), value.pdf};
}

// ---- Cook-Torrance

namespace {

struct Cavities {
  double m;
  bool smooth;
  explicit Cavities(float roughness)
      : m(double(std::clamp(roughness, kMirrorRoughness, 1.f))),
        smooth(roughness < kMirrorRoughness) {}
  double distribution(const Vec& h) const {
    const double tan2 = (h.x * h.x + h.y * h.y) / (h.z * h.z);
    return std::exp(-tan2 / (m * m)) / (kPi * m * m * std::pow(h.z, 4));
  }
  double pdf(const Vec& wo, const Vec& h) const {
    const double masking = std::fmin(1, 2 * h.z * wo.z / glm::dot(wo, h));
    return distribution(h) * masking / (4 * wo.z);
  }
  double value(const Vec& wo, const Vec& wi, const Vec& h) const {
    const double o_h = glm::dot(wo, h);
    const double g = std::fmin(1, std::fmin(2 * h.z * wo.z / o_h, 2 * h.z * wi.z / o_h));
    return distribution(h) * g / (4 * wo.z * wi.z);
  }
  /// The facet that wo sees of two that face each other.
  Vec normal(const Vec& wo, double side, double u, double v) const {
    const double tan2 = -m * m * std::log1p(-u), phi = 2 * kPi * v;
    const double z = 1 / std::sqrt(1 + tan2), sin = std::sqrt(tan2) * z;
    const Vec h(sin * std::cos(phi), sin * std::sin(phi), z), other(-h.x, -h.y, h.z);
    const double seen = std::fmax(glm::dot(wo, h), 0), faced = std::fmax(glm::dot(wo, other), 0);
    return side * (seen + faced) >= seen ? other : h;
  }
};

double polynomial(const float* coefficients, int count, double x) {
  double sum = 0;
  for (int i = count - 1; i >= 0; --i) sum = sum * x + double(coefficients[i]);
  return sum;
}

/// Kulla, Conty 2017.
struct Added {
  double m, average, chance = 0;
  Vec colour;
  Added(const CookTorranceParameters<Value>& p, double roughness, double cos_o)
      : m(roughness), average(polynomial(kCookTorranceAverageLoss, 6, m)) {
    const Vec kr(p.kr_r, p.kr_g, p.kr_b), mean = kr + (1. - kr) / 21.;
    colour = mean * mean * (1 - average) / (1. - mean * average);
    const double lost = loss(cos_o), added = lost * largest(colour);
    const double total = added + (1 - lost) * largest(schlick(p, cos_o));
    if (total > 0) chance = added / total;
  }
  double loss(double c) const {
    float in_c[6];
    for (int i = 0; i < 6; ++i) in_c[i] = float(polynomial(kCookTorranceLoss[i], 5, m));
    return std::fmax(c * polynomial(in_c, 6, c) - double(kCookTorranceMargin), 0);
  }
  Vec value(double cos_o, double cos_i) const {
    return colour * (loss(cos_o) * loss(cos_i) / (kPi * average));
  }
};

}  // namespace

Vec evaluate(const CookTorranceSingleParameters<Value>& p, const LocalView& view, const Vec& wi) {
  const Cavities facets(p.roughness);
  if (wi.z <= 0 || facets.smooth) return Vec(0.0);
  const Vec h = glm::normalize(view.wo + wi);
  return facets.value(view.wo, wi, h) * schlick(p, glm::dot(view.wo, h));
}
double pdf(const CookTorranceSingleParameters<Value>& p, const LocalView& view, const Vec& wi) {
  const Cavities facets(p.roughness);
  return wi.z > 0 && !facets.smooth ? facets.pdf(view.wo, glm::normalize(view.wo + wi)) : 0;
}
Bounce sample(const CookTorranceSingleParameters<Value>& p, const LocalView& view, double lobe,
              double u, double v) {
  const Cavities facets(p.roughness);
  if (facets.smooth) return {mirrored(view.wo), schlick(p, view.wo.z), 0};
  const Vec wi = reflected(view.wo, facets.normal(view.wo, lobe, u, v));
  const double density = pdf(p, view, wi);
  if (!(density > 0)) return {wi, Vec(0.0), 0};
  return {wi, evaluate(p, view, wi) * (wi.z / density), density};
}

namespace {

CookTorranceSingleParameters<Value> single(const CookTorranceParameters<Value>& p) {
  return {p.kr_r, p.kr_g, p.kr_b, p.roughness};
}

}  // namespace

Vec evaluate(const CookTorranceParameters<Value>& p, const LocalView& view, const Vec& wi) {
  const Cavities facets(p.roughness);
  if (wi.z <= 0 || facets.smooth) return Vec(0.0);
  return evaluate(single(p), view, wi) + Added(p, facets.m, view.wo.z).value(view.wo.z, wi.z);
}
double pdf(const CookTorranceParameters<Value>& p, const LocalView& view, const Vec& wi) {
  const Cavities facets(p.roughness);
  if (wi.z <= 0 || facets.smooth) return 0;
  const double chance = Added(p, facets.m, view.wo.z).chance;
  return chance * wi.z / kPi + (1 - chance) * pdf(single(p), view, wi);
}
Bounce sample(const CookTorranceParameters<Value>& p, const LocalView& view, double lobe, double u,
              double v) {
  const Cavities facets(p.roughness);
  if (facets.smooth) return {mirrored(view.wo), schlick(p, view.wo.z), 0};
  const double chance = Added(p, facets.m, view.wo.z).chance;
  const Vec wi =
      lobe < chance
          ? cosine_hemisphere(u, v)
          : reflected(view.wo, facets.normal(view.wo, (lobe - chance) / (1 - chance), u, v));
  const double density = pdf(p, view, wi);
  if (!(density > 0)) return {wi, Vec(0.0), 0};
  return {wi, evaluate(p, view, wi) * (wi.z / density), density};
}

// ---- For materials of which it is a part

double lobe_value(double u, double v, const Vec& wo, const Vec& wi) {
  return Lobe(float(u), float(v)).value(wo, wi, glm::normalize(wo + wi));
}
double lobe_distribution(double u, double v, const Vec& h) {
  return Lobe(float(u), float(v)).distribution(h);
}
double lobe_shadowing(double u, double v, double cos) {
  return Lobe(float(u), float(v)).shadowing(cos);
}
double lobe_pdf(double u, double v, const Vec& wo, const Vec& wi) {
  return Lobe(float(u), float(v)).pdf(wo, glm::normalize(wo + wi));
}
Vec lobe_direction(double u, double v, const Vec& wo, double x, double y) {
  return reflected(wo, Lobe(float(u), float(v)).reflecting_normal(wo, x, y));
}

}  // namespace yat::reference

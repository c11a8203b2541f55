#pragma once
// Cases of metals and rough glass, with their formulas as in lxs 7.1 to 7.3.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "kernels/materials/all.h"
#include "material_case.h"

namespace yat {

// ---- Fresnel ---------------------------------------------------------------------------------

/// Of the text book, by angles. n_o, n_i: indices on the ray's and on the other side.
inline double dielectric_reflectance(double cos_o, double n_o, double n_i) {
  const double sin_i = n_o / n_i * std::sqrt(1 - cos_o * cos_o);
  if (sin_i >= 1) return 1;
  const double cos_i = std::sqrt(1 - sin_i * sin_i);
  const double s = (n_o * cos_o - n_i * cos_i) / (n_o * cos_o + n_i * cos_i);
  const double p = (n_i * cos_o - n_o * cos_i) / (n_i * cos_o + n_o * cos_i);
  return (s * s + p * p) / 2;
}
inline double conductor_reflectance(double n, double k, double c) {
  const double q = n * n + k * k;
  const double p = (q * c * c - 2 * n * c + 1) / (q * c * c + 2 * n * c + 1);
  const double s = (q - 2 * n * c + c * c) / (q + 2 * n * c + c * c);
  return (p + s) / 2;
}
inline double general_reflectance(double n, double k, double c) {
  const double sin2 = 1 - c * c, a = 2 * k * k * sin2 / (n * n);
  const double rest = std::max(1 - sin2 / (n * n), 0.);
  const double t2 = (rest + std::sqrt(rest * rest + a * a)) / 2, t = std::sqrt(t2);
  const double q = n * n + k * k;
  const double p = (q * c * c - 2 * n * c * t + t2) / (q * c * c + 2 * n * c * t + t2);
  const double s = (q * t2 - 2 * n * c * t + c * c) / (q * t2 + 2 * n * c * t + c * c);
  return (p + s) / 2;
}
inline glm::dvec3 colour_reflectance(const glm::dvec3& colour, double cos) {
  glm::dvec3 f;
  for (int band = 0; band < 3; ++band) {
    const double r = std::min(colour[band], .999), root = std::sqrt(r);
    f[band] = general_reflectance((1 + root) / (1 - root), 2 * std::sqrt(r / (1 - r)), cos);
  }
  return f;
}
inline glm::dvec3 film_colour(double thickness, double index, double cos) {
  glm::dvec3 c;
  for (int band = 0; band < 3; ++band)
    c[band] = std::cos(4 * std::numbers::pi * thickness / double(kBandWavelengths[band]) *
                           std::sqrt(index * index - (1 - cos * cos)) +
                       std::numbers::pi);
  return c * c;
}

// ---- The lobe of lxs 7.1 -----------------------------------------------------------------------

struct LobeFormula {
  double u, v;

  double distribution(const glm::dvec3& h) const {
    const double r = u * v, a = u < v ? 1 - u * u / (v * v) : v * v / (u * u) - 1;
    const double p = 1 - std::abs(a), across = std::hypot(h.x, h.y);
    double share = 1;
    if (u != v && across > 0) {
      const double w = (a > 0 ? h.x : h.y) / across;
      share = std::sqrt(p / (p * p + w * w * (1 - p * p)));
    }
    const double rest = 1 + (r - 1) * h.z * h.z;
    return share * r / (std::numbers::pi * rest * rest);
  }
  double shadowing(double c) const { return c / (c * (1 - u * v) + u * v); }
  /// f without R F.
  double operator()(const glm::dvec3& wo, const glm::dvec3& wi) const {
    if (wi.z <= 0) return 0;
    return distribution(glm::normalize(wo + wi)) * shadowing(wo.z) * shadowing(wi.z) /
           (4 * wo.z * wi.z);
  }
  /// What its albedo may reach where nothing is absorbed: seen edge-on (microfacet.h).
  double bound() const {
    return std::max(1., .5 / std::sqrt(u * v)) * std::max(u, v) / std::min(u, v);
  }
};

/// lobe(wo, wi) * fresnel(cos at the facet).
template <class Fresnel>
Formula rough_reflection(const LobeFormula& lobe, Fresnel&& fresnel) {
  return [=](const glm::dvec3& wo, const glm::dvec3& wi) {
    const double f = lobe(wo, wi);
    return f == 0 ? glm::dvec3(0) : f * fresnel(glm::dot(wo, glm::normalize(wo + wi)));
  };
}

/// A case of each kind of roughness. make(u, v) gives the parameters.
template <template <template <class> class> class Record, class Make, class Fresnel>
std::vector<Case<Record>> rough_cases(Make&& make, Fresnel&& fresnel) {
  std::vector<Case<Record>> all;
  const auto add = [&](std::string name, float u, float v, double tolerance, int grid) {
    const LobeFormula lobe{double(u), double(v)};
    all.push_back({.name = std::move(name),
                   .parameters = make(u, v),
                   .f = rough_reflection(lobe, fresnel),
                   .albedo = lobe.bound(),
                   .tolerance = tolerance,
                   .grid = grid});
  };
  add("rough", .6f, .6f, 1e-5, 24);
  add("narrow", .2f, .2f, 2e-5, 24);
  add("brushed", .2f, .5f, 2e-5, 24);
  add("brushed across", .4f, .15f, 2e-5, 24);
  add("almost a mirror", .002f, .002f, 2e-2, 0);
  const Formula nothing = [](const glm::dvec3&, const glm::dvec3&) { return glm::dvec3(0); };
  all.push_back({.name = "mirror",
                 .parameters = make(0.f, 1e-4f),
                 .f = nothing,
                 .mirror = [fresnel](double cos) { return fresnel(std::abs(cos)); }});
  return all;
}

inline std::vector<Case<MetalParameters>> cases(MetalParameters<Value>) {
  return rough_cases<MetalParameters>(
      [](float u, float v) {
        return MetalParameters<Value>{.206f, .35f, 1.372f, 3.03f, 2.714f, 1.825f, u, v};
      },
      [](double cos) {
        return glm::dvec3(conductor_reflectance(double(.206f), double(3.03f), cos),
                          conductor_reflectance(double(.35f), double(2.714f), cos),
                          conductor_reflectance(double(1.372f), double(1.825f), cos));
      });
}

inline std::vector<Case<MetalIndexParameters>> cases(MetalIndexParameters<Value>) {
  return rough_cases<MetalIndexParameters>(
      [](float u, float v) { return MetalIndexParameters<Value>{5, 1.5f, 2, 0, 0, .5f, u, v}; },
      [](double cos) {
        return glm::dvec3(dielectric_reflectance(cos, 1, 5), dielectric_reflectance(cos, 1, 1.5),
                          general_reflectance(2, .5, cos));
      });
}

inline std::vector<Case<MetalColourParameters>> cases(MetalColourParameters<Value>) {
  return rough_cases<MetalColourParameters>(
      [](float u, float v) { return MetalColourParameters<Value>{1, .5f, 0, u, v}; },
      [](double cos) { return colour_reflectance({1, .5, 0}, cos); });
}

inline std::vector<Case<ShinyMetalParameters>> cases(ShinyMetalParameters<Value>) {
  std::vector<Case<ShinyMetalParameters>> all;
  const glm::dvec3 white(1), tinted(.5, .25, 0);
  const auto add = [&](const char* name, ShinyMetalParameters<Value> p, glm::dvec3 kr,
                       glm::dvec3 ks, double film) {
    const LobeFormula lobe{double(p.uroughness), double(p.vroughness)};
    all.push_back(
        {.name = name,
         .parameters = p,
         .f = rough_reflection(lobe, [ks](double cos) { return colour_reflectance(ks, cos); }),
         .albedo = 1 + lobe.bound(),
         .tolerance = 2e-5,
         .grid = 24,
         .mirror = [=](double cos) {
           return film_colour(film, 1.5, std::abs(cos)) * colour_reflectance(kr, std::abs(cos));
         }});
  };
  add("white", {1, 1, 1, 1, 1, 1, .3f, .3f, 0, 1.5f}, white, white, 0);
  add("tinted", {.5f, .25f, 0, 1, 1, 1, .3f, .3f, 200, 1.5f}, tinted, white, 200);
  add("no mirror", {0, 0, 0, 1, 1, 1, .3f, .4f, 0, 1.5f}, glm::dvec3(0), white, 0);
  add("no lobe", {1, 1, 1, 0, 0, 0, .3f, .3f, 0, 1.5f}, white, glm::dvec3(0), 0);
  return all;
}

inline std::vector<Case<RoughGlassParameters>> cases(RoughGlassParameters<Value>) {
  std::vector<Case<RoughGlassParameters>> all;
  const auto add = [&](const char* name, float index, float u, float v, glm::dvec3 kr,
                       glm::dvec3 kt, double tolerance, int grid) {
    const LobeFormula lobe{std::max(double(u), .006), std::max(double(v), .006)};
    const auto glass = [=](double n_o, double n_i) {
      return [=](const glm::dvec3& wo, const glm::dvec3& wi) {
        if (wi.z == 0) return glm::dvec3(0);
        glm::dvec3 h = glm::normalize(wi.z > 0 ? wo + wi : -(n_o * wo + n_i * wi));
        if (h.z < 0) h = -h;
        const double o_h = glm::dot(wo, h), i_h = glm::dot(wi, h);
        if (o_h <= 0 || i_h * wi.z <= 0) return glm::dvec3(0);
        const double fresnel = dielectric_reflectance(o_h, n_o, n_i);
        const double common = lobe.distribution(h) * lobe.shadowing(wo.z) *
                              lobe.shadowing(std::abs(wi.z)) / (wo.z * std::abs(wi.z));
        if (wi.z > 0) return kr * (fresnel * common / 4);
        const double eta = n_o / n_i, sum = glm::length(eta * wo + wi);
        return kt * ((1 - fresnel) * o_h * std::abs(i_h) * common * eta * eta / (sum * sum));
      };
    };
    all.push_back({.name = name,
                   .parameters = {float(kr.x), float(kr.y), float(kr.z), float(kt.x), float(kt.y),
                                  float(kt.z), index, u, v},
                   .f = glass(1, double(index)),
                   .albedo = lobe.bound(),
                   .inside = glass(double(index), 1),
                   .tolerance = tolerance,
                   .grid = grid});
  };
  const glm::dvec3 white(1), black(0);
  add("rough", 1.5f, .5f, .5f, white, white, 1e-3, 24);
  add("narrow", 1.5f, .15f, .15f, white, white, 3e-3, 0);
  add("brushed", 1.33f, .3f, .5f, {1, .5, .25}, {.25, .5, 1}, 1e-3, 24);
  add("thin", 1 / 1.5f, .3f, .3f, white, white, 1e-3, 24);
  add("reflecting only", 2.5f, .3f, .3f, white, black, 4e-5, 24);
  add("black", 1.5f, .3f, .3f, black, black, 1e-3, 0);
  add("smoothest", 1.5f, 0, 0, white, white, 5e-3, 0);
  return all;
}

// ---- Cook-Torrance -----------------------------------------------------------------------------

/// Without compensation.
inline Formula cook_torrance(double m, const glm::dvec3& kr) {
  return [=](const glm::dvec3& wo, const glm::dvec3& wi) {
    if (wi.z <= 0) return glm::dvec3(0);
    const glm::dvec3 h = glm::normalize(wo + wi);
    const double o_h = glm::dot(wo, h), tan = std::tan(std::acos(std::min(h.z, 1.)));
    const double d = std::exp(-tan * tan / (m * m)) / (std::numbers::pi * m * m * std::pow(h.z, 4));
    const double g = std::min({1., 2 * h.z * wo.z / o_h, 2 * h.z * wi.z / o_h});
    return (kr + (1. - kr) * std::pow(1 - o_h, 5)) * (d * g / (4 * wo.z * wi.z));
  };
}

inline std::vector<Case<CookTorranceSingleParameters>> cases(CookTorranceSingleParameters<Value>) {
  std::vector<Case<CookTorranceSingleParameters>> all;
  for (const float m : {.2f, .5f, 1.f})
    all.push_back({.name = "m " + std::to_string(m),
                   .parameters = {1, .5f, 0, m},
                   .f = cook_torrance(double(m), {1, .5, 0}),
                   .tolerance = 5e-5,
                   .grid = 24});
  all.push_back({.name = "mirror",
                 .parameters = {1, .5f, 0, 0},
                 .f = [](const glm::dvec3&, const glm::dvec3&) { return glm::dvec3(0); },
                 .mirror =
                     [](double cos) {
                       return glm::dvec3(1, .5, 0) +
                              glm::dvec3(0, .5, 1) * std::pow(1 - std::abs(cos), 5);
                     }});
  return all;
}

/// With it: Kulla, Conty 2017, the albedo by its fit.
inline Formula compensated_cook_torrance(double m, const glm::dvec3& kr) {
  const auto loss = [m](double c) {
    double sum = 0;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 5; ++j)
        sum += double(kCookTorranceLoss[i][j]) * std::pow(c, i) * std::pow(m, j);
    return std::max(c * sum - double(kCookTorranceMargin), 0.);
  };
  double average = 0;
  for (int j = 0; j < 6; ++j) average += double(kCookTorranceAverageLoss[j]) * std::pow(m, j);
  const glm::dvec3 mean = kr + (1. - kr) / 21.;
  const glm::dvec3 colour = mean * mean * (1 - average) / (1. - mean * average);
  return [=, single = cook_torrance(m, kr)](const glm::dvec3& wo, const glm::dvec3& wi) {
    if (wi.z <= 0) return glm::dvec3(0);
    return single(wo, wi) + colour * (loss(wo.z) * loss(wi.z) / (std::numbers::pi * average));
  };
}

inline std::vector<Case<CookTorranceParameters>> cases(CookTorranceParameters<Value>) {
  std::vector<Case<CookTorranceParameters>> all;
  for (const float m : {.2f, .4f, .7f, 1.f})
    all.push_back({.name = "m " + std::to_string(m),
                   .parameters = {1, .5f, 0, m},
                   .f = compensated_cook_torrance(double(m), {1, .5, 0}),
                   .tolerance = 5e-4,
                   .grid = 24});
  return all;
}

}  // namespace yat

#pragma once
// Cases of the materials that scatter diffusely, with their formulas as in lxs 7.2.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "kernels/materials/all.h"
#include "material_case.h"

namespace yat {

/// Oren, Nayar 1994 with its angles; sigma in degrees, both directions above the surface.
inline double oren_nayar_factor(double sigma, const glm::dvec3& wo, const glm::dvec3& wi) {
  const double s = sigma * std::numbers::pi / 180, s2 = s * s;
  const double a = 1 - s2 / (2 * (s2 + .33)), b = .45 * s2 / (s2 + .09);
  const double to = std::acos(std::clamp(wo.z, 0., 1.)), ti = std::acos(std::clamp(wi.z, 0., 1.));
  const double dphi = std::atan2(wo.y, wo.x) - std::atan2(wi.y, wi.x);
  return a +
         b * std::max(0., std::cos(dphi)) * std::sin(std::max(to, ti)) * std::tan(std::min(to, ti));
}
/// What its albedo may reach: grazing, the B term integrates to 1/2 at most.
inline double oren_nayar_bound(double sigma) {
  const double s = sigma * std::numbers::pi / 180, s2 = s * s;
  return std::max(1., 1 - s2 / (2 * (s2 + .33)) + .45 * s2 / (s2 + .09) / 2);
}

inline std::vector<Case<MatteParameters>> cases(MatteParameters<Value>) {
  const auto lambert = [](glm::dvec3 kd) {
    return [kd](const glm::dvec3&, const glm::dvec3& wi) {
      return wi.z > 0 ? kd / std::numbers::pi : glm::dvec3(0);
    };
  };
  return {{"white", {1, 1, 1}, lambert(glm::dvec3(1))},
          {"coloured", {.25f, .5f, 0}, lambert({.25, .5, 0})}};
}

inline std::vector<Case<OrenNayarParameters>> cases(OrenNayarParameters<Value>) {
  std::vector<Case<OrenNayarParameters>> all;
  for (const float sigma : {0.f, 6.f, 30.f, 90.f, 100.f}) {
    const double used = std::min(double(sigma), 90.);
    const Formula f = [used](const glm::dvec3& wo, const glm::dvec3& wi) {
      if (wi.z <= 0) return glm::dvec3(0);
      return glm::dvec3(1, .5, .25) / std::numbers::pi * oren_nayar_factor(used, wo, wi);
    };
    all.push_back(
        {"sigma " + std::to_string(sigma), {1, .5f, .25f, sigma}, f, oren_nayar_bound(used)});
  }
  return all;
}

inline std::vector<Case<MatteTranslucentParameters>> cases(MatteTranslucentParameters<Value>) {
  const auto sheet = [](glm::dvec3 kr, glm::dvec3 kt, double sigma) {
    return [=](const glm::dvec3& wo, const glm::dvec3& wi) {
      const double factor = oren_nayar_factor(sigma, wo, {wi.x, wi.y, std::abs(wi.z)});
      return (wi.z > 0 ? kr : wi.z < 0 ? kt : glm::dvec3(0)) * (factor / std::numbers::pi);
    };
  };
  return {{"white, conserving", {1, 1, 1, 1, 1, 1, 0, 1}, sheet(glm::dvec3(1), glm::dvec3(0), 0)},
          // What is not taken away by Kr is added to it.
          {"white", {1, 1, 1, 1, 1, 1, 0, 0}, sheet(glm::dvec3(1), glm::dvec3(1), 0), 2},
          {"coloured",
           {.5f, .25f, 0, 1, .5f, .25f, 20, 1},
           sheet({.5, .25, 0}, {.5, .375, .25}, 20),
           oren_nayar_bound(20)},
          {"thin", {.1f, .1f, .1f, .7f, .2f, 0, 0, 0}, sheet(glm::dvec3(.1), {.7, .2, 0}, 0)},
          {"black", {0, 0, 0, 0, 0, 0, 0, 0}, sheet(glm::dvec3(0), glm::dvec3(0), 0)}};
}

inline std::vector<Case<VelvetParameters>> cases(VelvetParameters<Value>) {
  const auto velvet = [](double kd, double p1, double p2, double p3, double thickness) {
    return [=](const glm::dvec3& wo, const glm::dvec3& wi) {
      if (wi.z <= 0) return glm::dvec3(0);
      const double c = -glm::dot(wo, wi);
      const double phase =
          (1 + p1 * c + p2 * (3 * c * c - 1) / 2 + p3 * (5 * c * c * c - 3 * c) / 2) /
          (4 * std::numbers::pi);
      return glm::dvec3(kd) * (std::clamp(phase * thickness / wo.z, 0., 1.) / wi.z);
    };
  };
  const double bound = 2 * std::numbers::pi;  // Kd from every direction without a cosine
  return {
      {"defaults", {.3f, .3f, .3f, -2, 20, 2, .1f}, velvet(.3, -2, 20, 2, .1), .3 * bound, false},
      {"thick", {1, 1, 1, -2, 20, 2, 1}, velvet(1, -2, 20, 2, 1), bound, false},
      {"isotropic", {1, 1, 1, 0, 0, 0, .2f}, velvet(1, 0, 0, 0, .2), bound, false},
      // Nowhere clamped but at the horizon.
      {"none", {1, 1, 1, -2, 20, 2, 0}, velvet(1, -2, 20, 2, 0)}};
}

inline std::vector<Case<ScatterParameters>> cases(ScatterParameters<Value>) {
  const auto phase = [](double g) {
    return [g](const glm::dvec3& wo, const glm::dvec3& wi) {
      const double k = g * (1.55 - .55 * g * g), rest = 1 + k * glm::dot(wo, wi);
      const double p = (1 - k * k) / (4 * std::numbers::pi * rest * rest);
      return wi.z == 0 ? glm::dvec3(0) : glm::dvec3(1, .5, 0) * (p / std::abs(wi.z));
    };
  };
  std::vector<Case<ScatterParameters>> all;
  for (const float g : {0.f, .5f, -.5f})
    all.push_back({"g " + std::to_string(g), {1, .5f, 0, g}, phase(double(g)), 1, false});
  return all;
}

/// Not BSDFs themselves: composite_cases.h.
inline std::vector<Case<CoatingParameters>> cases(CoatingParameters<Value>) {
  return {};
}
inline std::vector<Case<MixParameters>> cases(MixParameters<Value>) {
  return {};
}
inline std::vector<Case<DoubleSideParameters>> cases(DoubleSideParameters<Value>) {
  return {};
}

}  // namespace yat

#pragma once
// Cases of the coated materials, with their formulas as in lxs 7.2 and 7.3.

#include "diffuse_cases.h"
#include "microfacet_cases.h"

namespace yat {

inline glm::dvec3 schlick_colour(const glm::dvec3& r0, double cos) {
  return r0 + (1. - r0) * std::pow(1 - cos, 5);
}
inline glm::dvec3 absorption(const glm::dvec3& ka, double depth, double way) {
  return glm::exp(-ka * (depth * way));
}
inline double between_facets_formula(const LobeFormula& lobe, const glm::dvec3& wo,
                                     const glm::dvec3& wi, double spread) {
  return std::clamp((1 - lobe.shadowing(wo.z) * lobe.shadowing(wi.z)) / (4 * spread * wo.z * wi.z),
                    0., 1.);
}

/// A coat in double precision.
struct CoatFormula {
  glm::dvec3 kd, ks, ka{0.0};
  double depth = 0, index = 0;
  LobeFormula lobe{.3, .3};
  double sigma = 0, multibounce = 0;

  glm::dvec3 r0() const { return index > 0 ? ks * std::pow((index - 1) / (index + 1), 2) : ks; }
  glm::dvec3 base(const glm::dvec3& wo, const glm::dvec3& wi) const {
    return kd / std::numbers::pi * oren_nayar_factor(sigma, wo, wi);
  }
  glm::dvec3 fresnel(const glm::dvec3& wo, const glm::dvec3& wi) const {
    return schlick_colour(r0(), glm::dot(wi, glm::normalize(wo + wi)));
  }
  glm::dvec3 covered(const glm::dvec3& wo, const glm::dvec3& wi) const {
    return absorption(ka, depth, 1 / wo.z + 1 / wi.z) * (1. - fresnel(wo, wi)) * base(wo, wi);
  }
  glm::dvec3 coat(const glm::dvec3& wo, const glm::dvec3& wi, double spread) const {
    return fresnel(wo, wi) *
           (lobe(wo, wi) + multibounce * between_facets_formula(lobe, wo, wi, spread));
  }
};

template <class F>
Formula above_only(F&& f) {
  return [f](const glm::dvec3& wo, const glm::dvec3& wi) {
    return wi.z > 0 ? f(wo, wi) : glm::dvec3(0);
  };
}

/// What each glossy case is made of: the first five of its numbers are kd, ks, ka.
inline std::vector<std::pair<std::string, CoatFormula>> coats() {
  return {{"thin", {glm::dvec3(.75, .5, .25), glm::dvec3(.0625)}},
          {"of index", {glm::dvec3(.5), glm::dvec3(1, .5, .25), glm::dvec3(0), 0, 1.5, {.5, .5}}},
          {"absorbing",
           {glm::dvec3(1), glm::dvec3(.25), glm::dvec3(.5, .25, 0), .5, 0, {.25, .25}, 20}},
          {"multibounce", {glm::dvec3(.25), glm::dvec3(1), glm::dvec3(0), 0, 0, {.75, .75}, 0, 1}},
          {"black base", {glm::dvec3(0), glm::dvec3(.5), glm::dvec3(0), 0, 0, {.5, .5}}},
          {"no coat", {glm::dvec3(.5), glm::dvec3(0)}},
          {"black", {glm::dvec3(0), glm::dvec3(0)}}};
}
/// Twice what one lobe, and what is between its facets, may bring.
inline double coat_bound(const CoatFormula& c) {
  return oren_nayar_bound(c.sigma) + c.lobe.bound() + c.multibounce * std::numbers::pi;
}

inline std::vector<Case<GlossyParameters>> cases(GlossyParameters<Value>) {
  std::vector<Case<GlossyParameters>> all;
  for (const auto& [name, c] : coats())
    all.push_back({.name = name,
                   .parameters = {float(c.kd.x), float(c.kd.y), float(c.kd.z), float(c.ks.x),
                                  float(c.ks.y), float(c.ks.z), float(c.ka.x), float(c.ka.y),
                                  float(c.ka.z), float(c.depth), float(c.index), float(c.lobe.u),
                                  float(c.lobe.v), float(c.sigma), float(c.multibounce)},
                   .f = above_only([c](const glm::dvec3& wo, const glm::dvec3& wi) {
                     return c.coat(wo, wi, 1) + c.covered(wo, wi);
                   }),
                   .albedo = coat_bound(c),
                   .inside = above_only(
                       [c](const glm::dvec3& wo, const glm::dvec3& wi) { return c.base(wo, wi); }),
                   .tolerance = 2e-5,
                   .grid = 12});
  // A coat without roughness is a mirror over its base.
  const glm::dvec3 ks(.25);
  all.push_back(
      {.name = "smooth",
       .parameters = {0, 0, 0, .25f, .25f, .25f, 0, 0, 0, 0, 0, 1e-6f, 1e-6f, 0, 0},
       .f = [](const glm::dvec3&, const glm::dvec3&) { return glm::dvec3(0); },
       .mirror = [ks](double cos) { return cos > 0 ? schlick_colour(ks, cos) : glm::dvec3(0); }});
  return all;
}

inline std::vector<Case<GlossySingleParameters>> cases(GlossySingleParameters<Value>) {
  std::vector<Case<GlossySingleParameters>> all;
  for (auto [name, c] : coats()) {
    c.sigma = 0;
    all.push_back(
        {.name = name,
         .parameters = {float(c.kd.x), float(c.kd.y), float(c.kd.z), float(c.ks.x), float(c.ks.y),
                        float(c.ks.z), float(c.ka.x), float(c.ka.y), float(c.ka.z), float(c.depth),
                        float(c.index), float(c.lobe.u), float(c.lobe.v), float(c.multibounce)},
         .f = above_only([c = c](const glm::dvec3& wo, const glm::dvec3& wi) {
           return c.coat(wo, wi, std::numbers::pi) + c.covered(wo, wi);
         }),
         .albedo = coat_bound(c),
         .inside = above_only(
             [c = c](const glm::dvec3& wo, const glm::dvec3& wi) { return c.covered(wo, wi); }),
         .tolerance = 2e-5,
         .grid = 12});
  }
  return all;
}

inline std::vector<Case<GlossyLossyParameters>> cases(GlossyLossyParameters<Value>) {
  std::vector<Case<GlossyLossyParameters>> all;
  for (auto [name, c] : coats()) {
    if (c.multibounce != 0) continue;
    c.lobe.v = c.lobe.u / 2;
    const auto rim = [](double cos) { return 1 - std::pow(1 - cos / 2, 5); };
    all.push_back(
        {.name = name,
         .parameters = {float(c.kd.x), float(c.kd.y), float(c.kd.z), float(c.ks.x), float(c.ks.y),
                        float(c.ks.z), float(c.ka.x), float(c.ka.y), float(c.ka.z), float(c.depth),
                        float(c.index), float(c.lobe.u), float(c.lobe.v)},
         .f = above_only([c = c, rim](const glm::dvec3& wo, const glm::dvec3& wi) {
           const glm::dvec3 h = glm::normalize(wo + wi);
           const double cos = glm::dot(wi, h);
           return 28 / (23 * std::numbers::pi) * rim(wo.z) * rim(wi.z) * c.kd * (1. - c.r0()) *
                      absorption(c.ka, c.depth, 1 / wo.z + 1 / wi.z) +
                  schlick_colour(c.r0(), cos) *
                      (c.lobe.distribution(h) / (4 * cos * std::max(wo.z, wi.z)));
         }),
         .albedo = coat_bound(c),
         .tolerance = 3e-5,
         .grid = 24});
  }
  return all;
}

inline std::vector<Case<GlossyTranslucentParameters>> cases(GlossyTranslucentParameters<Value>) {
  std::vector<Case<GlossyTranslucentParameters>> all;
  const auto add = [&](const char* name, const CoatFormula& front, const CoatFormula& back,
                       const glm::dvec3& kt) {
    const auto seen = [=](const CoatFormula& here, const CoatFormula& there) {
      return [=](const glm::dvec3& wo, const glm::dvec3& wi) {
        if (wi.z > 0) return here.coat(wo, wi, std::numbers::pi) + here.covered(wo, wi);
        const glm::dvec3 up(wi.x, wi.y, -wi.z);
        return kt * (1. - here.kd) / std::numbers::pi *
               glm::sqrt((1. - here.fresnel(wo, up)) * (1. - there.fresnel(wo, up))) *
               absorption(here.ka, here.depth, 1 / wo.z) *
               absorption(there.ka, there.depth, 1 / up.z);
      };
    };
    const auto f = [](double x) { return float(x); };
    const CoatFormula &a = front, &b = back;
    all.push_back(
        {.name = name,
         .parameters = {f(a.kd.x),   f(a.kd.y),        f(a.kd.z),       f(kt.x),    f(kt.y),
                        f(kt.z),     f(a.ks.x),        f(a.ks.y),       f(a.ks.z),  f(a.ka.x),
                        f(a.ka.y),   f(a.ka.z),        f(a.depth),      f(a.index), f(a.lobe.u),
                        f(a.lobe.v), f(a.multibounce), f(b.ks.x),       f(b.ks.y),  f(b.ks.z),
                        f(b.ka.x),   f(b.ka.y),        f(b.ka.z),       f(b.depth), f(b.index),
                        f(b.lobe.u), f(b.lobe.v),      f(b.multibounce)},
         .f = seen(front, back),
         .albedo = 1 + coat_bound(front) + coat_bound(back),
         .inside = seen(back, front),
         .tolerance = 2e-5,
         .grid = 12});
  };
  const glm::dvec3 kd(.25, .5, .75), none(0);
  const CoatFormula thin{kd, glm::dvec3(.0625), none, 0, 0, {.3, .3}};
  add("thin", thin, thin, {.5, 1, .25});
  add("two coats", {kd, glm::dvec3(.5, .25, 1), {.5, 0, 1}, .5, 1.5, {.5, .5}},
      {kd, glm::dvec3(.25), {0, .25, 0}, 1, 0, {.75, .75}, 0, 1}, {.75, .5, .25});
  add("nothing", {none, none, none, 0, 0, {.3, .3}}, {none, none, none, 0, 0, {.3, .3}}, none);
  return all;
}

inline std::vector<Case<CarPaintParameters>> cases(CarPaintParameters<Value>) {
  std::vector<Case<CarPaintParameters>> all;
  const auto add = [&](const char* name, const glm::dvec3& kd, std::array<double, 3> ks,
                       std::array<double, 3> r, std::array<double, 3> m, const glm::dvec3& ka,
                       double depth) {
    const auto f = [](double x) { return float(x); };
    const auto base = [=](const glm::dvec3& wo, const glm::dvec3& wi) {
      return kd / std::numbers::pi * absorption(ka, depth, 1 / wo.z + 1 / wi.z);
    };
    double bound = 1;
    for (const double rough : m)
      if (rough > 0) bound += LobeFormula{rough, rough}.bound();
    all.push_back({.name = name,
                   .parameters = {f(kd.x), f(kd.y),  f(kd.z),  f(ks[0]), 0,        f(ks[0]),
                                  0,       f(ks[1]), f(ks[1]), f(ks[2]), f(ks[2]), 0,
                                  f(r[0]), f(r[1]),  f(r[2]),  f(m[0]),  f(m[1]),  f(m[2]),
                                  f(ka.x), f(ka.y),  f(ka.z),  f(depth)},
                   .f = above_only([=](const glm::dvec3& wo, const glm::dvec3& wi) {
                     const double cos = glm::dot(wi, glm::normalize(wo + wi));
                     const glm::dvec3 tint[3] = {{1, 0, 1}, {0, 1, 1}, {1, 1, 0}};
                     glm::dvec3 sum = base(wo, wi);
                     for (size_t k = 0; k < 3; ++k)
                       if (m[k] > 0)
                         sum += tint[k] * (ks[k] * schlick_colour(glm::dvec3(r[k]), cos).x *
                                           LobeFormula{m[k], m[k]}(wo, wi));
                     return sum;
                   }),
                   .albedo = bound,
                   .inside = above_only(base),
                   .tolerance = 3e-5,
                   .grid = 24});
  };
  add("three lobes", {.25, .5, .125}, {.25, .5, .125}, {1, .5, .0625}, {.5, .25, .75}, {0, 0, 0},
      0);
  add("one is not there", {.25, .5, .125}, {.25, .5, .5}, {1, .5, .25}, {.5, 0, .25}, {1, .5, 0},
      .25);
  add("lobes only", glm::dvec3(0), {.5, 0, .25}, {.5, .5, .5}, {.5, .25, .25}, {0, 0, 0}, 0);
  return all;
}

}  // namespace yat

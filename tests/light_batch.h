#pragma once
// Lights as rows, and calls of sample_lights, for tests of light kernels.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "kernel_columns.h"
#include "kernels/rng_scalar.h"

namespace yat {

/// A scene of lights only.
struct LightScene {
  RowTable<LightRow> rows;
  RowTable<LightChoice> choice;
  SceneView view;

  /// All lights equally likely, unless probabilities are set in the rows and `alias` is given.
  explicit LightScene(std::vector<LightRow<Value>> lights,
                      std::vector<LightChoice<Value>> alias = {}) {
    const auto n = uint32_t(lights.size());
    rows.resize(n);
    choice.resize(n);
    for (uint32_t i = 0; i < n; ++i) {
      if (alias.empty()) lights[i].probability = 1.f / float(n);
      rows.set(i, lights[i]);
      choice.set(i, alias.empty() ? LightChoice<Value>{1, i} : alias[i]);
      view.lights.kinds |= 1u << lights[i].kind;
    }
    view.lights.rows = rows.view();
    view.lights.choice = choice.view();
  }
};

inline void put(const glm::dvec3& v, float& x, float& y, float& z) {
  x = float(v.x), y = float(v.y), z = float(v.z);
}

inline LightRow<Value> triangle_light(const glm::dvec3& p0, const glm::dvec3& p1,
                                      const glm::dvec3& p2) {
  LightRow<Value> row{};
  put(p0, row.a_x, row.a_y, row.a_z);
  put(p1 - p0, row.b_x, row.b_y, row.b_z);
  put(p2 - p0, row.c_x, row.c_y, row.c_z);
  row.extra = float(glm::length(glm::cross(p1 - p0, p2 - p0)) / 2);
  row.radiance_r = 1, row.radiance_g = .5f, row.radiance_b = 2;
  row.probability = 1;
  row.kind = uint32_t(LightKind::kTriangle);
  return row;
}
/// b x c points where it shines.
inline LightRow<Value> rectangle_light(const glm::dvec3& corner, const glm::dvec3& b,
                                       const glm::dvec3& c) {
  LightRow<Value> row = triangle_light(corner, corner + b, corner + c);
  put(b, row.b_x, row.b_y, row.b_z);
  put(c, row.c_x, row.c_y, row.c_z);
  row.extra = float(glm::length(glm::cross(b, c)));
  row.kind = uint32_t(LightKind::kRectangle);
  return row;
}
inline glm::dvec3 corner_of(const LightRow<Value>& row) {
  return {row.a_x, row.a_y, row.a_z};
}
inline LightRow<Value> sphere_light(const glm::dvec3& center, double radius, bool inwards = false) {
  LightRow<Value> row{};
  put(center, row.a_x, row.a_y, row.a_z);
  row.b_x = inwards;
  row.extra = float(radius);
  row.radiance_r = 1, row.radiance_g = .5f, row.radiance_b = 2;
  row.probability = 1;
  row.kind = uint32_t(LightKind::kSphere);
  return row;
}
inline LightRow<Value> far_light(LightKind kind, const glm::dvec3& a, double cos = 1) {
  LightRow<Value> row{};
  put(a, row.a_x, row.a_y, row.a_z);
  row.extra = float(cos);
  row.radiance_r = 1, row.radiance_g = .5f, row.radiance_b = 2;
  row.probability = 1;
  row.kind = uint32_t(kind);
  // LuxRender's fall-off: 1 / distance^2.
  if (kind == LightKind::kPoint) row.b_x = 1;
  return row;
}

/// Inputs and outputs of one sample_lights call.
struct Batch {
  uint32_t n;
  GuardedTable<Surface> surfaces;
  GuardedTable<Randoms> randoms;
  GuardedTable<LightSample> samples;
  explicit Batch(uint32_t rows) : n(rows), surfaces(n), randoms(n), samples(n) {}
  void set(uint32_t i, const glm::dvec3& pos, float u, float v, float choice) {
    Surface<Value> s{};
    put(pos, s.pos_x, s.pos_y, s.pos_z);
    surfaces.set(i, s);
    Randoms<Value> r{};
    r.light_u = u, r.light_v = v, r.light_choice = choice;
    randoms.set(i, r);
  }
  void run(const KernelTable& k, const SceneView& scene, uint32_t kind) {
    k.sample_lights[kind](scene, surfaces.view(), randoms.view(), samples.columns(), n);
  }
  /// Without a number for the choice of the light.
  void run_by_place(const KernelTable& k, const SceneView& scene, uint32_t kind) {
    Randoms<ConstColumn> numbers = randoms.view();
    numbers.light_choice = nullptr;
    k.sample_lights[kind](scene, surfaces.view(), numbers, samples.columns(), n);
  }
  glm::dvec3 pos(uint32_t i) const {
    const Surface<Value> s = surfaces.row(i);
    return {s.pos_x, s.pos_y, s.pos_z};
  }
};
inline glm::dvec3 wi_of(const LightSample<Value>& s) {
  return {s.wi_x, s.wi_y, s.wi_z};
}
inline glm::dvec3 to_of(const LightSample<Value>& s) {
  return {s.to_x, s.to_y, s.to_z};
}

inline constexpr uint32_t kMany = 1 << 20;

/// kMany samples from one place with independent numbers.
inline Batch many_samples(const KernelTable& k, const LightScene& scene, uint32_t kind,
                          const glm::dvec3& pos, uint32_t seed) {
  Batch b(kMany);
  for (uint32_t i = 0; i < kMany; ++i) {
    const auto [u, v] = random_pair(SamplerKind::kIndependent, seed, Dimension::kLight, 0, i, 0);
    const auto choice = random_pair(SamplerKind::kIndependent, seed, Dimension::kChoice, 0, i, 0);
    b.set(i, pos, u, v, choice.first);
  }
  b.run(k, scene.view, kind);
  return b;
}

/// What many_samples gives a receiver with normal z: the mean, and its standard error.
struct MeanIrradiance {
  double mean, error;
};
inline MeanIrradiance mean_irradiance(const Batch& b) {
  double sum = 0, squares = 0;
  for (uint32_t i = 0; i < b.n; ++i) {
    const LightSample<Value> s = b.samples.row(i);
    const double x = std::max(0., double(s.wi_z)) * double(s.weight_r);
    sum += x;
    squares += x * x;
  }
  const double mean = sum / b.n;
  return {mean, std::sqrt((squares / b.n - mean * mean) / b.n)};
}

/// One sample for every pair of a place and a pair of numbers: `places`, and 40 up to 100 `size`
/// from the origin; corners of the square of numbers, its middle, and 4 from inside.
inline Batch batch_at(std::vector<glm::dvec3> places, double size, Random& random) {
  for (int i = 0; i < 40; ++i)
    places.push_back(size * std::pow(10., double(random.in(-7, 2))) * random.direction());
  constexpr float kNearlyOne = 0x1.fffffep-1f;
  std::vector<glm::vec2> numbers = {
      {0, 0}, {0, kNearlyOne}, {kNearlyOne, 0}, {kNearlyOne, kNearlyOne}, {.5f, .5f}};
  for (int i = 0; i < 4; ++i) numbers.push_back({random.unit(), random.unit()});
  Batch b(uint32_t(places.size() * numbers.size()));
  for (uint32_t i = 0; i < b.n; ++i) {
    const glm::vec2 uv = numbers[i % numbers.size()];
    b.set(i, places[i / numbers.size()], uv.x, uv.y, 0);
  }
  return b;
}
/// Sample i holds numbers, and none but 0 where the receiver is `behind` the light. Whether it has
/// a density: its weight must be one over that.
inline bool expect_numbers(const Batch& b, uint32_t i, bool behind) {
  const LightSample<Value> s = b.samples.row(i);
  const glm::dvec3 p = b.pos(i);
  EXPECT_TRUE(s.weight_r >= 0 && std::isfinite(s.weight_r)) << p.x << ", " << p.y << ", " << p.z;
  EXPECT_TRUE(s.pdf >= 0 && !std::isnan(s.pdf)) << p.x << ", " << p.y << ", " << p.z;
  if (behind) {
    EXPECT_EQ(s.weight_r, 0.f) << p.x << ", " << p.y << ", " << p.z;
  }
  if (!(s.weight_r > 1e-30f && std::isfinite(s.pdf))) return false;
  expect_close(double(s.pdf) * double(s.weight_r), 1, 1e-5, "pdf", i);
  return true;
}

/// A triangle light from a place: Van Oosterom, Strackee 1983, in double precision.
struct SeenTriangle {
  glm::dvec3 v0, v1, v2;   ///< unit, to the corners
  double volume, opening;  ///< tan(solid angle / 2) is their quotient
  bool sampled;  ///< by solid angle, by the rule of kernels/lights/triangle.h; else by area
  SeenTriangle(const LightRow<Value>& row, const glm::dvec3& from) {
    const glm::dvec3 e1(row.b_x, row.b_y, row.b_z), e2(row.c_x, row.c_y, row.c_z);
    const glm::dvec3 way = glm::dvec3(row.a_x, row.a_y, row.a_z) - from;
    const double d0 = glm::length(way), d1 = glm::length(way + e1), d2 = glm::length(way + e2);
    v0 = way / d0, v1 = (way + e1) / d1, v2 = (way + e2) / d2;
    volume = -glm::dot(v0, glm::cross(e1 / d1, e2 / d2));
    opening = 1 + glm::dot(v0, v1) + glm::dot(v0, v2) + glm::dot(v1, v2);
    sampled = d0 <= 2 * std::max(glm::length(e1), glm::length(e2)) && volume > 0 &&
              volume + opening / 32 > 1. / 64;
  }
  double solid_angle() const { return 2 * std::atan2(volume, opening); }
};

/// A rectangle light from a place: two of those.
struct SeenRectangle {
  double solid_angle;
  bool sampled;  ///< by solid angle, by the rule of kernels/lights/rectangle.h; else by area
  SeenRectangle(const LightRow<Value>& row, const glm::dvec3& from) {
    const glm::dvec3 b(row.b_x, row.b_y, row.b_z), c(row.c_x, row.c_y, row.c_z);
    LightRow<Value> one = row, other = row;
    put(b + c, one.c_x, one.c_y, one.c_z);
    put(b + c, other.b_x, other.b_y, other.b_z);
    solid_angle = SeenTriangle(one, from).solid_angle() + SeenTriangle(other, from).solid_angle();
    const glm::dvec3 way = from - corner_of(row);
    const double size = glm::length(c);
    sampled = glm::dot(way, glm::normalize(glm::cross(b, c))) >= size / 64 &&
              glm::length(way - b / 2. - c / 2.) <= 2 * size;
  }
};

}  // namespace yat

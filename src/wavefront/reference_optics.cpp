// Lights of the oracle.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wavefront/reference_parts.h"

namespace yat::reference {

namespace {

constexpr double kPi = std::numbers::pi;

Vec axis_a(const LightRow<Value>& row) {
  return {row.a_x, row.a_y, row.a_z};
}

/// A triangle light, uniform over its area (Heitz 2019 for the map).
void pick_triangle(const LightRow<Value>& row, const Vec& receiver, double u, double v,
                   LightPoint& pick, double& inverse_pdf) {
  const Vec e1(row.b_x, row.b_y, row.b_z), e2(row.c_x, row.c_y, row.c_z);
  const double b1 = v > u ? u / 2 : u - v / 2, b2 = v > u ? v - u / 2 : v / 2;
  const Vec point = axis_a(row) + b1 * e1 + b2 * e2;
  const Vec normal = glm::normalize(glm::cross(e1, e2)), way = point - receiver;
  const double squared = glm::dot(way, way);
  pick.wi = glm::normalize(way);
  const double cos = -glm::dot(normal, pick.wi);
  // Off the light, so that it does not shadow itself.
  // An instance's triangle lies where its map puts it, which the row's floats round.
  pick.to = point + normal * (1e-12 * (glm::length(point) + glm::length(e1) + glm::length(e2)) +
                              double(row.further));
  if (cos > 0 && squared > 0) {
    inverse_pdf = double(row.extra) * cos / squared;
    pick.pdf = 1 / inverse_pdf;
  }
}

/// A sphere light: uniform in its cone if it shines outwards, over its area if inwards.
void pick_sphere(const LightRow<Value>& row, const Vec& receiver, double u, double v,
                 LightPoint& pick, double& inverse_pdf) {
  const double radius = double(row.extra);
  const Vec center = axis_a(row), way = center - receiver;
  const double distance = glm::length(way);
  const bool inwards = row.b_x != 0;
  if (!inwards && distance <= radius) return;  // on the dark side
  Vec outward;
  if (!inwards) {
    const double measure = 1 - std::sqrt(1 - radius * radius / (distance * distance));
    pick.wi = Axes(way / distance).to_scene(cone(measure, u, v));
    inverse_pdf = 2 * kPi * measure;
    // The nearer intersection; on the rim the discriminant may round below 0.
    const double along = glm::dot(way, pick.wi);
    const double inside = radius * radius - (distance * distance - along * along);
    const double t = along - std::sqrt(std::fmax(inside, 0));
    outward = glm::normalize(receiver + t * pick.wi - center);
  } else {
    outward = cone(2, u, v);
    const Vec to = way + radius * outward;
    pick.wi = glm::normalize(to);
    const double cos = glm::dot(outward, pick.wi);
    if (!(cos > 0)) return;
    inverse_pdf = 4 * kPi * radius * radius * cos / glm::dot(to, to);
  }
  pick.to = center + outward * (radius + (inwards ? -1 : 1) * 1e-9 * radius);
  pick.pdf = 1 / inverse_pdf;
}

}  // namespace

LightPoint sample_light(const Scene& scene, const Vec& receiver, float choice, double u, double v) {
  // The choice in single precision, as in the kernels: a path that chose another light would not be
  // the same path.
  const uint32_t count = scene.lights.size();
  uint32_t chosen = 0;
  if (count > 1) {
    const float place = choice * float(count);
    const uint32_t interval = std::min(uint32_t(place), count - 1);
    const LightChoice<Value> entry = scene.light_choice.row(interval);
    chosen = place - float(uint32_t(place)) < entry.threshold ? interval : entry.other;
  }
  const LightRow<Value> row = scene.lights.row(chosen);
  LightPoint pick;
  double inverse_pdf = 0;
  switch (LightKind(row.kind)) {
    case LightKind::kTriangle:
      pick_triangle(row, receiver, u, v, pick, inverse_pdf);
      break;
    case LightKind::kSphere:
      pick_sphere(row, receiver, u, v, pick, inverse_pdf);
      break;
    case LightKind::kPoint: {
      pick.to = axis_a(row);
      const Vec way = pick.to - receiver;
      pick.wi = glm::normalize(way);
      inverse_pdf = 1 / glm::dot(way, way);
      break;
    }
    case LightKind::kDistant: {
      pick.wi = axis_a(row);
      inverse_pdf = 1;
      const double measure = 1 - double(row.extra);
      if (measure > 0) {
        pick.wi = Axes(pick.wi).to_scene(cone(measure, u, v));
        inverse_pdf = 2 * kPi * measure;
      }
      pick.to = receiver + 1e9 * (1 + glm::length(receiver)) * pick.wi;
      break;
    }
    case LightKind::kCount:
      break;
  }
  const double probability = double(row.probability);
  pick.arriving = light_radiance(scene, chosen) * (inverse_pdf / probability);
  pick.pdf *= probability;
  return pick;
}

double light_pdf(const Scene& scene, const Vec& receiver, const Point& at, double cos) {
  const LightRow<Value> row = scene.lights.row(at.light);
  const Vec way = at.position - receiver;
  const double squared = glm::dot(way, way);
  double area = double(row.extra);
  if (LightKind(row.kind) == LightKind::kSphere) {
    const double radius = double(row.extra);
    const Vec to_center = axis_a(row) - receiver;
    const double distance2 = glm::dot(to_center, to_center);
    if (row.b_x == 0 && distance2 <= radius * radius) return 0;
    if (row.b_x == 0)
      return double(row.probability) / (2 * kPi * (1 - std::sqrt(1 - radius * radius / distance2)));
    area = 4 * kPi * radius * radius;
  }
  return double(row.probability) * squared / (area * cos);
}

Vec light_radiance(const Scene& scene, uint32_t light) {
  const LightRow<Value> row = scene.lights.row(light);
  return {row.radiance_r, row.radiance_g, row.radiance_b};
}

}  // namespace yat::reference

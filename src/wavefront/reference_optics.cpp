#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "kernels/materials/all.h"
#include "wavefront/reference_parts.h"

namespace yat::reference {

namespace {

constexpr double kPi = std::numbers::pi;

template <template <template <class> class> class Record>
Record<Value> parameters(const Scene& scene, MaterialKind kind, uint32_t row) {
  const uint32_t* words = scene.parameters[uint32_t(kind)].data() + size_t(row) * row_words<Record>;
  Record<Value> out;
  for_each_field([&](auto index, auto& field) { std::memcpy(&field, words + index, 4); }, out);
  return out;
}

/// Oren, Nayar 1994 as in lxs 7.2, with its angles.
double oren_nayar(double sigma, const Vec& wo, const Vec& wi) {
  const double s2 = sigma * sigma;
  const double a = 1 - s2 / (2 * (s2 + .33)), b = .45 * s2 / (s2 + .09);
  const double theta_o = std::acos(std::clamp(wo.z, 0.0, 1.0));
  const double theta_i = std::acos(std::clamp(wi.z, 0.0, 1.0));
  const double phi = std::atan2(wo.y, wo.x) - std::atan2(wi.y, wi.x);
  return a + b * std::fmax(0, std::cos(phi)) * std::sin(std::fmax(theta_o, theta_i)) *
                 std::tan(std::fmin(theta_o, theta_i));
}

double largest(const Vec& c) {
  return std::fmax(c.x, std::fmax(c.y, c.z));
}

}  // namespace

Vec Bsdf::evaluate(const Vec& wi) const {
  if (wi.z <= 0) return Vec(0.0);
  if (kind_ == MaterialKind::kMatte) {
    const auto p = parameters<MatteParameters>(scene_, kind_, row_);
    return Vec(p.kd_r, p.kd_g, p.kd_b) / kPi;
  }
  if (kind_ == MaterialKind::kOrenNayar) {
    const auto p = parameters<OrenNayarParameters>(scene_, kind_, row_);
    return Vec(p.kd_r, p.kd_g, p.kd_b) / kPi * oren_nayar(double(p.sigma), wo_, wi);
  }
  return Vec(0.0);
}

double Bsdf::pdf(const Vec& wi) const {
  return material_traits(kind_).delta ? 0 : std::fmax(wi.z, 0) / kPi;
}

Bounce Bsdf::sample(double lobe, double u, double v) const {
  switch (kind_) {
    case MaterialKind::kMatte:
    case MaterialKind::kOrenNayar: {
      const Vec wi = cosine_hemisphere(u, v);
      if (wi.z <= 0) return {wi, Vec(0.0), 0};
      return {wi, evaluate(wi) * kPi, wi.z / kPi};
    }
    case MaterialKind::kMirror: {
      const auto p = parameters<MirrorParameters>(scene_, kind_, row_);
      return {{-wo_.x, -wo_.y, wo_.z}, {p.kr_r, p.kr_g, p.kr_b}, 0};
    }
    case MaterialKind::kGlass:
      return sample_glass(lobe);
    case MaterialKind::kNull:
    case MaterialKind::kCount:
      break;
  }
  return {-wo_, Vec(1.0), 0};
}

/// Snell's law and Fresnel's equations in their amplitudes.
Bounce Bsdf::sample_glass(double lobe) const {
  const auto p = parameters<GlassParameters>(scene_, kind_, row_);
  const double n_here = outside_ ? 1 : double(p.index), n_there = outside_ ? double(p.index) : 1;
  const double sin_here = std::sqrt(wo_.x * wo_.x + wo_.y * wo_.y);
  const double sin_there = n_here / n_there * sin_here;
  double reflectance = 1, cos_there = 0;
  if (sin_there < 1 && wo_.z > 0) {
    cos_there = std::sqrt(1 - sin_there * sin_there);
    const double rs =
        (n_here * wo_.z - n_there * cos_there) / (n_here * wo_.z + n_there * cos_there);
    const double rp =
        (n_there * wo_.z - n_here * cos_there) / (n_there * wo_.z + n_here * cos_there);
    reflectance = (rs * rs + rp * rp) / 2;
  }
  const Vec reflected = reflectance * Vec(p.kr_r, p.kr_g, p.kr_b);
  const Vec refracted = (1 - reflectance) * Vec(p.kt_r, p.kt_g, p.kt_b);
  const double total = largest(reflected) + largest(refracted);
  if (total == 0) return {{-wo_.x, -wo_.y, wo_.z}, Vec(0.0), 0};
  const double chance = largest(reflected) / total;
  if (lobe < chance) return {{-wo_.x, -wo_.y, wo_.z}, reflected / chance, 0};
  const double ratio = n_here / n_there;
  return {
      {-ratio * wo_.x, -ratio * wo_.y, -cos_there}, refracted * (ratio * ratio / (1 - chance)), 0};
}

// ---- Lights ------------------------------------------------------------------------------------

namespace {

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

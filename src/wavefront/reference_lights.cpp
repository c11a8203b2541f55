// The oracle's lights (reference_parts.h).

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "scene/light_maps.h"
#include "wavefront/reference_rectangle.h"
#include "wavefront/reference_shapes.h"

namespace yat::reference {

namespace {

constexpr double kPi = std::numbers::pi;
/// Far outside any scene.
constexpr double kFar = 1e9;

Vec axis_a(const LightRow<Value>& row) {
  return {row.a_x, row.a_y, row.a_z};
}

/// A triangle as a receiver sees it: unit vectors to its corners. Van Oosterom, Strackee 1983.
struct SphericalTriangle {
  Vec v0, v1, v2;
  double volume, opening;  ///< tan(solid angle / 2) is their quotient
  bool sampled;            ///< by solid angle; else by area: lights/triangle.h decides alike

  SphericalTriangle(const LightRow<Value>& row, const Vec& receiver) {
    const Vec e1(row.b_x, row.b_y, row.b_z), e2(row.c_x, row.c_y, row.c_z);
    const Vec way = axis_a(row) - receiver;
    v0 = glm::normalize(way);
    v1 = glm::normalize(way + e1);
    v2 = glm::normalize(way + e2);
    volume = -glm::dot(v0, glm::cross(e1 / glm::length(way + e1), e2 / glm::length(way + e2)));
    opening = 1 + glm::dot(v0, v1) + glm::dot(v0, v2) + glm::dot(v1, v2);
    const double size = std::max(glm::length(e1), glm::length(e2));
    sampled = glm::length(way) <= 2 * size && volume > 0 && volume + opening / 32 > 1. / 64;
  }
  double solid_angle() const { return 2 * std::atan2(volume, opening); }
  /// Arvo 1995 with the vectors of Peters 2021.
  Vec direction(double u, double v) const {
    const double half = u * solid_angle() / 2;
    const Vec middle = v0 * (volume * std::cos(half) - glm::dot(v0 + v1, v2) * std::sin(half)) +
                       v2 * ((1 + glm::dot(v0, v1)) * std::sin(half));
    const Vec q = 2 * glm::dot(v0, middle) / glm::dot(middle, middle) * middle - v0;
    const double z = 1 - v * (1 - glm::dot(q, v1));
    const Vec across = glm::normalize(q - glm::dot(q, v1) * v1);
    return z * v1 + std::sqrt(std::fmax(1 - z * z, 0)) * across;
  }
};

/// A point of a flat light that was sampled by area, or by the solid angle if that is not 0.
void pick_flat(const LightRow<Value>& row, const Vec& receiver, const Vec& point,
               double solid_angle, LightPoint& pick, double& inverse_pdf) {
  const Vec e1(row.b_x, row.b_y, row.b_z), e2(row.c_x, row.c_y, row.c_z);
  const Vec normal = glm::normalize(glm::cross(e1, e2));
  const Vec way = point - receiver;
  const double squared = glm::dot(way, way);
  pick.wi = glm::normalize(way);
  const double cos = -glm::dot(normal, pick.wi);
  // Off the light, so that it does not shadow itself: the row's edges are rounded differences of
  // the corners, and an instance's triangle lies where its map puts it, which the row's floats
  // round.
  pick.to =
      point + normal * (0x1p-22 * (glm::length(axis_a(row)) + glm::length(e1) + glm::length(e2)) +
                        double(row.further));
  if (cos > 0 && squared > 0) {
    inverse_pdf = solid_angle > 0 ? solid_angle : double(row.extra) * cos / squared;
    pick.pdf = 1 / inverse_pdf;
  }
}

/// A triangle light, uniform over its solid angle, or its area (Heitz 2019 for the map).
void pick_triangle(const LightRow<Value>& row, const Vec& receiver, double u, double v,
                   LightPoint& pick, double& inverse_pdf) {
  const Vec e1(row.b_x, row.b_y, row.b_z), e2(row.c_x, row.c_y, row.c_z);
  const SphericalTriangle seen(row, receiver);
  const double b1 = v > u ? u / 2 : u - v / 2, b2 = v > u ? v - u / 2 : v / 2;
  Vec point = axis_a(row) + b1 * e1 + b2 * e2;
  if (seen.sampled) {
    const Vec normal = glm::cross(e1, e2), w = seen.direction(u, v);
    point = receiver + glm::dot(axis_a(row) - receiver, normal) / glm::dot(w, normal) * w;
  }
  pick_flat(row, receiver, point, seen.sampled ? seen.solid_angle() : 0, pick, inverse_pdf);
}

/// A rectangle light likewise.
void pick_rectangle(const LightRow<Value>& row, const Vec& receiver, double u, double v,
                    LightPoint& pick, double& inverse_pdf) {
  const SphericalRectangle seen(row, receiver);
  const Vec point = seen.sampled ? receiver + seen.point(u, v)
                                 : axis_a(row) + u * Vec(row.b_x, row.b_y, row.b_z) +
                                       v * Vec(row.c_x, row.c_y, row.c_z);
  pick_flat(row, receiver, point, seen.sampled ? seen.solid_angle() : 0, pick, inverse_pdf);
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

ShapeRow<Value> shape_of(const Scene& scene, const LightRow<Value>& row) {
  return scene.shapes.row(std::bit_cast<uint32_t>(row.a_x));
}

/// An analytic shape, by area in its own way.
void pick_shape(const ShapeRow<Value>& shape, const Vec& receiver, double u, double v,
                LightPoint& pick, double& inverse_pdf) {
  const ShapeSamplePoint at = sample_shape(shape, u, v);
  const Vec way = at.position - receiver;
  const double squared = glm::dot(way, way);
  pick.wi = glm::normalize(way);
  pick.to = at.position + at.offset * at.normal;
  const double cos = -glm::dot(at.normal, pick.wi);
  if (cos > 0 && squared > 0 && at.inverse_density > 0) {
    inverse_pdf = at.inverse_density * cos / squared;
    pick.pdf = 1 / inverse_pdf;
  }
}

// ---- Lights with a map -------------------------------------------------------------------------

LightMapRow<Value> map_of(const Scene& scene, const LightRow<Value>& row) {
  return scene.light_maps.row(std::bit_cast<uint32_t>(row.c_x));
}
/// Scene to light space.
glm::dmat3 map_matrix(const LightMapRow<Value>& m) {
  return {Vec(m.m_xx, m.m_yx, m.m_zx), Vec(m.m_xy, m.m_yy, m.m_zy), Vec(m.m_xz, m.m_yz, m.m_zz)};
}

/// Inverts cumulative values of `count` cells, linear within each.
double invert(const float* cumulative, uint32_t count, double u, uint32_t& cell) {
  const float* const after = std::upper_bound(cumulative, cumulative + count, float(u));
  cell = uint32_t(after - cumulative) - 1;
  const double start = double(cumulative[cell]), mass = double(cumulative[cell + 1]) - start;
  return cell + (mass > 0 ? std::clamp((u - start) / mass, 0.0, 1.0) : 0);
}

/// Density of drawn directions at a place of the lat-long square, per area of it.
double cell_density(const Scene& scene, const LightMapRow<Value>& map, uint32_t column,
                    uint32_t row) {
  const float* rows = scene.light_cells.data() + map.cells;
  const float* columns =
      rows + cell_list_words(map.rows) + size_t(row) * cell_list_words(map.columns);
  return (double(rows[row + 1]) - double(rows[row])) * map.rows *
         (double(columns[column + 1]) - double(columns[column])) * map.columns;
}

/// Ratio of solid angles, light space to scene, where light space has direction l.
double turned(const glm::dmat3& to_light, const Vec& l) {
  const double stretch = glm::length(glm::inverse(to_light) * l);
  return 1 / (stretch * stretch * stretch);
}

/// A direction drawn by the cells of a map, in light space; what divides by its density.
Vec draw_by_cells(const Scene& scene, const LightMapRow<Value>& map, double u, double v, Vec& wi,
                  double& inverse_pdf) {
  const float* rows = scene.light_cells.data() + map.cells;
  uint32_t row = 0, column = 0;
  const double t = invert(rows, map.rows, v, row) / map.rows;
  const float* columns =
      rows + cell_list_words(map.rows) + size_t(row) * cell_list_words(map.columns);
  const double s = invert(columns, map.columns, u, column) / map.columns;
  const Vec l = latlong_direction(s, t);
  const glm::dmat3 to_light = map_matrix(map);
  wi = glm::normalize(glm::inverse(to_light) * l);
  inverse_pdf = 2 * kPi * kPi * std::sin(kPi * t) * turned(to_light, l) /
                cell_density(scene, map, column, row);
  return l;
}

/// What the map of an environment holds in a direction of light space.
Vec environment_colour(const Scene& scene, const LightRow<Value>& row, const Vec& l) {
  if (LightKind(row.kind) == LightKind::kSky)
    return sky_colour(scene.skies.row(std::bit_cast<uint32_t>(row.b_x)), scene.colour.light, l);
  return map_colour(map_of(scene, row), scene.light_texels.data(), l);
}

/// How much of its intensity a point light sends into direction w (away from the light).
Vec sent(const Scene& scene, const LightRow<Value>& row, const Vec& w) {
  switch (LightKind(row.kind)) {
    case LightKind::kSpot: {
      const double above = glm::dot(Vec(row.b_x, row.b_y, row.b_z), w) - double(row.extra);
      return Vec(std::pow(std::clamp(above * double(row.c_x), 0.0, 1.0), 4));
    }
    case LightKind::kPointMap: {
      const LightMapRow<Value> map = map_of(scene, row);
      return map_colour(map, scene.light_texels.data(), glm::normalize(map_matrix(map) * w));
    }
    case LightKind::kProjection: {
      const LightMapRow<Value> map = map_of(scene, row);
      const Vec l = glm::normalize(map_matrix(map) * w);
      const double x = l.x / l.z / double(row.b_x), y = l.y / l.z / double(row.b_y);
      if (!(l.z > 0 && std::fabs(x) <= 1 && std::fabs(y) <= 1)) return Vec(0.0);
      return double(row.extra) / std::pow(l.z, 4) *
             texel_colour(map, scene.light_texels.data(), (x + 1) / 2 * map.width - .5,
                          (y + 1) / 2 * map.height - .5, false);
    }
    default:
      return Vec(1.0);
  }
}

/// A direction of an environment, and what its radiance is multiplied by there.
Vec pick_environment(const Scene& scene, const LightRow<Value>& row, double u, double v, Vec& wi,
                     double& inverse_pdf) {
  switch (LightKind(row.kind)) {
    case LightKind::kConstant:
      wi = cone(2, u, v);
      inverse_pdf = 4 * kPi;
      return Vec(1.0);
    case LightKind::kSun:
      wi = Axes(axis_a(row)).to_scene(cone(double(row.extra), u, v));
      inverse_pdf = 2 * kPi * double(row.extra);
      return Vec(1.0);
    default:
      return environment_colour(scene, row,
                                draw_by_cells(scene, map_of(scene, row), u, v, wi, inverse_pdf));
  }
}

}  // namespace

LightPoint sample_light(const Scene& scene, const Receiver& lit, std::optional<float> choice,
                        float number_u, float number_v) {
  const LightChance chosen = choose_light(scene, lit, choice.value_or(number_u));
  return sample_light(scene, lit, chosen, double(choice ? number_u : chosen.left),
                      double(number_v));
}

LightPoint sample_light(const Scene& scene, const Receiver& lit, const LightChance& choice,
                        double u, double v) {
  const Vec& receiver = lit.position;
  const auto [chosen, chance, nominal, left] = choice;
  const LightRow<Value> row = scene.lights.row(chosen);
  LightPoint pick;
  double inverse_pdf = 0;
  Vec shade(1.0);
  switch (LightKind(row.kind)) {
    case LightKind::kTriangle:
      pick_triangle(row, receiver, u, v, pick, inverse_pdf);
      break;
    case LightKind::kRectangle:
      pick_rectangle(row, receiver, u, v, pick, inverse_pdf);
      break;
    case LightKind::kSphere:
      pick_sphere(row, receiver, u, v, pick, inverse_pdf);
      break;
    case LightKind::kPoint:
    case LightKind::kSpot:
    case LightKind::kPointMap:
    case LightKind::kProjection: {
      pick.to = axis_a(row);
      const Vec way = pick.to - receiver;
      pick.wi = glm::normalize(way);
      inverse_pdf = LightKind(row.kind) == LightKind::kPoint
                        ? 1 / (double(row.b_x) * glm::dot(way, way) + double(row.b_y))
                        : 1 / glm::dot(way, way);
      shade = sent(scene, row, -pick.wi);
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
      pick.to = receiver + kFar * (1 + glm::length(receiver)) * pick.wi;
      break;
    }
    case LightKind::kShape:
      pick_shape(shape_of(scene, row), receiver, u, v, pick, inverse_pdf);
      break;
    case LightKind::kConstant:
    case LightKind::kImage:
    case LightKind::kSun:
    case LightKind::kSky:
      shade = pick_environment(scene, row, u, v, pick.wi, inverse_pdf);
      pick.to = receiver + kFar * (1 + glm::length(receiver)) * pick.wi;
      if (inverse_pdf > 0) pick.pdf = 1 / inverse_pdf;
      break;
    case LightKind::kCount:
      break;
  }
  if (scene.emission.size() > 0 && inverse_pdf > 0)
    shade *= emission_factor(scene, chosen, pick.to, -pick.wi);
  pick.arriving = light_radiance(scene, chosen) * shade * (inverse_pdf / chance);
  pick.pdf *= nominal;
  return pick;
}

double light_pdf(const Scene& scene, const Vec& receiver, const Point& at, double cos) {
  const LightRow<Value> row = scene.lights.row(at.light);
  const Vec way = at.position - receiver;
  const double squared = glm::dot(way, way);
  const double probability = nominal_chance(scene, receiver, at.light);
  double area = double(row.extra);
  if (LightKind(row.kind) == LightKind::kTriangle) {
    const SphericalTriangle seen(row, receiver);
    if (seen.sampled) return probability / seen.solid_angle();
  }
  if (LightKind(row.kind) == LightKind::kRectangle) {
    const SphericalRectangle seen(row, receiver);
    if (seen.sampled) return probability / seen.solid_angle();
  }
  if (LightKind(row.kind) == LightKind::kShape)
    area = inverse_density(shape_of(scene, row), at.position);
  if (LightKind(row.kind) == LightKind::kSphere) {
    const double radius = double(row.extra);
    const Vec to_center = axis_a(row) - receiver;
    const double distance2 = glm::dot(to_center, to_center);
    if (row.b_x == 0 && distance2 <= radius * radius) return 0;
    if (row.b_x == 0)
      return probability / (2 * kPi * (1 - std::sqrt(1 - radius * radius / distance2)));
    area = 4 * kPi * radius * radius;
  }
  return probability * squared / (area * cos);
}

Vec light_radiance(const Scene& scene, uint32_t light) {
  const LightRow<Value> row = scene.lights.row(light);
  return {row.radiance_r, row.radiance_g, row.radiance_b};
}

SeenEnvironment see_environment(const Scene& scene, uint32_t light, const Vec& receiver,
                                const Vec& w) {
  const LightRow<Value> row = scene.lights.row(light);
  const Vec radiance = light_radiance(scene, light);
  const double probability = nominal_chance(scene, receiver, light);
  switch (LightKind(row.kind)) {
    case LightKind::kConstant:
      return {radiance, probability / (4 * kPi)};
    case LightKind::kSun: {
      const double sine = glm::length(glm::cross(w, axis_a(row)));
      const double angle = std::atan2(sine, glm::dot(w, axis_a(row)));
      const double measure = double(row.extra);
      const bool inside = angle <= 2 * std::asin(std::sqrt(measure / 2));
      return {inside ? radiance : Vec(0.0), probability / (2 * kPi * measure)};
    }
    default: {
      const LightMapRow<Value> map = map_of(scene, row);
      const glm::dmat3 to_light = map_matrix(map);
      const Vec l = glm::normalize(to_light * w);
      const double sine = std::sqrt(l.x * l.x + l.y * l.y);
      double s = std::atan2(l.y, l.x) / (2 * kPi);
      if (s < 0) s += 1;
      const double t = std::atan2(sine, l.z) / kPi;
      const double density =
          cell_density(scene, map, std::min(uint32_t(s * map.columns), map.columns - 1),
                       std::min(uint32_t(t * map.rows), map.rows - 1));
      // At a pole, what is never drawn has no density all the same.
      const double pdf = probability > 0
                             ? probability * density / (2 * kPi * kPi * sine * turned(to_light, l))
                             : 0;
      return {radiance * environment_colour(scene, row, l), pdf};
    }
  }
}

}  // namespace yat::reference

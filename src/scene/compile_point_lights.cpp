// Lights at a point or in a direction: point, goniometric, spot, projection, distant (lxs 6.3).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scene/light_compiler.h"

namespace yat {

namespace {

constexpr double kPi = std::numbers::pi;

bool is_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Puts a light at a world position; false, and an error, if that is none.
bool place(LightContext& light, const glm::dvec3& world, LightRow<Value>& row) {
  const glm::dvec3 position = world - light.center;
  if (!is_finite(position)) {
    light.p.diagnostics().error(light.loc(), "the light has no finite position: left out");
    return false;
  }
  row.a_x = float(position.x);
  row.a_y = float(position.y);
  row.a_z = float(position.z);
  return true;
}

/// The map of a light at the row's position; false, and an error, if its matrix is singular.
bool add_map(LightContext& light, const LightPicture& picture, LightRow<Value>& row) {
  auto map = make_light_map(light.linear());
  if (!map) {
    light.p.diagnostics().error(light.loc(), fmt::format("the transform of {} cannot be inverted: "
                                                         "left out",
                                                         light.p.what()));
    return false;
  }
  add_texels(picture, MapLayout::kLatLong, light.tables, *map);
  row.c_x = row_bits(light.tables.maps.size());
  light.tables.maps.push_back(*map);
  return true;
}

struct FromTo {
  glm::dvec3 from, to;  ///< world
};
FromTo from_to(LightContext& light) {
  const glm::dvec3 from = light.p.triple("from", ParameterType::kPoint, glm::dvec3(0.));
  const glm::dvec3 to = light.p.triple("to", ParameterType::kPoint, glm::dvec3(0., 0., 1.));
  return {transform_point(light.entry.to_world, from), transform_point(light.entry.to_world, to)};
}

/// A unit vector; empty, and an error, where both points are the same.
std::optional<glm::dvec3> direction(LightContext& light, const glm::dvec3& way) {
  const double length = glm::length(way);
  if (length > 0 && std::isfinite(length)) return way / length;
  light.p.diagnostics().error(
      light.loc(), fmt::format("{} has no direction (\"from\" and \"to\" are the same point): "
                               "left out",
                               light.p.what()));
  return std::nullopt;
}

/// A number of degrees in [low, high]; the fallback, and a warning, where it is another.
double degrees(LightContext& light, std::string_view name, float fallback, double low,
               double high) {
  const auto value = double(light.p.number(name, fallback));
  if (value >= low && value <= high) return value;
  light.p.diagnostics().warning(
      light.p.loc(name), fmt::format("\"{}\" is {} degrees, but must be from {} to {}: {} is used",
                                     name, value, low, high, fallback));
  return double(fallback);
}

}  // namespace

void compile_point(LightContext& light) {
  Parameters& p = light.p;
  const glm::dvec3 intensity = light_intensity(light, 4 * kPi);
  const glm::dvec3 from = p.triple("from", ParameterType::kPoint, glm::dvec3(0.));
  const std::optional<LightPicture> picture =
      read_distribution(p, light.colour.reflectance, light.description);
  LightRow<Value> row = light_row(LightKind::kPoint, intensity);
  // YART's points do not fall off.
  const bool by_yart = light.description.dialect == Dialect::kYart;
  (by_yart ? row.b_y : row.b_x) = 1;
  // Light to world is T(from) * CTM: `from` is neither turned nor scaled. In YART it is both.
  const glm::dvec3 at = by_yart ? transform_point(light.entry.to_world, from)
                                : from + transform_point(light.entry.to_world, glm::dvec3(0.));
  if (!place(light, at, row)) return;
  if (!picture) return light.add(row);
  if (!add_map(light, *picture, row)) return;
  // Divided by the mean of the map, so that the flux stays.
  const double mean =
      picture_cells(light.tables.maps.back(), light.tables, glm::dvec3(1.), light.colour.film)
          .average();
  const glm::dvec3 scaled = mean > 0 ? intensity / mean : glm::dvec3(0.);
  LightRow<Value> mapped = light_row(LightKind::kPointMap, scaled);
  mapped.a_x = row.a_x;
  mapped.a_y = row.a_y;
  mapped.a_z = row.a_z;
  mapped.c_x = row.c_x;
  mapped.extra = float(mean);
  light.add(mapped);
}

void compile_spot(LightContext& light) {
  const double cone = degrees(light, "coneangle", 30, 0, 180);
  double falloff = double(light.p.number("conedeltaangle", 5));
  if (!(falloff >= 0 && falloff <= cone)) {
    const double used = std::min(5., cone);
    light.p.diagnostics().warning(
        light.p.loc("conedeltaangle"),
        fmt::format("\"conedeltaangle\" is {} degrees, but must be from 0 to \"coneangle\": {} is "
                    "used",
                    falloff, used));
    falloff = used;
  }
  const auto cos_cone = float(std::cos(cone * kPi / 180));
  const double cos_full = std::cos((cone - falloff) * kPi / 180);
  LightRow<Value> row = light_row(
      LightKind::kSpot, light_intensity(light, 2 * kPi * (1 - (cos_full + double(cos_cone)) / 2)));
  const FromTo ends = from_to(light);
  const auto axis = direction(light, ends.to - ends.from);
  if (!axis || !place(light, ends.from, row)) return;
  row.b_x = float(axis->x);
  row.b_y = float(axis->y);
  row.b_z = float(axis->z);
  row.extra = cos_cone;
  // A rim without falloff is one of a millionth, less than the cosine's own rounding.
  row.c_x = float(1 / std::max(cos_full - double(cos_cone), 1e-6));
  light.add(row);
}

void compile_projection(LightContext& light) {
  Parameters& p = light.p;
  const glm::dvec3 intensity = light_color(p, light.description, light.colour).bands;
  const double fov = degrees(light, "fov", 45, 1e-3, 179.9);
  const std::string map_name = p.text("mapname", "");
  std::optional<LightPicture> picture;
  if (!map_name.empty())
    picture = read_light_picture(p, map_name, 1, light.colour.reflectance, light.description);
  if (!picture) picture = LightPicture{1, 1, {glm::vec3(1.f)}};
  LightRow<Value> row = light_row(LightKind::kProjection, intensity);
  if (!place(light, transform_point(light.entry.to_world, glm::dvec3(0.)), row) ||
      !add_map(light, *picture, row))
    return;
  // The window follows the camera's rule: fov spans the shorter side.
  const double aspect = double(picture->width) / double(picture->height);
  const double side = std::tan(fov / 2 * kPi / 180);
  const double half_x = aspect > 1 ? side * aspect : side;
  const double half_y = aspect > 1 ? side : side / aspect;
  const double area = 4 * side * side / aspect;
  row.b_x = float(half_x);
  row.b_y = float(half_y);
  row.extra = float(1 / area);
  // Flux: the integral of map / (area cos^4) over solid angles, cos^3 dx dy of the window.
  const LightMapRow<Value>& map = light.tables.maps.back();
  constexpr int kSteps = 64;
  double flux = 0;
  for (int j = 0; j < kSteps; ++j)
    for (int i = 0; i < kSteps; ++i) {
      const double s = (i + .5) / kSteps, t = (j + .5) / kSteps;
      const double x = (2 * s - 1) * half_x, y = (2 * t - 1) * half_y;
      const glm::dvec3 bands = texel_colour(map, light.tables.texels.data(), s * map.width - .5,
                                            t * map.height - .5, false);
      flux += luminance(to_rgb(bands, light.colour.film)) * std::sqrt(1 + x * x + y * y);
    }
  row.b_z = float(flux * 4 * half_x * half_y / (kSteps * kSteps) / area);
  light.add(row);
}

void compile_distant(LightContext& light) {
  const glm::dvec3 irradiance = light_color(light.p, light.description, light.colour).bands;
  const FromTo ends = from_to(light);
  const double theta = degrees(light, "theta", 0, 0, 90);
  const auto way = direction(light, ends.from - ends.to);
  if (!way) return;
  // The cosine as stored decides the solid angle, so that the irradiance is right however small the
  // disc; where it rounds to 1 the light is a direction.
  const auto cosine = float(std::cos(theta * kPi / 180));
  LightRow<Value> row =
      cosine < 1 ? light_row(LightKind::kDistant, irradiance / (2 * kPi * (1 - double(cosine))))
                 : light_row(LightKind::kDistant, irradiance);
  row.a_x = float(way->x);
  row.a_y = float(way->y);
  row.a_z = float(way->z);
  row.extra = cosine;
  light.add(row);
}

}  // namespace yat

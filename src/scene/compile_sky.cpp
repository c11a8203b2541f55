// Sun and sky in absolute units, candela per square metre (lxs 6.5).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scene/daylight.h"
#include "scene/light_compiler.h"

namespace yat {

namespace {

constexpr double kPi = std::numbers::pi;

/// Unit vector towards the sun, in light space; the fallback is LuxRender's for the light.
glm::dvec3 sun_direction(LightContext& light, const glm::dvec3& fallback) {
  const glm::dvec3 given = light.p.triple("sundir", ParameterType::kVector, fallback);
  const double length = glm::length(given);
  if (length > 0 && std::isfinite(length)) return given / length;
  light.p.diagnostics().warning(light.p.loc("sundir"),
                                "\"sundir\" is no direction: the default is used");
  return fallback;
}

/// Below this range the formula of the sky is negative around the zenith; above it, at noon.
double turbidity(LightContext& light) {
  constexpr double kLeast = 1.7, kMost = 30;
  const auto value = double(light.p.number("turbidity", 2));
  if (value >= kLeast && value <= kMost) return value;
  const double used = value > kMost ? kMost : kLeast;
  light.p.diagnostics().warning(light.p.loc("turbidity"),
                                fmt::format("\"turbidity\" is {}, but must be from {} to {}: {} is "
                                            "used",
                                            value, kLeast, kMost, used));
  return used;
}

double gain(LightContext& light) {
  const auto value = double(light.p.number("gain", 1));
  if (value >= 0 && std::isfinite(value)) return value;
  light.p.diagnostics().warning(light.p.loc("gain"), "\"gain\" is negative or infinite: 0 is used");
  return 0;
}

}  // namespace

void compile_sun(LightContext& light) {
  Parameters& p = light.p;
  const glm::dvec3 sun = sun_direction(light, glm::dvec3(0, 0, -1));
  auto size = double(p.number("relsize", 1));
  if (!(size > 0 && size <= kLargestSun)) {
    p.diagnostics().warning(
        p.loc("relsize"), fmt::format("\"relsize\" is {}, but must be above 0 and at most {}: 1 is "
                                      "used",
                                      size, kLargestSun));
    size = 1;
  }
  const double haze = turbidity(light), scale = gain(light);
  const glm::dvec3 way = light.linear() * sun;
  const double length = glm::length(way);
  if (!(length > 0) || !std::isfinite(length)) {
    p.diagnostics().error(light.loc(),
                          fmt::format("the transform of {} cannot be inverted: no sun", p.what()));
    return;
  }
  const glm::dvec3 axis = way / length;
  if (!(axis.z > 0)) {
    p.diagnostics().warning(light.loc(), "the sun is below the horizon: it does not shine");
    return;
  }
  const glm::dvec3 rgb = glm::max(sun_radiance(axis.z, haze), glm::dvec3(0.));
  LightRow<Value> row =
      light_row(LightKind::kSun, to_bands(rgb * (scale / (size * size)), light.colour.light));
  row.a_x = float(axis.x);
  row.a_y = float(axis.y);
  row.a_z = float(axis.z);
  const double sin = size * kSunSine;
  row.extra = float(sin * sin / (1 + std::sqrt(1 - sin * sin)));
  light.add(row);
}

void compile_sky(LightContext& light) {
  Parameters& p = light.p;
  const std::string& type = p.plugin().type;
  const glm::dvec3 sun = sun_direction(light, glm::dvec3(0, 0, 1));
  SkySettings settings;
  settings.turbidity = turbidity(light);
  settings.gain = gain(light);
  if (type == "sky2" || type == "sunsky2") {
    p.diagnostics().warning(light.loc(),
                            fmt::format("{}: the data of its sky (Hosek, Wilkie 2012) are not part "
                                        "of yat: \"sky\" is used",
                                        p.what()));
  } else {
    static constexpr std::string_view kNames[5][2] = {{"aconst", "horizonbrightness"},
                                                      {"bconst", "horizonsize"},
                                                      {"cconst", "sunhalobrightness"},
                                                      {"dconst", "sunhalosize"},
                                                      {"econst", "backscattering"}};
    for (size_t i = 0; i < 5; ++i)
      settings.factor[i] = double(p.number(kNames[i][0], p.number(kNames[i][1], 1)));
  }
  if (sun.z < 0)
    p.diagnostics().warning(light.loc(),
                            "the sun is below the horizon, where the formula of the sky has not "
                            "been fitted");
  const auto sky = make_sky(settings, sun);
  auto map = make_light_map(light.linear());
  if (!sky || !map)
    return p.diagnostics().error(light.loc(), fmt::format("the sky of {} has no finite colours, or "
                                                          "its transform no inverse: no sky",
                                                          p.what()));
  const CellMeans cells = sky_cells(*sky, light.colour.light, light.colour.film);
  const double mean = cells.average();
  LightRow<Value> row =
      light_row(LightKind::kSky, glm::dvec3(mean > 0 && std::isfinite(mean) ? 1. : 0.));
  row.extra = float(mean);
  row.c_y = float(cells.unevenness());
  add_cells(cells, light.tables, *map);
  row.c_x = row_bits(light.tables.maps.size());
  row.b_x = row_bits(light.tables.skies.size());
  light.tables.maps.push_back(*map);
  light.tables.skies.push_back(*sky);
  light.add(row);
}

}  // namespace yat

// Lights -> light rows, and how often each is chosen (lxs 6).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scene/alias_table.h"
#include "scene/compile_parts.h"

namespace yat {

namespace {

constexpr double kPi = std::numbers::pi;

/// A colour of a light: L, and L times gain, with negative and non-finite channels as 0.
struct LightColor {
  glm::dvec3 bands;  ///< of L times gain
  double y;          ///< luminance of L, without gain
};
LightColor light_color(Parameters& p, const Description& description, const ColourModel& colour) {
  const glm::dvec3 given = color_parameter(p, "L", glm::dvec3(1.), description);
  const auto gain = double(p.number("gain", 1));
  const auto clean = [](glm::dvec3 color) {
    for (int i = 0; i < 3; ++i)
      if (!(color[i] >= 0 && std::isfinite(color[i]))) color[i] = 0;
    return color;
  };
  const glm::dvec3 scaled = given * gain, color = clean(scaled);
  if (color != scaled)
    p.diagnostics().warning(p.loc(p.given("L") ? "L" : "gain"),
                            fmt::format("the colour of {} has negative or infinite channels: 0 is "
                                        "used for them",
                                        p.what()));
  const glm::dvec3 own = to_bands(clean(given), colour.light);
  return {to_bands(color, colour.light), luminance(to_rgb(own, colour.film))};
}

LightRow<Value> light_row(LightKind kind, const glm::dvec3& radiance) {
  LightRow<Value> row{};
  row.kind = uint32_t(kind);
  row.radiance_r = float(radiance.x);
  row.radiance_g = float(radiance.y);
  row.radiance_b = float(radiance.z);
  return row;
}

bool is_black(const LightRow<Value>& row) {
  return !(row.radiance_r > 0 || row.radiance_g > 0 || row.radiance_b > 0);
}

/// A matrix applied to a point, its last row taken as 0 0 0 w (lxs section 11).
glm::dvec3 transform_point(const Matrix& m, const glm::dvec3& p) {
  const glm::dvec4 q = m * glm::dvec4(p, 1.);
  return glm::dvec3(q) / q.w;
}

bool is_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::optional<LightRow<Value>> point_light(Parameters& p, const LightEntry& entry,
                                           const Description& description,
                                           const ColourModel& colour, const glm::dvec3& center) {
  auto [intensity, y] = light_color(p, description, colour);
  const double lumen = double(p.number("power", 0)) * double(p.number("efficacy", 0));
  const glm::dvec3 from = p.triple("from", ParameterType::kPoint, glm::dvec3(0.));
  p.unsupported({"mapname", "iesname"}, "the light shines evenly in all directions");
  p.accept({"flipz", "importance", "nsamples"});
  if (lumen > 0) {
    const double k = lumen / (4 * kPi * y);
    if (std::isfinite(k) && k > 0)
      intensity *= k;
    else
      p.diagnostics().warning(p.plugin().loc,
                              "the light has power but \"L\" is black: it does not shine");
  }
  // Light to world is T(from) * CTM: `from` is neither turned nor scaled.
  const glm::dvec3 position = from + transform_point(entry.to_world, glm::dvec3(0.)) - center;
  if (!is_finite(position)) {
    p.diagnostics().error(p.plugin().loc, "the light has no finite position: left out");
    return std::nullopt;
  }
  LightRow<Value> row = light_row(LightKind::kPoint, intensity);
  row.a_x = float(position.x);
  row.a_y = float(position.y);
  row.a_z = float(position.z);
  return row;
}

std::optional<LightRow<Value>> distant_light(Parameters& p, const LightEntry& entry,
                                             const Description& description,
                                             const ColourModel& colour) {
  const glm::dvec3 irradiance = light_color(p, description, colour).bands;
  const glm::dvec3 from = p.triple("from", ParameterType::kPoint, glm::dvec3(0.));
  const glm::dvec3 to = p.triple("to", ParameterType::kPoint, glm::dvec3(0., 0., 1.));
  auto theta = double(p.number("theta", 0));
  p.accept({"importance", "nsamples"});
  if (!(theta >= 0 && theta <= 90)) {
    p.diagnostics().warning(p.loc("theta"),
                            fmt::format("\"theta\" is {} degrees, but must be from 0 to 90: 0 is "
                                        "used",
                                        theta));
    theta = 0;
  }
  const glm::dvec3 way =
      transform_point(entry.to_world, from) - transform_point(entry.to_world, to);
  const double length = glm::length(way);
  if (!(length > 0) || !std::isfinite(length)) {
    p.diagnostics().error(p.plugin().loc,
                          "light \"distant\" has no direction (\"from\" and \"to\" "
                          "are the same point): left out");
    return std::nullopt;
  }
  // The cosine as stored decides the solid angle, so that the irradiance is right however small the
  // disc; where it rounds to 1 the light is a direction.
  const auto cosine = float(std::cos(theta * kPi / 180));
  LightRow<Value> row =
      cosine < 1 ? light_row(LightKind::kDistant, irradiance / (2 * kPi * (1 - double(cosine))))
                 : light_row(LightKind::kDistant, irradiance);
  row.a_x = float(way.x / length);
  row.a_y = float(way.y / length);
  row.a_z = float(way.z / length);
  row.extra = cosine;
  return row;
}

}  // namespace

std::optional<AreaLight> compile_area_light(const AreaLightEntry& entry,
                                            const Description& description,
                                            const ColourModel& colour, Diagnostics& diagnostics) {
  const Plugin& plugin = entry.plugin;
  if (plugin.type != "area") {
    diagnostics.error(
        plugin.loc, fmt::format("unknown area light \"{}\"{}: the shapes do not shine", plugin.type,
                                did_you_mean(plugin.type, {"area"})));
    for (const Parameter& p : plugin.parameters) p.used = true;
    return std::nullopt;
  }
  Parameters p(plugin, "area light", diagnostics);
  AreaLight light;
  light.loc = plugin.loc;
  const LightColor color = light_color(p, description, colour);
  light.color = color.bands;
  light.luminance = color.y;
  light.power = double(p.number("power", 100));
  light.efficacy = double(p.number("efficacy", 17));
  p.unsupported({"mapname", "iesname"}, "the light shines evenly (Lambertian)");
  p.accept({"importance", "nsamples", "flipz"});
  p.report_unused();
  return light;
}

glm::dvec3 area_light_radiance(const AreaLight& light, double area, Diagnostics& diagnostics) {
  const double lumen = light.power * light.efficacy;
  if (!(lumen > 0)) return light.color;
  const double k = lumen / (area * kPi * light.luminance);
  if (k > 0 && std::isfinite(k)) return light.color * k;
  diagnostics.warning(light.loc,
                      "the area light has power but no area or a black \"L\": \"L\" times "
                      "\"gain\" is taken as its radiance");
  return light.color;
}

void compile_light(const LightEntry& entry, const Description& description,
                   const ColourModel& colour, const glm::dvec3& center,
                   std::vector<LightRow<Value>>& rows, Diagnostics& diagnostics) {
  const Plugin& plugin = entry.plugin;
  Parameters p(plugin, "light \"" + plugin.type + "\"", diagnostics);
  std::optional<LightRow<Value>> row;
  if (plugin.type == "point" || plugin.type == "goniometric") {
    row = point_light(p, entry, description, colour, center);
  } else if (plugin.type == "distant") {
    row = distant_light(p, entry, description, colour);
  } else {
    static const std::vector<std::string_view> kKnown = {
        "point",          "goniometric", "distant", "spot", "projection", "infinite",
        "infinitesample", "sun",         "sky",     "sky2", "sunsky",     "sunsky2"};
    if (std::find(kKnown.begin(), kKnown.end(), plugin.type) != kKnown.end())
      diagnostics.warning(plugin.loc,
                          fmt::format("light \"{}\" is not yet supported: left out", plugin.type));
    else
      diagnostics.error(plugin.loc, fmt::format("unknown light \"{}\"{}: left out", plugin.type,
                                                did_you_mean(plugin.type, kKnown)));
    p.accept_all();
  }
  p.report_unused();
  if (row && is_black(*row))
    diagnostics.warning(plugin.loc, fmt::format("{} is black: left out", p.what()));
  else if (row)
    rows.push_back(*row);
}

double light_power(const LightRow<Value>& light, const ColourModel& colour, double scene_radius) {
  const glm::dvec3 bands(light.radiance_r, light.radiance_g, light.radiance_b);
  const double y = luminance(to_rgb(bands, colour.film));
  const auto extra = double(light.extra);
  switch (LightKind(light.kind)) {
    case LightKind::kTriangle:
      return kPi * extra * y;
    case LightKind::kSphere:
      return kPi * 4 * kPi * extra * extra * y;
    case LightKind::kPoint:
      return 4 * kPi * y;
    case LightKind::kDistant:
      return kPi * scene_radius * scene_radius * (extra < 1 ? 2 * kPi * (1 - extra) * y : y);
    case LightKind::kCount:
      break;
  }
  return 0;
}

void finish_lights(std::vector<LightRow<Value>> rows, double scene_radius, Scene& scene) {
  std::vector<double> power;
  for (const LightRow<Value>& row : rows)
    power.push_back(light_power(row, scene.colour, scene_radius));
  const AliasTable table = make_alias_table(power);
  scene.lights.resize(uint32_t(rows.size()));
  scene.light_choice.resize(uint32_t(rows.size()));
  scene.light_kinds = 0;
  for (uint32_t i = 0; i < rows.size(); ++i) {
    rows[i].probability = table.probability[i];
    scene.lights.set(i, rows[i]);
    scene.light_choice.set(i, table.choice[i]);
    scene.light_kinds |= 1u << rows[i].kind;
  }
}

}  // namespace yat

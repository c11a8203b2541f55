// Lights -> light rows, and how often each is chosen (lxs 6).

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scene/compile_emission.h"
#include "scene/light_choosing.h"
#include "scene/light_compiler.h"

namespace yat {

namespace {

constexpr double kPi = std::numbers::pi;

bool is_black(const LightRow<Value>& row) {
  return !(row.radiance_r > 0 || row.radiance_g > 0 || row.radiance_b > 0);
}

}  // namespace

LightColor light_color(Parameters& p, const Description& description, const ColourModel& colour) {
  return light_color(p, color_parameter(p, "L", glm::dvec3(1.), description), colour);
}

LightColor light_color(Parameters& p, const glm::dvec3& given, const ColourModel& colour) {
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

namespace {

/// YART's one factor for the units of area and point lights: no area, no colour, and the defaults
/// hold for both (lxs 12.5).
double yart_power(Parameters& p) {
  const auto power = double(p.number("power", 100)), efficacy = double(p.number("efficacy", 17));
  return power != 0 || efficacy != 0 ? power * efficacy / 100 : 1;
}

/// "nsamples": shadow rays at a hit in YART's ray tracer.
uint32_t light_samples(Parameters& p) {
  const int32_t samples = p.integer("nsamples", 1);
  if (samples >= 1 && samples <= 65536) return uint32_t(samples);
  p.diagnostics().warning(
      p.loc("nsamples"),
      fmt::format("\"nsamples\" is {}, but must be from 1 to 65536: 1 is used", samples));
  return 1;
}

}  // namespace

glm::dvec3 light_intensity(LightContext& light, double solid_angle) {
  const LightColor color = light_color(light.p, light.description, light.colour);
  if (light.description.dialect == Dialect::kYart) return color.bands * yart_power(light.p);
  const double lumen = double(light.p.number("power", 0)) * double(light.p.number("efficacy", 0));
  if (!(lumen > 0)) return color.bands;
  const double k = lumen / (solid_angle * color.y);
  if (std::isfinite(k) && k > 0) return color.bands * k;
  light.p.diagnostics().warning(light.loc(),
                                "the light has power but \"L\" is black: it does not shine");
  return color.bands;
}

LightRow<Value> light_row(LightKind kind, const glm::dvec3& radiance) {
  LightRow<Value> row{};
  row.kind = uint32_t(kind);
  row.radiance_r = float(radiance.x);
  row.radiance_g = float(radiance.y);
  row.radiance_b = float(radiance.z);
  return row;
}

float row_bits(size_t row) {
  return std::bit_cast<float>(uint32_t(row));
}
uint32_t row_of_bits(float bits) {
  return std::bit_cast<uint32_t>(bits);
}

glm::dvec3 transform_point(const Matrix& m, const glm::dvec3& p) {
  const glm::dvec4 q = m * glm::dvec4(p, 1.);
  return glm::dvec3(q) / q.w;
}

void LightContext::add(const LightRow<Value>& row) {
  if (is_black(row))
    p.diagnostics().warning(loc(), fmt::format("{} is black: left out", p.what()));
  else
    rows.push_back(row);
}

std::optional<AreaLight> compile_area_light(const AreaLightEntry& entry,
                                            const Description& description,
                                            EmissionCompiler& emission, Diagnostics& diagnostics) {
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
  const LightColor color = emission.color(p, light.look);
  light.color = color.bands;
  light.luminance = color.y;
  if (description.dialect == Dialect::kYart) {
    light.color *= yart_power(p);
    light.power = light.efficacy = 0;
  } else {
    light.power = double(p.number("power", 100));
    light.efficacy = double(p.number("efficacy", 17));
  }
  light.samples = light_samples(p);
  light.look.distribution = emission.distribution(p);
  // Where they are counted from.
  if (light.look.distribution != kNone) light.look.uv = std::max(light.look.uv, UvUse::kIfThere);
  p.accept({"importance"});
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

std::optional<SphereLamp> compile_sphere_lamp(const LightEntry& entry,
                                              const Description& description,
                                              const ColourModel& colour, Diagnostics& diagnostics) {
  if (entry.plugin.type != "point") return std::nullopt;
  Parameters p(entry.plugin, "light \"point\"", diagnostics);
  SphereLamp lamp;
  lamp.center = transform_point(entry.to_world, glm::dvec3(0.));
  lamp.radiance = light_color(p, description, colour).bands * yart_power(p);
  lamp.samples = light_samples(p);
  p.unsupported({"mapname", "iesname"}, "the light shines evenly in all directions");
  p.accept({"from", "flipz", "importance"});
  p.report_unused();
  return lamp;
}

void compile_light(const LightEntry& entry, const Description& description,
                   const ColourModel& colour, const glm::dvec3& center, LightTables& tables,
                   std::vector<LightRow<Value>>& rows, Diagnostics& diagnostics) {
  const std::string& type = entry.plugin.type;
  Parameters p(entry.plugin, "light \"" + type + "\"", diagnostics);
  p.accept({"importance", "nsamples"});
  LightContext light{p, entry, description, colour, center, tables, rows};
  if (type == "point" || type == "goniometric") {
    compile_point(light);
  } else if (type == "spot") {
    compile_spot(light);
  } else if (type == "projection") {
    compile_projection(light);
  } else if (type == "distant") {
    compile_distant(light);
  } else if (type == "infinite" || type == "infinitesample") {
    compile_infinite(light);
  } else if (type == "sun") {
    compile_sun(light);
  } else if (type == "sky" || type == "sky2") {
    compile_sky(light);
  } else if (type == "sunsky" || type == "sunsky2") {
    compile_sun(light);
    compile_sky(light);
  } else {
    static const std::vector<std::string_view> kKnown = {
        "point",          "goniometric", "distant", "spot", "projection", "infinite",
        "infinitesample", "sun",         "sky",     "sky2", "sunsky",     "sunsky2"};
    diagnostics.error(entry.plugin.loc, fmt::format("unknown light \"{}\"{}: left out", type,
                                                    did_you_mean(type, kKnown)));
    p.accept_all();
  }
  p.report_unused();
}

double light_power(const LightRow<Value>& light, const ColourModel& colour, double scene_radius) {
  const glm::dvec3 bands(light.radiance_r, light.radiance_g, light.radiance_b);
  const double y = luminance(to_rgb(bands, colour.film));
  const auto extra = double(light.extra);
  // What passes through the scene of an environment of mean luminance 1.
  const double cross_section = kPi * scene_radius * scene_radius, sphere = 4 * kPi;
  switch (LightKind(light.kind)) {
    case LightKind::kTriangle:
    case LightKind::kRectangle:
    case LightKind::kShape:
      return kPi * extra * y;
    case LightKind::kSphere:
      return kPi * sphere * extra * extra * y;
    case LightKind::kPoint:
      return light.b_y > 0 ? cross_section * y : sphere * y;
    case LightKind::kPointMap:
      return sphere * y;
    case LightKind::kDistant:
      return cross_section * (extra < 1 ? 2 * kPi * (1 - extra) * y : y);
    case LightKind::kSpot:
      return 2 * kPi * (1 - extra - .5 / double(light.c_x)) * y;
    case LightKind::kProjection:
      return double(light.b_z) * y;
    case LightKind::kConstant:
      return cross_section * sphere * y;
    case LightKind::kImage:
    case LightKind::kSky:
      return cross_section * sphere * extra;
    case LightKind::kSun:
      return cross_section * 2 * kPi * extra * y;
    case LightKind::kCount:
      break;
  }
  return 0;
}

void finish_lights(std::vector<LightRow<Value>> rows, const LightTables& tables,
                   const CompileOptions& options, ThreadPool& pool, Scene& scene) {
  prepare_light_choice(rows, options, pool, scene);
  scene.lights.resize(uint32_t(rows.size()));
  scene.light_kinds = 0;
  for (uint32_t i = 0; i < rows.size(); ++i) {
    scene.lights.set(i, rows[i]);
    scene.light_kinds |= 1u << rows[i].kind;
  }

  scene.light_maps.resize(uint32_t(tables.maps.size()));
  for (uint32_t i = 0; i < tables.maps.size(); ++i) scene.light_maps.set(i, tables.maps[i]);
  scene.skies.resize(uint32_t(tables.skies.size()));
  for (uint32_t i = 0; i < tables.skies.size(); ++i) scene.skies.set(i, tables.skies[i]);
  if (!tables.texels.empty()) scene.light_texels = std::span<const float>(tables.texels);
  if (!tables.cells.empty()) scene.light_cells = std::span<const float>(tables.cells);
}

}  // namespace yat

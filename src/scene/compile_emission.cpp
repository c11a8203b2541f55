#include "scene/compile_emission.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "kernels/textures/clamp.h"

namespace yat {

namespace {

/// Colours of textures as bands of lights.
ColourModel of_lights(const ColourModel& colour) {
  return {colour.light, colour.light, colour.film};
}

/// Axes of a triangle light: z its normal, x along dp/du or, where there is none, the first edge.
glm::dmat3 axes_of(const LightRow<Value>& light, const EmissionRow<Value>& row) {
  const glm::dvec3 b(light.b_x, light.b_y, light.b_z), c(light.c_x, light.c_y, light.c_z);
  const glm::dvec3 z = glm::normalize(glm::cross(b, c));
  const double v1 = double(row.v1) - double(row.v0), v2 = double(row.v2) - double(row.v0),
               u1 = double(row.u1) - double(row.u0), u2 = double(row.u2) - double(row.u0);
  const double span = u1 * v2 - v1 * u2;
  glm::dvec3 along = span != 0 ? (v2 * b - v1 * c) / span : b;
  along -= glm::dot(along, z) * z;
  if (!(glm::length(along) > 0)) along = b;
  const glm::dvec3 x = glm::normalize(along);
  return {x, glm::cross(z, x), z};
}

/// Bands of a distribution over directions divided by 4 times its mean over all of them: a light of
/// radiance L over the area A sends pi A L in all, and L A f / (4 mean) into a direction.
LightMapRow<Value> add_distribution(const LightPicture& picture, const ColourModel& colour,
                                    LightTables& tables) {
  LightMapRow<Value> map = *make_light_map(glm::dmat3(1.));
  add_texels(picture, MapLayout::kLatLong, tables, map);
  const double mean = picture_cells(map, tables, glm::dvec3(1.), colour.film).average();
  for (size_t i = size_t(map.texels) * kTexelWords; i < tables.texels.size(); ++i)
    tables.texels[i] = float(double(tables.texels[i]) / (4 * mean));
  return map;
}

}  // namespace

EmissionCompiler::EmissionCompiler(const Description& description, const ColourModel& colour,
                                   Diagnostics& diagnostics, ImageStore& images)
    : description_(description),
      colour_(of_lights(colour)),
      pictures_(colour.reflectance),
      diagnostics_(diagnostics),
      textures_(description, colour_, diagnostics, 0, TextureUse::kLight, &images) {}

LightColor EmissionCompiler::color(Parameters& p, EmissionLook& look) {
  const TextureValue l = textures_.color(p, "L", glm::dvec3(1.));
  if (!l.varies()) return light_color(p, l.constant, colour_);
  const glm::dvec3 mean = to_bands(glm::max(l.constant, glm::dvec3(0.)), colour_.light);
  double grey = luminance(to_rgb(mean, colour_.film));
  // About the mean may be black where the texture is not.
  if (!(grey > 0)) grey = std::max(0., l.most);
  if (!(grey > 0) || !std::isfinite(1 / float(grey)))
    return light_color(p, glm::dvec3(0.), colour_);
  TextureGraph& graph = textures_.graph();
  const TextureGraph::Input from = textures_.node(l);
  const TextureGraph::Input scaled{
      graph.add<ClampParameters>(StepKind::kClamp, 0,
                                 {0, std::numeric_limits<float>::max(), float(1 / grey)}, {from},
                                 graph[from.node].outputs),
      0};
  const TexturePrograms::Ref made = programs_.add_light(scaled, graph);
  look.program = made.program;
  look.parameter = made.row;
  look.uv = programs_.uv(made.program);
  return light_color(p, glm::dvec3(grey), colour_);
}

uint32_t EmissionCompiler::distribution(Parameters& p) {
  std::optional<LightPicture> picture = read_distribution(p, pictures_, description_);
  if (!picture) return kNone;
  const auto shines = [](const glm::vec3& c) { return c.x > 0 || c.y > 0 || c.z > 0; };
  if (std::none_of(picture->texels.begin(), picture->texels.end(), shines)) {
    diagnostics_.error(p.loc(p.given("iesname") ? "iesname" : "mapname"),
                       fmt::format("what {} sends into directions is 0 in all of them: it shines "
                                   "evenly (Lambertian)",
                                   p.what()));
    return kNone;
  }
  distributions_.push_back(std::move(*picture));
  return uint32_t(distributions_.size() - 1);
}

void EmissionCompiler::finish(Scene& scene) {
  scene.emission_programs = programs_.finish(textures_.graph(), scene.center, textures_.images());
}

void EmissionRows::add(uint32_t light, const EmissionLook& look, uint32_t prim) {
  EmissionRow<Value> row{};
  row.program = look.program;
  row.parameter = look.parameter;
  row.map = kNone;
  row.prim = prim;
  entries_.push_back({light, row, kNone, glm::dmat3(1.)});
}

void EmissionRows::add_triangle(uint32_t light, const EmissionLook& look, uint32_t prim,
                                const LightRow<Value>& triangle,
                                const TriangleVertexRow<Value>* vertices, bool mirrored) {
  add(light, look, prim);
  Entry& entry = entries_.back();
  if (vertices) {
    const TriangleVertexRow<Value>& v = *vertices;
    EmissionRow<Value>& row = entry.row;
    row.u0 = v.u0, row.v0 = v.v0;
    row.u1 = mirrored ? v.u2 : v.u1, row.v1 = mirrored ? v.v2 : v.v1;
    row.u2 = mirrored ? v.u1 : v.u2, row.v2 = mirrored ? v.v1 : v.v2;
  }
  entry.distribution = look.distribution;
  if (look.distribution != kNone) entry.axes = axes_of(triangle, entry.row);
}

void EmissionRows::finish(uint32_t lights, const EmissionCompiler& emission, LightTables& tables,
                          Scene& scene) const {
  if (entries_.empty()) return;
  EmissionRow<Value> even{};
  even.program = even.map = kNone;
  scene.emission.resize(lights);
  for (uint32_t i = 0; i < lights; ++i) scene.emission.set(i, even);
  std::vector<std::optional<LightMapRow<Value>>> maps(emission.distributions().size());
  for (const Entry& entry : entries_) {
    EmissionRow<Value> row = entry.row;
    if (entry.distribution != kNone) {
      auto& known = maps[entry.distribution];
      if (!known)
        known =
            add_distribution(emission.distributions()[entry.distribution], scene.colour, tables);
      LightMapRow<Value> map = *known;
      if (const auto turned = make_light_map(entry.axes)) {
        map = *turned;
        map.layout = known->layout;
        map.texels = known->texels;
        map.width = known->width;
        map.height = known->height;
      }
      row.map = uint32_t(tables.maps.size());
      tables.maps.push_back(map);
    }
    scene.emission.set(entry.light, row);
  }
}

}  // namespace yat

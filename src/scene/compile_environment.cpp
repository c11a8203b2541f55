// Environments of one colour or an image: infinite, infinitesample (lxs 6.4).

#include <fmt/format.h>

#include <cmath>

#include "scene/light_compiler.h"

namespace yat {

namespace {

MapLayout map_layout(Parameters& p) {
  const std::string name = p.text("mapping", "latlong");
  if (name == "angular") return MapLayout::kAngular;
  if (name == "vcross") return MapLayout::kCross;
  if (name != "latlong")
    p.diagnostics().error(p.loc("mapping"),
                          fmt::format("unknown mapping \"{}\"{}: latlong is used", name,
                                      did_you_mean(name, {"latlong", "angular", "vcross"})));
  return MapLayout::kLatLong;
}

}  // namespace

void compile_infinite(LightContext& light) {
  Parameters& p = light.p;
  const bool by_yart = light.description.dialect == Dialect::kYart;
  glm::dvec3 radiance = light_color(p, light.description, light.colour).bands;
  const std::string name = p.text("mapname", "");
  const MapLayout layout = map_layout(p);
  auto gamma = double(p.number("gamma", 1));
  glm::dmat3 to_world = light.linear();
  if (by_yart && !name.empty()) {
    // The picture as it is, half a turn about z against LuxRender's (lxs 12.5).
    radiance = glm::dvec3(1.);
    gamma = 1;
    to_world = glm::dmat3(-1, 0, 0, 0, -1, 0, 0, 0, 1);
  }
  // The table by which directions are drawn has the size that yat gives it.
  p.accept({"imapmaxresolution"});
  if (name.empty()) return light.add(light_row(LightKind::kConstant, radiance));
  const auto picture =
      read_light_picture(p, name, gamma, light.colour.reflectance, light.description);
  if (!picture) return light.add(light_row(LightKind::kConstant, radiance));
  auto map = make_light_map(to_world);
  if (!map)
    return p.diagnostics().error(
        light.loc(), fmt::format("the transform of {} cannot be inverted: left out", p.what()));
  add_texels(*picture, layout, light.tables, *map);
  const CellMeans cells = picture_cells(*map, light.tables, radiance, light.colour.film);
  const double mean = cells.average();
  LightRow<Value> row = light_row(LightKind::kImage, mean > 0 ? radiance : glm::dvec3(0.));
  row.extra = float(mean);
  row.c_y = float(cells.unevenness());
  add_cells(cells, light.tables, *map);
  row.c_x = row_bits(light.tables.maps.size());
  light.tables.maps.push_back(*map);
  light.add(row);
}

}  // namespace yat

// "color imagemap" by YART's rules (lxs 12.7): the nearest texel as it is, v = 0 at the bottom row,
// mapped by uv or in the space of the shape.

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "kernels/textures/map_planar.h"
#include "kernels/textures/map_round.h"
#include "kernels/textures/map_surface.h"
#include "scene/compile_parts.h"
#include "scene/compile_texture_image.h"

namespace yat {

namespace {

ImageWrap read_wrap(TextureContext& c) {
  if (!c.p.given("wrap")) {
    c.diagnostics().warning(
        c.loc(),
        fmt::format("{} has no \"wrap\", without which YART stops: repeat is used", c.what()));
    return ImageWrap::kRepeat;
  }
  const std::string name = c.p.text("wrap", "");
  if (name == "repeat") return ImageWrap::kRepeat;
  if (name == "black") return ImageWrap::kBlack;
  if (name == "clamp") return ImageWrap::kClamp;
  c.diagnostics().warning(
      c.p.loc("wrap"), fmt::format("{}: YART has no wrap \"{}\"{}: repeat is used", c.what(), name,
                                   did_you_mean(name, {"repeat", "black", "clamp"})));
  return ImageWrap::kRepeat;
}

/// Coefficients of object space's axis k in world space, and the offset.
glm::dvec4 object_row(const Matrix& to_object, int k) {
  return {to_object[0][k], to_object[1][k], to_object[2][k], to_object[3][k]};
}

TextureGraph::Input map_uv(TextureContext& c) {
  return {c.graph().add<MapSurfaceParameters>(StepKind::kMapSurface, 0, {1, 0, -1, 1}, {}, 2), 0};
}

/// s and t, rows down, of a surface.
TextureGraph::Input map_of(TextureContext& c) {
  const std::string mapping = c.p.text("mapping", "uv");
  const bool planar = mapping == "planar", spherical = mapping == "spherical";
  if (!planar && !spherical) {
    if (mapping != "uv")
      c.diagnostics().warning(
          c.p.loc("mapping"),
          fmt::format("{}: YART has no mapping \"{}\"{}: uv is used", c.what(), mapping,
                      did_you_mean(mapping, {"uv", "spherical", "planar"})));
    return map_uv(c);
  }
  const Matrix to_object = glm::inverse(c.textures.shape_to_world());
  const glm::dvec4 x = object_row(to_object, 0), y = object_row(to_object, 1),
                   z = object_row(to_object, 2);
  // A shape whose transform cannot be inverted is left out: what it would look like is no matter.
  if (!std::isfinite(glm::dot(x, x) + glm::dot(y, y) + glm::dot(z, z))) return map_uv(c);
  if (planar) {
    // s = x, t = 1 - y.
    const std::vector<double> rows = {x.x, x.y, x.z, x.w, -y.x, -y.y, -y.z, 1 - y.w};
    return {c.graph().add<MapPlanarParameters>(StepKind::kMapPlanar, 0, {}, {}, 2, rows), 0};
  }
  // s = atan2(x, z) in turns, t the angle from y: LuxRender's mapping with z, x, y for x, y, z.
  std::vector<double> rows;
  for (const glm::dvec4& row : {z, x, y})
    for (int k = 0; k < 4; ++k) rows.push_back(row[k]);
  MapRoundParameters<Value> constants{};
  constants.s_scale = constants.t_scale = 1;
  return {c.graph().add<MapRoundParameters>(StepKind::kMapRound, 0, constants, {}, 2, rows), 0};
}

}  // namespace

TextureValue yart_imagemap(TextureContext& c) {
  const ImageLook look{.wrap = read_wrap(c)};
  c.p.accept({"gain", "gamma", "uscale", "vscale", "udelta", "vdelta", "filtertype", "channel",
              "maxanisotropy", "discardmipmaps", "v1", "v2"});
  return image_texture(c, look, map_of(c));
}

}  // namespace yat

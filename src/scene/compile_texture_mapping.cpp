// From surfaces to texture space (lxs 8.1, 8.2).

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include "kernels/textures/map_planar.h"
#include "kernels/textures/map_round.h"
#include "kernels/textures/map_solid.h"
#include "kernels/textures/map_surface.h"
#include "scene/compile_textures.h"

namespace yat {

namespace {

/// x, y, z and the offset of each row.
std::vector<double> rows_of(const Matrix& m) {
  std::vector<double> rows;
  for (int r = 0; r < 3; ++r)
    for (int k = 0; k < 4; ++k) rows.push_back(m[k][r]);
  return rows;
}

bool is_usable(const Matrix& m) {
  const double determinant = glm::determinant(glm::dmat3(m));
  return std::isfinite(determinant) && determinant != 0;
}

}  // namespace

TextureGraph::Input map_2d(TextureContext& c, bool footprint) {
  Parameters& p = c.p;
  std::string mapping = p.text("mapping", "uv");
  const float s_scale = p.number("uscale", 1), t_scale = p.number("vscale", 1);
  const float s_delta = p.number("udelta", 0), t_delta = p.number("vdelta", 0);
  const glm::dvec3 v1 = p.triple("v1", ParameterType::kVector, {1, 0, 0});
  const glm::dvec3 v2 = p.triple("v2", ParameterType::kVector, {0, 1, 0});
  const uint32_t outputs = footprint ? 4 : 2;
  if (mapping != "uv" && mapping != "spherical" && mapping != "cylindrical" &&
      mapping != "planar") {
    c.diagnostics().error(
        p.loc("mapping"),
        fmt::format("{}: unknown mapping \"{}\"{}: uv is used", c.what(), mapping,
                    did_you_mean(mapping, {"uv", "spherical", "cylindrical", "planar"})));
    mapping = "uv";
  }
  if (mapping == "planar") {
    const std::vector<double> rows = {v1.x, v1.y, v1.z, double(s_delta),
                                      v2.x, v2.y, v2.z, double(t_delta)};
    return {c.graph().add<MapPlanarParameters>(StepKind::kMapPlanar, 0, {}, {}, outputs, rows), 0};
  }
  if (mapping == "spherical" || mapping == "cylindrical") {
    Matrix to_texture(1.);
    if (is_usable(c.entry.to_world))
      to_texture = glm::inverse(c.entry.to_world);
    else
      c.diagnostics().error(c.loc(),
                            c.what() + ": its transform is singular or not finite: left out");
    MapRoundParameters<Value> constants{};
    constants.s_scale = s_scale;
    constants.s_delta = s_delta;
    constants.t_scale = t_scale;
    constants.t_delta = t_delta;
    return {c.graph().add<MapRoundParameters>(StepKind::kMapRound, mapping == "cylindrical",
                                              constants, {}, outputs, rows_of(to_texture)),
            0};
  }
  return {c.graph().add<MapSurfaceParameters>(StepKind::kMapSurface, 0,
                                              {s_scale, s_delta, t_scale, t_delta}, {}, outputs),
          0};
}

TextureGraph::Input map_3d(TextureContext& c, bool own_scale) {
  Parameters& p = c.p;
  std::string coordinates = p.text("coordinates", "global");
  const glm::dvec3 translate = p.triple("translate", ParameterType::kVector, glm::dvec3(0.));
  const glm::dvec3 rotate = p.triple("rotate", ParameterType::kVector, glm::dvec3(0.));
  const glm::dvec3 scale =
      own_scale ? p.triple("scale", ParameterType::kVector, glm::dvec3(1.)) : glm::dvec3(1.);
  // CTM S(1 / scale) Rx Ry Rz T(-translate); LuxRender takes the CTM itself, not its inverse.
  Matrix m = glm::scale(c.entry.to_world, 1. / scale);
  m = glm::rotate(m, glm::radians(rotate.x), glm::dvec3(1, 0, 0));
  m = glm::rotate(m, glm::radians(rotate.y), glm::dvec3(0, 1, 0));
  m = glm::rotate(m, glm::radians(rotate.z), glm::dvec3(0, 0, 1));
  m = glm::translate(m, -translate);
  if (!is_usable(m)) {
    c.diagnostics().error(c.loc(),
                          c.what() + ": its 3D mapping is singular or not finite: left out");
    m = Matrix(1.);
  }
  static constexpr std::array<std::string_view, 5> kCoordinates = {"global", "uv", "globalnormal",
                                                                   "local", "localnormal"};
  if (coordinates == "local" || coordinates == "localnormal") {
    c.diagnostics().warning(
        p.loc("coordinates"),
        fmt::format("{}: \"{}\" coordinates are taken in world space", c.what(), coordinates));
    coordinates = coordinates == "local" ? "global" : "globalnormal";
  }
  uint32_t form = 0;
  if (coordinates == "uv")
    form = 1;
  else if (coordinates == "globalnormal")
    form = 2;
  else if (coordinates != "global")
    c.diagnostics().error(
        p.loc("coordinates"),
        fmt::format("{}: unknown coordinates \"{}\"{}: global is used", c.what(), coordinates,
                    did_you_mean(coordinates, {kCoordinates.begin(), kCoordinates.end()})));
  if (form == 0)
    return {c.graph().add<MapSolidParameters>(StepKind::kMapSolid, 0, {}, {}, 3, rows_of(m)), 0};
  MapSolidParameters<Value> constants{};
  const auto set = [](float& to, double from) { to = float(from); };
  set(constants.m_xx, m[0][0]), set(constants.m_xy, m[1][0]), set(constants.m_xz, m[2][0]);
  set(constants.m_yx, m[0][1]), set(constants.m_yy, m[1][1]), set(constants.m_yz, m[2][1]);
  set(constants.m_zx, m[0][2]), set(constants.m_zy, m[1][2]), set(constants.m_zz, m[2][2]);
  set(constants.x, m[3][0]), set(constants.y, m[3][1]), set(constants.z, m[3][2]);
  return {c.graph().add<MapSolidParameters>(StepKind::kMapSolid, form, constants, {}, 3), 0};
}

}  // namespace yat

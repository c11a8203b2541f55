// Shape statements -> shapes in object space (lxs 5, 12.4), and where they are put.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "scene/read_shapes.h"

namespace yat {

std::optional<Placement> make_placement(const Matrix& matrix, SourceLoc loc,
                                        const std::string& what, Diagnostics& diagnostics) {
  const double w = matrix[3][3];
  const bool affine = matrix[0][3] == 0 && matrix[1][3] == 0 && matrix[2][3] == 0;
  if (!affine || w != 1)
    diagnostics.warning(loc, affine ? "the transform's last row is 0 0 0 w: divided by w"
                                    : "the transform is not affine: its last row is taken as 0 0 0 "
                                      "w");
  Placement placement;
  placement.linear = glm::dmat3(matrix) * (1 / w);
  placement.origin = glm::dvec3(matrix[3]) / w;
  const double determinant = glm::determinant(placement.linear);
  // Size of the determinant if the columns were at right angles.
  const double size = glm::length(placement.linear[0]) * glm::length(placement.linear[1]) *
                      glm::length(placement.linear[2]);
  if (!std::isfinite(size) || !std::isfinite(glm::length(placement.origin)) ||
      !(std::abs(determinant) > 1e-12 * size)) {
    diagnostics.error(loc,
                      fmt::format("the transform of {} is singular or not finite: left out", what));
    return std::nullopt;
  }
  placement.normal_map = glm::transpose(glm::inverse(placement.linear));
  placement.mirrored = determinant < 0;
  // A similarity keeps spheres round. Matrices come from numbers of 7 digits, so 1e-5 is exact.
  const double scale = std::cbrt(std::abs(determinant));
  const glm::dmat3 gram = glm::transpose(placement.linear) * placement.linear;
  bool round = true;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      round = round && std::abs(gram[i][j] / (scale * scale) - (i == j)) < 1e-5;
  if (round) placement.scale = scale;
  return placement;
}

namespace {

constexpr std::string_view kMeshes[] = {"mesh", "trianglemesh", "waldtrianglemesh",
                                        "barytrianglemesh", "loopsubdiv"};
constexpr std::string_view kLeftOut[] = {"nurbs", "hairfile", "lenscomponent"};

template <size_t n>
bool is_one_of(std::string_view type, const std::string_view (&names)[n]) {
  return std::find(std::begin(names), std::end(names), type) != std::end(names);
}

/// What an unknown type may have meant.
std::vector<std::string_view> all_types() {
  std::vector<std::string_view> all = {"sphere",      "disk",    "cylinder", "cone",  "paraboloid",
                                       "hyperboloid", "torus",   "box",      "plane", "plymesh",
                                       "heightfield", "stlmesh", "deferred"};
  all.insert(all.end(), std::begin(kMeshes), std::end(kMeshes));
  all.insert(all.end(), std::begin(kLeftOut), std::end(kLeftOut));
  return all;
}

bool read_plane(Parameters& p, CompiledShape& shape) {
  shape.kind = CompiledShape::Kind::kPlane;
  // YART's scenes write N, where names match in any case.
  const char* const name = p.given("N") && !p.given("n") ? "N" : "n";
  shape.normal = p.triple(name, ParameterType::kNormal, shape.normal);
  p.accept({"name"});
  const double length = glm::length(shape.normal);
  if (length > 0 && std::isfinite(length)) return true;
  p.diagnostics().error(p.loc(name), "the plane's normal \"n\" is zero: left out");
  return false;
}

bool read_box(Parameters& p, Mesh& mesh) {
  const glm::dvec3 half(double(p.number("width", 1)), double(p.number("height", 1)),
                        double(p.number("depth", 1)));
  p.accept({"name"});
  make_box(half, mesh);
  return true;
}

bool read_shape(Parameters& p, std::string_view type, const ShapeEntry& entry,
                const Description& description, CompiledShape& shape) {
  if (is_one_of(type, kMeshes))
    return read_mesh(p, entry.to_world, description.dialect, shape.mesh);
  if (type == "plymesh") return read_plymesh(p, description, shape.mesh);
  if (type == "stlmesh") return read_stlmesh(p, description, shape.mesh);
  if (type == "heightfield") return read_heightfield(p, shape.mesh);
  if (type == "box") return read_box(p, shape.mesh);
  if (type == "plane") return read_plane(p, shape);
  if (is_analytic(type)) return read_analytic(p, type, shape);
  p.accept_all();
  if (is_one_of(type, kLeftOut))
    p.diagnostics().warning(p.plugin().loc,
                            fmt::format("shape \"{}\" is not supported: left out", type));
  else
    p.diagnostics().error(p.plugin().loc, fmt::format("unknown shape \"{}\"{}: left out", type,
                                                      did_you_mean(type, all_types())));
  return false;
}

}  // namespace

std::optional<CompiledShape> compile_shape(const ShapeEntry& entry, const Description& description,
                                           Diagnostics& diagnostics) {
  Parameters p(entry.plugin, "shape \"" + entry.plugin.type + "\"", diagnostics);
  std::string type = entry.plugin.type;
  if (type == "deferred") {
    // Built at once; the box says only where the shape would be found.
    type = p.text("shapename", "");
    p.accept({"shapebbox"});
  }
  CompiledShape shape;
  const bool usable = read_shape(p, type, entry, description, shape);
  p.report_unused();
  if (!usable) return std::nullopt;
  return shape;
}

}  // namespace yat

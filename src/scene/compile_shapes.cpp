// Shape statements -> meshes, spheres and planes in object space (lxs 5, 12.4).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "scene/compile_parts.h"
#include "scene/ply.h"

namespace yat {

namespace {

constexpr double kPi = std::numbers::pi;

glm::dvec3 vertex(std::span<const float> positions, size_t i) {
  return {double(positions[3 * i]), double(positions[3 * i + 1]), double(positions[3 * i + 2])};
}

/// Parameters of meshes that change nothing here, or not yet.
void accept_mesh_names(Parameters& p) {
  p.accept({"name", "acceltype", "tritype", "quadtype", "generatetangents", "C", "A", "gamma",
            "subdivscheme", "displacementmap", "dmscale", "dmoffset", "dmnormalsmooth",
            "dmsharpboundary", "dmnormalsplit", "projection", "cam"});
  if (p.texture("displacementmap"))
    p.diagnostics().warning(p.loc("displacementmap"),
                            "\"displacementmap\" is not yet supported: the surface stays as it is");
  const std::string_view levels = p.given("nsubdivlevels") ? "nsubdivlevels" : "nlevels";
  if (p.integer(levels, 0) > 0)
    p.diagnostics().warning(p.loc(levels),
                            "subdivision is not yet supported: the base mesh is rendered");
}

/// Whole polygons of `corners` vertices each. False, and an error, if an index is out of range.
bool check_indices(Parameters& p, std::string_view name, std::span<const int32_t> indices,
                   uint32_t vertices) {
  for (size_t i = 0; i < indices.size(); ++i)
    if (indices[i] < 0 || uint32_t(indices[i]) >= vertices) {
      p.diagnostics().error(
          p.loc(name), fmt::format("index {} at place {} of \"{}\" is out of range: there are {} "
                                   "vertices; the mesh is left out",
                                   indices[i], i, name, vertices));
      return false;
    }
  return true;
}

std::span<const int32_t> whole_polygons(Parameters& p, std::string_view name,
                                        std::span<const int32_t> indices, size_t corners) {
  const size_t rest = indices.size() % corners;
  if (rest)
    p.diagnostics().error(
        p.loc(name), fmt::format("\"{}\" has {} numbers, which is not a multiple of {}: the "
                                 "last {} {} dropped",
                                 name, indices.size(), corners, rest, rest == 1 ? "is" : "are"));
  return indices.first(indices.size() - rest);
}

/// A per-vertex array, or nothing and an error if its length is wrong.
std::span<const float> per_vertex(Parameters& p, std::string_view name,
                                  std::span<const float> values, size_t each, uint32_t vertices) {
  if (values.empty() || values.size() == each * vertices) return values;
  p.diagnostics().error(
      p.loc(name), fmt::format("\"{}\" has {} numbers where {} vertices need {}: it is ignored",
                               name, values.size(), vertices, each * vertices));
  return {};
}

/// Splits quads along the diagonal that is shorter in world space.
void add_quads(std::span<const int32_t> quads, const Matrix& to_world, Mesh& mesh) {
  const glm::dmat3 linear(to_world);
  const auto squared = [&](uint32_t a, uint32_t b) {
    const glm::dvec3 d = linear * (vertex(mesh.positions, a) - vertex(mesh.positions, b));
    return glm::dot(d, d);
  };
  for (size_t q = 0; q + 3 < quads.size(); q += 4) {
    const uint32_t a = uint32_t(quads[q]), b = uint32_t(quads[q + 1]), c = uint32_t(quads[q + 2]),
                   d = uint32_t(quads[q + 3]);
    const auto& i = squared(a, c) <= squared(b, d) ? std::array<uint32_t, 6>{a, b, c, a, c, d}
                                                   : std::array<uint32_t, 6>{a, b, d, b, c, d};
    mesh.indices.insert(mesh.indices.end(), i.begin(), i.end());
  }
}

/// Vertex normals from the faces around: their sum, each weighted by its area (YART's rule), or the
/// mean of their unit normals (LuxRender's for plymesh).
enum class NormalRule { kAreaSum, kUnitMean };
std::vector<float> vertex_normals(const Mesh& mesh, NormalRule rule) {
  std::vector<glm::dvec3> sums(mesh.vertices(), glm::dvec3(0.));
  std::vector<double> weights(mesh.vertices());
  for (size_t t = 0; t < mesh.indices.size(); t += 3) {
    const uint32_t* i = &mesh.indices[t];
    const glm::dvec3 p0 = vertex(mesh.positions, i[0]);
    const glm::dvec3 n =
        glm::cross(vertex(mesh.positions, i[1]) - p0, vertex(mesh.positions, i[2]) - p0);
    const double length = glm::length(n);
    if (!(length > 0) || !std::isfinite(length)) continue;
    const double weight = rule == NormalRule::kAreaSum ? length : 1;
    for (int k = 0; k < 3; ++k) {
      sums[i[k]] += n / length * weight;
      weights[i[k]] += weight;
    }
  }
  std::vector<float> normals(mesh.positions.size());
  for (size_t v = 0; v < sums.size(); ++v) {
    const double length = glm::length(sums[v]);
    // Where faces cancel out (both sides of a sheet share vertices) zero is kept: each triangle
    // then takes its own normal.
    const glm::dvec3 n = length > 1e-6 * weights[v] ? sums[v] / length : glm::dvec3(0.);
    for (int k = 0; k < 3; ++k) normals[3 * v + size_t(k)] = float(n[k]);
  }
  return normals;
}

bool read_mesh(Parameters& p, const Matrix& to_world, Dialect dialect, Mesh& mesh) {
  mesh.positions = p.floats("P", ParameterType::kPoint, mesh.owned_positions);
  mesh.positions = mesh.positions.first(mesh.positions.size() / 3 * 3);
  const bool old_name = !p.given("triindices") && p.given("indices");
  const std::string_view tri_name = old_name ? "indices" : "triindices";
  std::vector<int32_t> tri_storage, quad_storage;
  auto triangles = p.integers(tri_name, tri_storage);
  auto quads = p.integers("quadindices", quad_storage);
  const std::string_view uv_name = !p.given("uv") && p.given("st") ? "st" : "uv";
  const auto normals = p.floats("N", ParameterType::kNormal, mesh.owned_normals);
  const auto uvs = p.floats(uv_name, ParameterType::kFloat, mesh.owned_uvs);
  accept_mesh_names(p);

  const SourceLoc loc = p.plugin().loc;
  if (mesh.positions.empty()) {
    p.diagnostics().error(loc, fmt::format("{} has no vertices (\"point P\"): left out", p.what()));
    return false;
  }
  if (triangles.empty() && quads.empty()) {
    p.diagnostics().error(loc, fmt::format("{} has no faces (\"integer triindices\" or "
                                           "\"quadindices\"): left out",
                                           p.what()));
    return false;
  }
  const uint32_t n = mesh.vertices();
  triangles = whole_polygons(p, tri_name, triangles, 3);
  quads = whole_polygons(p, "quadindices", quads, 4);
  if (!check_indices(p, tri_name, triangles, n) || !check_indices(p, "quadindices", quads, n))
    return false;
  mesh.normals = per_vertex(p, "N", normals, 3, n);
  mesh.normals_from_file = true;
  mesh.uvs = per_vertex(p, uv_name, uvs, 2, n);
  mesh.indices.assign(triangles.begin(), triangles.end());
  add_quads(quads, to_world, mesh);
  if (dialect == Dialect::kYart && mesh.normals.empty()) {
    mesh.owned_normals = vertex_normals(mesh, NormalRule::kAreaSum);
    mesh.normals = mesh.owned_normals;
    mesh.normals_from_file = false;
  }
  return true;
}

bool read_plymesh(Parameters& p, const Description& description, Mesh& mesh) {
  const std::string name = p.text("filename", "");
  const bool smooth = p.flag("smooth", false);
  accept_mesh_names(p);
  const SourceLoc loc = p.loc("filename");
  const std::string path = find_data_file(name, loc, description, p.diagnostics());
  if (path.empty()) {
    p.diagnostics().error(loc,
                          fmt::format("mesh file \"{}\" not found: the shape is left out", name));
    return false;
  }
  PlyMesh ply;
  try {
    ply = read_ply(path);
  } catch (const PlyError& error) {
    p.diagnostics().error(loc, fmt::format("{}: the shape is left out", error.what()));
    return false;
  }
  for (const std::string& warning : ply.warnings) p.diagnostics().warning(loc, warning);
  mesh.owned_positions = std::move(ply.positions);
  mesh.owned_normals = std::move(ply.normals);
  mesh.owned_uvs = std::move(ply.uvs);
  mesh.indices = std::move(ply.triangles);
  mesh.positions = mesh.owned_positions;
  mesh.uvs = mesh.owned_uvs;
  if (mesh.indices.empty()) {
    p.diagnostics().error(
        loc, fmt::format("mesh file \"{}\" has no faces: the shape is left out", name));
    return false;
  }
  mesh.normals_from_file = !mesh.owned_normals.empty() && !smooth;
  if (!mesh.normals_from_file) mesh.owned_normals = vertex_normals(mesh, NormalRule::kUnitMean);
  mesh.normals = mesh.owned_normals;
  return true;
}

/// The axis-aligned box [-w,w] x [-h,h] x [-d,d], outward, flat.
void make_box(const glm::dvec3& half, Mesh& mesh) {
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < 3; ++k)
      mesh.owned_positions.push_back(float(i >> k & 1 ? half[k] : -half[k]));
  mesh.positions = mesh.owned_positions;
  mesh.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                  2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
}

bool read_sphere(Parameters& p, const ShapeEntry& entry, CompiledShape& shape) {
  auto radius = double(p.number("radius", 1));
  auto z0 = double(p.number("zmin", float(-radius))), z1 = double(p.number("zmax", float(radius)));
  auto phi_max = double(p.number("phimax", 360));
  p.accept({"name"});
  const SourceLoc loc = p.plugin().loc;
  if (!(radius > 0) || !std::isfinite(radius)) {
    p.diagnostics().warning(p.loc("radius"),
                            fmt::format("the sphere's \"radius\" is {}, but must be "
                                        "above 0: left out",
                                        radius));
    return false;
  }
  if (z0 > z1) {
    p.diagnostics().warning(p.loc("zmin"),
                            "the sphere's \"zmin\" is above its \"zmax\": they are "
                            "exchanged");
    std::swap(z0, z1);
  }
  z0 = std::clamp(z0, -radius, radius);
  z1 = std::clamp(z1, -radius, radius);
  phi_max = std::clamp(phi_max, 0., 360.);
  if (!(z1 > z0) || !(phi_max > 0)) {
    p.diagnostics().warning(loc,
                            "nothing is left of the sphere between \"zmin\" and \"zmax\": left "
                            "out");
    return false;
  }
  const bool whole = z0 == -radius && z1 == radius && phi_max == 360;
  shape.light_area = radius * (phi_max * kPi / 180) * (z1 - z0);
  // Whether the transform keeps it round is known here: an instance that squeezes it is rare, and
  // falls back where it is placed.
  const auto placement = make_placement(entry.to_world, loc, p.what(), p.diagnostics());
  if (!placement) return false;
  if (whole && placement->scale) {
    shape.kind = CompiledShape::Kind::kSphere;
    shape.radius = radius;
    return true;
  }
  p.diagnostics().warning(loc,
                          whole ? "a sphere scaled to an ellipsoid is rendered as 65000 triangles"
                                : "part of a sphere is rendered as 65000 triangles");
  shape.mesh = make_sphere_mesh(radius, z0, z1, phi_max * kPi / 180);
  return true;
}

}  // namespace

Mesh make_sphere_mesh(double radius, double z0, double z1, double phi_max) {
  Mesh mesh;
  constexpr uint32_t kRings = 128, kSegments = 256;
  const double theta0 = std::acos(std::clamp(z0 / radius, -1., 1.)),
               theta1 = std::acos(std::clamp(z1 / radius, -1., 1.));
  for (uint32_t j = 0; j <= kRings; ++j)
    for (uint32_t i = 0; i <= kSegments; ++i) {
      const double v = double(j) / kRings, u = double(i) / kSegments;
      const double theta = theta0 + (theta1 - theta0) * v, phi = phi_max * u;
      const glm::dvec3 n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                         std::cos(theta));
      for (int k = 0; k < 3; ++k) {
        mesh.owned_normals.push_back(float(n[k]));
        mesh.owned_positions.push_back(float(radius * n[k]));
      }
      mesh.owned_uvs.push_back(float(u));
      mesh.owned_uvs.push_back(float(v));
    }
  const auto at = [](uint32_t j, uint32_t i) { return j * (kSegments + 1) + i; };
  for (uint32_t j = 0; j < kRings; ++j)
    for (uint32_t i = 0; i < kSegments; ++i) {
      // At a pole one of the two has no area.
      const bool south_pole = j == 0 && theta0 == kPi, north_pole = j + 1 == kRings && theta1 == 0;
      if (!south_pole)
        mesh.indices.insert(mesh.indices.end(), {at(j, i), at(j, i + 1), at(j + 1, i + 1)});
      if (!north_pole)
        mesh.indices.insert(mesh.indices.end(), {at(j, i), at(j + 1, i + 1), at(j + 1, i)});
    }
  mesh.positions = mesh.owned_positions;
  mesh.normals = mesh.owned_normals;
  mesh.uvs = mesh.owned_uvs;
  return mesh;
}

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

std::optional<CompiledShape> compile_shape(const ShapeEntry& entry, const Description& description,
                                           Diagnostics& diagnostics) {
  const Plugin& plugin = entry.plugin;
  const std::string& type = plugin.type;
  Parameters p(plugin, "shape \"" + type + "\"", diagnostics);
  CompiledShape shape;
  bool usable = false;
  if (type == "mesh" || type == "trianglemesh" || type == "waldtrianglemesh" ||
      type == "barytrianglemesh" || type == "loopsubdiv") {
    usable = read_mesh(p, entry.to_world, description.dialect, shape.mesh);
  } else if (type == "plymesh") {
    usable = read_plymesh(p, description, shape.mesh);
  } else if (type == "sphere") {
    usable = read_sphere(p, entry, shape);
  } else if (type == "box") {
    make_box(
        {double(p.number("width", 1)), double(p.number("height", 1)), double(p.number("depth", 1))},
        shape.mesh);
    p.accept({"name"});
    usable = true;
  } else if (type == "plane") {
    shape.kind = CompiledShape::Kind::kPlane;
    shape.normal = p.triple("n", ParameterType::kNormal, shape.normal);
    p.accept({"name"});
    const double length = glm::length(shape.normal);
    usable = length > 0 && std::isfinite(length);
    if (!usable) diagnostics.error(p.loc("n"), "the plane's normal \"n\" is zero: left out");
  } else {
    static const std::vector<std::string_view> kLater = {
        "disk",        "cylinder", "cone",    "paraboloid", "hyperboloid",   "torus",
        "heightfield", "nurbs",    "stlmesh", "hairfile",   "lenscomponent", "deferred"};
    static const std::vector<std::string_view> kAll = [] {
      std::vector<std::string_view> all = {"mesh",   "trianglemesh", "plymesh",
                                           "sphere", "box",          "plane"};
      all.insert(all.end(), kLater.begin(), kLater.end());
      return all;
    }();
    if (std::find(kLater.begin(), kLater.end(), type) != kLater.end())
      diagnostics.warning(plugin.loc,
                          fmt::format("shape \"{}\" is not yet supported: left out", type));
    else
      diagnostics.error(plugin.loc, fmt::format("unknown shape \"{}\"{}: left out", type,
                                                did_you_mean(type, kAll)));
    p.accept_all();
  }
  p.report_unused();
  if (!usable) return std::nullopt;
  return shape;
}

}  // namespace yat

// Mesh statements -> meshes in object space (lxs 5.1, 5.2, 12.4).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scene/ply.h"
#include "scene/read_shapes.h"
#include "scene/stl.h"
#include "scene/subdivide.h"

namespace yat {

namespace {

glm::dvec3 vertex(std::span<const float> positions, size_t i) {
  return {double(positions[3 * i]), double(positions[3 * i + 1]), double(positions[3 * i + 2])};
}

/// Parameters of meshes that change nothing here, or not yet.
void accept_mesh_names(Parameters& p) {
  p.accept({"name", "acceltype", "tritype", "quadtype", "generatetangents", "gamma", "dmscale",
            "dmoffset", "dmnormalsplit", "projection", "cam"});
  for (const std::string_view name : {"C", "A"}) {
    if (p.given(name))
      p.diagnostics().note(p.loc(name),
                           fmt::format("\"{}\": colours of vertices are not used", name));
    p.accept({name});
  }
  if (p.texture("displacementmap"))
    p.diagnostics().warning(p.loc("displacementmap"),
                            "\"displacementmap\" is not yet supported: the surface stays as it is");
  p.accept({"displacementmap"});
}

/// Subdivides the mesh as the statement says. `default_levels`: without nsubdivlevels.
void subdivide_as_said(Parameters& p, Mesh& mesh) {
  const std::string_view name = p.given("nsubdivlevels") ? "nsubdivlevels" : "nlevels";
  const std::string scheme = p.text("subdivscheme", "loop");
  SubdivisionOptions options;
  options.levels = p.integer(name, 0);
  options.smooth_normals = p.flag("dmnormalsmooth", true);
  options.sharp_boundary = p.flag("dmsharpboundary", false);
  if (options.levels <= 0) return;
  if (scheme == "microdisplacement") {
    p.diagnostics().warning(
        p.loc("subdivscheme"),
        "subdivision scheme \"microdisplacement\" is not supported: the surface "
        "stays as it is");
    return;
  }
  if (scheme != "loop")
    p.diagnostics().warning(
        p.loc("subdivscheme"),
        fmt::format("unknown subdivision scheme \"{}\": \"loop\" is used", scheme));
  int most = 0;
  for (uint64_t n = mesh.triangles(); n > 0 && n * 4 <= kMaxSubdivided && most < 30; n *= 4) ++most;
  if (options.levels > most) {
    p.diagnostics().error(
        p.loc(name),
        fmt::format("{} levels of subdivision make 4^{} triangles of each of {}, more than the {} "
                    "that are allowed: {} are used; write \"integer {}\" [{}]",
                    options.levels, options.levels, mesh.triangles(), kMaxSubdivided, most, name,
                    most));
    options.levels = most;
  }
  if (options.levels > 0) subdivide(mesh, options);
}

/// An error at the name of the mesh's file. False: there is no mesh.
bool leave_out(Parameters& p, std::string_view why) {
  p.diagnostics().error(p.loc("filename"), fmt::format("{}: the shape is left out", why));
  return false;
}

/// False, and an error, if an index is out of range.
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

/// Indices of whole polygons of `corners` vertices each; an error where some are left over.
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

}  // namespace

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
  subdivide_as_said(p, mesh);
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
  if (path.empty()) return leave_out(p, fmt::format("mesh file \"{}\" not found", name));
  PlyMesh ply;
  try {
    ply = read_ply(path);
  } catch (const PlyError& error) {
    return leave_out(p, error.what());
  }
  for (const std::string& warning : ply.warnings) p.diagnostics().warning(loc, warning);
  if (ply.colours)
    p.diagnostics().note(loc,
                         fmt::format("mesh file \"{}\": colours of vertices are not used", name));
  mesh.owned_positions = std::move(ply.positions);
  mesh.owned_normals = std::move(ply.normals);
  mesh.owned_uvs = std::move(ply.uvs);
  mesh.indices = std::move(ply.triangles);
  mesh.positions = mesh.owned_positions;
  mesh.uvs = mesh.owned_uvs;
  if (mesh.indices.empty()) return leave_out(p, fmt::format("mesh file \"{}\" has no faces", name));
  mesh.normals_from_file = !mesh.owned_normals.empty() && !smooth;
  if (!mesh.normals_from_file) mesh.owned_normals = vertex_normals(mesh, NormalRule::kUnitMean);
  mesh.normals = mesh.owned_normals;
  subdivide_as_said(p, mesh);
  return true;
}

bool read_stlmesh(Parameters& p, const Description& description, Mesh& mesh) {
  const std::string name = p.text("filename", "");
  const bool recenter = p.flag("recenter_mesh", false);
  accept_mesh_names(p);
  const std::string path = find_data_file(name, p.loc("filename"), description, p.diagnostics());
  if (path.empty()) return leave_out(p, fmt::format("mesh file \"{}\" not found", name));
  try {
    mesh.owned_positions = read_stl(path);
  } catch (const StlError& error) {
    return leave_out(p, error.what());
  }
  if (mesh.owned_positions.empty())
    return leave_out(p, fmt::format("mesh file \"{}\" has no faces", name));
  if (recenter) {
    Bounds bounds;
    for (size_t v = 0; v < mesh.owned_positions.size() / 3; ++v) {
      const glm::dvec3 at = vertex(mesh.owned_positions, v);
      if (std::isfinite(at.x) && std::isfinite(at.y) && std::isfinite(at.z)) bounds.add(at);
    }
    if (!bounds.empty())
      for (size_t i = 0; i < mesh.owned_positions.size(); ++i)
        mesh.owned_positions[i] -= float(bounds.center()[int(i % 3)]);
  }
  mesh.positions = mesh.owned_positions;
  mesh.indices.resize(mesh.vertices());
  for (uint32_t i = 0; i < mesh.vertices(); ++i) mesh.indices[i] = i;
  subdivide_as_said(p, mesh);
  return true;
}

bool read_heightfield(Parameters& p, Mesh& mesh) {
  const int64_t nu = p.integer("nu", 0), nv = p.integer("nv", 0);
  std::vector<float> storage;
  const auto heights = p.floats("Pz", ParameterType::kFloat, storage);
  p.accept({"name"});
  if (nu < 2 || nv < 2) {
    p.diagnostics().error(
        p.loc(nu < 2 ? "nu" : "nv"),
        fmt::format("a heightfield of {} x {} places has no face: left out", nu, nv));
    return false;
  }
  if (uint64_t(nu) * uint64_t(nv) != heights.size()) {
    p.diagnostics().error(p.loc("Pz"),
                          fmt::format("\"Pz\" has {} numbers where \"nu\" x \"nv\" need {}: the "
                                      "heightfield is left out",
                                      heights.size(), nu * nv));
    return false;
  }
  for (int64_t j = 0; j < nv; ++j)
    for (int64_t i = 0; i < nu; ++i) {
      const auto x = float(double(i) / double(nu - 1)), y = float(double(j) / double(nv - 1));
      mesh.owned_positions.insert(mesh.owned_positions.end(), {x, y, heights[size_t(j * nu + i)]});
      mesh.owned_uvs.insert(mesh.owned_uvs.end(), {x, y});
    }
  for (int64_t j = 0; j + 1 < nv; ++j)
    for (int64_t i = 0; i + 1 < nu; ++i) {
      const auto a = uint32_t(j * nu + i), b = a + 1, c = uint32_t(b + nu), d = c - 1;
      mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
    }
  mesh.positions = mesh.owned_positions;
  mesh.uvs = mesh.owned_uvs;
  return true;
}

void make_box(const glm::dvec3& half, Mesh& mesh) {
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < 3; ++k)
      mesh.owned_positions.push_back(float(i >> k & 1 ? half[k] : -half[k]));
  mesh.positions = mesh.owned_positions;
  mesh.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                  2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
}

}  // namespace yat

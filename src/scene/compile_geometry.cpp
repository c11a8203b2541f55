// Placed shapes -> rows in scene space, with the orientation rules of lxs 2.5.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

#include "scene/compile_parts.h"

namespace yat {

namespace {

glm::dvec3 triple(std::span<const float> values, size_t i) {
  return {double(values[3 * i]), double(values[3 * i + 1]), double(values[3 * i + 2])};
}

bool is_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Vertex normals in the world, unit; (0,0,0) where the given one is zero or not finite.
std::vector<glm::dvec3> world_normals(const Mesh& mesh, const PlacedShape& placed) {
  std::vector<glm::dvec3> normals(mesh.normals.size() / 3);
  for (size_t v = 0; v < normals.size(); ++v) {
    const glm::dvec3 n = placed.placement.normal_map * triple(mesh.normals, v);
    const double length = glm::length(n);
    if (length > 0 && std::isfinite(length))
      normals[v] = n * ((placed.reverse_orientation ? -1 : 1) / length);
    else
      normals[v] = glm::dvec3(0.);
  }
  return normals;
}

/// A vertex normal that kernels may rely on: unit, on the side of the outside `g`. One that points
/// behind its triangle (coarse meshes near their outline) is laid into the triangle's plane, which
/// moves it as little as possible.
glm::dvec3 on_side_of(const glm::dvec3& g, const glm::dvec3& n) {
  const double cosine = glm::dot(n, g);
  if (cosine >= 0 && n != glm::dvec3(0.)) return n;
  const glm::dvec3 flat = n - cosine * g;
  const double length = glm::length(flat);
  return length > 1e-6 ? flat / length : g;
}

std::string counted(uint64_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

/// Interpolated normals this close to the face's own (about rounding of a unit float) shade the
/// same: the mesh is flat, and needs no vertex rows.
constexpr double kFlat = 1e-6;

}  // namespace

double mesh_area(const Mesh& mesh, const Placement& placement) {
  double area = 0;
  for (size_t t = 0; t < mesh.indices.size(); t += 3) {
    const glm::dvec3 p0 = placement.point(triple(mesh.positions, mesh.indices[t]));
    const glm::dvec3 p1 = placement.point(triple(mesh.positions, mesh.indices[t + 1]));
    const glm::dvec3 p2 = placement.point(triple(mesh.positions, mesh.indices[t + 2]));
    const double twice = glm::length(glm::cross(p1 - p0, p2 - p0));
    if (std::isfinite(twice)) area += .5 * twice;
  }
  return area;
}

void add_to_bounds(const PlacedShape& placed, Bounds& bounds) {
  const CompiledShape& shape = *placed.shape;
  if (shape.kind == CompiledShape::Kind::kSphere) {
    // The ellipsoid's extent along an axis is the length of that row of the matrix.
    const glm::dmat3 rows = glm::transpose(placed.placement.linear);
    const glm::dvec3 half =
        shape.radius * glm::dvec3(glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2]));
    bounds.add(placed.placement.origin - half);
    bounds.add(placed.placement.origin + half);
  } else if (shape.kind == CompiledShape::Kind::kMesh) {
    // Only vertices that a face uses: a stray one must not move the centre.
    for (uint32_t i : shape.mesh.indices) {
      const glm::dvec3 p = placed.placement.point(triple(shape.mesh.positions, i));
      if (is_finite(p)) bounds.add(p);
    }
  }
}

uint32_t GeometryRows::bin_key(GeometryKind geometry, const PlacedShape& placed) const {
  return uint32_t(geometry) << 16 | uint32_t(placed.material.kind) << 1 |
         uint32_t(placed.emissive());
}

void GeometryRows::add(const PlacedShape& placed) {
  switch (placed.shape->kind) {
    case CompiledShape::Kind::kMesh:
      return add_mesh(placed, placed.shape->mesh);
    case CompiledShape::Kind::kSphere:
      return add_sphere(placed);
    case CompiledShape::Kind::kPlane:
      return add_plane(placed);
  }
}

void GeometryRows::add_mesh(const PlacedShape& placed, const Mesh& mesh) {
  const auto first = uint32_t(triangles_.size());
  const size_t first_vertex_row = vertices_.size();
  const std::vector<glm::dvec3> normals = world_normals(mesh, placed);
  const bool mirrored = placed.reverse_orientation != placed.placement.mirrored;
  uint64_t no_area = 0, not_finite = 0, bad_normals = 0;
  bool flat = true;
  triangles_.reserve(triangles_.size() + mesh.triangles());

  for (size_t t = 0; t < mesh.indices.size(); t += 3) {
    uint32_t index[3] = {mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]};
    glm::vec3 p[3];
    for (int k = 0; k < 3; ++k)
      p[k] = glm::vec3(placed.placement.point(triple(mesh.positions, index[k])) - center_);
    if (!is_finite(p[0]) || !is_finite(p[1]) || !is_finite(p[2])) {
      ++not_finite;
      continue;
    }
    // Decided on the rounded vertices, as the tree and the kernels see them.
    const glm::dvec3 d0(p[0]), raw = glm::cross(glm::dvec3(p[1]) - d0, glm::dvec3(p[2]) - d0);
    const double length = glm::length(raw);
    if (!(length > 0)) {
      ++no_area;
      continue;
    }
    glm::dvec3 outside = raw * ((mirrored ? -1 : 1) / length);
    bool swap = mirrored;
    if (!normals.empty()) {
      // Vertex normals that agree with each other decide the side.
      int behind = 0, given = 0;
      for (int k = 0; k < 3; ++k) {
        const glm::dvec3& n = normals[index[k]];
        if (n == glm::dvec3(0.)) continue;
        ++given;
        behind += glm::dot(n, outside) < 0;
      }
      bad_normals += uint64_t(3 - given);
      if (given > 0 && behind == given) {
        outside = -outside;
        swap = !swap;
      }
    }
    if (swap) {
      std::swap(p[1], p[2]);
      std::swap(index[1], index[2]);
    }

    TriangleRow<Value> row{};
    row.p0_x = p[0].x, row.p0_y = p[0].y, row.p0_z = p[0].z;
    row.p1_x = p[1].x, row.p1_y = p[1].y, row.p1_z = p[1].z;
    row.p2_x = p[2].x, row.p2_y = p[2].y, row.p2_z = p[2].z;
    for (const glm::vec3& q : p)
      row.extent = std::max({row.extent, std::abs(q.x), std::abs(q.y), std::abs(q.z)});
    row.parameter = placed.material.row;
    row.light = kNone;
    if (placed.emissive()) {
      LightRow<Value> light{};
      light.kind = uint32_t(LightKind::kTriangle);
      const glm::vec3 b = p[1] - p[0], c = p[2] - p[0];
      light.a_x = p[0].x, light.a_y = p[0].y, light.a_z = p[0].z;
      light.b_x = b.x, light.b_y = b.y, light.b_z = b.z;
      light.c_x = c.x, light.c_y = c.y, light.c_z = c.z;
      light.extra = float(.5 * length);
      light.radiance_r = float(placed.radiance.x);
      light.radiance_g = float(placed.radiance.y);
      light.radiance_b = float(placed.radiance.z);
      // An area that a float cannot hold has nothing to sample.
      if (light.extra > 0) {
        row.light = uint32_t(lights_.size());
        lights_.push_back(light);
      }
    }
    triangles_.push_back(row);
    if (normals.empty()) continue;

    TriangleVertexRow<Value> vertex{};
    float* const to[3] = {&vertex.n0_x, &vertex.n1_x, &vertex.n2_x};
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 n = on_side_of(outside, normals[index[k]]);
      const glm::dvec3 off = glm::abs(n - outside);
      flat = flat && std::max({off.x, off.y, off.z}) <= kFlat;
      for (int axis = 0; axis < 3; ++axis) to[k][axis] = float(n[axis]);
    }
    const auto uv = [&](int k, int axis) {
      return mesh.uvs.empty() ? .5f : mesh.uvs[2 * index[k] + size_t(axis)];
    };
    vertex.u0 = uv(0, 0), vertex.v0 = uv(0, 1);
    vertex.u1 = uv(1, 0), vertex.v1 = uv(1, 1);
    vertex.u2 = uv(2, 0), vertex.v2 = uv(2, 1);
    vertices_.push_back(vertex);
  }

  if (flat) vertices_.resize(first_vertex_row);
  if (triangles_.size() > first)
    triangle_runs_.push_back(
        {first,
         bin_key(flat ? GeometryKind::kTriangleFlat : GeometryKind::kTriangleVertex, placed)});
  degenerate_ += uint32_t(no_area + not_finite);
  if (no_area || not_finite) {
    std::string what;
    if (no_area) what = counted(no_area, "triangle has", "triangles have") + " no area";
    if (not_finite)
      what += (no_area ? ", " : "") + counted(not_finite, "triangle has", "triangles have") +
              " a vertex that is NaN or infinite";
    diagnostics_.warning(placed.loc, what + ": left out");
  }
  if (bad_normals && mesh.normals_from_file)
    diagnostics_.warning(
        placed.loc,
        fmt::format("{} zero, NaN or infinite: the face's normal is used there",
                    counted(bad_normals, "corner's normal is", "corners' normals are")));
}

void GeometryRows::add_sphere(const PlacedShape& placed) {
  if (!placed.placement.scale) {
    // Only an instance can do this: compile_shape() has seen the shape's own transform.
    diagnostics_.warning(placed.loc,
                         "an instance scales a sphere to an ellipsoid: it is rendered as "
                         "65000 triangles");
    const double r = placed.shape->radius;
    return add_mesh(placed, make_sphere_mesh(r, -r, r, 2 * std::numbers::pi));
  }
  const glm::vec3 at(placed.placement.origin - center_);
  SphereRow<Value> row{};
  row.center_x = at.x, row.center_y = at.y, row.center_z = at.z;
  row.radius = float(placed.shape->radius * *placed.placement.scale);
  if (!(row.radius > 0) || !std::isfinite(row.radius)) {
    diagnostics_.warning(
        placed.loc, fmt::format("the sphere's radius in the world is {}: left out", row.radius));
    return;
  }
  row.inward = placed.reverse_orientation;
  row.parameter = placed.material.row;
  row.occludes = placed.material.kind != MaterialKind::kNull;
  row.light = kNone;
  if (placed.emissive()) {
    row.light = uint32_t(lights_.size());
    LightRow<Value> light{};
    light.kind = uint32_t(LightKind::kSphere);
    light.a_x = at.x, light.a_y = at.y, light.a_z = at.z;
    light.extra = row.radius;
    light.b_x = row.inward ? 1.f : 0.f;
    light.radiance_r = float(placed.radiance.x);
    light.radiance_g = float(placed.radiance.y);
    light.radiance_b = float(placed.radiance.z);
    lights_.push_back(light);
  }
  spheres_.push_back(row);
  sphere_keys_.push_back(bin_key(GeometryKind::kSphere, placed));
}

void GeometryRows::add_plane(const PlacedShape& placed) {
  const glm::dvec3 normal = glm::normalize(placed.placement.normal_map * placed.shape->normal) *
                            (placed.reverse_orientation ? -1. : 1.);
  PlaneRow<Value> row{};
  row.normal_x = float(normal.x), row.normal_y = float(normal.y), row.normal_z = float(normal.z);
  row.distance = float(glm::dot(normal, placed.placement.origin - center_));
  row.parameter = placed.material.row;
  row.occludes = placed.material.kind != MaterialKind::kNull;
  planes_.push_back(row);
  plane_keys_.push_back(bin_key(GeometryKind::kPlane, placed));
}

void GeometryRows::finish(Scene& scene, std::vector<uint8_t>& occludes) {
  // Bins in the order of their keys, so that they do not depend on the order of shapes.
  std::map<uint32_t, uint32_t> bin_of_key;
  for (const Run& run : triangle_runs_) bin_of_key.emplace(run.key, 0);
  for (uint32_t key : sphere_keys_) bin_of_key.emplace(key, 0);
  for (uint32_t key : plane_keys_) bin_of_key.emplace(key, 0);
  scene.bins.assign(1, Bin{});
  for (auto& [key, bin] : bin_of_key) {
    bin = uint32_t(scene.bins.size());
    scene.bins.push_back(
        {GeometryKind(key >> 16), MaterialKind(key >> 1 & 0x7fff), bool(key & 1), 0});
  }
  static_assert(uint32_t(GeometryKind::kCount) * kMaterialKinds * 2 < kMaxBins);

  const auto n = uint32_t(triangles_.size());
  scene.triangles.resize(n);
  if (!vertices_.empty()) scene.triangle_vertices.resize(n);
  scene.spheres.resize(uint32_t(spheres_.size()));
  scene.planes.resize(uint32_t(planes_.size()));
  scene.prim_bin.resize(n + spheres_.size() + planes_.size());
  scene.all_occlude = true;

  uint32_t prim = 0, vertex_row = 0;
  for (size_t r = 0; r < triangle_runs_.size(); ++r) {
    const uint32_t end = r + 1 < triangle_runs_.size() ? triangle_runs_[r + 1].first : n;
    const uint32_t bin = bin_of_key[triangle_runs_[r].key];
    const bool see_through = scene.bins[bin].material == MaterialKind::kNull;
    if (see_through && occludes.empty()) occludes.assign(n, 1);
    scene.all_occlude = scene.all_occlude && !see_through;
    scene.bins[bin].primitives += end - prim;
    for (; prim < end; ++prim) {
      scene.triangles.set(prim, triangles_[prim]);
      scene.prim_bin[prim] = bin;
      if (see_through) occludes[prim] = 0;
      if (scene.bins[bin].geometry == GeometryKind::kTriangleVertex)
        scene.triangle_vertices.set(prim, vertices_[vertex_row++]);
    }
  }
  for (uint32_t s = 0; s < spheres_.size(); ++s, ++prim) {
    scene.spheres.set(s, spheres_[s]);
    ++scene.bins[scene.prim_bin[prim] = bin_of_key[sphere_keys_[s]]].primitives;
  }
  for (uint32_t p = 0; p < planes_.size(); ++p, ++prim) {
    scene.planes.set(p, planes_[p]);
    ++scene.bins[scene.prim_bin[prim] = bin_of_key[plane_keys_[p]]].primitives;
  }
  scene.degenerate_triangles = degenerate_;
}

}  // namespace yat

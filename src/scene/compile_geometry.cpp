// Placed shapes -> rows in scene space.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scene/compile_parts.h"

namespace yat {

namespace {

glm::dvec3 position(const Mesh& mesh, size_t i) {
  return {double(mesh.positions[3 * i]), double(mesh.positions[3 * i + 1]),
          double(mesh.positions[3 * i + 2])};
}

/// Rows of an analytic shape in the order of its table: so that its veils are a table of their own.
struct VeilsLast {
  std::vector<uint32_t> rows;
  uint32_t first_veil = 0;
  explicit VeilsLast(const std::vector<BinKey>& keys) {
    for (const bool veils : {false, true}) {
      if (veils) first_veil = uint32_t(rows.size());
      for (uint32_t r = 0; r < keys.size(); ++r)
        if ((keys[r].passing == Passing::kVeil) == veils) rows.push_back(r);
    }
  }
};

bool is_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

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
      const glm::dvec3 p = placed.placement.point(position(shape.mesh, i));
      if (is_finite(p)) bounds.add(p);
    }
  }
}

BinKey BinKey::of(GeometryKind geometry, const MaterialRef& material, bool emissive,
                  Placing placing) {
  return {.lasting = emissive || material.passing != Passing::kSolid,
          .placing = placing,
          .geometry = geometry,
          .material = material.kind,
          .split = material.split,
          .passing = material.passing,
          .program = material.program,
          .emissive = emissive,
          .tangents = material.tangents};
}

void BinKeys::number(Scene& scene, Diagnostics& diagnostics) {
  if (bin_of_key_.size() >= kMaxBins)
    diagnostics.fail({}, fmt::format("the scene combines {} kinds of shapes and materials; at most "
                                     "{} are possible: use fewer kinds of materials",
                                     bin_of_key_.size(), kMaxBins - 1));
  scene.bins.assign(1, Bin{});
  scene.first_lasting_bin = 1;
  for (auto& [key, bin] : bin_of_key_) {
    bin = uint32_t(scene.bins.size());
    scene.bins.push_back({.geometry = key.geometry,
                          .material = key.material,
                          .emissive = key.emissive,
                          .tangents = key.tangents,
                          .instanced = key.placing == Placing::kByInstance,
                          .split = key.split,
                          .passing = key.passing,
                          .program = key.program});
    if (!key.lasting) scene.first_lasting_bin = bin + 1;
  }
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
  const MeshRows added =
      add_mesh_rows(placed, mesh, center_, placed.material.uv, triangles_, vertices_, diagnostics_);
  degenerate_ += added.left_out;
  if (triangles_.size() == first) return;
  for (size_t t = first; t < triangles_.size(); ++t) {
    TriangleRow<Value>& row = triangles_[t];
    row.parameter = placed.material.row;
    if (!placed.emissive()) continue;
    const LightRow<Value> light = triangle_light(row, placed.radiance);
    // An area that a float cannot hold has nothing to sample.
    if (!(light.extra > 0)) continue;
    row.light = uint32_t(lights_.size());
    lights_.push_back(light);
  }
  triangle_runs_.push_back(
      {first, BinKey::of(added.flat ? GeometryKind::kTriangleFlat : GeometryKind::kTriangleVertex,
                         placed.material, placed.emissive(), Placing::kOnce)});
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
  row.occludes = placed.material.passing == Passing::kSolid;
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
  sphere_keys_.push_back(
      BinKey::of(GeometryKind::kSphere, placed.material, placed.emissive(), Placing::kOnce));
}

void GeometryRows::add_plane(const PlacedShape& placed) {
  const glm::dvec3 normal = glm::normalize(placed.placement.normal_map * placed.shape->normal) *
                            (placed.reverse_orientation ? -1. : 1.);
  PlaneRow<Value> row{};
  row.normal_x = float(normal.x), row.normal_y = float(normal.y), row.normal_z = float(normal.z);
  row.distance = float(glm::dot(normal, placed.placement.origin - center_));
  row.parameter = placed.material.row;
  row.occludes = placed.material.passing == Passing::kSolid;
  planes_.push_back(row);
  plane_keys_.push_back(
      BinKey::of(GeometryKind::kPlane, placed.material, placed.emissive(), Placing::kOnce));
}

void GeometryRows::add_keys(BinKeys& keys) const {
  for (const Run& run : triangle_runs_) keys.add(run.key);
  for (const BinKey& key : sphere_keys_) keys.add(key);
  for (const BinKey& key : plane_keys_) keys.add(key);
}

void GeometryRows::finish(const BinKeys& keys, Scene& scene, std::vector<uint8_t>& occludes) {
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
    const uint32_t bin = keys.bin(triangle_runs_[r].key);
    const bool see_through = scene.bins[bin].passing != Passing::kSolid;
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
  const auto set = [&](auto& table, const auto& rows, const std::vector<BinKey>& row_keys) {
    const VeilsLast order(row_keys);
    for (uint32_t r = 0; r < rows.size(); ++r, ++prim) {
      table.set(r, rows[order.rows[r]]);
      ++scene.bins[scene.prim_bin[prim] = keys.bin(row_keys[order.rows[r]])].primitives;
    }
    return order.first_veil;
  };
  scene.first_veil_sphere = set(scene.spheres, spheres_, sphere_keys_);
  scene.first_veil_plane = set(scene.planes, planes_, plane_keys_);
  scene.degenerate_triangles += degenerate_;
}

}  // namespace yat

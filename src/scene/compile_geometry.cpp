// Placed shapes -> rows in scene space.

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <span>
#include <utility>

#include "scene/compile_parts.h"
#include "scene/rectangle_lights.h"

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
  if (shape.kind == CompiledShape::Kind::kSphere || shape.kind == CompiledShape::Kind::kAnalytic) {
    const TopBox box = bounds_of(shape.analytic, placed.placement);
    bounds.add({box.min[0], box.min[1], box.min[2]});
    bounds.add({box.max[0], box.max[1], box.max[2]});
  } else if (shape.kind == CompiledShape::Kind::kMesh) {
    // Only vertices that a face uses: a stray one must not move the centre.
    for (uint32_t i : shape.mesh.indices) {
      const glm::dvec3 p = placed.placement.point(position(shape.mesh, i));
      if (is_finite(p)) bounds.add(p);
    }
  }
}

BinKey BinKey::of(GeometryKind geometry, const MaterialRef& material, const Shining& shining,
                  Placing placing) {
  return {.lasting = shining.emissive || material.passing != Passing::kSolid,
          .placing = placing,
          .geometry = geometry,
          .material = material.kind,
          .split = material.split,
          .passing = material.passing,
          .program = material.program,
          .emissive = shining.emissive,
          .tangents = material.tangents,
          .emission_program = shining.program,
          .emission_by_direction = shining.by_direction};
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
                          .program = key.program,
                          .emission_program = key.emission_program,
                          .emission_by_direction = key.emission_by_direction});
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
    case CompiledShape::Kind::kAnalytic:
      return add_shape(placed);
  }
}

void GeometryRows::add_mesh(const PlacedShape& placed, const Mesh& mesh) {
  const auto first = uint32_t(triangles_.size());
  const MeshRows added =
      add_mesh_rows(placed, mesh, center_, placed.material.uv, triangles_, vertices_, diagnostics_);
  const size_t first_vertices = vertices_.size() - (added.flat ? 0 : triangles_.size() - first);
  degenerate_ += added.left_out;
  if (triangles_.size() == first) return;
  std::vector<uint32_t> partner;  // in a rectangle that is one light, counted from `first`
  if (rectangles_ && placed.emissive() && !placed.look.varies())
    partner = find_rectangles(std::span(triangles_).subspan(first));
  for (size_t t = first; t < triangles_.size(); ++t) {
    TriangleRow<Value>& row = triangles_[t];
    row.parameter = placed.material.row;
    if (!placed.emissive()) continue;
    const uint32_t other = partner.empty() ? kNone : partner[t - first];
    if (other < t - first) {
      row.light = triangles_[first + other].light;
      continue;
    }
    const LightRow<Value> light =
        other == kNone
            ? triangle_light(row, placed.radiance)
            : rectangle_light(*rectangle_of(row, triangles_[first + other]), placed.radiance);
    // An area that a float cannot hold has nothing to sample.
    if (!(light.extra > 0)) continue;
    row.light = uint32_t(lights_.size());
    lights_.push_back(light);
    if (placed.look.varies())
      emission_.add_triangle(row.light, placed.look, uint32_t(t), light,
                             added.flat ? nullptr : &vertices_[first_vertices + t - first], false);
  }
  triangle_runs_.push_back(
      {first,
       BinKey::of(added.flat ? GeometryKind::kTriangleFlat : GeometryKind::kTriangleVertex,
                  placed.material, placed.shining(), Placing::kOnce),
       placed.ids()});
}

void GeometryRows::add_sphere(const PlacedShape& placed) {
  if (!placed.placement.scale) return add_shape(placed);
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
  const glm::vec3 x(placed.placement.linear[0] / *placed.placement.scale),
      z(placed.placement.linear[2] / *placed.placement.scale);
  row.x_x = x.x, row.x_y = x.y, row.x_z = x.z;
  row.z_x = z.x, row.z_y = z.y, row.z_z = z.z;
  row.hand = placed.placement.mirrored ? -1.f : 1.f;
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
    if (placed.look.varies()) shape_looks_[row.light] = placed.look;
  }
  spheres_.push_back(row);
  TopBox box;
  const double grow =
      64 * 0x1p-24 *
      double(row.radius + std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}));
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = double(at[axis]) - double(row.radius) - grow;
    box.max[axis] = double(at[axis]) + double(row.radius) + grow;
  }
  sphere_boxes_.push_back(box);
  sphere_ids_.push_back(placed.ids());
  sphere_keys_.push_back(
      BinKey::of(GeometryKind::kSphere, placed.material, placed.shining(), Placing::kOnce));
}

void GeometryRows::add_plane(const PlacedShape& placed) {
  const glm::dvec3 normal = glm::normalize(placed.placement.normal_map * placed.shape->normal) *
                            (placed.reverse_orientation ? -1. : 1.);
  PlaneRow<Value> row{};
  row.normal_x = float(normal.x), row.normal_y = float(normal.y), row.normal_z = float(normal.z);
  row.distance = float(glm::dot(normal, placed.placement.origin - center_));
  // u along object space's x as nearly as the plane has it, v to the left of it: x and y of the
  // usual plane.
  const glm::dvec3 n = glm::normalize(placed.shape->normal);
  const glm::dvec3 x = std::abs(n.x) < .99 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 along = glm::normalize(x - glm::dot(x, n) * n);
  const glm::dvec3 u = placed.placement.normal_map * along,
                   v = placed.placement.normal_map * glm::cross(n, along);
  row.u_x = float(u.x), row.u_y = float(u.y), row.u_z = float(u.z);
  row.v_x = float(v.x), row.v_y = float(v.y), row.v_z = float(v.z);
  row.u_0 = float(glm::dot(u, center_ - placed.placement.origin));
  row.v_0 = float(glm::dot(v, center_ - placed.placement.origin));
  row.parameter = placed.material.row;
  row.occludes = placed.material.passing == Passing::kSolid;
  planes_.push_back(row);
  plane_ids_.push_back(placed.ids());
  plane_keys_.push_back(
      BinKey::of(GeometryKind::kPlane, placed.material, placed.shining(), Placing::kOnce));
}

void GeometryRows::add_shape(const PlacedShape& placed) {
  const AnalyticShape& shape = placed.shape->analytic;
  ShapeRow<Value> row = shape_row(shape, placed.placement, placed.reverse_orientation, center_);
  if (!std::isfinite(row.o_xx + row.w_xx + row.radius) || !(row.radius > 0)) {
    diagnostics_.warning(placed.loc,
                         "the shape's size in the world is beyond what floats hold: left out");
    return;
  }
  row.parameter = placed.material.row;
  row.occludes = placed.material.passing == Passing::kSolid;
  if (placed.emissive()) {
    row.light = uint32_t(lights_.size());
    LightRow<Value> light{};
    light.kind = uint32_t(LightKind::kShape);
    light.extra = float(area_of(shape, placed.placement.linear));
    light.radiance_r = float(placed.radiance.x);
    light.radiance_g = float(placed.radiance.y);
    light.radiance_b = float(placed.radiance.z);
    lights_.push_back(light);
    if (placed.look.varies()) shape_looks_[row.light] = placed.look;
  }
  analytic_.push_back(row);
  analytic_ids_.push_back(placed.ids());
  analytic_boxes_.push_back(traced_bounds(shape, placed.placement, center_));
  analytic_keys_.push_back(BinKey::of(GeometryKind(uint32_t(GeometryKind::kQuadric) + row.kind),
                                      placed.material, placed.shining(), Placing::kOnce));
}

void GeometryRows::add_keys(BinKeys& keys) const {
  for (const Run& run : triangle_runs_) keys.add(run.key);
  for (const BinKey& key : sphere_keys_) keys.add(key);
  for (const BinKey& key : plane_keys_) keys.add(key);
  for (const BinKey& key : analytic_keys_) keys.add(key);
}

void GeometryRows::finish(const BinKeys& keys, Scene& scene, std::vector<uint8_t>& occludes) {
  const auto n = uint32_t(triangles_.size());
  scene.triangles.resize(n);
  if (!vertices_.empty()) scene.triangle_vertices.resize(n);
  scene.prim_bin.resize(n + spheres_.size() + planes_.size() + analytic_.size());
  if (ids_) scene.prim_ids.resize(scene.prim_bin.size());
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
      if (ids_) scene.prim_ids[prim] = triangle_runs_[r].ids;
      if (see_through) occludes[prim] = 0;
      if (scene.bins[bin].geometry == GeometryKind::kTriangleVertex)
        scene.triangle_vertices.set(prim, vertices_[vertex_row++]);
    }
  }
  const auto set = [&](auto& table, const auto& rows, const std::vector<BinKey>& row_keys,
                       const std::vector<SurfaceIds>& ids, const std::vector<uint32_t>& order) {
    table.resize(uint32_t(rows.size()));
    for (uint32_t r = 0; r < rows.size(); ++r, ++prim) {
      table.set(r, rows[order[r]]);
      if (ids_) scene.prim_ids[prim] = ids[order[r]];
      if constexpr (requires { rows[order[r]].light; })
        if (const auto look = shape_looks_.find(rows[order[r]].light); look != shape_looks_.end())
          emission_.add(look->first, look->second, prim);
      ++scene.bins[scene.prim_bin[prim] = keys.bin(row_keys[order[r]])].primitives;
    }
  };
  const VeilsLast sphere_order(sphere_keys_), plane_order(plane_keys_);
  set(scene.spheres, spheres_, sphere_keys_, sphere_ids_, sphere_order.rows);
  set(scene.planes, planes_, plane_keys_, plane_ids_, plane_order.rows);
  scene.first_veil_sphere = sphere_order.first_veil;
  scene.first_veil_plane = plane_order.first_veil;
  const std::vector<uint32_t> shape_order = order_shapes(scene);
  set(scene.shapes, analytic_, analytic_keys_, analytic_ids_, shape_order);
  build_shape_trees(sphere_order.rows, shape_order, scene);
  scene.degenerate_triangles += degenerate_;
}

std::vector<uint32_t> GeometryRows::order_shapes(Scene& scene) {
  std::vector<uint32_t> order(analytic_.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto place = [this](uint32_t row) {
    return std::pair(analytic_[row].kind, analytic_keys_[row].passing == Passing::kVeil);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return place(a) < place(b); });
  for (uint32_t kind = 0; kind < kShapeKinds; ++kind) {
    const auto begin_of = [&](bool veils) {
      return uint32_t(
          std::partition_point(order.begin(), order.end(),
                               [&](uint32_t row) { return place(row) < std::pair(kind, veils); }) -
          order.begin());
    };
    scene.shape_rows[kind] = {begin_of(false), 0};
    scene.veil_shape_rows[kind] = {begin_of(true), 0};
  }
  for (uint32_t kind = 0; kind < kShapeKinds; ++kind) {
    const uint32_t end =
        kind + 1 < kShapeKinds ? scene.shape_rows[kind + 1].first : uint32_t(order.size());
    scene.shape_rows[kind].end = scene.veil_shape_rows[kind].end = end;
  }
  for (uint32_t s = 0; s < order.size(); ++s)
    if (const uint32_t light = analytic_[order[s]].light; light != kNone)
      lights_[light].a_x = std::bit_cast<float>(s);
  return order;
}

void GeometryRows::build_shape_trees(const std::vector<uint32_t>& sphere_order,
                                     const std::vector<uint32_t>& shape_order, Scene& scene) const {
  std::vector<TopBox> all, veils;
  std::vector<uint32_t> veil_items;  // what a leaf of the tree over veils stands for
  uint64_t price = 0, veil_price = 0;
  const auto add = [&](const TopBox& box, const BinKey& key, uint32_t own_price) {
    if (key.passing == Passing::kVeil) {
      veils.push_back(box);
      veil_items.push_back(uint32_t(all.size()));
      veil_price += own_price;
    }
    all.push_back(box);
    price += own_price;
  };
  for (const uint32_t row : sphere_order) add(sphere_boxes_[row], sphere_keys_[row], kSpherePrice);
  for (const uint32_t row : shape_order)
    add(analytic_boxes_[row], analytic_keys_[row], kShapePrice[analytic_[row].kind]);
  if (price > kTriedPrice) scene.shape_tree = build_top_tree(all);
  if (veil_price > kTriedPrice) scene.veil_shape_tree = build_top_tree(veils, veil_items);
}

}  // namespace yat

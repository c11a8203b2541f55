// Shared objects -> triangles and a tree each in object space, and a row per instance.
//
// Object space has its origin in the middle of the object, so that a ray taken there is known to a
// rounding of the object's size, wherever the instance is. An instance's map is what the floats of
// its row say: rays go by the inverse of that, rounded once more, and the bounds below allow for
// what the two roundings move.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "scene/compile_objects.h"
#include "scene/rectangle_lights.h"
#include "scene/tree_parts.h"

namespace yat {

namespace {

constexpr double kUlp = 0x1p-24;  // half an ulp of 1: the relative error of one rounding
/// Boxes of an object's tree that are placed one by one: their union is tighter than the placed
/// box of the whole.
constexpr size_t kPlacedBoxes = 64;

glm::dmat3 absolute(const glm::dmat3& m) {
  return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])};
}

double largest(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// About kPlacedBoxes boxes that hold all that the tree holds.
std::vector<TopBox> outer_boxes(const TreeView& tree) {
  struct Place {
    uint32_t node, child;
  };
  std::vector<Place> places;
  const auto open = [&](uint32_t node) {
    for (uint32_t c = 0; c < 8 && tree.nodes[node].child[c] != kNone; ++c)
      places.push_back({node, c});
  };
  if (tree.node_count) open(0);
  for (size_t i = 0; i < places.size() && places.size() + 7 <= kPlacedBoxes;) {
    const uint32_t child = tree.nodes[places[i].node].child[places[i].child];
    if (child >> 31) {
      ++i;  // a leaf stays
      continue;
    }
    places.erase(places.begin() + ptrdiff_t(i));
    open(child);
  }
  std::vector<TopBox> boxes;
  for (const Place& p : places) {
    const TreeNode& n = tree.nodes[p.node];
    boxes.push_back({{n.min_x[p.child], n.min_y[p.child], n.min_z[p.child]},
                     {n.max_x[p.child], n.max_y[p.child], n.max_z[p.child]}});
  }
  return boxes;
}

glm::dvec3 corner(const TopBox& box, int k) {
  return {k & 1 ? box.max[0] : box.min[0], k & 2 ? box.max[1] : box.min[1],
          k & 4 ? box.max[2] : box.min[2]};
}

float above(double x) {
  return tree::round_up(x);
}

}  // namespace

void ObjectCompiler::build(const TreeOptions& options, ThreadPool& pool, Scene& scene) {
  Instances& out = scene.instances;
  std::vector<TriangleRow<Value>> triangles;
  std::vector<TriangleVertexRow<Value>> vertices;
  std::vector<uint32_t> vertex_triangle;  // whose vertices they are
  objects_.resize(shapes_.objects.size());
  out.objects.resize(objects_.size());
  out.trees.resize(objects_.size());
  for (size_t o = 0; o < objects_.size(); ++o) {
    const SharedShapes::Object& shapes = shapes_.objects[o];
    Object& object = objects_[o];
    Bounds bounds;
    for (const PlacedShape& mesh : shapes.meshes) yat::add_to_bounds(mesh, bounds);
    if (!bounds.empty()) object.center = bounds.center();
    object.first_triangle = uint32_t(triangles.size());
    for (uint32_t m = 0; m < shapes.meshes.size(); ++m) {
      const PlacedShape& mesh = shapes.meshes[m];
      if (mesh.material.kind == MaterialKind::kNull && !mesh.emissive()) continue;
      const auto first = uint32_t(triangles.size());
      const MeshRows added =
          add_mesh_rows(mesh, mesh.shape->mesh, object.center, uv_use(uint32_t(o), m), triangles,
                        vertices, diagnostics_);
      scene.degenerate_triangles += added.left_out;
      if (triangles.size() == first) continue;
      std::vector<uint32_t> partner =
          find_partners(uint32_t(o), mesh, std::span(triangles).subspan(first));
      uint32_t emissive = 0;
      for (size_t t = first; t < triangles.size(); ++t) {
        triangles[t].parameter = uint32_t(object.runs.size());
        const uint32_t other = partner.empty() ? kNone : partner[t - first];
        if (mesh.emissive())
          triangles[t].light = other < t - first ? triangles[first + other].light : emissive++;
        if (!added.flat) vertex_triangle.push_back(uint32_t(t));
      }
      object.emissive = object.emissive || mesh.emissive();
      object.runs.push_back(
          {first, uint32_t(triangles.size()),
           added.flat ? GeometryKind::kTriangleFlat : GeometryKind::kTriangleVertex, mesh.shining(),
           m, std::move(partner)});
    }
    out.objects[o].name = description_.objects[shapes.row].name;
    out.objects[o].first_triangle = object.first_triangle;
    out.objects[o].triangles = uint32_t(triangles.size()) - object.first_triangle;
  }

  const auto n = uint32_t(triangles.size());
  out.triangles.resize(n);
  out.triangle_shape.resize(n);
  if (!vertices.empty()) out.triangle_vertices.resize(n);
  for (uint32_t t = 0; t < n; ++t) {
    out.triangles.set(t, triangles[t]);
    out.triangle_shape[t] = triangles[t].parameter;
  }
  for (size_t v = 0; v < vertices.size(); ++v)
    out.triangle_vertices.set(vertex_triangle[v], vertices[v]);

  for (size_t o = 0; o < objects_.size(); ++o) {
    Object& object = objects_[o];
    SharedObject& shared = out.objects[o];
    std::vector<uint8_t> occludes;
    for (const Run& run : object.runs) {
      if (shapes_.objects[o].meshes[run.mesh].material.kind != MaterialKind::kNull) continue;
      if (occludes.empty()) occludes.assign(shared.triangles, 1);
      std::fill(occludes.begin() + (run.first - object.first_triangle),
                occludes.begin() + (run.end - object.first_triangle), uint8_t(0));
      out.all_occlude = false;
    }
    const Rows<TriangleRow> rows{
        out.triangles.view().words + size_t(object.first_triangle) * row_words<TriangleRow>,
        shared.triangles};
    shared.tree = build_tree(rows, occludes, options, pool);
    out.trees[o] = shared.tree.view;
    object.boxes = outer_boxes(shared.tree.view);
    for (const TopBox& box : object.boxes)
      for (int a = 0; a < 3; ++a)
        object.half[a] = std::max({object.half[a], std::abs(box.min[a]), std::abs(box.max[a])});
  }
}

ObjectCompiler::Map ObjectCompiler::map_of(const Placement& placement,
                                           const glm::dvec3& object_center,
                                           const glm::dvec3& scene_center) {
  Map map;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) map.to_scene[i][j] = double(float(placement.linear[i][j]));
  const glm::dmat3 inverse = glm::inverse(map.to_scene);
  const glm::dvec3 origin = placement.point(object_center) - scene_center;
  for (int i = 0; i < 3; ++i) {
    map.origin[i] = double(float(origin[i]));
    for (int j = 0; j < 3; ++j) map.to_object[i][j] = double(float(inverse[i][j]));
  }
  map.growth = absolute(map.to_scene) * absolute(map.to_object) * glm::dvec3(1.);
  return map;
}

TopBox ObjectCompiler::placed_bounds(const Object& object, const Map& map) {
  Bounds bounds;
  const glm::dmat3 reach = absolute(map.to_scene);
  for (const TopBox& box : object.boxes) {
    const glm::dvec3 low = corner(box, 0), high = corner(box, 7);
    const glm::dvec3 middle = map.to_scene * (.5 * low + .5 * high) + map.origin;
    const glm::dvec3 half = reach * (.5 * high - .5 * low);
    bounds.add(middle - half);
    bounds.add(middle + half);
  }
  TopBox out;
  for (int a = 0; a < 3; ++a) {
    out.min[a] = bounds.min[a];
    out.max[a] = bounds.max[a];
  }
  return out;
}

InstanceRow<Value> ObjectCompiler::row_of(const Object& object, const Map& map) {
  InstanceRow<Value> row{};
  // Nine fields in a row; glm matrices are columns first.
  const auto set = [](const glm::dmat3& m, float* first) {
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) first[3 * r + c] = float(m[c][r]);
  };
  set(map.to_object, &row.o_xx);
  set(map.to_scene, &row.w_xx);
  row.org_x = float(map.origin.x), row.org_y = float(map.origin.y), row.org_z = float(map.origin.z);
  const TopBox box = placed_bounds(object, map);
  double extent = largest(map.origin), radius = 0;
  for (int a = 0; a < 3; ++a)
    extent = std::max({extent, std::abs(box.min[a]), std::abs(box.max[a])});
  for (const TopBox& inner : object.boxes)
    for (int k = 0; k < 8; ++k)
      radius = std::max(radius, glm::length(map.to_scene * corner(inner, k)));
  // Rays start where they enter this sphere (kernels/traverse_instances.h), to a rounding of where
  // the instance is; a hundredth is room for the arithmetic.
  row.radius = above(1.01 * radius + 16 * kUlp * extent);
  row.extent = above(extent);
  // A point of the object, taken to the scene and back, is off by a few roundings of this.
  const glm::dvec3 there_and_back =
      absolute(map.to_object) * (absolute(map.to_scene) * object.half);
  const double size = largest(object.half);
  row.inner_x = above(std::max(size, there_and_back.x));
  row.inner_y = above(std::max(size, there_and_back.y));
  row.inner_z = above(std::max(size, there_and_back.z));
  return row;
}

UvUse ObjectCompiler::uv_use(uint32_t object, uint32_t mesh) const {
  UvUse most = UvUse::kUnread;
  for (const SharedShapes::Instance& instance : shapes_.instances)
    if (instance.object == object)
      most = std::max(most, shapes_.materials[instance.materials][mesh].uv);
  return most;
}

void ObjectCompiler::add_to_bounds(Bounds& bounds) const {
  for (const SharedShapes::Instance& instance : shapes_.instances) {
    const Object& object = objects_[instance.object];
    if (object.boxes.empty()) continue;
    const TopBox box =
        placed_bounds(object, map_of(instance.placement, object.center, glm::dvec3(0.)));
    bounds.add(corner(box, 0));
    bounds.add(corner(box, 7));
  }
}

BinKey ObjectCompiler::key(const Run& run, const MaterialRef& material) const {
  return BinKey::of(run.geometry, material, run.shining, Placing::kByInstance);
}

void ObjectCompiler::add_keys(BinKeys& keys) const {
  for (const SharedShapes::Instance& instance : shapes_.instances) {
    const Object& object = objects_[instance.object];
    if (object.boxes.empty()) continue;
    for (const Run& run : object.runs)
      keys.add(key(run, shapes_.materials[instance.materials][run.mesh]));
  }
}

uint32_t ObjectCompiler::add_shapes(const SharedShapes::Instance& instance, const BinKeys& keys,
                                    std::vector<InstanceShapeRow<Value>>& shapes,
                                    std::vector<uint32_t>& material_ids) const {
  const auto first = uint32_t(shapes.size());
  for (const Run& run : objects_[instance.object].runs) {
    const MaterialRef& material = shapes_.materials[instance.materials][run.mesh];
    shapes.push_back({keys.bin(key(run, material)), material.row, kNone});
    material_ids.push_back(material.id);
  }
  return first;
}

std::vector<uint32_t> ObjectCompiler::find_partners(
    uint32_t object, const PlacedShape& mesh, std::span<const TriangleRow<Value>> triangles) const {
  if (!rectangles_ || !mesh.emissive() || mesh.look.varies()) return {};
  return find_rectangles(triangles, [&](const RectangleSides& sides) {
    return std::all_of(shapes_.instances.begin(), shapes_.instances.end(),
                       [&](const SharedShapes::Instance& instance) {
                         const glm::dmat3& map = instance.placement.linear;
                         return instance.object != object ||
                                is_rectangle(map * sides.b, map * sides.c);
                       });
  });
}

LightRow<Value> ObjectCompiler::placed_light(const TriangleRow<Value>& triangle,
                                             const TriangleRow<Value>* partner, const Map& map,
                                             const glm::dvec3& radiance) {
  const bool mirrored = glm::determinant(map.to_scene) < 0;
  const auto place = [&](RectangleSides s) {
    s = {map.to_scene * s.corner + map.origin, map.to_scene * s.b, map.to_scene * s.c};
    // The outside stays outside: see kernels/surface_instance.h.
    if (mirrored) std::swap(s.b, s.c);
    return s;
  };
  constexpr float kLeast = std::numeric_limits<float>::min();
  if (partner) {
    LightRow<Value> light = rectangle_light(place(*rectangle_of(triangle, *partner)), radiance);
    light.extra = std::max(light.extra, kLeast);
    return light;
  }
  const glm::dvec3 p0(triangle.p0_x, triangle.p0_y, triangle.p0_z);
  const auto [a, b, c] = place({p0, glm::dvec3(triangle.p1_x, triangle.p1_y, triangle.p1_z) - p0,
                                glm::dvec3(triangle.p2_x, triangle.p2_y, triangle.p2_z) - p0});
  LightRow<Value> light{};
  light.kind = uint32_t(LightKind::kTriangle);
  light.a_x = float(a.x), light.a_y = float(a.y), light.a_z = float(a.z);
  light.b_x = float(b.x), light.b_y = float(b.y), light.b_z = float(b.z);
  light.c_x = float(c.x), light.c_y = float(c.y), light.c_z = float(c.z);
  light.extra = std::max(float(.5 * glm::length(glm::cross(b, c))), kLeast);
  light.radiance_r = float(radiance.x);
  light.radiance_g = float(radiance.y);
  light.radiance_b = float(radiance.z);
  return light;
}

void ObjectCompiler::add_lights(const SharedShapes::Instance& instance,
                                const InstanceRow<Value>& row, const Map& map,
                                InstanceShapeRow<Value>* shapes, const Scene& scene,
                                std::vector<LightRow<Value>>& lights,
                                EmissionRows& emission) const {
  const Object& object = objects_[instance.object];
  const bool mirrored = glm::determinant(map.to_scene) < 0;
  const glm::dmat3 normal_map = glm::transpose(map.to_object);
  for (size_t r = 0; r < object.runs.size(); ++r) {
    const Run& run = object.runs[r];
    if (!run.shining.emissive) continue;
    shapes[r].light = uint32_t(lights.size());
    const PlacedShape& mesh = shapes_.objects[instance.object].meshes[run.mesh];
    const glm::dvec3& radiance = mesh.radiance;
    for (uint32_t t = run.first; t < run.end; ++t) {
      const uint32_t other = run.partner.empty() ? kNone : run.partner[t - run.first];
      if (other < t - run.first) continue;
      const TriangleRow<Value> p = scene.instances.triangles.row(t);
      TriangleRow<Value> partner{};
      if (other != kNone) partner = scene.instances.triangles.row(run.first + other);
      const glm::dvec3 p0(p.p0_x, p.p0_y, p.p0_z);
      const glm::dvec3 e1 = glm::dvec3(p.p1_x, p.p1_y, p.p1_z) - p0;
      const glm::dvec3 e2 = glm::dvec3(p.p2_x, p.p2_y, p.p2_z) - p0;
      LightRow<Value> light = placed_light(p, other == kNone ? nullptr : &partner, map, radiance);
      // As far off as a ray that leaves this triangle starts (kernels/surface_instance.h).
      const glm::dvec3 normal = glm::normalize(glm::cross(e1, e2));
      const glm::dvec3 inner(row.inner_x, row.inner_y, row.inner_z);
      const glm::dvec3 outside = glm::abs(normal_map * normal);
      const double scale = 1 / glm::length(outside);
      light.further = above(32 * kUlp * scale *
                            (glm::dot(glm::abs(normal), inner) +
                             (outside.x + outside.y + outside.z) * double(row.extent)));
      if (mesh.look.varies()) {
        TriangleVertexRow<Value> vertices{};
        if (run.geometry == GeometryKind::kTriangleVertex)
          vertices = scene.instances.triangle_vertices.row(t);
        emission.add_triangle(uint32_t(lights.size()), mesh.look, t, light, &vertices, mirrored);
      }
      lights.push_back(light);
    }
  }
}

void ObjectCompiler::finish(const BinKeys& keys, bool ids, Scene& scene,
                            std::vector<LightRow<Value>>& lights, EmissionRows& emission) {
  Instances& out = scene.instances;
  std::vector<uint32_t> object_ids, material_ids;
  std::vector<InstanceRow<Value>> rows;
  std::vector<InstanceShapeRow<Value>> shapes;
  std::vector<Map> maps;
  std::vector<TopBox> boxes;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> known;  // (object, materials) -> first shape
  double extent = 0;
  for (const SharedShapes::Instance& instance : shapes_.instances) {
    const Object& object = objects_[instance.object];
    if (object.boxes.empty()) continue;
    const Map map = map_of(instance.placement, object.center, scene.center);
    InstanceRow<Value> row = row_of(object, map);
    row.object = instance.object;
    row.first_triangle = object.first_triangle;
    if (object.emissive) {
      row.first_shape = add_shapes(instance, keys, shapes, material_ids);
      add_lights(instance, row, map, &shapes[row.first_shape], scene, lights, emission);
    } else {
      const auto [first, is_new] = known.try_emplace({instance.object, instance.materials}, 0u);
      if (is_new) first->second = add_shapes(instance, keys, shapes, material_ids);
      row.first_shape = first->second;
    }
    for (size_t r = 0; r < object.runs.size(); ++r)
      scene.bins[shapes[row.first_shape + r].bin].primitives +=
          object.runs[r].end - object.runs[r].first;
    ++out.objects[instance.object].instances;
    extent = std::max(extent, double(row.extent));
    rows.push_back(row);
    object_ids.push_back(instance.id);
    maps.push_back(map);
    boxes.push_back(placed_bounds(object, map));
  }
  if (rows.empty()) return;
  if (ids) {
    out.object_ids = std::move(object_ids);
    out.material_ids = std::move(material_ids);
  }

  // A ray's way through an instance is off by the roundings of the way there and through the maps:
  // some 40 of them, with origins within kFarExtents (kernels/traverse_rays.h); 64 are taken.
  for (size_t i = 0; i < boxes.size(); ++i)
    for (int a = 0; a < 3; ++a) {
      const double grow = 64 * kUlp * extent * maps[i].growth[a];
      boxes[i].min[a] -= grow;
      boxes[i].max[a] += grow;
    }
  out.top = build_top_tree(boxes);
  out.rows.resize(uint32_t(rows.size()));
  for (uint32_t i = 0; i < rows.size(); ++i) out.rows.set(i, rows[i]);
  out.shapes.resize(uint32_t(shapes.size()));
  for (uint32_t i = 0; i < shapes.size(); ++i) out.shapes.set(i, shapes[i]);
}

}  // namespace yat

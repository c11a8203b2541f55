#include "scene/compile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scene/compile_parts.h"

namespace yat {

namespace {

/// Above this many triangles from instances, say what copies cost.
constexpr uint64_t kManyCopies = 1'000'000;

/// A shape's own part, shared by all places it is put at.
struct ShapeInfo {
  bool read = false;
  std::optional<CompiledShape> shape;
  glm::dvec3 radiance{0.0};  ///< bands, of its area light, by the area before instancing
};

class ShapePlacer {
 public:
  ShapePlacer(const Description& description, const ColourModel& colour, Diagnostics& diagnostics)
      : description_(description),
        colour_(colour),
        diagnostics_(diagnostics),
        materials_(description, colour, diagnostics),
        shapes_(description.shapes.size()),
        area_lights_(description.area_lights.size()) {}

  void place_all() {
    std::vector<std::vector<uint32_t>> members(description_.objects.size());
    for (uint32_t i = 0; i < description_.shapes.size(); ++i) {
      const ShapeEntry& entry = description_.shapes[i];
      if (entry.object == kNone)
        place(i, entry.to_world, entry.material, entry.plugin.loc);
      else if (entry.object < members.size())
        members[entry.object].push_back(i);
    }
    uint64_t copied = 0;
    for (const InstanceEntry& instance : description_.instances) {
      if (instance.object >= members.size()) continue;  // reported by the parser
      for (uint32_t i : members[instance.object]) {
        const ShapeEntry& entry = description_.shapes[i];
        place(i, instance.to_world * entry.to_world,
              instance.material != kNone ? instance.material : entry.material, instance.loc);
        if (shapes_[i].shape) copied += shapes_[i].shape->mesh.triangles();
      }
    }
    if (copied > kManyCopies)
      diagnostics_.note({}, fmt::format("instances are placed as copies: {} triangles, about {} MB",
                                        copied, copied * 200 / 1'000'000));
  }

  const std::vector<PlacedShape>& placed() const { return placed_; }
  MaterialCompiler& materials() { return materials_; }
  uint32_t shapes_read() const { return shapes_read_; }

 private:
  void place(uint32_t index, const Matrix& to_world, uint32_t material, SourceLoc loc) {
    const ShapeEntry& entry = description_.shapes[index];
    const std::string what = "shape \"" + entry.plugin.type + "\"";
    ShapeInfo& info = shapes_[index];
    if (!info.read) read(entry, info);
    if (!info.shape) return;
    auto placement = make_placement(to_world, loc, what, diagnostics_);
    if (!placement) return;
    PlacedShape placed;
    placed.shape = &*info.shape;
    placed.loc = loc;
    placed.placement = *placement;
    placed.reverse_orientation = entry.reverse_orientation;
    placed.material = materials_.compile(material);
    placed.radiance = info.radiance;
    // A null surface that does not shine is not there.
    if (placed.material.kind == MaterialKind::kNull && !placed.emissive()) return;
    if (placed.emissive() && placed.placement.mirrored &&
        info.shape->kind == CompiledShape::Kind::kMesh && info.shape->mesh.normals.empty())
      diagnostics_.note(loc,
                        "a mesh light under a mirrored transform shines to the side that its "
                        "mesh says, mirrored with it (LuxRender: to the other side)");
    placed_.push_back(std::move(placed));
  }

  void read(const ShapeEntry& entry, ShapeInfo& info) {
    info.read = true;
    info.shape = compile_shape(entry, description_, diagnostics_);
    if (!info.shape) return;
    ++shapes_read_;
    if (entry.area_light < area_lights_.size()) info.radiance = radiance(entry, *info.shape);
  }

  /// What the shape emits, in bands; black if it is no light.
  glm::dvec3 radiance(const ShapeEntry& entry, const CompiledShape& shape) {
    const glm::dvec3 black(0.);
    auto& light = area_lights_[entry.area_light];
    if (!light)
      light = std::make_optional(compile_area_light(description_.area_lights[entry.area_light],
                                                    description_, colour_, diagnostics_));
    if (!*light) return black;
    if (shape.kind == CompiledShape::Kind::kPlane) {
      diagnostics_.warning(entry.plugin.loc,
                           "an infinite plane cannot be a light: it does not shine");
      return black;
    }
    const auto own = make_placement(entry.to_world, entry.plugin.loc, "the light", diagnostics_);
    if (!own) return black;
    const double area = shape.light_area ? *shape.light_area : mesh_area(shape.mesh, *own);
    if (!(area > 0)) {
      diagnostics_.warning(entry.plugin.loc, "the area light has no area: it does not shine");
      return black;
    }
    const glm::dvec3 radiance = area_light_radiance(**light, area, diagnostics_);
    if (!std::isfinite(float(radiance.x)) || !std::isfinite(float(radiance.y)) ||
        !std::isfinite(float(radiance.z))) {
      diagnostics_.error((*light)->loc,
                         "the area light's radiance is too large for a number: it does "
                         "not shine");
      return black;
    }
    return radiance;
  }

  const Description& description_;
  const ColourModel& colour_;
  Diagnostics& diagnostics_;
  MaterialCompiler materials_;
  std::vector<ShapeInfo> shapes_;  // never resized: PlacedShape points into it
  std::vector<std::optional<std::optional<AreaLight>>> area_lights_;  // outer: read yet?
  std::vector<PlacedShape> placed_;
  uint32_t shapes_read_ = 0;
};

AlignedArray<float> to_array(const std::vector<float>& values) {
  return AlignedArray<float>(std::span<const float>(values));
}

void set_filter(FilterTables tables, Scene& scene) {
  scene.filter_quantile_x = to_array(tables.quantile_x);
  scene.filter_quantile_y = to_array(tables.quantile_y);
  scene.filter_marginal = to_array(tables.marginal);
  scene.filter_conditional = to_array(tables.conditional);
  scene.filter_sign = to_array(tables.sign);
  scene.filter.radius_x = tables.radius_x;
  scene.filter.radius_y = tables.radius_y;
  scene.filter.kind = tables.kind;
}

/// Statements that change nothing in the converged picture of a path tracer.
void accept_silently(const std::optional<Plugin>& plugin) {
  if (!plugin) return;
  for (const Parameter& parameter : plugin->parameters) parameter.used = true;
}

/// Trees give the same picture: what is asked for here is speed alone.
bool wants_kd_tree(const std::optional<Plugin>& accelerator, TreeChoice choice,
                   Diagnostics& diagnostics) {
  accept_silently(accelerator);
  if (choice != TreeChoice::kFromScene) return choice == TreeChoice::kKd;
  if (!accelerator) return false;
  // Three names of one thing.
  for (const std::string_view name : {"kdtree", "tabreckdtree", "unsafekdtree"})
    if (accelerator->type == name) return true;
  diagnostics.note(accelerator->loc,
                   fmt::format("Accelerator \"{}\": yat builds the tree that suits the triangles",
                               accelerator->type));
  return false;
}

}  // namespace

Scene compile_scene(const Description& description, const CompileOptions& options, ThreadPool& pool,
                    Diagnostics& diagnostics) {
  Scene scene;
  scene.hash = description.hash;
  scene.colour = colour_model(options.colour);
  scene.film = compile_film(description, options, diagnostics);
  set_filter(compile_filter(description.filter, diagnostics), scene);
  const IntegratorSettings integrator = compile_integrator(description.integrator, diagnostics);
  scene.max_depth = integrator.max_depth;
  scene.direct_only = integrator.direct_only;
  accept_silently(description.sampler);
  const bool kd_tree = wants_kd_tree(description.accelerator, options.tree, diagnostics);
  accept_silently(description.renderer);
  accept_silently(description.volume_integrator);

  ShapePlacer shapes(description, scene.colour, diagnostics);
  shapes.place_all();
  scene.shapes_read = shapes.shapes_read();

  // The origin moves to the middle of the scene, where floats are finest: a scene far from its
  // origin renders as it would near it.
  Bounds bounds;
  for (const PlacedShape& placed : shapes.placed()) add_to_bounds(placed, bounds);
  scene.center = bounds.empty() ? camera_position(description) : bounds.center();
  const CameraSetup camera = compile_camera(description, scene.film, scene.center, diagnostics);
  scene.camera = camera.view;
  scene.thin_lens = camera.thin_lens;
  const float* eye = scene.camera.origin;
  const double reach =
      std::max(bounds.radius(), std::hypot(double(eye[0]), double(eye[1]), double(eye[2])));
  if (reach > 0) scene.radius = std::nextafter(float(reach), INFINITY);

  GeometryRows rows(scene.center, diagnostics);
  for (const PlacedShape& placed : shapes.placed()) rows.add(placed);
  std::vector<uint8_t> occludes;
  rows.finish(scene, occludes);
  shapes.materials().finish(scene);
  if (scene.prim_bin.empty())
    diagnostics.fail({}, description.shapes.empty()
                             ? "the scene is empty: it has no Shape"
                             : fmt::format("nothing to render: none of the {} shapes can be seen",
                                           description.shapes.size()));

  std::vector<LightRow<Value>> lights = std::move(rows.lights());
  for (const LightEntry& light : description.lights)
    compile_light(light, description, scene.colour, scene.center, lights, diagnostics);
  if (lights.empty())
    diagnostics.warning({}, "the scene has no light that can be used: the picture will be black");
  finish_lights(std::move(lights), double(scene.radius), scene);

  if (scene.triangles.size() > 0)
    scene.tree =
        build_tree(scene.triangles.view(), occludes, {options.block_width, kd_tree, {}}, pool);
  return scene;
}

SceneView Scene::view() const {
  SceneView view;
  view.geometry.tree = tree.view;
  view.geometry.triangles = triangles.view();
  view.geometry.triangle_vertices = triangle_vertices.view();
  view.geometry.spheres = spheres.view();
  view.geometry.planes = planes.view();
  view.geometry.prim_bin = prim_bin.data();
  view.geometry.all_occlude = all_occlude;
  view.lights.rows = lights.view();
  view.lights.choice = light_choice.view();
  view.lights.kinds = light_kinds;
  view.camera = camera;
  view.filter = filter;
  view.radius = radius;
  view.filter.quantile_x = filter_quantile_x.data();
  view.filter.quantile_y = filter_quantile_y.data();
  view.filter.marginal = filter_marginal.data();
  view.filter.conditional = filter_conditional.data();
  view.filter.sign = filter_sign.data();
  for (uint32_t kind = 0; kind < kMaterialKinds; ++kind)
    view.parameters[kind] = {parameters[kind].data(), parameter_rows[kind]};
  return view;
}

size_t Scene::bytes() const {
  size_t sum = triangles.bytes() + triangle_vertices.bytes() + spheres.bytes() + planes.bytes() +
               prim_bin.bytes() + tree.bytes() + lights.bytes() + light_choice.bytes() +
               filter_quantile_x.bytes() + filter_quantile_y.bytes() + filter_marginal.bytes() +
               filter_conditional.bytes() + filter_sign.bytes();
  for (const auto& table : parameters) sum += table.bytes();
  return sum;
}

}  // namespace yat

#include "scene/compile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "scene/compile_emission.h"
#include "scene/compile_objects.h"
#include "scene/light_maps.h"

namespace yat {

namespace {

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

/// The sampler that a statement names: LuxRender's as what is nearest, yat's own names as they are.
/// Only noise depends on it. YART ignores the statement.
SamplerKind sampler_of(const Description& description, Diagnostics& diagnostics) {
  static constexpr std::pair<std::string_view, SamplerKind> kNames[] = {
      {"random", SamplerKind::kIndependent},
      {"lowdiscrepancy", SamplerKind::kSobol},
      {"metropolis", SamplerKind::kSobol},
      {"erpt", SamplerKind::kSobol},
      {"independent", SamplerKind::kIndependent},
      {"sobol", SamplerKind::kSobol},
      {"regular", SamplerKind::kRegular},
      {"jittered", SamplerKind::kJittered},
      {"nrooks", SamplerKind::kNRooks},
      {"multijittered", SamplerKind::kMultiJittered},
      {"cmj", SamplerKind::kCorrelatedMultiJittered},
  };
  accept_silently(description.sampler);
  if (!description.sampler || description.dialect == Dialect::kYart) return SamplerKind::kSobol;
  const Plugin& plugin = *description.sampler;
  std::vector<std::string_view> names;
  for (const auto& [name, kind] : kNames) {
    names.push_back(name);
    if (plugin.type != name) continue;
    if (name == "metropolis" || name == "erpt" || name == "random" || name == "lowdiscrepancy")
      diagnostics.note(plugin.loc,
                       fmt::format("Sampler \"{}\": yat's nearest is \"{}\" (--sampler)", name,
                                   kind == SamplerKind::kSobol ? "sobol" : "independent"));
    return kind;
  }
  diagnostics.warning(plugin.loc, fmt::format("unknown Sampler \"{}\"{}: \"sobol\" is used",
                                              plugin.type, did_you_mean(plugin.type, names)));
  return SamplerKind::kSobol;
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

/// How many there are if each triangle that shines is one.
uint64_t lights_with_a_place(const ShapePlacer& shapes,
                             const std::vector<const LightEntry*>& others) {
  const auto lights = [](const PlacedShape& placed) -> uint64_t {
    if (!placed.emissive()) return 0;
    return placed.shape->kind == CompiledShape::Kind::kMesh ? placed.shape->mesh.triangles() : 1;
  };
  uint64_t count = 0;
  for (const PlacedShape& placed : shapes.placed()) count += lights(placed);
  for (const SharedShapes::Instance& instance : shapes.shared().instances)
    for (const PlacedShape& mesh : shapes.shared().objects[instance.object].meshes)
      count += lights(mesh);
  constexpr std::string_view kWithAPlace[] = {"point", "goniometric", "spot", "projection"};
  for (const LightEntry* light : others)
    count += uint64_t(std::ranges::count(kWithAPlace, light->plugin.type));
  return count;
}

}  // namespace

Scene compile_scene(const Description& description, const CompileOptions& options, ThreadPool& pool,
                    Diagnostics& diagnostics) {
  Scene scene;
  scene.hash = description.hash;
  scene.colour = colour_model(options.colour);
  scene.film = compile_film(description, options, diagnostics);
  // YART knows no filters: a pixel is the mean over its square.
  static const Plugin kBox{"box", {}, {}};
  set_filter(compile_filter(description.dialect == Dialect::kYart ? std::optional<Plugin>(kBox)
                                                                  : description.filter,
                            diagnostics),
             scene);
  const IntegratorSettings integrator = compile_integrator(description.integrator, diagnostics);
  scene.max_depth = integrator.max_depth;
  scene.direct_only = options.direct_only.value_or(integrator.direct_only);
  scene.show_environment = integrator.show_environment;
  scene.sampler = sampler_of(description, diagnostics);
  const bool kd_tree = wants_kd_tree(description.accelerator, options.tree, diagnostics);
  accept_silently(description.renderer);
  accept_silently(description.volume_integrator);

  ShapePlacer shapes(description, scene.colour, options, diagnostics);
  shapes.place_all();
  scene.shapes_read = shapes.shapes_read();
  // YART's path tracer knows no points.
  const bool sphere_lamps = description.dialect == Dialect::kYart && !scene.direct_only;
  std::vector<const LightEntry*> other_lights;
  for (const LightEntry& light : description.lights) {
    std::optional<SphereLamp> lamp;
    if (sphere_lamps) lamp = compile_sphere_lamp(light, description, scene.colour, diagnostics);
    if (lamp)
      shapes.place_lamp(*lamp, light.plugin.loc);
    else
      other_lights.push_back(&light);
  }
  // Every triangle counts here: what would be one light must not hide that there are many. Where
  // all are to be asked, there are too many if half of the triangles would be.
  const uint64_t with_a_place = lights_with_a_place(shapes, other_lights);
  const bool rectangles =
      options.light_choice == LightChoosing::kPower ||
      options.light_choice == LightChoosing::kUniform ||
      (options.light_choice == LightChoosing::kAll && with_a_place <= 2 * kMostAskedLights) ||
      with_a_place < kTreeLights;
  ObjectCompiler objects(shapes.shared(), description, rectangles, diagnostics);
  objects.build({options.block_width, kd_tree, {}}, pool, scene);

  // The origin moves to the middle of the scene, where floats are finest: a scene far from its
  // origin renders as it would near it.
  Bounds bounds;
  for (const PlacedShape& placed : shapes.placed()) add_to_bounds(placed, bounds);
  objects.add_to_bounds(bounds);
  scene.center = bounds.empty() ? camera_position(description) : bounds.center();
  const CameraSetup camera = compile_camera(description, scene.film, scene.center, diagnostics);
  scene.camera = camera.view;
  scene.camera_kind = camera.kind;
  scene.autofocus = camera.autofocus;
  const float* eye = scene.camera.origin;
  const double reach =
      std::max(bounds.radius(), std::hypot(double(eye[0]), double(eye[1]), double(eye[2])));
  if (reach > 0) scene.radius = std::nextafter(float(reach), INFINITY);

  GeometryRows rows(scene.center, options.ids, rectangles, diagnostics);
  for (const PlacedShape& placed : shapes.placed()) rows.add(placed);
  BinKeys keys;
  rows.add_keys(keys);
  objects.add_keys(keys);
  keys.number(scene, diagnostics);
  std::vector<uint8_t> occludes;
  rows.finish(keys, scene, occludes);
  objects.finish(keys, options.ids, scene, rows.lights(), rows.emission());
  shapes.emission().finish(scene);
  shapes.materials().finish(scene);
  std::vector<LightRow<Value>> lights = std::move(rows.lights());
  LightTables light_tables;
  for (const LightEntry* light : other_lights)
    compile_light(*light, description, scene.colour, scene.center, light_tables, lights,
                  diagnostics);
  scene.light_samples = shapes.light_samples() + other_lights.size();
  rows.emission().finish(uint32_t(lights.size()), shapes.emission(), light_tables, scene);
  finish_lights(std::move(lights), light_tables, options, pool, scene);
  if (options.light_choice == LightChoosing::kAll && scene.lights.size() > kMostAskedLights)
    diagnostics.warning({}, fmt::format("--light-choice all: {} lights are more than the {} that a "
                                        "surface may ask together: auto is used",
                                        scene.lights.size(), kMostAskedLights));
  if (scene.prim_bin.empty() && scene.instances.empty() &&
      scene.first_environment == scene.lights.size())
    diagnostics.fail({}, description.shapes.empty()
                             ? "the scene is empty: it has no Shape"
                             : fmt::format("nothing to render: none of the {} shapes can be seen",
                                           description.shapes.size()));
  if (scene.lights.size() == 0)
    diagnostics.warning({}, "the scene has no light that can be used: the picture will be black");

  if (scene.triangles.size() > 0)
    scene.tree =
        build_tree(scene.triangles.view(), occludes, {options.block_width, kd_tree, {}}, pool);
  build_veils({options.block_width, kd_tree, {}}, pool, scene);
  return scene;
}

SceneView Scene::view() const {
  SceneView view;
  view.geometry.tree = tree.view;
  view.geometry.triangles = triangles.view();
  view.geometry.triangle_vertices = triangle_vertices.view();
  view.geometry.spheres = spheres.view();
  view.geometry.planes = planes.view();
  view.geometry.shapes.rows = shapes.view();
  std::copy(shape_rows.begin(), shape_rows.end(), view.geometry.shapes.kinds);
  view.geometry.shapes.tree = shape_tree.view;
  view.geometry.prim_bin = prim_bin.data();
  view.geometry.all_occlude = all_occlude;
  const auto from = []<template <template <class> class> class Record>(Rows<Record> rows,
                                                                       uint32_t first) {
    return Rows<Record>{rows.words + size_t(first) * row_words<Record>, rows.count - first};
  };
  view.veils.tree = veils.view;
  view.veils.spheres = from(spheres.view(), first_veil_sphere);
  view.veils.first_sphere = triangles.size() + first_veil_sphere;
  view.veils.planes = from(planes.view(), first_veil_plane);
  view.veils.first_plane = triangles.size() + spheres.size() + first_veil_plane;
  view.veils.shapes.rows = shapes.view();
  std::copy(veil_shape_rows.begin(), veil_shape_rows.end(), view.veils.shapes.kinds);
  view.veils.shapes.tree = veil_shape_tree.view;
  view.instances = instances.view();
  view.lights.rows = lights.view();
  view.lights.emission = emission.view();
  view.lights.choice = light_choice.view();
  if (light_tree.nodes.size() > 0)
    view.lights.tree = {light_tree.nodes.view(), light_tree.trail.data(), light_tree_scale,
                        far_light, first_far_light};
  view.lights.kinds = light_kinds;
  view.lights.first_environment = first_environment;
  view.lights.maps = light_maps.view();
  view.lights.skies = skies.view();
  view.lights.texels = light_texels.data();
  view.lights.cells = light_cells.data();
  view.lights.basis = colour.light;
  view.camera = camera;
  view.filter = filter;
  view.radius = radius;
  view.texels = texels.view();
  view.filter.quantile_x = filter_quantile_x.data();
  view.filter.quantile_y = filter_quantile_y.data();
  view.filter.marginal = filter_marginal.data();
  view.filter.conditional = filter_conditional.data();
  view.filter.sign = filter_sign.data();
  for (uint32_t kind = 0; kind < kMaterialKinds; ++kind)
    view.parameters[kind] = {parameters[kind].data(), parameter_rows[kind], nullptr};
  return view;
}

size_t Scene::bytes() const {
  size_t sum = triangles.bytes() + triangle_vertices.bytes() + spheres.bytes() + planes.bytes() +
               shapes.bytes() + shape_tree.bytes() + veil_shape_tree.bytes() + prim_bin.bytes() +
               tree.bytes() + veils.bytes() + instances.object_bytes() +
               instances.instance_bytes() + lights.bytes() + emission.bytes() +
               light_choice.bytes() + light_tree.nodes.bytes() + light_tree.trail.bytes() +
               light_maps.bytes() + skies.bytes() + light_texels.bytes() + light_cells.bytes() +
               filter_quantile_x.bytes() + filter_quantile_y.bytes() + filter_marginal.bytes() +
               filter_conditional.bytes() + filter_sign.bytes();
  for (const auto& table : parameters) sum += table.bytes();
  for (const auto* list : {&programs, &emission_programs})
    for (const TextureProgram& program : *list) sum += program.bytes();
  sum += texels.bytes();
  return sum;
}

}  // namespace yat

#include "app/info.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

#include "app/option_names.h"
#include "film/film.h"

namespace yat {

namespace {

constexpr std::array<std::string_view, kMaterialKinds> kMaterialNames = {
#define YAT_MATERIAL(file, Type) #file,
    YAT_MATERIALS(YAT_MATERIAL)
#undef YAT_MATERIAL
};
constexpr std::array<std::string_view, uint32_t(GeometryKind::kCount)> kGeometryNames = {
    "triangles", "triangles with vertex data", "spheres", "planes", "quadrics", "disks", "tori"};

std::string_view filter_word(FilterKind kind) {
  switch (kind) {
    case FilterKind::kBox:
      return "box";
    case FilterKind::kProduct:
      return "product of two tables";
    case FilterKind::kTable:
      return "table of cells";
  }
  return "";
}

/// "3 trianglemesh, 1 sphere" of the shapes as written.
std::string shape_types(const Description& description) {
  std::map<std::string, uint64_t> counts;
  for (const ShapeEntry& shape : description.shapes) ++counts[shape.plugin.type];
  std::string text;
  for (const auto& [type, count] : counts)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, type);
  return text.empty() ? "none" : text;
}

std::string light_counts(const Scene& scene) {
  std::array<uint64_t, uint32_t(LightKind::kCount)> counts{};
  for (uint32_t row = 0; row < scene.lights.size(); ++row) {
    const uint32_t kind = scene.lights.row(row).kind;
    if (kind < counts.size()) ++counts[kind];
  }
  std::string text;
  for (size_t kind = 0; kind < counts.size(); ++kind)
    if (counts[kind])
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counts[kind], kLightKindNames[kind]);
  return text.empty() ? "none" : text;
}

std::string camera_words(const Scene& scene) {
  switch (scene.camera_kind) {
    case CameraKind::kPinhole:
      return "pinhole";
    case CameraKind::kThinLens:
      return fmt::format("thin lens, focus at {:.6g} m", scene.camera.focal_distance);
    case CameraKind::kPolygonLens:
      return fmt::format("lens of {} blades, focus at {:.6g} m", scene.camera.blades,
                         scene.camera.focal_distance);
    case CameraKind::kOrthographic:
      return "orthographic";
    case CameraKind::kEnvironment:
      return "environment";
    case CameraKind::kFisheye:
      return fmt::format("fisheye, {:.6g} degrees to each side",
                         360 * double(scene.camera.half_angle));
    case CameraKind::kCount:
      break;
  }
  return "";
}

std::string holds(const Description& description, const Scene& scene) {
  const FilmSettings& film = scene.film;
  const CameraView& camera = scene.camera;
  std::string text = fmt::format("Scene {} (hash {:016x})\n", description.file, scene.hash);
  text += fmt::format("  shapes     {} ({})\n", scene.shapes_read, shape_types(description));
  text += fmt::format(
      "  geometry   {} triangles{}{}, {} spheres, {} planes{}\n", scene.triangles.size(),
      scene.triangle_vertices.size() ? " (with normals or uv)" : "",
      scene.degenerate_triangles ? fmt::format(" ({} without area)", scene.degenerate_triangles)
                                 : std::string(),
      scene.spheres.size(), scene.planes.size(),
      scene.shapes.size() ? fmt::format(", {} other shapes", scene.shapes.size()) : std::string());
  if (!scene.instances.empty()) {
    uint64_t placed = 0;
    for (const SharedObject& object : scene.instances.objects)
      placed += object.instances * object.triangles;
    text += fmt::format("  instances  {} of {} objects: {} triangles stored, {} placed\n",
                        scene.instances.rows.size(), scene.instances.objects.size(),
                        scene.instances.triangles.size(), placed);
  }
  text += "  materials ";
  std::string materials;
  for (uint32_t kind = 0; kind < kMaterialKinds; ++kind)
    if (scene.parameter_rows[kind])
      materials += fmt::format("{} {} {}", materials.empty() ? "" : ",", scene.parameter_rows[kind],
                               kMaterialNames[kind]);
  text += (materials.empty() ? " none" : materials) + "\n";
  text += fmt::format("  lights     {}\n", light_counts(scene));
  text += fmt::format(
      "  camera     {}, at {:.6g} {:.6g} {:.6g}, looking along {:.4f} {:.4f} {:.4f}\n",
      camera_words(scene), scene.center.x + double(camera.origin[0]),
      scene.center.y + double(camera.origin[1]), scene.center.z + double(camera.origin[2]),
      camera.forward[0], camera.forward[1], camera.forward[2]);
  text +=
      fmt::format("  film       {}x{}, crop x {}..{} y {}..{}, \"{}\", tone map {}, gamma {:.3g}\n",
                  film.width, film.height, film.crop_x0, film.crop_x1, film.crop_y0, film.crop_y1,
                  film.filename, name_of(film.tone_map, kToneMaps), film.gamma);
  text += fmt::format("  filter     {}, radius {:.3g} x {:.3g} pixels\n",
                      filter_word(scene.filter.kind), scene.filter.radius_x, scene.filter.radius_y);
  text += fmt::format("  integrator {}, depth {}\n", scene.direct_only ? "direct" : "path",
                      scene.max_depth);
  return text;
}

std::string bins_of(const Scene& scene) {
  std::string text = "Bins (rows that take the same way)\n";
  for (size_t i = 1; i < scene.bins.size(); ++i) {
    const Bin& bin = scene.bins[i];
    text += fmt::format(
        "  {:>2}  {}{}, {}{}: {} primitives\n", i, kGeometryNames[uint32_t(bin.geometry)],
        bin.instanced ? " in instances" : "", kMaterialNames[uint32_t(bin.material)],
        bin.emissive ? ", emissive" : "", bin.primitives);
  }
  return text;
}

/// What the tree is split by, and why.
std::string shape_of(const TreeStatistics& s) {
  switch (s.shape) {
    case TreeShape::kKd:
      return "by planes alone, as asked for";
    case TreeShape::kObjects:
      if (s.planes_cost > 0)
        return fmt::format(
            "by objects: siblings overlap by {:.2f} of the bounds, but a ray alone would pay "
            "{:.2f} "
            "with planes, {:.2f} without",
            s.overlap, s.planes_cost, s.objects_cost);
      return fmt::format("by objects: siblings overlap by {:.2f} of the bounds, less than {}",
                         s.overlap, kMuchOverlap);
    case TreeShape::kObjectsAndPlanes:
      return fmt::format(
          "by objects and planes: without planes siblings would overlap by {:.2f} of the bounds "
          "and a ray alone pay {:.2f}, not {:.2f}",
          s.overlap, s.objects_cost, s.planes_cost);
  }
  return "";
}

std::string tree_of(const Tree& tree) {
  const TreeStatistics& s = tree.statistics;
  if (s.triangles == 0) return "Tree\n  none: no triangles\n";
  return fmt::format(
      "Tree\n"
      "  {} references to {} triangles ({:.3f} each), {} nodes, {} leaves, {} blocks of {} ({:.1f} "
      "% full)\n"
      "  deepest way {} nodes, SAH cost {:.2f}, {} bytes, built in {:.3f} s\n"
      "  split {}\n",
      s.references, s.triangles, double(s.references) / double(s.triangles), s.nodes, s.leaves,
      s.blocks, tree.view.block_width, 100 * s.block_fill, s.max_depth, s.sah_cost, tree.bytes(),
      s.build_seconds, shape_of(s));
}

/// Objects stored once, and how much the others of their instances would have been.
std::string instances_of(const Instances& instances) {
  std::string text = "Instances\n";
  if (instances.empty())
    return text + fmt::format(
                      "  none shared: an object is stored once when it has more than one instance, "
                      "and {}\n  triangles, or {} in all instances together (--instances)\n",
                      kSharedTriangles, kCopiedTriangles);
  for (const SharedObject& object : instances.objects)
    text += fmt::format(
        "  object \"{}\": {} instances of {} triangles, tree of {} nodes, deepest "
        "way {}\n",
        object.name, object.instances, object.triangles, object.tree.statistics.nodes,
        object.tree.statistics.max_depth);
  const TreeStatistics& top = instances.top.statistics;
  text += fmt::format("  tree above them: {} nodes, deepest way {}\n", top.nodes, top.max_depth);
  return text;
}

std::string memory_of(const Scene& scene) {
  std::string text = "Memory [bytes]\n";
  const auto line = [&](std::string_view name, size_t bytes) {
    if (bytes) text += fmt::format("  {:<24}{:>14}\n", name, bytes);
  };
  line("triangles", scene.triangles.bytes());
  line("triangle vertices", scene.triangle_vertices.bytes());
  line("spheres", scene.spheres.bytes());
  line("planes", scene.planes.bytes());
  line("other shapes", scene.shapes.bytes());
  line("tree of shapes", scene.shape_tree.bytes());
  line("bin of primitive", scene.prim_bin.bytes());
  line("tree nodes", scene.tree.nodes.bytes());
  line("tree blocks", scene.tree.blocks.bytes());
  line("tree occluder masks", scene.tree.block_occluders.bytes());
  if (!scene.instances.empty()) {
    line("objects, each once", scene.instances.object_bytes());
    line("their instances", scene.instances.instance_bytes());
  }
  line("lights", scene.lights.bytes() + scene.emission.bytes());
  line("light choice", scene.light_choice.bytes() + scene.light_tree.nodes.bytes() +
                           scene.light_tree.trail.bytes());
  for (uint32_t kind = 0; kind < kMaterialKinds; ++kind)
    line(fmt::format("material {}", kMaterialNames[kind]), scene.parameters[kind].bytes());
  size_t programs = 0;
  for (const auto* list : {&scene.programs, &scene.emission_programs})
    for (const TextureProgram& program : *list) programs += program.bytes();
  line("texture programs", programs);
  line("texels", scene.texels.bytes());
  line("pixel filter", scene.filter_quantile_x.bytes() + scene.filter_quantile_y.bytes() +
                           scene.filter_marginal.bytes() + scene.filter_conditional.bytes() +
                           scene.filter_sign.bytes());
  line("all of the scene", scene.bytes());
  line("film", scene.film.crop_width() * size_t(scene.film.crop_height()) * sizeof(FilmPixel));
  return text;
}

}  // namespace

std::string info_text(const Description& description, const Scene& scene, const Plan& plan) {
  std::string text = holds(description, scene);
  text += bins_of(scene);
  text += fmt::format("Plan ({}, {} lanes)\n", plan.kernels->isa, plan.kernels->lanes);
  std::string steps = describe_plan(plan, scene);
  if (!steps.empty() && steps.back() != '\n') steps += '\n';
  text += steps;
  text += tree_of(scene.tree);
  if (!description.instances.empty()) text += instances_of(scene.instances);
  text += memory_of(scene);
  return text;
}

}  // namespace yat

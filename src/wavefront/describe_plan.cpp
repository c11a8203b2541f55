// A plan in words: the kernels of each stage, and what is skipped and why (yat info).
#include <fmt/format.h>

#include <iterator>
#include <string>
#include <string_view>

#include "kernels/texture.h"
#include "wavefront/pilot.h"
#include "wavefront/plan.h"
#include "wavefront/stages.h"

namespace yat {

namespace {

constexpr std::string_view kGeometryNames[] = {
    "triangle_flat", "triangle_vertex", "sphere", "plane", "quadric", "disk", "torus"};
constexpr std::string_view kLightNames[] = {"triangle",  "sphere", "point", "distant",
                                            "rectangle", "mixed",  "any"};
constexpr std::string_view kSamplerNames[] = {"independent", "sobol",         "regular", "jittered",
                                              "nrooks",      "multijittered", "cmj",     "zsobol"};
constexpr std::string_view kCameraNames[] = {"pinhole",      "thin lens",   "polygon lens",
                                             "orthographic", "environment", "fisheye"};
static_assert(std::size(kCameraNames) == uint32_t(CameraKind::kCount));
static_assert(std::size(kGeometryNames) == uint32_t(GeometryKind::kCount));
static_assert(std::size(kLightNames) == kLightKernels);
static_assert(std::size(kSamplerNames) == uint32_t(SamplerKind::kCount));

std::string_view shape_name(uint32_t kind) {
  return kGeometryNames[uint32_t(GeometryKind::kQuadric) + kind];
}

uint32_t veil_shapes(const Scene& scene) {
  uint32_t sum = 0;
  for (const RowRange& rows : scene.veil_shape_rows) sum += rows.end - rows.first;
  return sum;
}

/// ", shadow_..." for the kernels of analytic shapes that run.
std::string shadow_shape_names(const Plan& plan) {
  std::string text = plan.shape_tree ? ", shadow_shape_tree" : "";
  for (uint32_t kind = 0; kind < kShapeKinds; ++kind)
    if (plan.shapes[kind]) text += fmt::format(", shadow_shapes ({})", shape_name(kind));
  return text;
}

/// "texture map_surface image bands"
std::string texture_steps(const TextureProgram& program) {
  std::string text = "texture";
  if (!program.bump_steps.empty()) text += program.normal_map ? " normals:" : " bump:";
  for (const TextureStep& step : program.bump_steps)
    text += fmt::format(" {}", texture_traits(step.kind).name);
  if (!program.bump_steps.empty() && !program.steps.empty()) text += "; parameters:";
  for (const TextureStep& step : program.steps)
    text += fmt::format(" {}", texture_traits(step.kind).name);
  return text;
}

std::string_view ways_text(const Plan& plan) {
  switch (plan.light_sampling) {
    case LightSampling::kLights:
      return ", by light samples alone (--light-sampling lights)";
    case LightSampling::kBsdf:
      return ", samples only of those that no ray meets (--light-sampling bsdf)";
    default:
      return "";
  }
}

/// The kernels that sample lights, one for each group of them.
std::string light_kernels(const Plan& plan) {
  std::string text;
  for (const LightGroup& group : plan.light_groups)
    text += fmt::format(", {} ({})",
                        plan.varying_emission ? "sample_varying_lights"
                        : group.tree          ? "sample_tree_lights"
                                              : "sample_lights",
                        kLightNames[plan.varying_emission ? kAnyLights : group.kernel]);
  return text;
}

std::string describe_material(const Plan& plan, const ShadePlan& material) {
  const std::string_view name = material_traits(material.material).name;
  if (material.splits)
    return fmt::format(", split {}{} [{}] [{}]", name, material.unequal ? " by brightness" : "",
                       describe_material(plan, plan.children[material.child[0]]).substr(2),
                       describe_material(plan, plan.children[material.child[1]]).substr(2));
  std::string numbers;
  if (material.sample_lights) numbers += " light";
  if (material.draw_choice) numbers += " choice";
  if (material.draw_lobe) numbers += " lobe";
  if (material.draw_direction) numbers += " bsdf";
  if (material.draw_roulette) numbers += " roulette";
  std::string what;
  if (!numbers.empty()) what += ", draw" + numbers;
  if (material.sample_lights) what += light_kernels(plan);
  return what + fmt::format(", shade {}", name);
}

}  // namespace

std::string_view camera_kind_name(CameraKind kind) {
  return kCameraNames[uint32_t(kind)];
}
std::string_view sampler_kind_name(SamplerKind kind) {
  return kSamplerNames[uint32_t(kind)];
}

std::string describe_plan(const Plan& plan, const Scene& scene) {
  std::string text;
  const auto line = [&](Stage stage, std::string_view what) {
    fmt::format_to(std::back_inserter(text), "  {:<17}{}\n", stage_name(stage), what);
  };
  text += fmt::format("stages ({}, {} lanes)\n", plan.kernels->isa, plan.kernels->lanes);
  const bool pilot = plan.shadow_roulette != kNoShadowRoulette;
  if (pilot)
    text += fmt::format(
        "  {:<17}before the first pass, {} windows of {} x {} pixels: shadow rays below {:g} of "
        "the level play roulette\n",
        "pilot", kPilotWindows, kPilotWindowEdge, kPilotWindowEdge, plan.shadow_roulette);
  line(Stage::kGenerate,
       fmt::format("generate_camera_rays ({}), {} numbers: {} x {} pixels",
                   camera_kind_name(plan.camera), kSamplerNames[uint32_t(plan.sampler)],
                   scene.film.crop_width(), scene.film.crop_height()));
  if (plan.triangles)
    line(Stage::kIntersect,
         fmt::format("intersect_tiles (camera), intersect_closest: {} triangles, {} nodes",
                     scene.triangles.size(), scene.tree.view.node_count));
  if (plan.spheres)
    line(Stage::kIntersect, fmt::format("intersect_spheres: {} spheres", scene.spheres.size()));
  if (plan.planes)
    line(Stage::kIntersect, fmt::format("intersect_planes: {} planes", scene.planes.size()));
  for (uint32_t kind = 0; kind < kShapeKinds; ++kind)
    if (plan.shapes[kind])
      line(Stage::kIntersect,
           fmt::format("intersect_shapes ({}): {}", shape_name(kind),
                       scene.shape_rows[kind].end - scene.shape_rows[kind].first));
  if (plan.shape_tree)
    line(Stage::kIntersect,
         fmt::format("intersect_shape_tree: {} spheres, {} other shapes, {} nodes",
                     scene.spheres.size(), scene.shapes.size(), scene.shape_tree.view.node_count));
  if (plan.instances)
    line(Stage::kIntersect,
         fmt::format("intersect_instances: {} instances, {} nodes above them, {} objects of {} "
                     "triangles",
                     scene.instances.rows.size(), scene.instances.top.view.node_count,
                     scene.instances.objects.size(), scene.instances.triangles.size()));
  line(Stage::kSort,
       fmt::format("{}: {} bins", plan.instances ? "classify_instance_hits" : "classify_hits",
                   plan.bins.size() - 1));
  if (plan.environment)
    line(Stage::kEnvironment,
         fmt::format("{}: {} lights{}",
                     plan.far_by_tree ? "add_tree_environment" : "add_environment",
                     scene.lights.size() - scene.first_environment,
                     plan.transport.hide_environment ? ", not to camera rays" : ""));
  for (uint32_t b = 1; b < plan.bins.size(); ++b) {
    const BinPlan& bin = plan.bins[b];
    std::string what = fmt::format("bin {}, {} primitives: {} {}", b, bin.bin.primitives,
                                   bin.bin.instanced ? "make_instance_surfaces" : "make_surfaces",
                                   kGeometryNames[uint32_t(bin.bin.geometry)]);
    if (bin.bin.tangents) what += ", make_tangents";
    if (bin.emission) what += plan.light_tree ? ", add_tree_emission" : ", add_emission";
    if (bin.bin.emission_program != kNone)
      what += " by " + texture_steps(scene.emission_programs[bin.bin.emission_program]);
    if (bin.bin.emission_by_direction) what += " by direction";
    if (bin.bin.program != kNone) what += ", " + texture_steps(scene.programs[bin.bin.program]);
    line(Stage::kShade, what + describe_material(plan, bin));
  }
  if (plan.lights) {
    line(Stage::kIntersectShadow,
         fmt::format("{}{}{}{}{}",
                     plan.triangles
                         ? plan.shadow_mask ? "intersect_shadow (masked)" : "intersect_shadow"
                         : "no triangles",
                     plan.spheres ? ", shadow_spheres" : "", plan.planes ? ", shadow_planes" : "",
                     shadow_shape_names(plan),
                     !plan.instances      ? ""
                     : plan.instance_mask ? ", shadow_instances (masked)"
                                          : ", shadow_instances"));
    if (plan.veils)
      line(Stage::kIntersectShadow,
           fmt::format("veils: {} nodes, {} spheres, {} planes, {} other shapes{}",
                       scene.veils.view.node_count, scene.spheres.size() - scene.first_veil_sphere,
                       scene.planes.size() - scene.first_veil_plane, veil_shapes(scene),
                       plan.veil_shape_tree
                           ? fmt::format(" ({} nodes)", scene.veil_shape_tree.view.node_count)
                           : std::string()));
    line(Stage::kAccumulate,
         fmt::format("add_unoccluded: {} lights{}", scene.asked_lights, ways_text(plan)));
  }

  text += "skipped\n";
  const auto skipped = [&](bool runs, std::string_view kernel, std::string_view why) {
    if (!runs) fmt::format_to(std::back_inserter(text), "  {}: {}\n", kernel, why);
  };
  const auto any_bin = [&](auto condition) {
    for (uint32_t b = 1; b < plan.bins.size(); ++b)
      if (condition(plan.bins[b])) return true;
    for (const ShadePlan& child : plan.children) {
      if constexpr (requires { condition(child); })
        if (condition(child)) return true;
    }
    return false;
  };
  skipped(plan.triangles, "intersect_closest", "no triangle in the scene");
  if (!plan.shape_tree) skipped(plan.spheres, "intersect_spheres", "no sphere in the scene");
  skipped(plan.planes, "intersect_planes", "no plane in the scene");
  skipped(scene.shapes.size() > 0, "intersect_shapes", "no other analytic shape in the scene");
  skipped(plan.instances, "intersect_instances", "no object is stored once for its instances");
  skipped(has_lens(plan.camera), "draw lens", "the camera has no lens");
  skipped(plan.veils, "veils", "no surface lets a part of the light pass");
  skipped(plan.shadow_mask || !plan.lights, "intersect_shadow (masked)",
          "every triangle stops shadow rays");
  skipped(plan.environment, "add_environment", "no light lies around the scene");
  skipped(any_bin([](const BinPlan& b) { return b.emission; }), "add_emission",
          "no surface emits light");
  skipped(scene.emission.size() > 0, "make_light_points, apply_emission_maps",
          "every light shines evenly");
  skipped(plan.tangents, "make_tangents", "every material looks the same from all sides");
  skipped(any_bin([](const ShadePlan& b) { return b.program != kNone; }), "textures",
          "no material varies over its surface");
  if (!plan.lights)
    skipped(false, "sample_lights, intersect_shadow, add_unoccluded",
            !scene.lights.size()        ? "no light in the scene"
            : !scene.asked_lights       ? "paths find the even sky by chance"
            : !plan.transport.max_depth ? "paths end at their first vertex"
                                        : "light is found by chance (--light-sampling bsdf)");
  else
    skipped(any_bin([](const ShadePlan& b) { return b.draw_choice; }) ||
                (scene.asked_lights > 1 && !plan.light_by_place && plan.light_groups.size() == 1),
            "draw choice",
            plan.light_by_place            ? "the number of the place chooses the light"
            : plan.light_groups.size() > 1 ? "every light is asked"
                                           : "one light is asked");
  skipped(plan.light_tree || !plan.lights, "light tree",
          plan.light_groups.size() > 1 ? "every light is asked" : "lights are chosen by power");
  skipped(any_bin([](const ShadePlan& b) { return b.draw_lobe; }), "draw lobe",
          "no material chooses between lobes");
  skipped(any_bin([](const ShadePlan& b) { return b.draw_roulette; }), "draw roulette",
          plan.transport.roulette_depth == kNoRoulette
              ? "paths go on to their last vertex (--roulette off)"
              : "no path gets as far as Russian roulette");
  skipped(
      pilot, "pilot",
      plan.lights ? "all shadow rays are traced (--shadow-roulette off)" : "no light is sampled");
  for (uint32_t kind = 0; kind < kMaterialKinds; ++kind)
    skipped(any_bin([&](const ShadePlan& b) { return b.material == MaterialKind(kind); }),
            "shade " + std::string(material_traits(MaterialKind(kind)).name),
            "no surface of this material");
  return text;
}

}  // namespace yat

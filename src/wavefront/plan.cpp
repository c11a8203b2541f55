#include "wavefront/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "kernels/strata.h"
#include "kernels/texture.h"
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

/// A table without a kernel that the plan wants is a mistake in the program, not in the scene.
void need(bool present, const KernelTable& kernels, std::string_view kernel) {
  if (!present) throw std::logic_error(fmt::format("{}: no kernel {}", kernels.isa, kernel));
}

void need_material(const ShadePlan& plan, const KernelTable& k) {
  if (plan.splits)
    need(k.split[uint32_t(plan.material)], k, "split");
  else
    need(k.shade[uint32_t(plan.material)], k, "shade");
  if (plan.coats) need(k.coats && k.take_coats && k.weigh_child, k, "coats");
  if (plan.program != kNone) need(k.spread_parameters && k.make_derivatives, k, "textures");
}

void need_kernels(const Plan& plan) {
  const KernelTable& k = *plan.kernels;
  need(k.draw[uint32_t(plan.sampler)], k, "draw");
  need(k.generate_camera_rays[uint32_t(plan.camera)], k, "generate_camera_rays");
  if (plan.triangles) {
    need(k.traversal_scratch_bytes, k, "traversal_scratch_bytes");
    need(k.intersect_closest && k.intersect_tiles, k, "intersect_closest");
    if (plan.lights) need(k.intersect_shadow[plan.shadow_mask], k, "intersect_shadow");
  }
  if (plan.spheres) need(k.intersect_spheres && k.shadow_spheres, k, "intersect_spheres");
  if (plan.planes) need(k.intersect_planes && k.shadow_planes, k, "intersect_planes");
  for (uint32_t kind = 0; kind < kShapeKinds; ++kind)
    if (plan.shapes[kind])
      need(k.intersect_shapes[kind] && k.shadow_shapes[kind], k, "intersect_shapes");
  if (plan.shape_tree || plan.veil_shape_tree)
    need(k.shape_scratch_bytes && k.intersect_shape_tree && k.shadow_shape_tree, k,
         "intersect_shape_tree");
  if (plan.instances) {
    need(k.instance_scratch_bytes && k.intersect_instances, k, "intersect_instances");
    need(k.classify_instance_hits, k, "classify_instance_hits");
    if (plan.lights) need(k.shadow_instances[plan.instance_mask], k, "shadow_instances");
  }
  need(k.classify_hits, k, "classify_hits");
  if (plan.lights) {
    if (plan.light_tree)
      need(k.sample_tree_lights[plan.light_kernel], k, "sample_tree_lights");
    else
      need(k.sample_lights[plan.light_kernel], k, "sample_lights");
    need(k.add_unoccluded, k, "add_unoccluded");
  }
  if (plan.environment)
    need(plan.light_tree ? k.add_tree_environment : k.add_environment, k, "add_environment");
  for (uint32_t b = 1; b < plan.bins.size(); ++b) {
    const BinPlan& bin = plan.bins[b];
    if (bin.bin.instanced)
      need(k.make_instance_surfaces[bin.bin.geometry == GeometryKind::kTriangleVertex], k,
           "make_instance_surfaces");
    else
      need(k.make_surfaces[uint32_t(bin.bin.geometry)], k, "make_surfaces");
    if (bin.bin.tangents)
      need(bin.bin.instanced
               ? bool(k.make_instance_tangents[bin.bin.geometry == GeometryKind::kTriangleVertex])
               : bool(k.make_tangents[uint32_t(bin.bin.geometry)]),
           k, "make_tangents");
    need_material(bin, k);
    if (bin.emission)
      need(plan.light_tree ? k.add_tree_emission : k.add_emission, k, "add_emission");
    if (bin.bin.emission_varies())
      need(k.make_derivatives && k.apply_emission_maps && k.multiply_colours, k,
           "apply_emission_maps");
  }
  if (plan.varying_emission)
    need(k.sample_varying_lights[plan.light_tree] && k.make_light_points, k,
         "sample_varying_lights");
  for (const ShadePlan& child : plan.children) need_material(child, k);
  if (plan.split_levels) need(k.choose_child && k.take_rows, k, "choose_child");
  if (plan.veils)
    need(k.start_veils && k.share_weight && k.pass_veils && k.end_veils, k, "start_veils");
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

}  // namespace

namespace {

/// Whether some light is one that no ray can meet.
bool has_unmet_lights(const Scene& scene) {
  for (uint32_t i = 0; i < scene.lights.size(); ++i) switch (LightKind(scene.lights.row(i).kind)) {
      case LightKind::kPoint:
      case LightKind::kDistant:
      case LightKind::kSpot:
      case LightKind::kPointMap:
      case LightKind::kProjection:
        return true;
      default:
        break;
    }
  return false;
}

/// Whether one number can choose a light and a place on it, so that a pixel's samples spread evenly
/// over all lights together: what a rare light leaves of its 24 bits must be a fine enough grid.
bool lights_share_number(const Scene& scene) {
  constexpr float kRarest = 1.f / 64;
  if (scene.light_tree.nodes.size() > 0 || scene.lights.size() < 2) return false;
  for (uint32_t i = 0; i < scene.lights.size(); ++i)
    if (scene.lights.row(i).probability > 0 && scene.lights.row(i).probability < kRarest)
      return false;
  return true;
}

/// The plan of a material, with those of what it is made of in plan.children.
ShadePlan plan_material(const Scene& scene, const MaterialForm& form, bool roulette, uint32_t level,
                        Plan& plan) {
  ShadePlan out;
  out.material = form.kind;
  out.program = form.program;
  const MaterialTraits traits = material_traits(form.kind);
  out.splits = traits.splits;
  out.coats = form.kind == MaterialKind::kCoating;
  if (out.splits) {
    const MaterialSplit& split = scene.splits[form.split];
    plan.split_levels = std::max(plan.split_levels, level);
    for (int c = 0; c < 2; ++c) {
      const ShadePlan child = plan_material(scene, split.child[c], roulette, level + 1, plan);
      out.child[c] = uint32_t(plan.children.size());
      plan.children.push_back(child);
      out.turned[c] = split.turned[c];
    }
    return out;
  }
  out.veil = traits.veil;
  out.sample_lights = plan.lights && !traits.delta && !traits.see_through;
  out.draw_choice = out.sample_lights && scene.lights.size() > 1 && !plan.light_by_place;
  out.all_around = traits.all_around;
  out.draw_lobe = traits.needs_lobe;
  out.draw_direction = traits.needs_direction;
  out.draw_roulette = roulette && !traits.see_through;
  return out;
}

}  // namespace

std::string_view camera_kind_name(CameraKind kind) {
  return kCameraNames[uint32_t(kind)];
}
std::string_view sampler_kind_name(SamplerKind kind) {
  return kSamplerNames[uint32_t(kind)];
}

Plan make_plan(const Scene& scene, const KernelTable& kernels, const PlanOptions& options) {
  Plan plan;
  plan.kernels = &kernels;
  plan.sampler = options.sampler;
  plan.transport.max_depth = options.max_depth;
  if (options.integrator == Integrator::kDirect)
    plan.transport.least_depth_after_scatter = options.max_depth;
  plan.transport.seed = options.seed;
  plan.transport.roulette_depth = options.roulette_depth;
  plan.light_sampling = options.light_sampling;
  plan.camera = scene.camera_kind;
  const uint32_t set = std::clamp(options.sample_set, 1u, kLargestSet);
  plan.set_columns = uint32_t(std::sqrt(double(set)));
  plan.set_rows = set / plan.set_columns;
  if (plan.sampler == SamplerKind::kNRooks || plan.sampler == SamplerKind::kZSobol) {
    plan.set_columns = plan.sampler == SamplerKind::kZSobol ? std::bit_ceil(set) : set;
    plan.set_rows = 1;
  }
  plan.triangles = scene.triangles.size() > 0;
  plan.shape_tree = scene.shape_tree.view.node_count > 0;
  plan.spheres = scene.spheres.size() > 0 && !plan.shape_tree;
  for (uint32_t kind = 0; kind < kShapeKinds; ++kind)
    plan.shapes[kind] =
        scene.shape_rows[kind].end > scene.shape_rows[kind].first && !plan.shape_tree;
  plan.planes = scene.planes.size() > 0;
  plan.shadow_mask = !scene.all_occlude;
  plan.instances = !scene.instances.empty();
  plan.instance_mask = !scene.instances.all_occlude;

  // Light is sampled at vertices below max_depth only.
  plan.lights = scene.lights.size() > 0 && options.max_depth > 0 &&
                (plan.light_sampling != LightSampling::kBsdf || has_unmet_lights(scene));
  plan.light_kernel = scene.light_kinds >> kPlainLightKinds ? kAnyLights
                      : std::popcount(scene.light_kinds) == 1
                          ? uint32_t(std::countr_zero(scene.light_kinds))
                          : kPlainLights;
  plan.light_tree = scene.light_tree.nodes.size() > 0;
  plan.light_by_place = lights_share_number(scene);
  if (plan.light_tree && plan.light_kernel < kPlainLights &&
      plan.light_kernel != uint32_t(LightKind::kTriangle) &&
      plan.light_kernel != uint32_t(LightKind::kRectangle))
    plan.light_kernel = kPlainLights;
  plan.varying_emission = plan.lights && scene.emission.size() > 0;
  plan.environment = scene.first_environment < scene.lights.size();
  plan.transport.hide_environment = !scene.show_environment;
  // Scattering vertices beyond the first that plays roulette are needed for it to be played.
  const bool roulette = plan.transport.max_depth > plan.transport.roulette_depth;

  plan.first_lasting_bin = scene.first_lasting_bin;
  plan.bins.resize(scene.bins.size());
  for (uint32_t b = 1; b < scene.bins.size(); ++b) {
    BinPlan& bin = plan.bins[b];
    bin.bin = scene.bins[b];
    bin.emission = bin.bin.emissive;
    plan.tangents = plan.tangents || bin.bin.tangents;
    static_cast<ShadePlan&>(bin) =
        plan_material(scene, {bin.bin.material, bin.bin.split, bin.bin.program}, roulette, 1, plan);
    plan.veils = plan.veils || (plan.lights && bin.bin.passing == Passing::kVeil);
  }
  plan.veil_shape_tree = plan.veils && scene.veil_shape_tree.view.node_count > 0;
  need_kernels(plan);
  return plan;
}

namespace {

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

std::string describe_material(const Plan& plan, const ShadePlan& material) {
  const std::string_view name = material_traits(material.material).name;
  if (material.splits)
    return fmt::format(", split {} [{}] [{}]", name,
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
  if (material.sample_lights)
    what += fmt::format(", {} ({})",
                        plan.varying_emission ? "sample_varying_lights"
                        : plan.light_tree     ? "sample_tree_lights"
                                              : "sample_lights",
                        kLightNames[plan.varying_emission ? kAnyLights : plan.light_kernel]);
  return what + fmt::format(", shade {}", name);
}

}  // namespace

std::string describe_plan(const Plan& plan, const Scene& scene) {
  std::string text;
  const auto line = [&](Stage stage, std::string_view what) {
    fmt::format_to(std::back_inserter(text), "  {:<17}{}\n", stage_name(stage), what);
  };
  text += fmt::format("stages ({}, {} lanes)\n", plan.kernels->isa, plan.kernels->lanes);
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
    line(
        Stage::kEnvironment,
        fmt::format("{}: {} lights{}", plan.light_tree ? "add_tree_environment" : "add_environment",
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
         fmt::format("add_unoccluded: {} lights{}", scene.lights.size(), ways_text(plan)));
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
            : !plan.transport.max_depth ? "paths end at their first vertex"
                                        : "light is found by chance (--light-sampling bsdf)");
  else
    skipped(
        any_bin([](const ShadePlan& b) { return b.draw_choice; }) ||
            (scene.lights.size() > 1 && !plan.light_by_place),
        "draw choice",
        plan.light_by_place ? "the number of the place chooses the light" : "there is one light");
  skipped(plan.light_tree || !plan.lights, "light tree", "lights are chosen by power");
  skipped(any_bin([](const ShadePlan& b) { return b.draw_lobe; }), "draw lobe",
          "no material chooses between lobes");
  skipped(any_bin([](const ShadePlan& b) { return b.draw_roulette; }), "draw roulette",
          plan.transport.roulette_depth == kNoRoulette
              ? "paths go on to their last vertex (--roulette off)"
              : "no path gets as far as Russian roulette");
  for (uint32_t kind = 0; kind < kMaterialKinds; ++kind)
    skipped(any_bin([&](const ShadePlan& b) { return b.material == MaterialKind(kind); }),
            "shade " + std::string(material_traits(MaterialKind(kind)).name),
            "no surface of this material");
  return text;
}

}  // namespace yat

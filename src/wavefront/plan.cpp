#include "wavefront/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "kernels/strata.h"

namespace yat {

namespace {

/// A table without a kernel that the plan wants is a mistake in the program, not in the scene.
void need(bool present, const KernelTable& kernels, std::string_view kernel) {
  if (!present) throw std::logic_error(fmt::format("{}: no kernel {}", kernels.isa, kernel));
}

/// groups: of lights.
void need_material(const ShadePlan& plan, size_t groups, const KernelTable& k) {
  if (plan.splits)
    need(k.split[uint32_t(plan.material)], k, "split");
  else
    need(k.shade[uint32_t(plan.material)], k, "shade");
  if (plan.sample_lights && groups > 1) need(k.connect[uint32_t(plan.material)], k, "connect");
  if (plan.unequal) need(k.chances && k.weigh_child, k, "chances");
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
    for (const LightGroup& group : plan.light_groups)
      if (group.tree)
        need(k.sample_tree_lights[group.kernel], k, "sample_tree_lights");
      else
        need(k.sample_lights[group.kernel], k, "sample_lights");
    need(k.add_unoccluded, k, "add_unoccluded");
  }
  if (plan.environment)
    need(plan.far_by_tree ? k.add_tree_environment : k.add_environment, k, "add_environment");
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
    need_material(bin, plan.light_groups.size(), k);
    if (bin.emission)
      need(plan.light_tree ? k.add_tree_emission : k.add_emission, k, "add_emission");
    if (bin.bin.emission_varies())
      need(k.make_derivatives && k.apply_emission_maps && k.multiply_colours, k,
           "apply_emission_maps");
  }
  if (plan.varying_emission)
    need(k.sample_varying_lights[plan.light_tree] && k.make_light_points, k,
         "sample_varying_lights");
  for (const ShadePlan& child : plan.children) need_material(child, plan.light_groups.size(), k);
  if (plan.split_levels) need(k.choose_child && k.take_rows, k, "choose_child");
  if (plan.veils)
    need(k.start_veils && k.share_weight && k.pass_veils && k.end_veils, k, "start_veils");
}

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
/// over all lights of the group: what a rare light leaves of its 24 bits must be a fine enough
/// grid.
bool lights_share_number(const Scene& scene, const LightGroup& group) {
  constexpr float kRarest = 1.f / 64;
  if (group.tree || group.rows.end - group.rows.first < 2) return false;
  for (uint32_t i = group.rows.first; i < group.rows.end; ++i)
    if (scene.lights.row(i).probability > 0 && scene.lights.row(i).probability < kRarest)
      return false;
  return true;
}

LightGroup plan_group(const Scene& scene, RowRange rows) {
  const bool tree = scene.light_tree.nodes.size() > 0;
  uint32_t kinds = 0, kernel = kPlainLights;
  for (uint32_t i = rows.first; i < rows.end; ++i) kinds |= 1u << scene.lights.row(i).kind;
  if (kinds >> kPlainLightKinds)
    kernel = kAnyLights;
  else if (std::has_single_bit(kinds) && (!tree || kinds == 1u << uint32_t(LightKind::kTriangle)))
    kernel = uint32_t(std::countr_zero(kinds));
  return {rows, kinds, kernel, tree};
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
    out.unequal = split.unequal;
    for (int c = 0; c < 2; ++c) {
      const ShadePlan child = plan_material(scene, split.child[c], roulette, level + 1, plan);
      out.child[c] = uint32_t(plan.children.size());
      plan.children.push_back(child);
      out.turned[c] = split.turned[c];
    }
    out.solid = plan.children[out.child[0]].solid && plan.children[out.child[1]].solid;
    return out;
  }
  out.veil = traits.veil;
  out.solid = !traits.veil && !traits.see_through;
  out.sample_lights = plan.lights && !traits.delta && !traits.see_through;
  out.draw_choice = out.sample_lights && !plan.light_by_place &&
                    plan.light_groups[0].rows.end - plan.light_groups[0].rows.first > 1;
  out.all_around = traits.all_around;
  out.draw_lobe = traits.needs_lobe;
  out.draw_direction = traits.needs_direction;
  out.draw_roulette = roulette && !traits.see_through;
  return out;
}

}  // namespace

SceneView light_view(const SceneView& scene, const LightGroup& group) {
  SceneView view = scene;
  const Rows<LightRow>& all = scene.lights.rows;
  view.lights.rows = {all.words + size_t(group.rows.first) * row_words<LightRow>,
                      group.rows.end - group.rows.first};
  view.lights.kinds = group.kinds;
  return view;
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

  if (plan.light_sampling == LightSampling::kLights && scene.asked_lights < scene.lights.size())
    throw std::logic_error("make_plan: some lights of the scene are found by chance alone");
  // Light is sampled at vertices below max_depth only.
  plan.lights = scene.asked_lights > 0 && options.max_depth > 0 &&
                (plan.light_sampling != LightSampling::kBsdf || has_unmet_lights(scene));
  if (plan.lights) plan.shadow_roulette = options.shadow_roulette;
  plan.light_tree = scene.light_tree.nodes.size() > 0;
  const uint32_t lights = scene.asked_lights, in_group = scene.every_light ? 1 : lights;
  for (uint32_t i = 0; plan.lights && i < lights; i += in_group)
    plan.light_groups.push_back(plan_group(scene, {i, i + in_group}));
  plan.light_by_place = plan.lights && lights_share_number(scene, plan.light_groups[0]);
  plan.varying_emission = plan.lights && scene.emission.size() > 0;
  plan.environment = scene.first_environment < scene.lights.size();
  plan.far_by_tree = plan.light_tree && scene.first_far_light < scene.asked_lights;
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

}  // namespace yat

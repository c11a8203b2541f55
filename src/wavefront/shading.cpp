// A turn's shading, chunk by chunk: from the hits of a bin to shadow rays and the next rays. Chunks
// are dense rows of one bin, and of one material where that is made of others.

#include <algorithm>

#include "wavefront/light_sampling.h"
#include "wavefront/schedule.h"

namespace yat {

void Worker::shade() {
  for (uint32_t b = 1; b < plan_.bins.size(); ++b)
    for (uint32_t begin = bin_begin_[b]; begin < bin_begin_[b + 1]; begin += kChunkRows)
      shade_bin(plan_.bins[b], begin, std::min(begin + kChunkRows, bin_begin_[b + 1]));
}

void Worker::draw(Dimension dimension, const PathState<ConstColumn>& paths, float* first,
                  float* second, uint32_t n) {
  kernels_.draw[uint32_t(plan_.sampler)](plan_.draw_key(), dimension, paths.pixel, paths.sample,
                                         paths.depth, first, second, n);
}

void Worker::shade_bin(const BinPlan& bin, uint32_t begin, uint32_t end) {
  const uint32_t n = end - begin;
  ChunkRows rows{.surfaces = batch_.surfaces.view(),
                 .bendable = batch_.surfaces.columns(),
                 .paths = batch_.chunk_paths.view(),
                 .tangents = {},
                 .coats = {},
                 .slots = batch_.chunk_paths.columns().slot,
                 .seen_weight = batch_.chunk_paths.view().throughput_r,
                 .geometry = bin.bin.geometry,
                 .order = batch_.order.data() + begin,
                 .instance = bin.bin.instanced ? batch_.instance.data() : nullptr,
                 .n = n};

  clock_.enter(Stage::kSurface, n);
  if (bin.bin.instanced)
    kernels_.make_instance_surfaces[bin.bin.geometry == GeometryKind::kTriangleVertex](
        view_, batch_.order.data() + begin, batch_.rays[current_].view(), batch_.hits.view(),
        batch_.instance.data(), batch_.paths[current_].view(), batch_.surfaces.columns(),
        batch_.chunk_paths.columns(), n);
  else
    kernels_.make_surfaces[uint32_t(bin.bin.geometry)](
        view_, batch_.order.data() + begin, batch_.rays[current_].view(), batch_.hits.view(),
        batch_.paths[current_].view(), batch_.surfaces.columns(), batch_.chunk_paths.columns(), n);
  if (bin.bin.tangents) {
    if (bin.bin.instanced)
      kernels_.make_instance_tangents[bin.bin.geometry == GeometryKind::kTriangleVertex](
          view_, batch_.order.data() + begin, batch_.instance.data(), rows.surfaces,
          batch_.tangents.columns(), n);
    else
      kernels_.make_tangents[uint32_t(bin.bin.geometry)](view_, rows.surfaces,
                                                         batch_.tangents.columns(), n);
    rows.tangents = batch_.tangents.view();
  }
  count(Stage::kSurface, n);

  if (bin.emission) {
    clock_.enter(Stage::kEmission, n);
    const auto add = plan_.light_tree ? kernels_.add_tree_emission : kernels_.add_emission;
    PathState<ConstColumn> paths = rows.paths;
    if (bin.bin.emission_varies())
      paths = batch_.emission.tint(
          bin.bin, {view_, rows.geometry, rows.order, rows.instance, rows.bendable, rows.paths, n});
    if (plan_.light_sampling == LightSampling::kLights)
      forget_lights(paths.pdf, batch_.surfaces.columns().light, n);
    else if (plan_.light_sampling == LightSampling::kBsdf)
      paths.pdf = batch_.no_density.data();
    add(view_, rows.surfaces, paths, batch_.sums.columns(), counted_.drops, n);
    count(Stage::kEmission, n);
  }

  if (bin.splits) {
    clock_.enter(Stage::kDraw, n);
    draw(Dimension::kChild, rows.paths, batch_.child_u.data(), nullptr, n);
    count(Stage::kDraw, n);
    shade_split(bin, rows, batch_.child_u.data(), 0);
  } else {
    shade_rows(bin, rows);
  }
}

ParameterView Worker::parameters_of(const ShadePlan& plan, const ChunkRows& rows) {
  if (plan.program == kNone) return view_.parameters[uint32_t(plan.material)];
  clock_.enter(Stage::kTexture, rows.n);
  const ParameterView made = batch_.textures.run(
      plan.program,
      {view_, rows.geometry, rows.order, rows.instance, rows.bendable, rows.paths, rows.n});
  count(Stage::kTexture, rows.n);
  return made;
}

void Worker::shade_rows(const ShadePlan& plan, const ChunkRows& rows) {
  const uint32_t n = rows.n;
  const ParameterView parameters = parameters_of(plan, rows);
  if (features_.active() && !material_traits(plan.material).see_through) {
    features_.record_surfaces(rows.surfaces, rows.paths, rows.seen_weight, rows.order,
                              rows.instance, batch_.sums.columns(), n);
    features_.turn_indirect(rows.paths.depth, rows.slots, n);
  }
  const Randoms<Column>& randoms = batch_.randoms.columns();
  // Columns that this material does not draw are not there.
  Randoms<ConstColumn> drawn{};
  clock_.enter(Stage::kDraw, n);
  if (plan.sample_lights) {
    drawn.light_u = randoms.light_u;
    drawn.light_v = randoms.light_v;
  }
  // The first number of kChild may have chosen this material among others.
  if (plan.veil)
    draw(Dimension::kChild, rows.paths, randoms.light_choice, randoms.lobe, n);
  else if (plan.draw_choice || plan.draw_lobe)
    draw(Dimension::kChoice, rows.paths, randoms.light_choice,
         plan.draw_lobe ? randoms.lobe : nullptr, n);
  if (plan.draw_choice) drawn.light_choice = randoms.light_choice;
  if (plan.draw_lobe) drawn.lobe = randoms.lobe;
  if (plan.draw_direction) {
    draw(Dimension::kBsdf, rows.paths, randoms.bsdf_u, randoms.bsdf_v, n);
    drawn.bsdf_u = randoms.bsdf_u;
    drawn.bsdf_v = randoms.bsdf_v;
  }
  if (plan.draw_roulette) {
    draw(Dimension::kRoulette, rows.paths, randoms.roulette, nullptr, n);
    drawn.roulette = randoms.roulette;
  }
  count(Stage::kDraw, n);

  ShadeInput in{rows.surfaces, rows.paths, drawn, {}, parameters, rows.tangents, rows.coats};
  if (plan.sample_lights) {
    for (uint32_t group = 0; group < further_shadow_.size(); ++group) {
      in.lights = sample_lights(plan, rows, drawn, group);
      in.light = group;
      clock_.enter(Stage::kShade, n);
      ShadeOutput out;
      out.shadow_rays = batch_.shadow[group].columns();
      out.shadow_count = further_shadow_[group];
      kernels_.connect[uint32_t(plan.material)](in, plan_.transport, out, counted_.drops, n);
      further_shadow_[group] = out.shadow_count;
      count(Stage::kShade, n);
    }
    in.light = uint32_t(further_shadow_.size());
    in.lights = sample_lights(plan, rows, drawn, in.light);
  }

  clock_.enter(Stage::kShade, n);
  const uint32_t first_path = out_.path_count;
  kernels_.shade[uint32_t(plan.material)](in, plan_.transport, out_, counted_.drops, n);
  if (features_.active())
    features_.record_albedo(out_.paths, batch_.sums.columns(), first_path, out_.path_count);
  count(Stage::kShade, n);
}

LightSample<ConstColumn> Worker::sample_lights(const ShadePlan& plan, const ChunkRows& rows,
                                               const Randoms<ConstColumn>& drawn, uint32_t number) {
  const uint32_t n = rows.n;
  const LightGroup& group = plan_.light_groups[number];
  const SceneView& view = light_views_[number];
  const LightSample<Column>& samples = batch_.lights.columns();
  clock_.enter(Stage::kDraw, n);
  draw(of_light(Dimension::kLight, number), rows.paths, batch_.randoms.columns().light_u,
       batch_.randoms.columns().light_v, n);
  count(Stage::kDraw, n);
  clock_.enter(Stage::kLightSample, n);
  if (plan_.varying_emission) {
    uint32_t* const light = batch_.emission.lights();
    kernels_.sample_varying_lights[group.tree](view, rows.surfaces, drawn, plan.all_around, samples,
                                               light, n);
    // The kernel counts from the group's first light: a group behind the first is one light.
    if (number > 0) std::fill_n(light, n, group.rows.first);
    batch_.emission.scale(view_, samples, n);
  } else if (group.tree) {
    kernels_.sample_tree_lights[group.kernel](view, rows.surfaces, drawn, plan.all_around, samples,
                                              n);
  } else {
    kernels_.sample_lights[group.kernel](view, rows.surfaces, drawn, samples, n);
  }
  if (plan_.light_sampling == LightSampling::kLights)
    count_in_full(samples, n);
  else if (plan_.light_sampling == LightSampling::kBsdf)
    empty_met_lights(samples, n);
  count(Stage::kLightSample, n);
  return batch_.lights.view();
}

void Worker::shade_split(const ShadePlan& plan, const ChunkRows& rows, const float* u,
                         uint32_t level) {
  const ParameterView parameters = parameters_of(plan, rows);
  clock_.enter(Stage::kSort, rows.n);
  SplitRows& split = batch_.splits[level];
  kernels_.split[uint32_t(plan.material)](parameters, rows.surfaces, false, split.share.data(),
                                          split.parameter[0].data(), split.parameter[1].data(),
                                          rows.n);
  const float* chance = split.share.data();
  if (plan.unequal) {
    kernels_.chances(parameters, rows.surfaces, split.share.data(), split.chance.data(), rows.n);
    chance = split.chance.data();
  }
  kernels_.choose_child(chance, u, split.child.data(), split.left.data(), rows.n);
  if (plan.coats) kernels_.coats(parameters, rows.surfaces, split.own_coats.columns(), rows.n);
  uint32_t taken[2] = {};
  for (uint32_t i = 0; i < rows.n; ++i) {
    const uint32_t c = split.child[i];
    split.order[c][taken[c]++] = i;
  }
  count(Stage::kSort, rows.n);
  for (uint32_t c = 0; c < 2; ++c) {
    if (!taken[c]) continue;
    clock_.enter(Stage::kSort, taken[c]);
    Surface<ConstColumn> surfaces = rows.surfaces;
    surfaces.parameter = split.parameter[c].data();
    kernels_.take_rows(surfaces, rows.paths, split.left.data(), split.order[c].data(),
                       plan.turned[c], split.surfaces.columns(), split.paths.columns(),
                       split.u.data(), taken[c]);
    const ShadePlan& child = plan_.children[plan.child[c]];
    ChunkRows own{.surfaces = split.surfaces.view(),
                  .bendable = split.surfaces.columns(),
                  .paths = split.paths.view(),
                  .tangents = {},
                  .coats = {},
                  .slots = split.paths.columns().slot,
                  .seen_weight = split.paths.view().throughput_r,
                  .geometry = rows.geometry,
                  .order = nullptr,
                  .instance = rows.instance,
                  .n = taken[c]};
    if (features_.active() && plan.solid) {
      for (uint32_t i = 0; i < taken[c]; ++i)
        split.seen_weight[i] = rows.seen_weight[split.order[c][i]];
      own.seen_weight = split.seen_weight.data();
    }
    if (plan.unequal || plan.coats)
      kernels_.weigh_child(plan.coats ? nullptr : split.share.data(), chance, split.order[c].data(),
                           c, split.paths.columns(), taken[c]);
    const Coat<ConstColumn> over = plan.coats && c ? split.own_coats.view() : rows.coats;
    if (over.outside) {
      kernels_.take_coats(over, split.order[c].data(), split.coats.columns(), taken[c]);
      own.coats = split.coats.view();
    }
    if (rows.instance) {
      for (uint32_t i = 0; i < taken[c]; ++i) split.hit[i] = rows.order[split.order[c][i]];
      own.order = split.hit.data();
    }
    if (rows.tangents.x) {
      const Tangent<Column>& to = split.tangents.columns();
      for (uint32_t i = 0; i < taken[c]; ++i) {
        const uint32_t from = split.order[c][i];
        to.x[i] = rows.tangents.x[from];
        to.y[i] = rows.tangents.y[from];
        to.z[i] = rows.tangents.z[from];
      }
      own.tangents = split.tangents.view();
    }
    if (child.splits)
      shade_split(child, own, split.u.data(), level + 1);
    else
      shade_rows(child, own);
  }
}

}  // namespace yat

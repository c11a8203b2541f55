#include "wavefront/schedule.h"

#include <algorithm>

#include "wavefront/light_sampling.h"

namespace yat {

namespace {
constexpr uint32_t kFilmGroup = 16;  ///< paths that go to the film together
}

Worker::Worker(const Scene& scene, const Plan& plan, uint32_t batch_rows, bool trace, Film& film,
               FeatureFilm* features)
    : scene_(scene),
      view_(scene.view()),
      plan_(plan),
      kernels_(*plan.kernels),
      film_(film),
      film_x0_(scene.film.crop_x0),
      film_y0_(scene.film.crop_y0),
      batch_(scene, plan, batch_rows, FeatureRecorder::sums_per_path(features)),
      features_(scene, features, batch_rows),
      clock_(trace),
      further_shadow_(plan.light_groups.empty() ? 0 : plan.light_groups.size() - 1) {
  for (const LightGroup& group : plan.light_groups)
    light_views_.push_back(light_view(view_, group));
}

void Worker::count(Stage stage, uint64_t rows, LaneCount lanes) {
  StageCount& c = counted_.stats.stages[uint32_t(stage)];
  ++c.calls;
  c.rows += rows;
  c.lanes_active += lanes.rows;
  c.lanes_total += lanes.steps * kernels_.lanes;
}

void Worker::count(Stage stage, uint64_t rows) {
  count(stage, rows, {rows, (rows + kernels_.lanes - 1) / kernels_.lanes});
}

void Worker::generate(WorkCursor& work) {
  const CameraSample<Column>& camera = batch_.camera.columns();
  clock_.enter(Stage::kGenerate);
  const uint32_t n = work.take(free_rows(), camera.pixel, camera.sample);
  if (!n) return;
  const SampleSum<Column>& sums = batch_.sums.columns();
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t slot = batch_.free_slots[--batch_.free_count];
    const uint32_t x = camera.pixel[i] & 0xffffu, y = camera.pixel[i] >> 16;
    camera.slot[i] = slot;
    sums.r[slot] = sums.g[slot] = sums.b[slot] = 0;
    sums.pixel[slot] = (y - film_y0_) * film_.width() + (x - film_x0_);
    batch_.slot_sample[slot] = camera.sample[i];
  }
  if (features_.active()) features_.start(sums, camera.slot, n);
  const auto draw_film = kernels_.draw[uint32_t(plan_.sampler)];
  draw_film(plan_.draw_key(), Dimension::kFilm, camera.pixel, camera.sample, nullptr,
            batch_.film_u.data(), batch_.film_v.data(), n);
  if (has_lens(plan_.camera))
    draw_film(plan_.draw_key(), Dimension::kLens, camera.pixel, camera.sample, nullptr,
              batch_.lens_u.data(), batch_.lens_v.data(), n);
  kernels_.generate_camera_rays[uint32_t(plan_.camera)](
      view_, batch_.camera.view(), batch_.film_u.data(), batch_.film_v.data(),
      has_lens(plan_.camera) ? batch_.lens_u.data() : nullptr,
      has_lens(plan_.camera) ? batch_.lens_v.data() : nullptr,
      columns_from(batch_.rays[current_].columns(), count_),
      columns_from(batch_.paths[current_].columns(), count_), n);
  count(Stage::kGenerate, n);
  counted_.stats.camera_rays += n;
  count_ += n;
  fresh_ += n;
}

void Worker::turn() {
  const uint32_t next = current_ ^ 1;
  out_ = {};
  out_.rays = batch_.rays[next].columns();
  out_.paths = batch_.paths[next].columns();
  out_.shadow_rays = batch_.shadow.back().columns();
  out_.finished = batch_.finished.data();
  intersect();
  sort();
  if (plan_.environment) environment();
  shade();
  for (uint32_t i = 0; i < further_shadow_.size(); ++i)
    shadow(batch_.shadow[i].view(), std::exchange(further_shadow_[i], 0));
  shadow(batch_.shadow.back().view(), out_.shadow_count);
  accumulate();
  clock_.enter(Stage::kSchedule);
  counted_.stats.bounce_rays += out_.path_count;
  current_ = next;
  count_ = out_.path_count;
  fresh_ = 0;
}

void Worker::intersect() {
  clock_.enter(Stage::kIntersect, count_);
  const Ray<ConstColumn> rays = batch_.rays[current_].view();
  const Hit<Column>& hits = batch_.hits.columns();
  LaneCount lanes{count_, (count_ + kernels_.lanes - 1) / kernels_.lanes};
  if (plan_.triangles) {
    const uint32_t old = count_ - fresh_;
    lanes = kernels_.intersect_closest(view_.geometry.tree, rays, hits, old, batch_.scratch);
    const LaneCount fresh =
        kernels_.intersect_tiles(view_.geometry.tree, columns_from(rays, old),
                                 columns_from(hits, old), fresh_, batch_.scratch);
    lanes.rows += fresh.rows;
    lanes.steps += fresh.steps;
  } else {
    std::copy_n(rays.t_max, count_, hits.t);
    std::fill_n(hits.prim, count_, kNone);
  }
  const uint32_t first_sphere = view_.geometry.triangles.count;
  if (plan_.spheres)
    kernels_.intersect_spheres(view_.geometry.spheres, first_sphere, rays, hits, count_);
  const uint32_t first_plane = first_sphere + view_.geometry.spheres.count;
  if (plan_.planes)
    kernels_.intersect_planes(view_.geometry.planes, first_plane, rays, hits, count_);
  const uint32_t first_shape = first_plane + view_.geometry.planes.count;
  for (uint32_t kind = 0; kind < kShapeKinds; ++kind)
    if (plan_.shapes[kind])
      kernels_.intersect_shapes[kind](view_.geometry.shapes, first_shape, rays, hits, count_);
  if (plan_.shape_tree) {
    const LaneCount c = kernels_.intersect_shape_tree(view_.geometry, view_.geometry.shapes.tree,
                                                      rays, hits, count_, batch_.scratch);
    lanes.rows += c.rows;
    lanes.steps += c.steps;
  }
  if (plan_.instances) {
    const LaneCount inside = kernels_.intersect_instances(
        view_.instances, rays, hits, batch_.instance.data(), count_, batch_.scratch);
    lanes.rows += inside.rows;
    lanes.steps += inside.steps;
  }
  count(Stage::kIntersect, count_, lanes);
}

void Worker::sort() {
  clock_.enter(Stage::kSort, count_);
  const uint32_t* depth = batch_.paths[current_].columns().depth;
  if (plan_.instances)
    kernels_.classify_instance_hits(view_.instances, view_.geometry.prim_bin,
                                    plan_.first_lasting_bin, plan_.transport.max_depth,
                                    batch_.hits.view(), batch_.instance.data(), depth,
                                    batch_.bin.data(), count_);
  else
    kernels_.classify_hits(view_.geometry.prim_bin, plan_.first_lasting_bin,
                           plan_.transport.max_depth, batch_.hits.view(), depth, batch_.bin.data(),
                           count_);
  // Counting sort. Two histograms: neighbouring rows are often of one bin, and an increment that
  // waits for the store before it takes several cycles.
  const uint32_t bins = uint32_t(plan_.bins.size());
  uint32_t even[kMaxBins], odd[kMaxBins];
  std::fill_n(even, bins, 0u);
  std::fill_n(odd, bins, 0u);
  const uint32_t* bin = batch_.bin.data();
  uint32_t i = 0;
  for (; i + 1 < count_; i += 2) {
    ++even[bin[i]];
    ++odd[bin[i + 1]];
  }
  if (i < count_) ++even[bin[i]];
  uint32_t place[kMaxBins];
  uint32_t sum = 0;
  for (uint32_t b = 0; b < bins; ++b) {
    bin_begin_[b] = place[b] = sum;
    sum += even[b] + odd[b];
  }
  bin_begin_[bins] = sum;
  uint32_t* order = batch_.order.data();
  for (i = 0; i < count_; ++i) order[place[bin[i]]++] = i;
  count(Stage::kSort, count_);
}

void Worker::environment() {
  // Among the rows of the ended bin are those that missed: the kernel tells them by their hits.
  const uint32_t n = bin_begin_[1];
  if (!n) return;
  clock_.enter(Stage::kEnvironment, n);
  const auto add = plan_.far_by_tree ? kernels_.add_tree_environment : kernels_.add_environment;
  PathState<ConstColumn> paths = batch_.paths[current_].view();
  const uint32_t* rows = batch_.order.data();
  uint32_t taken = n;
  if (plan_.light_sampling == LightSampling::kLights) {
    taken = keep_without_density(paths.pdf, rows, n, batch_.certain.data());
    rows = batch_.certain.data();
  } else if (plan_.light_sampling == LightSampling::kBsdf) {
    paths.pdf = batch_.no_density.data();
  }
  add(view_, rows, batch_.rays[current_].view(), batch_.hits.view(), paths, plan_.transport,
      batch_.sums.columns(), counted_.drops, taken);
  count(Stage::kEnvironment, n);
}

void Worker::shadow(const ShadowRay<ConstColumn>& rays, uint32_t n) {
  if (!n) return;
  clock_.enter(Stage::kIntersectShadow, n);
  counted_.stats.shadow_rays += n;
  uint32_t* occluded = batch_.occluded.data();
  LaneCount lanes{n, (n + kernels_.lanes - 1) / kernels_.lanes};
  if (plan_.triangles)
    lanes = kernels_.intersect_shadow[plan_.shadow_mask](view_.geometry.tree, rays, occluded, n,
                                                         batch_.scratch);
  else
    std::fill_n(occluded, n, 0u);
  if (plan_.spheres) kernels_.shadow_spheres(view_.geometry.spheres, rays, occluded, n);
  if (plan_.planes) kernels_.shadow_planes(view_.geometry.planes, rays, occluded, n);
  for (uint32_t kind = 0; kind < kShapeKinds; ++kind)
    if (plan_.shapes[kind]) kernels_.shadow_shapes[kind](view_.geometry.shapes, rays, occluded, n);
  if (plan_.shape_tree) {
    const LaneCount c =
        kernels_.shadow_shape_tree(view_.geometry, rays, occluded, n, batch_.scratch);
    lanes.rows += c.rows;
    lanes.steps += c.steps;
  }
  if (plan_.instances) {
    const LaneCount inside = kernels_.shadow_instances[plan_.instance_mask](
        view_.instances, rays, occluded, n, batch_.scratch);
    lanes.rows += inside.rows;
    lanes.steps += inside.steps;
  }
  count(Stage::kIntersectShadow, n, lanes);
  if (plan_.veils) {
    walk_veils(rays, n);
    return;
  }
  clock_.enter(Stage::kAccumulate, n);
  kernels_.add_unoccluded(rays, occluded, batch_.sums.columns(), n);
  count(Stage::kAccumulate, n);
}

void Worker::accumulate() {
  // Paths of the ended bin, then those that ended while shading: their last light counts too, so
  // all of them go to the film after it has been added.
  const uint32_t ended = bin_begin_[1];
  clock_.enter(Stage::kAccumulate);
  const uint32_t* slot = batch_.paths[current_].columns().slot;
  for (uint32_t i = 0; i < ended; ++i) out_.finished[out_.finished_count++] = slot[batch_.order[i]];
  // Slots are in no order: a group's pixels are asked for before the first is needed.
  for (uint32_t i = 0; i < out_.finished_count; i += kFilmGroup)
    flush(out_.finished + i, std::min(kFilmGroup, out_.finished_count - i));
  counted_.stats.paths += out_.finished_count;
}

void Worker::flush(const uint32_t* rows, uint32_t n) {
  const SampleSum<Column>& sums = batch_.sums.columns();
  uint32_t* const slots = batch_.free_slots.data() + batch_.free_count;
  FilmPixel* pixels[kFilmGroup];
  for (uint32_t i = 0; i < n; ++i) {
    slots[i] = features_.own_row(rows[i]);
    pixels[i] = film_.data() + sums.pixel[slots[i]];
    __builtin_prefetch(pixels[i], 1);
  }
  batch_.free_count += n;
  float r[kFilmGroup] = {}, g[kFilmGroup] = {}, b[kFilmGroup] = {};
  for (uint32_t i = 0; i < n; ++i) {
    const ColourTriple<float> bands = features_.light(sums, slots[i]);
    r[i] = bands.r, g[i] = bands.g, b[i] = bands.b;
  }
  const BandMatrix film = scene_.colour.film;
  for (uint32_t i = 0; i < kFilmGroup; ++i) {
    const ColourTriple<float> rgb = rgb_of<float>({r[i], g[i], b[i]}, film);
    r[i] = rgb.r, g[i] = rgb.g, b[i] = rgb.b;
  }
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t slot = slots[i];
    if (pixels[i]->add(r[i], g[i], b[i])) {
      if (features_.active()) features_.record_light(sums, slot, {r[i], g[i], b[i]});
    } else {
      const uint32_t pixel = sums.pixel[slot];
      const uint32_t x = film_x0_ + pixel % film_.width();
      const uint32_t y = film_y0_ + pixel / film_.width();
      counted_.drops.add(DropCause::kOther, y << 16 | x, batch_.slot_sample[slot]);
    }
  }
}

}  // namespace yat

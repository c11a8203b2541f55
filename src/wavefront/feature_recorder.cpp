#include "wavefront/feature_recorder.h"

#include <stdexcept>

namespace yat {

FeatureRecorder::FeatureRecorder(const Scene& scene, FeatureFilm* film, uint32_t rows)
    : scene_(scene), film_(film), rows_(rows), split_(sums_per_path(film) == 2) {
  if (!film_) return;
  if (film_->has_ids() && scene.prim_ids.size() != scene.prim_bin.size())
    throw std::logic_error("FeatureRecorder: the scene was compiled without ids");
  seen_.resize(rows);
}

void FeatureRecorder::start(const SampleSum<Column>& sums, const uint32_t* slots, uint32_t n) {
  for (uint32_t i = 0; i < n; ++i) {
    seen_[slots[i]] = kNothing;
    if (!split_) continue;
    const uint32_t rest = slots[i] + rows_;
    sums.r[rest] = sums.g[rest] = sums.b[rest] = 0;
  }
}

SurfaceIds FeatureRecorder::ids_of(uint32_t prim, uint32_t instance) const {
  if (instance == kNone) return scene_.prim_ids[prim];
  const Instances& instances = scene_.instances;
  const uint32_t shape = instances.rows.row(instance).first_shape + instances.triangle_shape[prim];
  return {instances.object_ids[instance], instances.material_ids[shape]};
}

void FeatureRecorder::record_surfaces(const Surface<ConstColumn>& s,
                                      const PathState<ConstColumn>& paths, const float* weights,
                                      const uint32_t* order, const uint32_t* instance,
                                      const SampleSum<Column>& sums, uint32_t n) {
  const bool with_ids = film_->has_ids();
  const auto add = [&](Feature feature, size_t pixel, float x, float y, float z) {
    if (film_->has(feature)) film_->plane(feature).add(pixel, x, y, z);
  };
  for (uint32_t i = 0; i < n; ++i) {
    if (paths.depth[i] & 0xffffu) continue;
    const uint32_t slot = paths.slot[i];
    if (seen_[slot] != kNothing) continue;
    seen_[slot] = kSurface;
    const float weight = weights[i];
    const size_t pixel = sums.pixel[slot];
    const bool outside = s.ng_x[i] * s.wo_x[i] + s.ng_y[i] * s.wo_y[i] + s.ng_z[i] * s.wo_z[i] >= 0;
    const float side = outside ? weight : -weight;
    add(Feature::kNormal, pixel, side * s.ns_x[i], side * s.ns_y[i], side * s.ns_z[i]);
    add(Feature::kGeometricNormal, pixel, side * s.ng_x[i], side * s.ng_y[i], side * s.ng_z[i]);
    add(Feature::kDepth, pixel, s.distance[i], 0, 0);
    add(Feature::kPosition, pixel, float(double(s.pos_x[i]) + scene_.center.x),
        float(double(s.pos_y[i]) + scene_.center.y), float(double(s.pos_z[i]) + scene_.center.z));
    add(Feature::kUv, pixel, s.u[i], s.v[i], 0);
    if (with_ids) {
      const SurfaceIds ids = ids_of(s.prim[i], instance ? instance[order[i]] : kNone);
      film_->ids().add(pixel, {paths.sample[i], ids.object, ids.material});
    }
  }
}

void FeatureRecorder::turn_indirect(const uint32_t* depth, uint32_t* slots, uint32_t n) const {
  if (!split_) return;
  for (uint32_t i = 0; i < n; ++i)
    if ((depth[i] & 0xffffu) && slots[i] < rows_) slots[i] += rows_;
}

void FeatureRecorder::record_albedo(const PathState<Column>& paths, const SampleSum<Column>& sums,
                                    uint32_t first, uint32_t end) {
  if (!film_->has(Feature::kAlbedo)) return;
  FeaturePlane& plane = film_->plane(Feature::kAlbedo);
  for (uint32_t i = first; i < end; ++i) {
    const uint32_t slot = own_row(paths.slot[i]);
    if (seen_[slot] != kSurface || !(paths.depth[i] & 0xffffu)) continue;
    seen_[slot] = kAlbedo;
    // f cos / pdf of one direction is an estimate without bias of what all directions get. The
    // filter weight is in the throughput.
    const ColourTriple<float> rgb = rgb_of<float>(
        {paths.throughput_r[i], paths.throughput_g[i], paths.throughput_b[i]}, scene_.colour.film);
    plane.add(sums.pixel[slot], rgb.r, rgb.g, rgb.b);
  }
}

void FeatureRecorder::record_light(const SampleSum<Column>& sums, uint32_t slot,
                                   const ColourTriple<float>& rgb) {
  const size_t pixel = sums.pixel[slot];
  const auto add = [&](Feature feature, const ColourTriple<float>& c) {
    if (film_->has(feature)) film_->plane(feature).add(pixel, c.r, c.g, c.b);
  };
  add(Feature::kVariance, {rgb.r * rgb.r, rgb.g * rgb.g, rgb.b * rgb.b});
  if (!split_) return;
  add(Feature::kDirect, film_colour(sums, slot));
  add(Feature::kIndirect, film_colour(sums, slot + rows_));
}

}  // namespace yat

#pragma once
// All memory that one worker needs while it renders, taken once.
//
//   rays, paths [2]   the paths under way, dense; a turn reads one pair and packs the next turn's
//                     into the other
//   hits, bin, order  row for row with the pair that is read; order lists its rows bin by bin
//   chunk             a few hundred rows of one bin while they are shaded: stays in the L1 cache
//   shadow            shadow rays of this turn, a table for each group of lights: in each a path
//   has
//                     one at most
//   sums              one row per slot, a slot per path under way (two with parts of the light
//   wanted)
//
// Columns are indexed by row, except sums, slot_sample (by slot).

#include <algorithm>
#include <cstdint>
#include <vector>

#include "kernels/table.h"
#include "soa/columns.h"
#include "soa/records.h"
#include "wavefront/emission.h"
#include "wavefront/plan.h"
#include "wavefront/split_rows.h"
#include "wavefront/textures.h"

namespace yat {

struct Batch {
  /// sums_per_path: rows of SampleSum that each path has (FeatureRecorder).
  Batch(const Scene& scene, const Plan& plan, uint32_t batch_rows, uint32_t sums_per_path)
      : rows(batch_rows),
        hits(batch_rows),
        instance(plan.instances ? batch_rows : 0),
        bin(batch_rows),
        order(batch_rows),
        shadow(std::max<size_t>(1, plan.light_groups.size())),
        occluded(batch_rows),
        sums(batch_rows * sums_per_path),
        slot_sample(batch_rows),
        free_slots(batch_rows),
        finished(batch_rows),
        camera(batch_rows),
        film_u(batch_rows),
        film_v(batch_rows),
        lens_u(has_lens(plan.camera) ? batch_rows : 0),
        lens_v(has_lens(plan.camera) ? batch_rows : 0),
        surfaces(kChunkRows),
        tangents(plan.tangents ? kChunkRows : 0),
        chunk_paths(kChunkRows),
        randoms(kChunkRows),
        lights(plan.lights ? kChunkRows : 0),
        certain(plan.light_sampling == LightSampling::kLights && plan.environment ? batch_rows : 0),
        no_density(plan.light_sampling == LightSampling::kBsdf ? batch_rows : 0),
        textures(scene.programs, scene.colour.reflectance, *plan.kernels, kChunkRows),
        emission(scene, *plan.kernels, kChunkRows),
        child_u(plan.split_levels ? kChunkRows : 0),
        splits(plan.split_levels),
        veils(plan.veils ? batch_rows : 0) {
    for (Table<ShadowRay>& table : shadow) table.resize(batch_rows);
    for (int i = 0; i < 2; ++i) {
      rays[i].resize(batch_rows);
      paths[i].resize(batch_rows);
    }
    size_t scratch_bytes = 0;
    if (plan.triangles)
      scratch_bytes = plan.kernels->traversal_scratch_bytes(scene.tree.view, batch_rows);
    if (plan.veils)
      scratch_bytes = std::max(scratch_bytes,
                               plan.kernels->traversal_scratch_bytes(scene.veils.view, batch_rows));
    if (plan.instances)
      scratch_bytes = std::max(
          scratch_bytes, plan.kernels->instance_scratch_bytes(scene.instances.view(), batch_rows));
    if (plan.shape_tree)
      scratch_bytes = std::max(
          scratch_bytes, plan.kernels->shape_scratch_bytes(scene.shape_tree.view, batch_rows));
    if (plan.veil_shape_tree)
      scratch_bytes = std::max(
          scratch_bytes, plan.kernels->shape_scratch_bytes(scene.veil_shape_tree.view, batch_rows));
    if (scratch_bytes) {
      scratch_memory.resize(scratch_bytes);
      scratch = {scratch_memory.data(), scratch_memory.size()};
    }
    // Lowest slot on top.
    for (uint32_t i = 0; i < batch_rows; ++i) free_slots[i] = batch_rows - 1 - i;
    free_count = batch_rows;
  }
  // `scratch` points into this object's own memory.
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  uint32_t rows;
  Table<Ray> rays[2];
  Table<PathState> paths[2];
  Table<Hit> hits;
  AlignedArray<uint32_t> instance;  ///< per hit, where the plan has instances
  AlignedArray<uint32_t> bin, order;
  std::vector<Table<ShadowRay>> shadow;
  AlignedArray<uint32_t> occluded;
  Table<SampleSum> sums;
  AlignedArray<uint32_t> slot_sample;  ///< sample index of the slot's path
  AlignedArray<uint32_t> free_slots, finished;
  uint32_t free_count = 0;
  Table<CameraSample> camera;
  AlignedArray<float> film_u, film_v, lens_u, lens_v;
  Table<Surface> surfaces;
  Table<Tangent> tangents;
  Table<PathState> chunk_paths;
  Table<Randoms> randoms;
  Table<LightSample> lights;
  AlignedArray<uint32_t> certain;  ///< rows that may count the environment, where not all may
  AlignedArray<float> no_density;  ///< zeros in place of PathState::pdf, where all light met counts
  TextureStage textures;
  EmissionStage emission;
  AlignedArray<float> child_u;    ///< of a chunk: decides between the children of its material
  std::vector<SplitRows> splits;  ///< per level of materials made of others
  VeilRows veils;
  AlignedArray<std::byte> scratch_memory;
  Scratch scratch;

  size_t bytes() const {
    size_t total = hits.bytes() + instance.bytes() + bin.bytes() + order.bytes() +
                   occluded.bytes() + sums.bytes() + slot_sample.bytes() + free_slots.bytes() +
                   finished.bytes() + camera.bytes() + film_u.bytes() + film_v.bytes() +
                   lens_u.bytes() + lens_v.bytes() + surfaces.bytes() + tangents.bytes() +
                   chunk_paths.bytes() + randoms.bytes() + lights.bytes() + certain.bytes() +
                   no_density.bytes() + textures.bytes() + emission.bytes() +
                   scratch_memory.bytes();
    for (int i = 0; i < 2; ++i) total += rays[i].bytes() + paths[i].bytes();
    total += child_u.bytes() + veils.bytes();
    for (const SplitRows& level : splits) total += level.bytes();
    for (const Table<ShadowRay>& table : shadow) total += table.bytes();
    return total;
  }
};

}  // namespace yat

// The kernels that only scenes with shared objects need: intersection, classification, shadow rays,
// surfaces of instances.

#include <algorithm>

#include "kernel_bench.h"
#include "kernel_inputs.h"

namespace yat::bench {

namespace {

/// Rays that the scene's own triangles have not stopped: hits are put back before each call.
void add_closest(const KernelTable& table) {
  const auto kernel = table.intersect_instances;
  if (!kernel || !table.instance_scratch_bytes) return add_missing("intersect_instances", table);
  for (const bool bounce : {false, true})
    add_share_benchmarks(
        bounce ? "intersect_instances/bounce" : "intersect_instances/camera", table,
        [&table, kernel, bounce](benchmark::State& state, uint32_t share) {
          const KernelInputs& in = instance_inputs_for(table);
          const uint32_t n = bounce ? std::min(in.bounce_count, kRows) : in.camera_count;
          if (!n) return no_rows(state);
          const Table<Ray> rays = with_share(bounce ? in.bounce_rays : in.camera_rays, n, share);
          Table<Hit> hits(n);
          AlignedArray<uint32_t> instance(n + kRowPad);
          const Scratch scratch = scratch_for(in);
          LaneCount lanes{};
          time_rows(
              state, n,
              [&] {
                for (uint32_t i = 0; i < n; ++i) hits.set(i, {rays.view().t_max[i], 0, 0, kNone});
              },
              [&] {
                lanes = kernel(in.view.instances, rays.view(), hits.columns(), instance.data(), n,
                               scratch);
              });
          show_lanes(state, table, lanes);
        });
}

void add_shadow(const KernelTable& table) {
  for (const int masked : {0, 1}) {
    const std::string name = masked ? "shadow_instances/masked" : "shadow_instances/all";
    const auto kernel = table.shadow_instances[masked];
    if (!kernel || !table.instance_scratch_bytes) {
      add_missing(name, table);
      continue;
    }
    add_share_benchmarks(name, table, [&table, kernel](benchmark::State& state, uint32_t share) {
      const KernelInputs& in = instance_inputs_for(table);
      const uint32_t n = std::min(in.shadow_count, kRows);
      if (!n) return no_rows(state);
      AlignedArray<uint32_t> occluded(n);
      const Scratch scratch = scratch_for(in);
      LaneCount lanes{};
      // Rays that the scene's own triangles have already stopped are the ones without work.
      time_rows(
          state, n,
          [&] {
            for (uint32_t i = 0; i < n; ++i) occluded[i] = is_active(i, share) ? 0 : 1;
          },
          [&] {
            lanes = kernel(in.view.instances, in.shadow_rays.view(), occluded.data(), n, scratch);
          });
      show_lanes(state, table, lanes);
    });
  }
}

void add_classify(const KernelTable& table) {
  const auto kernel = table.classify_instance_hits;
  if (!kernel) return add_missing("classify_instance_hits", table);
  add_share_benchmarks(
      "classify_instance_hits", table, [&table, kernel](benchmark::State& state, uint32_t share) {
        const KernelInputs& in = instance_inputs_for(table);
        if (!in.camera_count || in.bins.empty()) return no_rows(state);
        Table<Hit> hits(kRows);
        for (uint32_t i = 0; i < kRows; ++i) {
          Hit<Value> hit = in.camera_hits.row(i);
          if (!is_active(i, share)) hit.prim = kNone;
          hits.set(i, hit);
        }
        AlignedArray<uint32_t> bin(kRows);
        time_rows(state, kRows, [&] {
          kernel(in.view.instances, in.view.geometry.prim_bin, in.plan.first_lasting_bin,
                 in.plan.transport.max_depth, hits.view(), in.instance.data(),
                 in.camera_paths.view().depth, bin.data(), kRows);
        });
      });
}

void add_surfaces(const KernelTable& table) {
  for (const int vertex_data : {0, 1}) {
    const std::string name =
        vertex_data ? "make_instance_surfaces/vertices" : "make_instance_surfaces/flat";
    const auto kernel = table.make_instance_surfaces[vertex_data];
    if (!kernel) {
      add_missing(name, table);
      continue;
    }
    add_share_benchmarks(
        name, table, [&table, kernel, vertex_data](benchmark::State& state, uint32_t share) {
          const KernelInputs& in = instance_inputs_for(table);
          const ShadingRows* rows = in.rows_of(
              vertex_data ? GeometryKind::kTriangleVertex : GeometryKind::kTriangleFlat, true);
          if (!rows) return no_rows(state);
          uint32_t n = 0;
          const AlignedArray<uint32_t> order = sparse_order(*rows, share, n);
          Table<Surface> surfaces(kRows);
          Table<PathState> paths(kRows);
          time_rows(state, n, [&] {
            kernel(in.view, order.data(), in.camera_rays.view(), in.camera_hits.view(),
                   in.instance.data(), in.camera_paths.view(), surfaces.columns(), paths.columns(),
                   n);
          });
        });
  }
}

}  // namespace

void add_instance_benchmarks(const KernelTable& table) {
  add_closest(table);
  add_shadow(table);
  add_classify(table);
  add_surfaces(table);
}

}  // namespace yat::bench

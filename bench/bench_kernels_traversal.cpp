// Camera rays, random numbers, intersection, classification, shadow rays.

#include <fmt/format.h>

#include <cstring>

#include "kernel_bench.h"
#include "kernel_inputs.h"
#include "wavefront/plan.h"

namespace yat::bench {

Table<Ray> with_share(const Table<Ray>& rays, uint32_t n, uint32_t share) {
  Table<Ray> out(n);
  for (uint32_t i = 0; i < n; ++i) {
    Ray<Value> ray = rays.row(i);
    if (!is_active(i, share)) ray.t_max = 0;
    out.set(i, ray);
  }
  return out;
}
Table<ShadowRay> with_share(const Table<ShadowRay>& rays, uint32_t n, uint32_t share) {
  Table<ShadowRay> out(n);
  for (uint32_t i = 0; i < n; ++i) {
    ShadowRay<Value> ray = rays.row(i);
    if (!is_active(i, share)) ray.dir_x = ray.dir_y = ray.dir_z = 0;
    out.set(i, ray);
  }
  return out;
}

namespace {

void add_draw(const KernelTable& table) {
  for (uint32_t sampler = 0; sampler < uint32_t(SamplerKind::kCount); ++sampler) {
    const std::string name = fmt::format("draw/{}", sampler_kind_name(SamplerKind(sampler)));
    const auto kernel = table.draw[sampler];
    if (!kernel) {
      add_missing(name, table);
      continue;
    }
    add_benchmark(name, table, [&table, kernel](benchmark::State& state) {
      const KernelInputs& in = inputs_for(table, kAllLights);
      if (!in.camera_count) return no_rows(state);
      const PathState<ConstColumn> paths = in.camera_paths.view();
      AlignedArray<float> first(kRows), second(kRows);
      time_rows(state, kRows, [&] {
        kernel(0, Dimension::kBsdf, paths.pixel, paths.sample, paths.depth, first.data(),
               second.data(), kRows);
      });
    });
  }
}

void add_camera(const KernelTable& table) {
  for (const CameraKind kind : {CameraKind::kPinhole, CameraKind::kThinLens}) {
    const bool lens = has_lens(kind);
    const std::string name =
        lens ? "generate_camera_rays/thin_lens" : "generate_camera_rays/pinhole";
    const auto kernel = table.generate_camera_rays[uint32_t(kind)];
    if (!kernel) {
      add_missing(name, table);
      continue;
    }
    add_benchmark(name, table, [&table, kernel, lens](benchmark::State& state) {
      const KernelInputs& in = inputs_for(table, kAllLights);
      if (!in.camera_count) return no_rows(state);
      Table<Ray> rays(kRows);
      Table<PathState> paths(kRows);
      time_rows(state, kRows, [&] {
        kernel(in.view, in.camera_samples.view(), in.film_u.data(), in.film_v.data(),
               lens ? in.lens_u.data() : nullptr, lens ? in.lens_v.data() : nullptr, rays.columns(),
               paths.columns(), kRows);
      });
    });
  }
}

void add_closest(const KernelTable& table) {
  const auto kernel = table.intersect_closest;
  if (!kernel || !table.traversal_scratch_bytes) return add_missing("intersect_closest", table);
  for (const bool bounce : {false, true})
    add_share_benchmarks(
        bounce ? "intersect_closest/bounce" : "intersect_closest/camera", table,
        [&table, kernel, bounce](benchmark::State& state, uint32_t share) {
          const KernelInputs& in = inputs_for(table, kAllLights);
          const uint32_t n = bounce ? std::min(in.bounce_count, kRows) : in.camera_count;
          if (!n) return no_rows(state);
          const Table<Ray> rays = with_share(bounce ? in.bounce_rays : in.camera_rays, n, share);
          Table<Hit> hits(n);
          const Scratch scratch = scratch_for(in);
          LaneCount lanes{};
          time_rows(state, n, [&] {
            lanes = kernel(in.view.geometry.tree, rays.view(), hits.columns(), n, scratch);
          });
          show_lanes(state, table, lanes);
        });
}

void add_shadow(const KernelTable& table) {
  for (const int masked : {0, 1}) {
    const std::string name = masked ? "intersect_shadow/masked" : "intersect_shadow/all";
    const auto kernel = table.intersect_shadow[masked];
    if (!kernel || !table.traversal_scratch_bytes) {
      add_missing(name, table);
      continue;
    }
    add_share_benchmarks(name, table, [&table, kernel](benchmark::State& state, uint32_t share) {
      const KernelInputs& in = inputs_for(table, kAllLights);
      const uint32_t n = std::min(in.shadow_count, kRows);
      if (!n) return no_rows(state);
      const Table<ShadowRay> rays = with_share(in.shadow_rays, n, share);
      AlignedArray<uint32_t> occluded(n);
      const Scratch scratch = scratch_for(in);
      LaneCount lanes{};
      time_rows(state, n, [&] {
        lanes = kernel(in.view.geometry.tree, rays.view(), occluded.data(), n, scratch);
      });
      show_lanes(state, table, lanes);
    });
  }
}

/// Analytic shapes change the hits: they are put back before each call.
template <class Kernel, class Rows>
void add_analytic(const KernelTable& table, const char* name, Kernel kernel, Rows rows_of) {
  if (!kernel) return add_missing(name, table);
  add_share_benchmarks(name, table,
                       [&table, kernel, rows_of](benchmark::State& state, uint32_t share) {
                         const KernelInputs& in = inputs_for(table, kAllLights);
                         const uint32_t n = std::min(in.bounce_count, kRows);
                         if (!n) return no_rows(state);
                         const Table<Ray> rays = with_share(in.bounce_rays, n, share);
                         Table<Hit> hits(n);
                         const auto [rows, first] = rows_of(in.view.geometry);
                         time_rows(
                             state, n,
                             [&] {
                               for (uint32_t i = 0; i < n; ++i)
                                 hits.set(i, {rays.columns().t_max[i], 0, 0, kNone});
                             },
                             [&] { kernel(rows, first, rays.view(), hits.columns(), n); });
                       });
}

template <class Kernel, class Rows>
void add_analytic_shadow(const KernelTable& table, const char* name, Kernel kernel, Rows rows_of) {
  if (!kernel) return add_missing(name, table);
  add_share_benchmarks(name, table,
                       [&table, kernel, rows_of](benchmark::State& state, uint32_t share) {
                         const KernelInputs& in = inputs_for(table, kAllLights);
                         const uint32_t n = std::min(in.shadow_count, kRows);
                         if (!n) return no_rows(state);
                         AlignedArray<uint32_t> occluded(n);
                         const auto rows = rows_of(in.view.geometry);
                         // Rays that the tree has already found occluded are the ones without work.
                         time_rows(
                             state, n,
                             [&] {
                               for (uint32_t i = 0; i < n; ++i)
                                 occluded[i] = is_active(i, share) ? 0 : 1;
                             },
                             [&] { kernel(rows, in.shadow_rays.view(), occluded.data(), n); });
                       });
}

void add_classify(const KernelTable& table) {
  const auto kernel = table.classify_hits;
  if (!kernel) return add_missing("classify_hits", table);
  add_share_benchmarks(
      "classify_hits", table, [&table, kernel](benchmark::State& state, uint32_t share) {
        const KernelInputs& in = inputs_for(table, kAllLights);
        if (!in.camera_count || in.bins.empty()) return no_rows(state);
        Table<Hit> hits(kRows);
        for (uint32_t i = 0; i < kRows; ++i) {
          Hit<Value> hit = in.camera_hits.row(i);
          if (!is_active(i, share)) hit.prim = kNone;
          hits.set(i, hit);
        }
        AlignedArray<uint32_t> bin(kRows);
        time_rows(state, kRows, [&] {
          kernel(in.view.geometry.prim_bin, in.plan.first_lasting_bin, in.plan.transport.max_depth,
                 hits.view(), in.camera_paths.view().depth, bin.data(), kRows);
        });
      });
}

}  // namespace

void add_traversal_benchmarks(const KernelTable& table) {
  add_draw(table);
  add_camera(table);
  add_closest(table);
  const auto spheres = [](const GeometryView& g) {
    return std::pair(g.spheres, g.triangles.count);
  };
  const auto planes = [](const GeometryView& g) {
    return std::pair(g.planes, g.triangles.count + g.spheres.count);
  };
  add_analytic(table, "intersect_spheres", table.intersect_spheres, spheres);
  add_analytic(table, "intersect_planes", table.intersect_planes, planes);
  add_classify(table);
  add_shadow(table);
  add_analytic_shadow(table, "shadow_spheres", table.shadow_spheres,
                      [](const GeometryView& g) { return g.spheres; });
  add_analytic_shadow(table, "shadow_planes", table.shadow_planes,
                      [](const GeometryView& g) { return g.planes; });
}

}  // namespace yat::bench

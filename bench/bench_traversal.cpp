// Traversal alone: recorded rays through every instruction set's kernels, per batch size.
//
//   bench_traversal [--benchmark_...] [mesh.ply ...]        Google Benchmark over all sets
//   bench_traversal --table [mesh.ply ...]                  one table, interleaved with Embree
//
// The table times each kernel and each Embree variant in turn, five rounds, and keeps the best of
// each: frequency changes then hit all alike. Embree's best is over calls (single rays, packets,
// streams, coherent and not) and both build qualities. It also counts rays whose answers differ.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>

#include "kernels/dispatch.h"
#include "measure.h"
#include "ray_sets.h"
#include "scene/tree_build.h"
#if defined(YAT_WITH_EMBREE)
#include "traversal_embree.h"
#endif

namespace yat::bench {
namespace {

constexpr uint32_t kBatch = 8192;

struct Kernel {
  const KernelTable* table;
  Tree tree;
};

struct Prepared {
  BenchScene scene;
  std::vector<Kernel> kernels;
  std::vector<RaySet> sets;
};

Prepared prepare(BenchScene scene) {
  Prepared out{std::move(scene), {}, {}};
  ThreadPool pool;
  for (const IsaEntry& entry : built_isas())
    if (entry.here)
      out.kernels.push_back(
          {entry.table(), build_tree(out.scene.rows.view(), {},
                                     {std::max(4u, entry.table()->lanes), false}, pool)});
  const Kernel& best = out.kernels.back();
  out.sets = record_rays(out.scene, *best.table, best.tree.view, 512, 512);
  return out;
}

/// Columns of a set, cut into batches.
struct Batches {
  Table<Ray> rays;
  Table<ShadowRay> shadow_rays;
  Table<Hit> hits;
  AlignedArray<uint32_t> occluded;
  AlignedArray<std::byte> scratch;
  uint32_t n, batch;

  Batches(const Kernel& kernel, const RaySet& set, uint32_t batch_rows)
      : n(uint32_t(set.rays.size())), batch(batch_rows) {
    scratch.resize(kernel.table->traversal_scratch_bytes(kernel.tree.view, batch));
    if (set.shadow) {
      shadow_rays.resize(n);
      occluded.resize(n);
      for (uint32_t i = 0; i < n; ++i) {
        const Ray<Value>& r = set.rays[i];
        shadow_rays.set(i, {r.org_x, r.org_y, r.org_z, r.dir_x, r.dir_y, r.dir_z, 0, 0, 0, i});
      }
    } else {
      rays.resize(n);
      hits.resize(n);
      for (uint32_t i = 0; i < n; ++i) rays.set(i, set.rays[i]);
    }
  }
  LaneCount trace(const Kernel& kernel, bool shadow) {
    LaneCount sum;
    for (uint32_t i = 0; i < n; i += batch) {
      const uint32_t m = std::min(batch, n - i);
      const LaneCount c =
          shadow ? kernel.table->intersect_shadow[0](
                       kernel.tree.view, columns_from(shadow_rays.view(), i), occluded.data() + i,
                       m, {scratch.data(), scratch.size()})
                 : kernel.table->intersect_closest(kernel.tree.view, columns_from(rays.view(), i),
                                                   columns_from(hits.columns(), i), m,
                                                   {scratch.data(), scratch.size()});
      sum.rows += c.rows;
      sum.steps += c.steps;
    }
    return sum;
  }
};

void print_table(const Prepared& p) {
  const TreeStatistics& s = p.kernels.back().tree.statistics;
  std::printf(
      "\n%s: %llu triangles, build %.3f s, %llu nodes, %llu leaves, %llu blocks (%.0f %% full), "
      "%.2f references per triangle, depth %u, SAH %.2f, %.1f MB\n",
      p.scene.name.c_str(), static_cast<unsigned long long>(s.triangles), s.build_seconds,
      static_cast<unsigned long long>(s.nodes), static_cast<unsigned long long>(s.leaves),
      static_cast<unsigned long long>(s.blocks), 100 * s.block_fill,
      double(s.references) / double(s.triangles), s.max_depth, s.sah_cost,
      double(p.kernels.back().tree.bytes()) / 1e6);
  std::printf("%-10s %9s", "rays", "n");
  for (const Kernel& k : p.kernels) std::printf(" %9s ns/ray lanes", k.table->isa);
#if defined(YAT_WITH_EMBREE)
  std::printf("   Embree  ratio best (variant), differing\n");
  const EmbreeScene embree[2] = {{p.scene, EmbreeQuality::kMedium},
                                 {p.scene, EmbreeQuality::kHigh}};
  const std::vector<std::string> variants = EmbreeScene::variants();
#else
  std::printf("   (no Embree here)\n");
#endif
  for (const RaySet& set : p.sets) {
    std::vector<std::unique_ptr<Batches>> batches;
    for (const Kernel& k : p.kernels) batches.push_back(std::make_unique<Batches>(k, set, kBatch));
    std::vector<double> best(p.kernels.size(), HUGE_VAL), lanes(p.kernels.size());
    const double n = double(set.rays.size());
#if defined(YAT_WITH_EMBREE)
    double best_embree = HUGE_VAL;
    std::string best_variant;
    std::vector<Hit<Value>> theirs;
#endif
    for (int round = 0; round < 5; ++round) {
      for (size_t k = 0; k < p.kernels.size(); ++k) {
        const double start = thread_seconds();
        const LaneCount count = batches[k]->trace(p.kernels[k], set.shadow);
        const double t = thread_seconds() - start;
        best[k] = std::min(best[k], t);
        lanes[k] = double(count.rows) / (double(count.steps) * p.kernels[k].table->lanes);
      }
#if defined(YAT_WITH_EMBREE)
      for (uint32_t v = 0; v < variants.size(); ++v)
        for (int quality = 0; quality < 2; ++quality) {
          const double t = embree[quality].trace(v, set, theirs);
          if (t < best_embree) {
            best_embree = t;
            best_variant = variants[v] + (quality ? ", high" : ", medium");
          }
        }
#endif
    }
    std::printf("%-10s %9zu", set.name.c_str(), set.rays.size());
    for (size_t k = 0; k < best.size(); ++k)
      std::printf(" %6.1fM/s %6.1f  %3.0f%%", n / best[k] * 1e-6, best[k] / n * 1e9,
                  100 * lanes[k]);
#if defined(YAT_WITH_EMBREE)
    embree[0].trace(0, set, theirs);
    uint32_t differing = 0;
    for (uint32_t i = 0; i < set.rays.size(); ++i) {
      if (set.shadow) {
        differing += (batches.back()->occluded[i] != 0) != (theirs[i].prim != kNone);
      } else {
        const Hit<Value> ours = batches.back()->hits.row(i);
        differing += (ours.prim == kNone) != (theirs[i].prim == kNone) ||
                     (ours.prim != kNone && std::abs(ours.t - theirs[i].t) > 1e-4f * ours.t);
      }
    }
    std::printf("  %6.1fM/s %5.2f (%s) %u", n / best_embree * 1e-6, best_embree / best.back(),
                best_variant.c_str(), differing);
#endif
    std::printf("\n");
    std::fflush(stdout);
  }
}

void register_all(const Prepared& p) {
  for (const RaySet& set : p.sets)
    for (const Kernel& kernel : p.kernels)
      for (const uint32_t batch : {1024u, 4096u, 8192u, 16384u})
        benchmark::RegisterBenchmark(
            (p.scene.name + "/" + set.name + "/" + kernel.table->isa + "/" + std::to_string(batch))
                .c_str(),
            [&kernel, &set, batch](benchmark::State& state) {
              Batches batches(kernel, set, batch);
              LaneCount count;
              for (auto _ : state) count = batches.trace(kernel, set.shadow);
              state.SetItemsProcessed(int64_t(state.iterations()) * batches.n);
              state.counters["lanes"] =
                  double(count.rows) / (double(count.steps) * kernel.table->lanes);
            });
}

int run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  bool table = false;
  std::vector<Prepared> scenes;
  scenes.push_back(prepare(cornell_box()));
  scenes.push_back(prepare(rough_sphere(70000)));
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]) == "--table") {
      table = true;
    } else {
      scenes.push_back(prepare(mesh_in_room(argv[i])));
    }
  }
  if (table) {
    for (const Prepared& p : scenes) print_table(p);
    return 0;
  }
  for (const Prepared& p : scenes) register_all(p);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace
}  // namespace yat::bench

int main(int argc, char** argv) {
  try {
    return yat::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_traversal: %s\n", error.what());
    return 1;
  }
}

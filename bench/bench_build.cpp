// Building the tree: time, memory and quality over 10k to 2M triangles, beside Embree's builds.
//
//   bench_build [--benchmark_...] [options] [mesh.ply ...]          Google Benchmark, yat alone
//   bench_build --table [--json FILE] [options] [mesh.ply ...]      one table, in turn with Embree
//
// The table builds each scene by each program in turn on the same number of threads, and shows
// medians: wall time, and processor time of all threads, which other programs disturb less; "cores"
// is the one by the other, and tells whether two threads had two processors. Memory is taken in a
// round of its own, the process's before each build against its peak: the same measure for all.
// Embree's tree copies the corners out of the mesh as yat's blocks do; the meshes themselves are in
// neither number.

#include <benchmark/benchmark.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "base/error.h"
#include "bench_scenes.h"
#include "kernels/dispatch.h"
#include "measure.h"
#include "scene/tree_build.h"
#include "split_arguments.h"
#if defined(YAT_WITH_EMBREE)
#include "embree_build.h"
#endif

namespace yat::bench {
namespace {

struct Options {
  std::vector<std::string> meshes;
  std::vector<std::string> scenes = {"hall", "sphere"};
  std::vector<uint32_t> sizes = {10000, 30000, 100000, 300000, 1000000, 2000000};
  std::vector<uint32_t> threads = {1, 2};
  uint32_t repetitions = 5;
  double seconds = 20;
  std::string isa, tree = "auto", json;
  bool table = false, no_embree = false;
};

/// One builder's measurements of one scene on so many threads.
struct Series {
  std::string builder;  ///< "yat", "Embree medium", "Embree high"
  std::vector<double> wall, cpu;
  uint64_t bytes = 0;           ///< of the finished tree
  uint64_t peak_bytes = 0;      ///< resident above what was there before the build
  uint64_t own_peak_bytes = 0;  ///< by the builder's own count; 0 where it keeps none
};

using BuildOnce = std::function<Series()>;

TreeOptions tree_options(const Options& options) {
  return {std::max(4u, select_kernels(options.isa).lanes), options.tree == "kd"};
}

Series build_yat(const BenchScene& scene, const TreeOptions& options, ThreadPool& pool,
                 TreeStatistics& statistics) {
  const double wall = wall_seconds(), cpu = process_seconds();
  const Tree tree = build_tree(scene.rows.view(), {}, options, pool);
  Series once{"yat", {wall_seconds() - wall}, {process_seconds() - cpu}, tree.bytes(), 0, 0};
  statistics = tree.statistics;
  return once;
}

#if defined(YAT_WITH_EMBREE)
Series build_embree(EmbreeBuilder& builder, EmbreeQuality quality) {
  const EmbreeBuilder::Result r = builder.build(quality);
  return {std::string("Embree ") + embree_quality_name(quality),
          {r.wall},
          {r.cpu},
          r.bytes,
          0,
          r.peak_bytes};
}
#endif

/// A first round for memory, then rounds for time, until there are enough of them or (after three)
/// enough seconds have passed.
std::vector<Series> measure_in_turn(const std::vector<BuildOnce>& builds, const Options& options) {
  std::vector<Series> out;
  for (const BuildOnce& build : builds) {
    const bool reset = reset_peak_bytes();
    const uint64_t before = resident_bytes();
    Series series = build();
    series.peak_bytes = reset ? peak_resident_bytes() - std::min(before, peak_resident_bytes()) : 0;
    series.wall.clear(), series.cpu.clear();
    out.push_back(std::move(series));
  }
  const double start = wall_seconds();
  for (uint32_t round = 0; round < options.repetitions; ++round) {
    if (round >= 3 && wall_seconds() - start > options.seconds) break;
    for (size_t i = 0; i < builds.size(); ++i) {
      const Series once = builds[i]();
      out[i].wall.push_back(once.wall[0]);
      out[i].cpu.push_back(once.cpu[0]);
    }
  }
  return out;
}

void print_header(bool embree) {
  std::printf("%-22s %8s %3s %9s %9s %8s %8s %5s %6s %5s %5s", "scene", "triangles", "thr",
              "wall s", "cpu s", "MB", "peak MB", "refs", "SAH", "full", "depth");
  if (embree) std::printf(" | medium: wall    cpu     MB   peak | high: wall    cpu     MB   peak");
  std::printf("\n");
}

void print_row(const BenchScene& scene, uint32_t threads, const TreeStatistics& s,
               const std::vector<Series>& all) {
  const Series& yat = all[0];
  const auto ratio = [](double ours, double theirs) { return theirs > 0 ? ours / theirs : 0; };
  const auto cores = [&](const Series& series) {
    return ratio(median(series.cpu), median(series.wall));
  };
  std::printf("%-16s %9llu %3u %8.4f %8.4f %5.2f %7.2f %7.2f %5.2f %6.2f %3.0f%% %5u",
              scene.name.c_str(), static_cast<unsigned long long>(s.triangles), threads,
              median(yat.wall), median(yat.cpu), cores(yat), double(yat.bytes) * 1e-6,
              double(yat.peak_bytes) * 1e-6, double(s.references) / double(s.triangles), s.sah_cost,
              100 * s.block_fill, s.max_depth);
  for (size_t i = 1; i < all.size(); ++i)
    std::printf(" | %12.2f %5.2f %5.2f %5.2f %5.2f", ratio(median(yat.wall), median(all[i].wall)),
                ratio(median(yat.cpu), median(all[i].cpu)), cores(all[i]),
                ratio(double(yat.bytes), double(all[i].bytes)),
                ratio(double(yat.peak_bytes), double(all[i].peak_bytes)));
  std::printf("\n");
  std::fflush(stdout);
}

Json json_row(const BenchScene& scene, uint32_t threads, const TreeStatistics& s,
              const std::vector<Series>& all) {
  Json row = {
      {"scene", scene.name},        {"triangles", s.triangles},   {"threads", threads},
      {"references", s.references}, {"nodes", s.nodes},           {"leaves", s.leaves},
      {"blocks", s.blocks},         {"block_fill", s.block_fill}, {"max_depth", s.max_depth},
      {"sah_cost", s.sah_cost},     {"builders", Json::array()}};
  for (const Series& series : all)
    row["builders"].push_back({{"builder", series.builder},
                               {"wall", series.wall},
                               {"cpu", series.cpu},
                               {"wall_median", median(series.wall)},
                               {"cpu_median", median(series.cpu)},
                               {"bytes", series.bytes},
                               {"peak_resident_bytes", series.peak_bytes},
                               {"own_peak_bytes", series.own_peak_bytes}});
  return row;
}

/// Calls f with every scene that is wanted, one alive at a time.
void for_each_scene(const Options& options, const std::function<void(const BenchScene&)>& f) {
  for (const std::string& mesh : options.meshes) f(mesh_in_room(mesh));
  for (const std::string& name : options.scenes)
    for (const uint32_t size : options.sizes) f(generated_scene(name + ":" + std::to_string(size)));
}

void run_table(const Options& options) {
#if defined(YAT_WITH_EMBREE)
  const bool embree = !options.no_embree;
#else
  const bool embree = false;
#endif
  Json report = origin("bench_build");
  const TreeOptions tree = tree_options(options);
  report["tree"] = {{"kind", options.tree}, {"block_width", tree.block_width}};
#if defined(YAT_WITH_EMBREE)
  if (embree) report["embree"] = embree_version();
#endif
  report["rows"] = Json::array();
  std::printf("yat's builds, and the ratio yat / Embree%s; cores: Embree's own\n",
              embree ? "" : " (without Embree)");
  print_header(embree);
  for_each_scene(options, [&](const BenchScene& scene) {
    for (const uint32_t threads : options.threads) {
      ThreadPool pool(threads);
      TreeStatistics statistics;
      std::vector<BuildOnce> builds = {[&] { return build_yat(scene, tree, pool, statistics); }};
#if defined(YAT_WITH_EMBREE)
      std::unique_ptr<EmbreeBuilder> builder;
      if (embree) {
        builder = std::make_unique<EmbreeBuilder>(scene, threads);
        builds.push_back([&] { return build_embree(*builder, EmbreeQuality::kMedium); });
        builds.push_back([&] { return build_embree(*builder, EmbreeQuality::kHigh); });
      }
#endif
      const std::vector<Series> all = measure_in_turn(builds, options);
      print_row(scene, threads, statistics, all);
      report["rows"].push_back(json_row(scene, threads, statistics, all));
      // After every row: what is measured is not lost when the rest is cut off.
      if (!options.json.empty()) write_json(options.json, report);
    }
  });
}

void run_benchmarks(const Options& options) {
  const TreeOptions tree = tree_options(options);
  const auto add = [&](const std::string& name, std::function<BenchScene()> make) {
    for (const uint32_t threads : options.threads)
      benchmark::RegisterBenchmark(
          ("build/" + name + "/threads:" + std::to_string(threads)).c_str(),
          [make, threads, tree](benchmark::State& state) {
            const BenchScene scene = make();
            ThreadPool pool(threads);
            TreeStatistics s;
            for (auto _ : state) build_yat(scene, tree, pool, s);
            state.counters["triangles/s"] = benchmark::Counter(
                double(s.triangles), benchmark::Counter::kIsIterationInvariantRate);
            state.counters["refs/triangle"] = double(s.references) / double(s.triangles);
            state.counters["SAH"] = s.sah_cost;
          })
          ->UseRealTime()
          ->MeasureProcessCPUTime()
          ->Unit(benchmark::kMillisecond);
  };
  for (const std::string& mesh : options.meshes)
    add(mesh.substr(mesh.find_last_of('/') + 1), [mesh] { return mesh_in_room(mesh); });
  for (const std::string& kind : options.scenes)
    for (const uint32_t size : options.sizes) {
      const std::string name = kind + ":" + std::to_string(size);
      add(name, [name] { return generated_scene(name); });
    }
  benchmark::RunSpecifiedBenchmarks();
}

int run(int argc, char** argv) {
  SplitArguments words(argc, argv);
  Options options;
  CLI::App app("Building the tree: time, memory and quality, beside Embree's builds.");
  app.footer("--benchmark_... options go to Google Benchmark.");
  app.option_defaults()->always_capture_default();
  app.add_flag("--table", options.table, "One table, in turn with Embree, instead of benchmarks");
  app.add_option("--json", options.json, "Write the table's measurements here (implies --table)");
  app.add_option("--scenes", options.scenes, "Generated scenes: hall, sphere")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember({"hall", "sphere"}));
  app.add_option("--sizes", options.sizes, "Triangles of each generated scene; 0: no such scenes")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--threads", options.threads, "Threads of every builder")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Range(1, 1024));
  app.add_option("--repetitions", options.repetitions, "Rounds, of which the median is shown")
      ->check(CLI::Range(1, 1000));
  app.add_option("--seconds", options.seconds,
                 "After three rounds, start no other once a row has taken this long");
  app.add_option("--isa", options.isa, "Width of the tree's blocks by this instruction set");
  app.add_option("--tree", options.tree, "Kind of tree")->check(CLI::IsMember({"auto", "kd"}));
  app.add_flag("--no-embree", options.no_embree, "yat alone");
  app.add_option("meshes", options.meshes, "PLY files, each placed in a closed room");
  try {
    app.parse(int(words.own.size()), words.own.data());
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  std::erase(options.sizes, 0u);
  if (options.table || !options.json.empty()) {
    run_table(options);
    return 0;
  }
  int library_count = int(words.library.size());
  benchmark::Initialize(&library_count, words.library.data());
  run_benchmarks(options);
  return 0;
}

}  // namespace
}  // namespace yat::bench

int main(int argc, char** argv) {
  return yat::bench::run_program("bench_build", yat::bench::run, argc, argv);
}

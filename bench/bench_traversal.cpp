// Traversal alone: recorded rays through the kernels, and through Embree's variants.
//
//   bench_traversal [--benchmark_...] [options] [mesh.ply | scene.lxs ...]   Google Benchmark, yat
//   alone bench_traversal --table [--json FILE] [options] [mesh.ply | scene.lxs ...]   a table, in
//   turn with Embree
//
// Without scenes: the Cornell box and a displaced sphere of 70 thousand triangles. The table traces
// each set by each kernel and each variant of Embree (single rays, packets of 8 and 16, streams;
// coherent and incoherent; MEDIUM and HIGH builds) in turn, several rounds, and shows medians of
// the thread's processor time. Embree gets its rays ready-made in its own form; yat reads columns
// and writes columns. Answers are compared; where they differ beyond ties, double precision over
// all triangles says who is right, and where yat is wrong the program ends with 1.

#include <benchmark/benchmark.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "base/error.h"
#include "kernels/dispatch.h"
#include "measure.h"
#include "rays_file.h"
#include "split_arguments.h"
#include "traversal_table.h"
#if defined(YAT_WITH_EMBREE)
#include "embree_build.h"
#endif

namespace yat::bench {
namespace {

struct Options {
  std::vector<std::string> files, open_meshes, ray_files, scenes;
  uint32_t resolution = 512;
  bool table = false, no_embree = false;
  std::string json;
  TableOptions traced;
};

void register_all(const Prepared& p) {
  for (const RaySet& set : p.sets)
    for (const Config& config : p.configs)
      benchmark::RegisterBenchmark(
          (p.scene.name + "/" + set.name + "/" + config.name()).c_str(),
          [&config, &set](benchmark::State& state) {
            TracedSet traced(config, set);
            TraceTime time;
            for (auto _ : state) time = traced.trace();
            state.SetItemsProcessed(int64_t(state.iterations()) * traced.rows());
            if (time.lanes.steps)
              state.counters["lanes"] =
                  double(time.lanes.rows) / (double(time.lanes.steps) * config.table->lanes);
          });
}

Recording record_file(const std::string& file, uint32_t resolution) {
  Diagnostics diagnostics([](Severity severity, std::string_view line) {
    if (severity == Severity::kError) std::fprintf(stderr, "%.*s\n", int(line.size()), line.data());
  });
  RecordOptions options;
  options.camera_rays = uint64_t(resolution) * resolution;
  return record_scene(file, best_kernels(), options, diagnostics);
}

/// Calls f(prepared) for every scene asked for, one after the other.
template <class F>
void for_each_scene(const Options& options, F&& f) {
  const auto with = [&](Recording recording) {
    f(prepare(std::move(recording), options.resolution, options.traced));
  };
  for (const std::string& file : options.files)
    if (file.ends_with(".lxs")) {
      with(record_file(file, options.resolution));
    } else {
      with({mesh_in_room(file), {}});
    }
  for (const std::string& mesh : options.open_meshes) with({mesh_as_it_is(mesh), {}});
  for (const std::string& file : options.ray_files) with(read_rays(file));
  for (const std::string& name : options.scenes) with({generated_scene(name), {}});
}

int run_tables(const Options& options) {
  Json report = origin("bench_traversal");
  report["resolution"] = options.resolution;
  report["repetitions"] = options.traced.repetitions;
#if defined(YAT_WITH_EMBREE)
  if (options.traced.embree) report["embree"] = embree_version();
#endif
  report["scenes"] = Json::array();
  uint64_t wrong = 0;
  for_each_scene(options, [&](std::unique_ptr<Prepared> prepared) {
    report["scenes"].push_back(run_table(*prepared, options.traced, wrong));
    // After every scene: what is measured is not lost when the rest is cut off.
    if (!options.json.empty()) write_json(options.json, report);
  });
  print_summary(report["scenes"]);
  if (wrong == 0) return 0;
  std::fprintf(stderr, "bench_traversal: %llu answers of yat are wrong: see the rows marked ***\n",
               static_cast<unsigned long long>(wrong));
  return 1;
}

void describe(CLI::App& app, Options& options) {
  app.footer("--benchmark_... options go to Google Benchmark.");
  app.option_defaults()->always_capture_default();
  const auto list = [](CLI::Option* option) {
    return option->delimiter(',')->allow_extra_args(false);
  };
  app.add_flag("--table", options.table, "One table, in turn with Embree, instead of benchmarks");
  app.add_option("--json", options.json, "Write the table's measurements here (implies --table)");
  list(app.add_option("--scenes", options.scenes,
                      "Generated scenes: cornell, sphere[:triangles], hall[:triangles]"));
  app.add_option("--open", options.open_meshes,
                 "A PLY file as it is, seen from its middle (repeatable)")
      ->allow_extra_args(false);
  app.add_option(
         "--resolution", options.resolution,
         "Camera rays: this, squared; of an .lxs scene about so many, but one per pixel at least")
      ->check(CLI::Range(8, 4096));
  list(app.add_option("--isa", options.traced.isas,
                      "Instruction sets (default: YAT_ISA, else the best here)"));
  list(app.add_option("--tree", options.traced.trees, "Kinds of tree: auto, kd"))
      ->check(CLI::IsMember({"auto", "kd"}));
  list(app.add_option("--kernels", options.traced.kernels,
                      "render: camera rays in tiles, others in streams; stream: all in streams; "
                      "scalar: plain code over the same tree"))
      ->check(CLI::IsMember(trace_kernel_names()));
  list(app.add_option("--streams", options.traced.streams,
                      "Rows of a stream; 0: 8192 camera and shadow rays, 32768 to 65536 others"))
      ->check(CLI::Range(0, 1 << 22));
  list(app.add_option("--threads", options.traced.threads,
                      "Trace on so many threads too, and show the gain over one"))
      ->check(CLI::Range(1, 1024));
  app.add_option("--repetitions", options.traced.repetitions, "Rounds, of which medians are shown")
      ->check(CLI::Range(1, 1000));
  app.add_option("--seconds", options.traced.seconds,
                 "After three rounds, start no other once a set has taken this long");
  app.add_flag("--no-embree", options.no_embree, "yat alone");
  app.add_option("--rays", options.ray_files, "A file made by record_rays (repeatable)")
      ->allow_extra_args(false);
  app.add_option(
      "files", options.files,
      "PLY files, each placed in a closed room, and .lxs scenes, recorded as record_rays "
      "does");
}

int run(int argc, char** argv) {
  SplitArguments words(argc, argv);
  Options options;
  options.traced.trees = {"auto"};
  options.traced.streams = {0};
  options.traced.kernels = {"render"};
  CLI::App app("Traversal alone: recorded rays through the kernels, beside Embree's variants.");
  describe(app, options);
  try {
    app.parse(int(words.own.size()), words.own.data());
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  options.traced.embree = !options.no_embree;
  for (uint32_t& stream : options.traced.streams)
    stream = (stream + kRowPad - 1) / kRowPad * kRowPad;
  if (options.scenes.empty() && options.files.empty() && options.open_meshes.empty() &&
      options.ray_files.empty())
    options.scenes = {"cornell", "sphere"};
  if (options.table || !options.json.empty()) return run_tables(options);
  int library_count = int(words.library.size());
  benchmark::Initialize(&library_count, words.library.data());
  std::vector<std::unique_ptr<Prepared>> scenes;
  for_each_scene(options, [&](std::unique_ptr<Prepared> prepared) {
    scenes.push_back(std::move(prepared));
    register_all(*scenes.back());
  });
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace
}  // namespace yat::bench

int main(int argc, char** argv) {
  return yat::bench::run_program("bench_traversal", yat::bench::run, argc, argv);
}

// bench_render [BENCHMARK OPTION...] [SCENE...]: read, build and render, for 1 and 2 threads.
// Without scenes: the bundled ones. Rays and paths per second count rendering alone.
//   bench_render --benchmark_repetitions=5 scenes/cornell-box/cornell-box.lxs
// YAT_ISA chooses the instruction set, as in the program; YAT_BENCH_SPP the samples per pixel (16).

#include <benchmark/benchmark.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "kernels/dispatch.h"
#include "scene/compile.h"
#include "scene/parse.h"
#include "wavefront/pilot.h"
#include "wavefront/render.h"

namespace yat::bench {
namespace {

void quiet(Severity, std::string_view) {}

uint32_t samples_per_pixel() {
  const char* text = std::getenv("YAT_BENCH_SPP");
  if (!text) return 16;
  uint32_t value = 0;
  const char* end = text + std::strlen(text);
  const auto [stop, error] = std::from_chars(text, end, value);
  if (error != std::errc() || stop != end || value == 0)
    throw UsageError(std::string("YAT_BENCH_SPP=") + text + ": give a number of samples above 0");
  return value;
}

Scene load(const std::string& path, const KernelTable& kernels, ThreadPool& pool) {
  Diagnostics diagnostics(quiet);
  CompileOptions options;
  options.block_width = kernels.lanes;
  return compile_scene(read_scene(path, diagnostics), options, pool, diagnostics);
}

void bench_read(benchmark::State& state, const std::string& path) {
  for (auto _ : state) {
    Diagnostics diagnostics(quiet);
    Description description = read_scene(path, diagnostics);
    benchmark::DoNotOptimize(description.hash);
  }
}

void bench_build(benchmark::State& state, const std::string& path, uint32_t threads) {
  Diagnostics diagnostics(quiet);
  const Description description = read_scene(path, diagnostics);
  ThreadPool pool(threads);
  CompileOptions options;
  options.block_width = select_kernels().lanes;
  uint64_t triangles = 0;
  for (auto _ : state) {
    const Scene scene = compile_scene(description, options, pool, diagnostics);
    triangles = scene.triangles.size();
  }
  state.counters["triangles/s"] =
      benchmark::Counter(double(triangles), benchmark::Counter::kIsIterationInvariantRate);
}

void bench_render(benchmark::State& state, const std::string& path, uint32_t threads) {
  const KernelTable& kernels = select_kernels();
  ThreadPool pool(threads);
  const Scene scene = load(path, kernels, pool);
  PlanOptions plan_options;
  plan_options.integrator = scene.direct_only ? Integrator::kDirect : Integrator::kPath;
  plan_options.max_depth = uint32_t(std::max(0, scene.max_depth));
  Plan plan = make_plan(scene, kernels, plan_options);
  RenderOptions options;
  options.end_sample = samples_per_pixel();
  uint64_t rays = 0, paths = 0;
  for (auto _ : state) {
    Film film(scene.film.crop_width(), scene.film.crop_height());
    set_shadow_bound(scene, plan);
    const RenderResult result = render(scene, plan, options, pool, film);
    rays += result.stats.camera_rays + result.stats.bounce_rays + result.stats.shadow_rays;
    paths += result.stats.paths;
  }
  using benchmark::Counter;
  state.counters["Mrays/s"] = Counter(double(rays) * 1e-6, Counter::kIsRate);
  state.counters["Mpaths/s"] = Counter(double(paths) * 1e-6, Counter::kIsRate);
}

std::vector<std::string> bundled_scenes() {
  std::vector<std::string> scenes;
  const std::filesystem::path folder = YAT_SOURCE_DIR "/scenes";
  if (std::filesystem::is_directory(folder))
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
      if (entry.path().extension() == ".lxs") scenes.push_back(entry.path().string());
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

/// An exception inside a benchmark would end the others, too.
template <class F>
void add(const std::string& name, F f) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [f](benchmark::State& state) {
                                 try {
                                   f(state);
                                 } catch (const std::exception& error) {
                                   state.SkipWithError(error.what());
                                 }
                               })
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace
}  // namespace yat::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  std::vector<std::string> scenes;
  for (int i = 1; i < argc; ++i) {
    if (argv[i][0] == '-') {
      std::fprintf(stderr, "%s: no such option (see --help)\n", argv[i]);
      return 2;
    }
    scenes.emplace_back(argv[i]);
  }
  if (scenes.empty()) scenes = yat::bench::bundled_scenes();
  for (const std::string& scene : scenes) {
    const std::string name = std::filesystem::path(scene).stem().string();
    yat::bench::add(name + "/read",
                    [scene](benchmark::State& state) { yat::bench::bench_read(state, scene); });
    for (const uint32_t threads : {1u, 2u}) {
      const std::string suffix = "/threads:" + std::to_string(threads);
      yat::bench::add(name + "/build" + suffix, [scene, threads](benchmark::State& state) {
        yat::bench::bench_build(state, scene, threads);
      });
      yat::bench::add(name + "/render" + suffix, [scene, threads](benchmark::State& state) {
        yat::bench::bench_render(state, scene, threads);
      });
    }
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

#include "app/yart_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>

#include "app/build_info.h"
#include "app/interrupt.h"
#include "app/load.h"
#include "base/whole_file.h"
#include "film/film.h"
#include "film/output.h"
#include "kernels/dispatch.h"
#include "wavefront/pilot.h"
#include "wavefront/render.h"

namespace yat {

namespace {

constexpr uint32_t kRayTracerDepth = 10;  ///< reflections and refractions

Arguments arguments_of(const YartArguments& given) {
  Arguments arguments;
  arguments.scene = given.scene;
  arguments.dialect = Dialect::kYart;
  arguments.threads = given.threads;
  arguments.integrator = given.path_tracer ? Integrator::kPath : Integrator::kDirect;
  // What is seen by the last reflection is lit, too: a vertex more.
  arguments.max_depth =
      given.path_tracer ? given.trace_depth : given.ray_depth.value_or(kRayTracerDepth) + 1;
  return arguments;
}

/// Paths per pixel. The ray tracer's hits ask for as many shadow rays as the lights say together;
/// here every path takes one, and its own place in the pixel.
uint32_t samples_of(const YartArguments& given, const Scene& scene) {
  if (given.path_tracer) return given.samples;
  constexpr uint64_t kMost = uint64_t(1) << 30;
  return uint32_t(
      std::min(kMost, uint64_t(given.antialiasing) * std::max<uint64_t>(1, scene.light_samples)));
}

uint64_t triangles_of(const Scene& scene) {
  uint64_t placed = scene.triangles.size();
  for (const SharedObject& object : scene.instances.objects)
    placed += uint64_t(object.instances) * object.triangles;
  return placed;
}

std::string time_of_day() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  return fmt::format("{}:{:02}", local.tm_hour, local.tm_min);
}

/// One whole render, timed.
struct Run {
  Film film;
  double seconds = 0;
  uint64_t dropped = 0;
};
Run render_once(const YartArguments& given, const Loaded& loaded, ThreadPool& pool,
                const std::atomic<bool>& stop) {
  const FilmSettings& film = loaded.scene.film;
  Run run{Film(film.crop_width(), film.crop_height())};
  RenderOptions options;
  options.end_sample = samples_of(given, loaded.scene);
  options.tile_size = given.bucket_size;
  options.stop = &stop;
  if (given.heart_beat) options.tile_done = [] { print("."); };
  Stopwatch watch;
  Plan plan = loaded.plan;
  set_shadow_bound(loaded.scene, plan);
  const RenderResult result = render(loaded.scene, plan, options, pool, run.film);
  run.seconds = watch.lap();
  for (const uint64_t count : result.drops.count) run.dropped += count;
  return run;
}

void save(const YartArguments& given, const Loaded& loaded, const Run& run, double shown_seconds,
          Console& console) {
  if (given.output.empty()) return;
  PictureMetadata metadata;
  metadata.scene = given.scene;
  metadata.scene_hash = loaded.scene.hash;
  metadata.seed = loaded.plan.transport.seed;
  metadata.samples_per_pixel =
      double(run.film.total_samples()) / (double(run.film.width()) * run.film.height());
  metadata.render_seconds = run.seconds;
  metadata.isa = loaded.plan.kernels->isa;
  metadata.version = kBuildInfo.version;
  if (given.stamp)
    metadata.stamp =
        fmt::format("{} time: {} | Tris: {}", given.benchmark > 1 ? "Average" : "Render",
                    yart_time(shown_seconds), triangles_of(loaded.scene));
  const bool stamped = write_picture(given.output, run.film.resolve(), run.film.width(),
                                     run.film.height(), loaded.scene.film, metadata);
  if (!stamped)
    console.line(given.output.ends_with(".exr")
                     ? "warning: -t: an .exr holds light, not text: nothing is written into it"
                     : "warning: -t: no font found, the bar is empty: " + metadata.stamp);
}

}  // namespace

ExitCode yart_command(const YartArguments& given, Console& console) {
  if (!given.remarks.empty()) console.line(given.remarks);
  if (!given.output.empty() && !is_picture_name(given.output))
    throw Error(fmt::format("yat: -o {}: unknown kind of picture, choose .png, .exr or .jpg",
                            given.output));
  const Arguments arguments = arguments_of(given);
  const KernelTable& kernels = select_kernels(arguments.isa);
  ThreadPool pool(arguments.threads);
  Diagnostics diagnostics(sink_for(console, arguments.verbosity));
  Loaded loaded;
  load(arguments, kernels, pool, console, diagnostics, loaded);
  diagnostics.flush_repeats();
  if (!given.output.empty()) require_writable(given.output);
  require_film_memory(loaded.scene.film, {});
  print(fmt::format("Scene loading time: {}\n", yart_time(loaded.time.read)));

  InterruptGuard guard;
  const uint32_t runs = std::max(given.benchmark, 1u);
  if (!given.benchmark) print(fmt::format("Starting process at {}\n", time_of_day()));
  std::optional<Run> last;
  uint64_t milliseconds = 0;
  double seconds = 0;
  uint32_t done = 0;
  do {
    if (given.benchmark) print(fmt::format("Render {}/{}... ", done + 1, runs));
    last.reset();  // one film at a time
    last.emplace(render_once(given, loaded, pool, guard.stop()));
    ++done;
    seconds += last->seconds;
    milliseconds += uint64_t(std::llround(last->seconds * 1000));
    if (given.heart_beat) print("\n");
    if (given.benchmark) print(yart_time(last->seconds) + "\n");
  } while (done < runs && !guard.interrupted());
  if (last->dropped)
    console.line(
        fmt::format("warning: {} contributions that were not finite or negative are left "
                    "out (yat render --compat yart says which)",
                    last->dropped));
  if (last->film.total_samples() == 0) {
    if (!guard.interrupted())
      throw Error(
          fmt::format("{}: error: all samples were dropped, no picture written", given.scene));
    console.line("interrupted before the first sample: no picture written");
    return ExitCode::kInterrupted;
  }
  const double average = double(milliseconds / done) * 1e-3;
  save(given, loaded, *last, given.benchmark ? average : last->seconds, console);
  if (guard.interrupted()) {
    console.line("interrupted: the picture holds what was done so far");
    return ExitCode::kInterrupted;
  }
  if (given.benchmark)
    print(fmt::format(
        "Benchmark finished!\nTotal runs: {}\nAverage time: {}\n"
        "Renders per second: {}\nTotal time: {}\n",
        done, yart_time(average), float(done / std::max(seconds, 1e-9)), yart_time(seconds)));
  else
    print(
        fmt::format("Render finished!\nPreprocessing time: {}\nRender time: {}\n"
                    "-------------------\nTotal time: {}\n",
                    yart_time(loaded.time.build), yart_time(last->seconds),
                    yart_time(loaded.time.build + last->seconds)));
  if (diagnostics.error_count())
    console.line(fmt::format("warning: {} error{} above: parts of the scene are not in the picture",
                             diagnostics.error_count(), diagnostics.error_count() == 1 ? "" : "s"));
  return ExitCode::kDone;
}

}  // namespace yat

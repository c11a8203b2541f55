#include "app/converge_renders.h"

#include <fmt/format.h>

#include "app/machine.h"
#include "app/noise_passes.h"
#include "base/error.h"
#include "kernels/dispatch.h"

namespace yat {

namespace {

Arguments with(const Arguments& arguments, uint32_t spp, uint32_t seed) {
  Arguments changed = arguments;
  if (!changed.noise_target) changed.samples_per_pixel = spp;
  changed.seed = seed;
  return changed;
}

}  // namespace

ConvergeRenders::ConvergeRenders(const ConvergeArguments& arguments, Console& console) {
  const auto prepare = [&](const ConvergeVariant& variant, Verbosity verbosity) {
    auto& threads = pools_[variant.arguments.threads];
    if (!threads) threads = std::make_unique<ThreadPool>(variant.arguments.threads);
    auto& scene = scenes_[variant.scene_key];
    if (scene) return;
    scene = std::make_unique<ConvergeScene>();
    scene->kernels = &select_kernels(variant.arguments.isa);
    Diagnostics diagnostics(sink_for(console, verbosity));
    // What stratified samplers spread depends on the rung: see plan().
    Arguments of_scene = with(variant.arguments, arguments.ladder.back(), 0);
    of_scene.verbosity = verbosity;
    load(of_scene, *scene->kernels, *threads, console, diagnostics, scene->loaded);
    diagnostics.flush_repeats();
    scene->bytes = scene->loaded.scene.bytes();
  };
  Verbosity verbosity = arguments.verbosity;
  for (const ConvergeVariant& variant : arguments.variants) {
    prepare(variant, verbosity);
    verbosity = Verbosity::kQuiet;
  }
  if (arguments.reference.empty()) prepare(arguments.shared, verbosity);
  for (const ConvergeVariant& variant : arguments.variants)
    require_film_memory(scene(variant).loaded.scene.film, 0,
                        film_parts(variant.to_noise(), variant.arguments.adaptive));
  const FilmSettings& first = scene(arguments.variants.front()).loaded.scene.film;
  for (const ConvergeVariant& variant : arguments.variants) {
    const FilmSettings& film = scene(variant).loaded.scene.film;
    if (film.crop_width() != first.crop_width() || film.crop_height() != first.crop_height())
      throw Error(fmt::format(
          "error: variant \"{}\" renders {} x {} pixels, the first one {} x {}: give all the same "
          "--resolution and --crop",
          variant.name, film.crop_width(), film.crop_height(), first.crop_width(),
          first.crop_height()));
  }
}

ThreadPool& ConvergeRenders::pool(const ConvergeVariant& variant) const {
  return *pools_.at(variant.arguments.threads);
}

Plan ConvergeRenders::plan(const ConvergeVariant& variant, uint32_t spp, uint32_t seed) const {
  const ConvergeScene& s = scene(variant);
  return plan_of(with(variant.arguments, spp, seed), *s.kernels, s.loaded.scene);
}

RunResult ConvergeRenders::run(const ConvergeVariant& variant, uint32_t spp, uint32_t seed,
                               Progress& progress, std::atomic<bool>& stop) const {
  const Scene& compiled = scene(variant).loaded.scene;
  const Plan planned = plan(variant, spp, seed);
  const bool to_noise = variant.to_noise();
  FilmParts film(compiled.film.crop_width(), compiled.film.crop_height(), 0, to_noise ? 2 : 1);
  PassLimits limits;
  limits.samples = {0, spp};
  if (to_noise) {
    limits.samples.end = kLastSample;
    limits.unlimited = true;
    limits.noise_target = *variant.arguments.noise_target;
    limits.adaptive = variant.arguments.adaptive;
  }
  const PassContext context{compiled, planned, pool(variant), progress, stop};
  RunResult result;
  const double before = cpu_seconds();
  result.totals = to_noise ? render_to_noise(context, limits, film)
                           : render_passes(context, limits, film[0].film, nullptr);
  result.cpu_seconds = cpu_seconds() - before;
  const uint64_t samples = film.total_samples();
  if (samples == 0 && !stop)
    throw Error(fmt::format(
        "{}: error: all samples of variant \"{}\" were dropped: their light is not finite or above "
        "{:.3g} W/m2/sr: use weaker lights",
        variant.arguments.scene, variant.name, double(kLargestSample)));
  result.image = {film.width(), film.height(), film.resolve(), true};
  result.samples_per_pixel = double(samples) / double(result.image.pixels());
  result.film_bytes = film.bytes();
  return result;
}

}  // namespace yat

#include "app/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "app/machine.h"
#include "app/passes.h"
#include "film/film.h"
#include "kernels/strata.h"
#include "scene/parse.h"
#include "wavefront/focus.h"

namespace yat {

namespace {

/// One line: whose rules the scene is read by. What suggests the other's, as warnings.
void tell_rules(const Description& description, Console& console, Verbosity verbosity,
                Diagnostics& diagnostics) {
  if (verbosity != Verbosity::kQuiet)
    console.line(description.dialect == Dialect::kYart
                     ? "read by YART's rules (--compat yart)"
                     : "read by LuxRender's rules (YART's: --compat yart)");
  for (const DialectHint& hint : description.dialect_hints)
    diagnostics.warning(hint.loc, hint.message);
}

/// What stratified samplers spread together: all samples of a pixel, as far as their number is
/// known before.
uint32_t sample_set(const Arguments& arguments, const FilmSettings& film) {
  constexpr uint32_t kUnknown = 64;
  if (arguments.sample_set) return *arguments.sample_set;
  const PassLimits limits = pass_limits(arguments, film);
  const bool known = !limits.unlimited && !arguments.samples_range && limits.noise_target == 0;
  return known ? std::min(limits.samples.end, kLargestSet) : kUnknown;
}

/// The description in `loaded` as columns and plan, with what the command line says otherwise.
void compile(const Arguments& arguments, const KernelTable& kernels, ThreadPool& pool,
             Diagnostics& diagnostics, Loaded& loaded) {
  CompileOptions options;
  options.block_width = kernels.lanes;
  options.tree = arguments.tree;
  options.width = arguments.width;
  options.height = arguments.height;
  options.colour = colour_mode(arguments);
  if (arguments.integrator) options.direct_only = *arguments.integrator == Integrator::kDirect;
  if (arguments.crop) {
    for (size_t i = 0; i < 4; ++i) options.crop[i] = (*arguments.crop)[i];
    options.crop_given = true;
  }
  options.image_bytes = arguments.image_bytes;
  const auto asks_for = [&](Feature feature) {
    return (arguments.features & feature_bit(feature)) != 0;
  };
  options.ids = asks_for(Feature::kObjectId) || asks_for(Feature::kMaterialId);
  options.keep_uv = asks_for(Feature::kUv);
  options.instances = arguments.instances;
  options.compensation = arguments.compensation;
  options.light_choice = arguments.light_choice;
  options.leaves_even_skies = arguments.light_sampling != LightSampling::kLights;
  loaded.scene = compile_scene(loaded.description, options, pool, diagnostics);
  if (arguments.tone_map) loaded.scene.film.tone_map = *arguments.tone_map;
  loaded.scene.film.exposure_stops = arguments.exposure_stops;
  focus_camera(loaded.scene);

  loaded.integrator = loaded.scene.direct_only ? Integrator::kDirect : Integrator::kPath;
  loaded.plan = plan_of(arguments, kernels, loaded.scene);
}

}  // namespace

Diagnostics::Sink sink_for(Console& console, Verbosity verbosity) {
  return [&console, verbosity](Severity severity, std::string_view line) {
    const bool wanted = severity == Severity::kError ||
                        (severity == Severity::kWarning && verbosity != Verbosity::kQuiet) ||
                        verbosity == Verbosity::kVerbose;
    if (wanted) console.line(line);
  };
}

Plan plan_of(const Arguments& arguments, const KernelTable& kernels, const Scene& scene) {
  PlanOptions plan;
  plan.integrator = scene.direct_only ? Integrator::kDirect : Integrator::kPath;
  plan.sampler = arguments.sampler.value_or(scene.sampler);
  plan.sample_set = sample_set(arguments, scene.film);
  plan.max_depth = arguments.max_depth.value_or(uint32_t(std::max(0, scene.max_depth)));
  plan.seed = arguments.seed;
  plan.light_sampling = arguments.light_sampling;
  plan.roulette_depth = arguments.roulette_depth;
  plan.shadow_roulette = arguments.shadow_roulette;
  return make_plan(scene, kernels, plan);
}

ColourMode colour_mode(const Arguments& arguments) {
  return arguments.colour.value_or(arguments.dialect == Dialect::kYart ? ColourMode::kRgb
                                                                       : ColourMode::kBands);
}

void load(const Arguments& arguments, const KernelTable& kernels, ThreadPool& pool,
          Console& console, Diagnostics& diagnostics, Loaded& loaded) {
  Stopwatch watch;
  loaded.description = read_scene(arguments.scene, diagnostics, arguments.dialect);
  tell_rules(loaded.description, console, arguments.verbosity, diagnostics);
  loaded.time.read = watch.lap();
  compile(arguments, kernels, pool, diagnostics, loaded);
  loaded.time.build = watch.lap();
}

void print(std::string_view text) {
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!written || std::fflush(stdout) != 0)
    throw ResourceError(
        fmt::format("error: standard output: cannot write: {}", std::strerror(errno)));
}

void require_film_memory(const FilmSettings& film, FeatureSet features, uint32_t parts) {
  // Sums, the mean picture, its tone mapped copy and its bytes in a file.
  const uint64_t pixels = uint64_t(film.crop_width()) * film.crop_height();
  const uint64_t pictures = 1 + uint64_t(std::popcount(features));
  const uint64_t needed = pixels * (pictures * (parts * sizeof(FilmPixel) + 12 + 12) + 12);
  const uint64_t there = available_memory_bytes();
  if (there && needed > there)
    throw ResourceError(fmt::format(
        "error: out of memory: a picture of {} x {} pixels needs {:.1f} GB, {:.1f} GB are free: "
        "use "
        "a smaller --resolution or a --crop",
        film.crop_width(), film.crop_height(), double(needed) * 1e-9, double(there) * 1e-9));
}

}  // namespace yat

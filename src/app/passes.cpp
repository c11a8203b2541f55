#include "app/passes.h"

#include <algorithm>
#include <bit>

namespace yat {

namespace {

constexpr uint32_t kDefaultSamples = 64;
constexpr uint64_t kFirstPassSamples = uint64_t(1) << 23;

}  // namespace

PassLimits pass_limits(const Arguments& arguments, const FilmSettings& film) {
  PassLimits limits;
  if (arguments.samples_range) {
    limits.samples = *arguments.samples_range;
    return limits;
  }
  // The command line outranks the scene as a whole: `--time 60` is not cut short by a haltspp.
  const bool from_scene =
      !arguments.samples_per_pixel && !arguments.time_limit && !arguments.noise_target;
  const uint32_t halt_spp = from_scene && film.halt_spp > 0 ? uint32_t(film.halt_spp) : 0;
  const double halt_time = from_scene && film.halt_time > 0 ? film.halt_time : 0;
  limits.time_limit = arguments.time_limit.value_or(halt_time);
  limits.noise_target = arguments.noise_target.value_or(0);
  limits.adaptive = arguments.adaptive;
  if (arguments.samples_per_pixel) {
    limits.samples.end = *arguments.samples_per_pixel;
  } else if (halt_spp) {
    limits.samples.end = halt_spp;
  } else if (limits.time_limit > 0 || limits.noise_target > 0) {
    limits.samples.end = kLastSample;
    limits.unlimited = true;
  } else {
    limits.samples.end = kDefaultSamples;
  }
  return limits;
}

uint32_t next_pass_size(const PassLimits& limits, uint32_t first, uint64_t pixels, double seconds) {
  const uint32_t left = limits.samples.end - first;
  const uint32_t done = first - limits.samples.first;
  uint64_t size = 1;
  if (done > 0) {
    size = std::bit_floor(uint64_t(done));
    if (limits.time_limit > 0 && seconds > 0) {
      const double fits = std::max(0., limits.time_limit - seconds) * double(done) / seconds;
      size = std::min(size, std::bit_floor(std::max<uint64_t>(1, uint64_t(std::min(fits, 1e9)))));
    }
  } else if (limits.time_limit == 0) {
    size = std::bit_floor(std::max<uint64_t>(1, kFirstPassSamples / std::max<uint64_t>(1, pixels)));
  }
  return uint32_t(std::min<uint64_t>(size, left));
}

RenderTotals render_passes(const PassContext& context, const PassLimits& limits, Film& film,
                           FeatureFilm* features) {
  const uint64_t pixels = uint64_t(film.width()) * film.height();
  PassRunner runner(context);
  if (!limits.unlimited) runner.expect((limits.samples.end - limits.samples.first) * pixels);
  uint32_t first = limits.samples.first;
  while (first < limits.samples.end && !runner.over()) {
    const uint32_t size = next_pass_size(limits, first, pixels, runner.seconds());
    RenderOptions options;
    options.first_sample = first;
    options.end_sample = first + size;
    options.features = features;
    if (!runner.run(options, film)) break;
    first += size;
  }
  return runner.finish();
}

}  // namespace yat

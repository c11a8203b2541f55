#include "app/noise_passes.h"

#include <algorithm>
#include <bit>

#include "kernels/strata.h"

namespace yat {

namespace {

constexpr uint32_t kFirstCount = 4;
constexpr uint32_t kHalfSamples = uint32_t(1) << 29;

/// What fits of `step` further samples in each half before the time limit, at the speed so far.
uint32_t fitting(uint32_t step, uint32_t done, double seconds, double time_limit) {
  if (time_limit <= 0 || !done || seconds <= 0) return step;
  const double fits = std::max(0., time_limit - seconds) * double(done) / seconds;
  if (fits >= double(step)) return step;
  return std::bit_floor(std::max(1u, uint32_t(fits)));
}

/// Paths that the render will have had when the error, which falls with their number, is on target.
uint64_t expected_paths(const NoiseEstimate& noise, double target, uint64_t paths, uint64_t most) {
  const double needed = double(paths) * std::max(1., noise.high() / target);
  return needed < double(most) ? uint64_t(needed) : most;
}

}  // namespace

uint32_t second_half(const Plan& plan) {
  if (!is_stratified(plan.sampler)) return kHalfSamples;
  const uint32_t set = plan.set_columns * plan.set_rows;
  return kHalfSamples / set * set;
}

uint32_t next_half_count(uint32_t n) {
  if (n < kFirstCount) return kFirstCount;
  const uint32_t power = std::bit_floor(n);
  return n - power < power / 2 ? power + power / 2 : 2 * power;
}

RenderTotals render_to_noise(const PassContext& context, const PassLimits& limits,
                             FilmParts& halves) {
  const uint64_t pixels = uint64_t(halves.width()) * halves.height();
  const uint32_t most = limits.samples.end / 2;
  const uint32_t first_index[2] = {0, second_half(context.plan)};
  PassRunner runner(context);
  std::optional<NoiseEstimate> noise;
  for (uint32_t done = 0; done < most && !runner.over();) {
    noise.reset();
    const uint32_t step = fitting(std::min(next_half_count(done), most) - done, done,
                                  runner.seconds(), context.time_limit);
    bool complete = true;
    for (uint32_t half = 0; half < 2 && complete; ++half) {
      RenderOptions options;
      options.first_sample = first_index[half] + done;
      options.end_sample = options.first_sample + step;
      options.features = halves[half].features_or_null();
      complete = runner.run(options, halves[half].film);
    }
    if (!complete) break;
    done += step;
    noise = halves.noise(context.pool);
    runner.expect(expected_paths(*noise, limits.noise_target, 2 * done * pixels,
                                 2 * uint64_t(most) * pixels));
    if (noise->high() <= limits.noise_target) break;
  }
  RenderTotals totals = runner.finish();
  if (!noise) noise = halves.noise(context.pool);
  if (noise->pixels) totals.noise = noise;
  totals.noise_target = limits.noise_target;
  return totals;
}

}  // namespace yat

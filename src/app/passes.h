#pragma once
// A render as passes over ranges of samples, so that it can stop between them: at a time limit, or
// with a picture that holds nearly the same number of samples everywhere.

#include <cstdint>

#include "app/arguments.h"
#include "app/pass_runner.h"

namespace yat {

/// The largest index of a sample that there is, and one.
inline constexpr uint32_t kLastSample = uint32_t(1) << 30;

/// Films that a render to a noise target needs: two halves; a pilot has two more, and both are
/// joined to estimate its error. Without a target one is enough.
constexpr uint32_t film_parts(bool to_noise, Adaptive adaptive) {
  return !to_noise ? 1 : adaptive == Adaptive::kOff ? 2 : 6;
}

/// Which samples of every pixel to take and when to stop.
struct PassLimits {
  SampleRange samples{0, 64};
  bool unlimited = false;              ///< `samples.end` is only the largest index that there is
  double time_limit = 0;               ///< [s]; 0: none
  Adaptive adaptive = Adaptive::kOff;  ///< with a noise target
  double noise_target = 0;             ///< relMSE at which to stop; 0: none
};

/// Limits from the command line, else from the scene, else 64 samples. With a noise target
/// the numbers of samples and seconds are upper bounds.
PassLimits pass_limits(const Arguments& arguments, const FilmSettings& film);

/// Number of samples of the pass that begins at `first`: powers of two, at most as many as were
/// done before (the sobol sampler's sets are best at powers of two), small enough to end before the
/// time limit at the speed so far, and never past the end.
///
/// pixels   of the picture; without a time limit the first pass takes about 8 million samples.
/// seconds  rendering time so far.
uint32_t next_pass_size(const PassLimits& limits, uint32_t first, uint64_t pixels, double seconds);

/// Renders into `film` (and `features`, which may be null) until the samples are done, the time is
/// up or it is stopped. context.time_limit is that of `limits`.
RenderTotals render_passes(const PassContext& context, const PassLimits& limits, Film& film,
                           FeatureFilm* features);

}  // namespace yat

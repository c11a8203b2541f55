#pragma once
// A render that goes on until its error is small enough.
//
// Samples are taken for two half pictures, A and B, whose difference tells the error
// (film/halves.h). They have disjoint, independent samples: A those from index 0 on, B those from
// index second_half() on. Both are whole aligned sets of the sampler from their first sample on;
// what they lose is that together they are two sets and not one. After each round the error is
// estimated; the render stops when even the upper end of its 95 % interval is at most the target.
//
// Is the picture still without bias, although its own samples say when to stop? Stopping is one
// decision for all pixels. Let X be a pixel's mean when round r ends, and s its standard deviation.
// Stopping depends on the mean over P pixels of independent terms t, of which this pixel's is one.
// Where the mean has standard deviation d, knowing the pixel changes the chance to stop by about
// (t - E t) / (P d), at most times .4, the height of the normal density; P d is at least
// sqrt(P) sd(t) if the pixel is as noisy as the others. So
//
//   |bias of X| = |Cov(stop, X)| <= .4 s |corr(t, X)| / sqrt(P) <= .4 s / sqrt(P):
//
// of 100 000 pixels less than .0013 of the pixel's standard deviation, and for the mean of the
// whole picture, whose standard deviation is s / sqrt(P), less than .4 of that; both vanish as the
// error does. Stopping each pixel or tile by itself would have P = 1 or so, and is seen as darkness
// where light is rare.

#include "app/pass_runner.h"
#include "app/passes.h"
#include "film/film_parts.h"

namespace yat {

/// Index of B's first sample: 2^29, or the beginning of a set of a stratified sampler before it.
uint32_t second_half(const Plan& plan);

/// The least number of samples of each half after the next round, when it has n: 4, 6, 8, 12, 16,
/// 24 and so on. Rounds end at the powers of two that suit the sobol sampler and half way between.
uint32_t next_half_count(uint32_t n);

/// Renders until limits.noise_target is reached, limits.samples.end samples per pixel are in the
/// picture, the time is up or it is stopped. halves: two, empty; their `weigh` is set.
///
/// Rounds are alike for all pixels, until an estimate says that at most 8 times as many samples are
/// needed. If it is also 1.5 times as many or more, the samples so far are the pilot, by which
/// blocks of 8 x 8 pixels get their weights, once (wavefront/allocation.h). With Adaptive::kAuto
/// they are used if they promise to save a third of the samples or more. Rounds after it multiply
/// the samples of all blocks by one number, and so, like the end, this is one decision for the
/// whole picture.
RenderTotals render_to_noise(const PassContext& context, const PassLimits& limits,
                             FilmParts& halves);

}  // namespace yat

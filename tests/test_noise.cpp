// Renders to a noise target.

#include <gtest/gtest.h>

#include "app/noise_passes.h"
#include "metrics/metrics.h"
#include "render_scenes.h"

namespace yat {
namespace {

constexpr uint32_t kWidth = 40, kHeight = 30;

/// everything_text() rendered until its error is on target.
struct Rendered {
  FilmParts film{kWidth, kHeight, 0, 2};
  RenderTotals totals;
};
Rendered render_room(double target, uint32_t seed, uint32_t threads, uint32_t most_samples,
                     SamplerKind sampler = SamplerKind::kSobol) {
  const KernelTable& kernels = select_kernels();
  const Scene scene = compile_text(everything_text(kWidth, kHeight), kernels);
  PlanOptions plan_options;
  plan_options.seed = seed;
  plan_options.sampler = sampler;
  plan_options.max_depth = 6;
  const Plan plan = make_plan(scene, kernels, plan_options);
  ThreadPool pool(threads);
  Console console;
  Progress progress(console, ProgressKind::kSilent);
  std::atomic<bool> stop{false};
  PassLimits limits;
  limits.samples = {0, most_samples};
  limits.noise_target = target;
  Rendered r;
  r.totals = render_to_noise({scene, plan, pool, progress, stop}, limits, r.film);
  return r;
}

Image image_of(const std::vector<float>& rgb) {
  Image image;
  image.width = kWidth;
  image.height = kHeight;
  image.rgb = rgb;
  return image;
}

TEST(NoisePasses, RoundsEndAtPowersOfTwoAndHalfWayBetween) {
  std::vector<uint32_t> counts{0};
  while (counts.back() < 64) counts.push_back(next_half_count(counts.back()));
  EXPECT_EQ(counts, (std::vector<uint32_t>{0, 4, 6, 8, 12, 16, 24, 32, 48, 64}));
  EXPECT_EQ(next_half_count(5), 6u);
  EXPECT_EQ(next_half_count(7), 8u);
}

TEST(NoisePasses, TheSecondHalfBeginsWithAWholeSet) {
  Plan plan;
  plan.sampler = SamplerKind::kSobol;
  EXPECT_EQ(second_half(plan), 1u << 29);
  plan.sampler = SamplerKind::kNRooks;
  plan.set_columns = 7;
  plan.set_rows = 3;
  EXPECT_EQ(second_half(plan) % 21, 0u);
  EXPECT_GT(second_half(plan), (1u << 29) - 21);
}

TEST(NoisePasses, StopAtTheTargetAndSayTheTrueError) {
  constexpr double kTarget = 2.5e-2;
  // 4096 samples: the reference adds some 3 % to the error.
  const KernelTable& kernels = select_kernels();
  const Scene scene = compile_text(everything_text(kWidth, kHeight), kernels);
  PlanOptions options;
  options.seed = 77;
  options.max_depth = 6;
  const Film long_one = render_film(scene, make_plan(scene, kernels, options), 0, 4096);
  const Image reference = image_of(long_one.resolve());
  double ratio = 0;
  constexpr int kSeeds = 6;
  for (uint32_t seed = 1; seed <= kSeeds; ++seed) {
    const Rendered r = render_room(kTarget, seed, 1, 1 << 20);
    ASSERT_TRUE(r.totals.noise_reached());
    const double truth = image_error(image_of(r.film.resolve()), reference).rel_mse;
    EXPECT_LE(truth, 1.3 * kTarget) << seed;
    EXPECT_NEAR(r.totals.noise->epsilon, image_error(reference, reference).epsilon,
                .05 * r.totals.noise->epsilon);
    ratio += r.totals.noise->rel_mse / truth / kSeeds;
    // Not far beyond it either: a round adds half or a third of the samples.
    EXPECT_GT(truth, .3 * kTarget) << seed;
  }
  EXPECT_NEAR(ratio, 1, .2);
}

TEST(NoisePasses, TheBoundOnSamplesHolds) {
  const Rendered r = render_room(1e-9, 1, 1, 21);
  EXPECT_FALSE(r.totals.noise_reached());
  ASSERT_TRUE(r.totals.noise);
  EXPECT_GT(r.totals.noise->low(), 1e-9);
  EXPECT_EQ(r.film.total_samples(), 20u * kWidth * kHeight);
  EXPECT_EQ(r.totals.noise_target, 1e-9);
}

TEST(NoisePasses, SameBitsForAnyNumberOfThreads) {
  for (const SamplerKind sampler : {SamplerKind::kSobol, SamplerKind::kMultiJittered}) {
    const Rendered one = render_room(2e-2, 5, 1, 1 << 12, sampler);
    const Rendered three = render_room(2e-2, 5, 3, 1 << 12, sampler);
    EXPECT_TRUE(one.totals.noise_reached());
    for (size_t half = 0; half < 2; ++half)
      EXPECT_TRUE(same_bits(one.film[half].film, three.film[half].film));
    EXPECT_EQ(one.totals.noise->rel_mse, three.totals.noise->rel_mse);
    EXPECT_EQ(one.totals.noise->rel_mse_se, three.totals.noise->rel_mse_se);
  }
}

}  // namespace
}  // namespace yat

// Renders to a noise target.

#include <gtest/gtest.h>

#include "app/noise_passes.h"
#include "metrics/metrics.h"
#include "render_scenes.h"
#include "wavefront/allocation.h"

namespace yat {
namespace {

constexpr uint32_t kWidth = 40, kHeight = 30;

/// everything_text() rendered until its error is on target.
struct Rendered {
  FilmParts film{kWidth, kHeight, 0, 2};
  RenderTotals totals;
};
Rendered render_room(double target, uint32_t seed, uint32_t threads, uint32_t most_samples,
                     SamplerKind sampler = SamplerKind::kSobol, Adaptive adaptive = Adaptive::kOff,
                     FeatureSet features = 0) {
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
  limits.adaptive = adaptive;
  Rendered r;
  r.film = FilmParts(kWidth, kHeight, features, 2);
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
  for (const SamplerKind sampler : {SamplerKind::kSobol, SamplerKind::kMultiJittered})
    for (const Adaptive adaptive : {Adaptive::kOff, Adaptive::kOn}) {
      const Rendered one = render_room(2e-2, 5, 1, 1 << 12, sampler, adaptive);
      const Rendered three = render_room(2e-2, 5, 3, 1 << 12, sampler, adaptive);
      EXPECT_TRUE(one.totals.noise_reached());
      EXPECT_EQ(one.totals.adaptive, adaptive == Adaptive::kOn);
      for (size_t half = 0; half < 2; ++half)
        EXPECT_TRUE(same_bits(one.film[half].film, three.film[half].film));
      EXPECT_EQ(one.totals.noise->rel_mse, three.totals.noise->rel_mse);
      EXPECT_EQ(one.totals.noise->rel_mse_se, three.totals.noise->rel_mse_se);
    }
}

TEST(NoisePasses, AdaptiveSamplesFollowTheNoiseAndKeepTheBound) {
  const FeatureSet features = feature_bit(Feature::kDirect) | feature_bit(Feature::kIndirect);
  const Rendered r = render_room(1e-9, 3, 2, 128, SamplerKind::kSobol, Adaptive::kOn, features);
  EXPECT_TRUE(r.totals.adaptive);
  EXPECT_LE(r.film.total_samples(), 128u * kWidth * kHeight);
  EXPECT_GE(r.film.total_samples(), 110u * kWidth * kHeight);
  uint64_t least = ~uint64_t(0), most = 0;
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x)
      for (size_t half = 0; half < 2; ++half) {
        const FilmPixel& pixel = r.film[half].film.at(x, y);
        EXPECT_EQ(pixel.samples, r.film[half].film.at(x / 8 * 8, y / 8 * 8).samples);
        EXPECT_EQ(pixel.samples, nice_count(double(pixel.samples)));
        least = std::min(least, pixel.samples);
        most = std::max(most, pixel.samples);
      }
  EXPECT_GE(least, 8u);
  EXPECT_GE(most, 2 * least);
  // Both parts of the light have the picture's weights.
  const std::vector<float> picture = r.film.resolve();
  const std::vector<PictureLayer> layers = r.film.resolve_features();
  ASSERT_EQ(layers.size(), 2u);
  for (size_t i = 0; i < picture.size(); ++i)
    EXPECT_NEAR(layers[0].values[i] + layers[1].values[i], picture[i],
                1e-5f * std::max(1.f, picture[i]));
}

TEST(NoisePasses, AdaptivePicturesHaveTheRightMean) {
  const KernelTable& kernels = select_kernels();
  const Scene scene = compile_text(everything_text(kWidth, kHeight), kernels);
  const auto mean_of = [](const std::vector<float>& rgb) {
    double sum = 0;
    for (const float c : rgb) sum += double(c);
    return sum / double(rgb.size());
  };
  PlanOptions options;
  options.max_depth = 6;
  options.sampler = SamplerKind::kIndependent;
  std::vector<double> uniform, adaptive;
  for (uint32_t seed = 100; seed < 116; ++seed) {
    options.seed = seed;
    uniform.push_back(
        mean_of(render_film(scene, make_plan(scene, kernels, options), 0, 256).resolve()));
  }
  for (uint32_t seed = 1; seed <= 40; ++seed)
    adaptive.push_back(mean_of(
        render_room(1e-9, seed, 1, 64, SamplerKind::kIndependent, Adaptive::kOn).film.resolve()));
  const Estimate u = estimate(uniform), a = estimate(adaptive);
  const double error = std::hypot(u.error, a.error);
  EXPECT_LT(error, .005 * u.mean);
  EXPECT_LT(std::abs(a.mean - u.mean), 3.5 * error) << a.mean << " against " << u.mean;
}

}  // namespace
}  // namespace yat

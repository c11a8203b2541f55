// Statistics of few runs against known answers.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/student.h"
#include "converge/bias_test.h"
#include "converge/hash.h"
#include "converge/ladder.h"
#include "converge/statistics.h"

namespace yat {
namespace {

TEST(Statistics, MeansAndDeviationsOfShortLists) {
  const std::vector<double> v = {4, 1, 3, 2};
  EXPECT_DOUBLE_EQ(mean_of(v), 2.5);
  EXPECT_DOUBLE_EQ(median_of(v), 2.5);
  EXPECT_DOUBLE_EQ(median_of(std::vector<double>{5, 1, 2}), 2);
  EXPECT_DOUBLE_EQ(deviation_of(v), std::sqrt(5. / 3));
  EXPECT_TRUE(std::isnan(mean_of({})));
  EXPECT_TRUE(std::isnan(median_of({})));
  EXPECT_TRUE(std::isnan(deviation_of(std::vector<double>{1})));
}

TEST(Statistics, SlopeOfAPowerIsItsExponent) {
  std::vector<double> x, y;
  for (double n = 4; n <= 4096; n *= 2) {
    x.push_back(n);
    y.push_back(3 * std::pow(n, -.75));
  }
  EXPECT_NEAR(log_slope(x, y), -.75, 1e-14);
  // Points without an error left say nothing.
  y[3] = 0;
  y[5] = -1;
  EXPECT_NEAR(log_slope(x, y), -.75, 1e-14);
  EXPECT_TRUE(std::isnan(log_slope(std::vector<double>{4}, std::vector<double>{1})));
}

// The share of intervals that hold the truth, over many experiments of 16 normal values: the
// percentile bootstrap is known to be a little too narrow with so few.
TEST(Statistics, BootstrapIntervalsHoldTheMeanAboutAsOftenAsTheySay) {
  std::mt19937 rng(5);
  std::normal_distribution<double> normal(10, 2);
  constexpr int kExperiments = 400;
  int held = 0;
  double width = 0;
  for (int k = 0; k < kExperiments; ++k) {
    std::vector<double> values(16);
    for (double& v : values) v = normal(rng);
    const Interval i = bootstrap_interval(16, [&](std::span<const uint32_t> runs) {
      double sum = 0;
      for (const uint32_t r : runs) sum += values[r];
      return sum / double(runs.size());
    });
    held += !i.excludes(10);
    width += i.high - i.low;
  }
  EXPECT_GT(held, .88 * kExperiments);
  EXPECT_LT(held, .97 * kExperiments);
  // 2 x 1.96 sigma / sqrt(16), times sqrt(15 / 16).
  EXPECT_NEAR(width / kExperiments, 2 * 1.96 * .5 * std::sqrt(15. / 16), .05);
}

TEST(Statistics, IntervalsAreUnknownWhereRunsCannotTell) {
  const auto one = [](std::span<const uint32_t>) { return 1.; };
  EXPECT_FALSE(bootstrap_interval(1, one).known());
  EXPECT_TRUE(bootstrap_interval(2, one).known());
  const auto never = [](std::span<const uint32_t>) { return std::nan(""); };
  EXPECT_FALSE(bootstrap_interval(8, never).known());
  EXPECT_FALSE(Interval().excludes(0));
  EXPECT_TRUE(Interval(1, 2).excludes(.5));
}

TEST(Statistics, TimesToAnErrorAlongLinesOnLogAxes) {
  // Error 1 / t.
  const std::vector<double> t = {1, 10, 100}, e = {1, .1, .01};
  const TimeToError inside = time_to_error(t, e, .05);
  EXPECT_NEAR(inside.seconds, 20, 1e-9);
  EXPECT_FALSE(inside.extrapolated);
  const TimeToError after = time_to_error(t, e, 1e-3);
  EXPECT_NEAR(after.seconds, 1000, 1e-6);
  EXPECT_TRUE(after.extrapolated);
  const TimeToError before = time_to_error(t, e, 2);
  EXPECT_NEAR(before.seconds, .5, 1e-9);
  EXPECT_TRUE(before.extrapolated);
  const TimeToError at_the_end = time_to_error(t, e, .01);
  EXPECT_NEAR(at_the_end.seconds, 100, 1e-9);
  EXPECT_FALSE(at_the_end.extrapolated);
  // An error that stays is never below.
  EXPECT_TRUE(std::isnan(time_to_error(t, std::vector<double>{1, 1, 1}, .1).seconds));
  EXPECT_TRUE(
      std::isnan(time_to_error(std::vector<double>{1}, std::vector<double>{1}, .1).seconds));
}

// Tables of Student's distribution (Abramowitz and Stegun 1964, table 26.10), and closed forms for
// 1 and 2 degrees of freedom.
TEST(Statistics, StudentsDistributionAgainstTables) {
  EXPECT_NEAR(student_two_sided(2.1314495, 15), .05, 1e-8);
  EXPECT_NEAR(student_two_sided(2.9467129, 15), .01, 1e-8);
  EXPECT_NEAR(student_two_sided(2.2281389, 10), .05, 1e-8);
  EXPECT_NEAR(student_two_sided(4.0727655, 15), .001, 1e-9);
  for (const double t : {.1, 1., 3., 50., 1e6}) {
    const double cauchy = 2 / M_PI * std::atan2(1, t);
    EXPECT_NEAR(student_two_sided(t, 1) / cauchy, 1, 1e-10) << t;
  }
  EXPECT_NEAR(student_two_sided(3, 2), 1 - 3 / std::sqrt(11.), 1e-13);
  // Many degrees of freedom: the normal distribution.
  EXPECT_NEAR(student_two_sided(1.959964, 1e7), .05, 1e-6);
  for (const double df : {1e9, 1e12, 1e15, 1e20, 1e30, 1e300})
    for (const double t : {1e-3, 1., 3., 20.})
      EXPECT_NEAR(student_two_sided(t, df) / std::erfc(t / M_SQRT2), 1, 1e-4) << t << " " << df;
  // Finite sums for even ones (26.7.4), by arithmetic of 120 digits, and no step between formulas.
  EXPECT_NEAR(student_two_sided(3, 1000) / 0.00276670904423819, 1, 1e-12);
  EXPECT_NEAR(student_two_sided(8, 100000) / 1.25739198762564e-15, 1, 1e-11);
  for (const double t : {1., 5., 25.})
    EXPECT_NEAR(student_two_sided(t, 1e7) / student_two_sided(t, 1e7 + 1), 1, 1e-9) << t;
  EXPECT_EQ(student_two_sided(0, 7), 1);
  EXPECT_EQ(student_two_sided(-2, 7), student_two_sided(2, 7));
}

// The test vectors of the algorithm's authors.
TEST(Hash, IsFnv1a) {
  EXPECT_EQ(fnv1a_of(""), 0xcbf29ce484222325u);
  EXPECT_EQ(fnv1a_of("a"), 0xaf63dc4c8601ec8cu);
  EXPECT_EQ(fnv1a_of("foobar"), 0x85944171f73967e8u);
}

TEST(Ladder, SeedsOfRunsAndReferencesNeverMeet) {
  EXPECT_EQ(ladder_up_to(64), (std::vector<uint32_t>{1, 4, 16, 64}));
  EXPECT_EQ(ladder_up_to(100), (std::vector<uint32_t>{1, 4, 16, 64, 100}));
  EXPECT_EQ(ladder_up_to(1), (std::vector<uint32_t>{1}));
  EXPECT_EQ(not_powers_of_two({1, 2, 3, 64, 100}), (std::vector<uint32_t>{3, 100}));
  std::vector<uint32_t> seeds;
  for (const uint32_t spp : ladder_up_to(4096))
    for (uint32_t run = 0; run < 64; ++run) {
      seeds.push_back(run_seed(0, spp, run));
      EXPECT_LT(seeds.back(), 1u << 31);
    }
  for (uint32_t part = 0; part < 16; ++part) EXPECT_GE(reference_seed(0, part), 1u << 31);
  std::sort(seeds.begin(), seeds.end());
  EXPECT_EQ(std::adjacent_find(seeds.begin(), seeds.end()), seeds.end());
}

/// `count` pictures of normal noise around `level`, summed up.
PixelMoments noise(uint32_t width, uint32_t height, uint32_t count, float level, float sigma,
                   uint32_t seed) {
  std::mt19937 rng(seed);
  std::normal_distribution<float> normal(level, sigma);
  PixelMoments moments(width, height);
  Image image{width, height, std::vector<float>(size_t(width) * height * 3), true};
  for (uint32_t k = 0; k < count; ++k) {
    for (size_t p = 0; p < image.pixels(); ++p) {
      const float v = normal(rng);
      for (size_t c = 0; c < 3; ++c) image.rgb[3 * p + c] = v;
    }
    moments.add(image);
  }
  return moments;
}

TEST(BiasTest, FindsADifferenceAndNotNoise) {
  const PixelMoments parts = noise(64, 64, 8, 1, .05f, 1);
  const Reference reference = reference_of(parts, 100);
  EXPECT_EQ(reference.samples_per_pixel, 800);
  EXPECT_NEAR(mean_variance(reference), .05 * .05 / 8, .05 * .05 / 8 * .05);

  const BiasTest same = test_bias(noise(64, 64, 16, 1, .2f, 2), reference);
  EXPECT_EQ(same.pixels, 4096u);
  EXPECT_LE(same.beyond, 1u);
  // What is left is the reference's variance.
  EXPECT_NEAR(same.floor, mean_variance(reference), 3e-4 * .2);

  const BiasTest other = test_bias(noise(64, 64, 16, 1.5f, .1f, 3), reference);
  EXPECT_GT(other.share(), .9);
  EXPECT_NEAR(other.floor, .25 + mean_variance(reference), .005);
}

TEST(BiasTest, PixelsWithoutSpreadDifferIfTheyDiffer) {
  Reference exact;
  exact.image = {2, 1, {1, 1, 1, 2, 2, 2}, true};
  PixelMoments runs(2, 1);
  const Image image{2, 1, {1, 1, 1, 2, 2.5f, 2}, true};
  runs.add(image);
  EXPECT_EQ(test_bias(runs, exact).pixels, 0u) << "one run has no spread";
  runs.add(image);
  EXPECT_EQ(test_bias(runs, exact).beyond, 1u);
}

TEST(PixelMoments, AreKeptToTheBit) {
  PixelMoments some = noise(5, 3, 4, 2, 1, 9);
  PixelMoments back(5, 3);
  EXPECT_TRUE(back.restore(some.bytes()));
  EXPECT_EQ(back.count(), 4u);
  EXPECT_EQ(back.mean(), some.mean());
  EXPECT_EQ(back.variance(), some.variance());
  PixelMoments other(3, 5);
  EXPECT_FALSE(other.restore(some.bytes()));
  EXPECT_FALSE(back.restore("nonsense"));
  EXPECT_EQ(back.count(), 4u);
}

}  // namespace
}  // namespace yat

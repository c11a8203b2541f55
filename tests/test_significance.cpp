// The tests that prove pictures unbiased are tested themselves: on values from tables, on pictures
// that differ by a known bias, and on pictures that do not.

#include "significance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "picture_tests.h"
#include "run_program.h"

namespace yat {
namespace {

TEST(Significance, ValuesOfTables) {
  EXPECT_NEAR(incomplete_beta(.5, .5, 2, 3), .6875, 1e-12);
  EXPECT_NEAR(incomplete_beta(.25, .75, .5, .5), 1. / 3, 1e-12);
  EXPECT_NEAR(normal_p_value(1.959963985), .05, 1e-9);
  // Critical values of Student's t, two-sided.
  EXPECT_NEAR(student_two_sided(2.228138852, 10), .05, 1e-9);
  EXPECT_NEAR(student_two_sided(-3.646, 30), .001, 1e-6);
  EXPECT_NEAR(student_two_sided(1, 1), .5, 1e-12);
  EXPECT_NEAR(student_two_sided(3.2905267, 1e7), .001, 1e-8);
  EXPECT_NEAR(z_test(5.5, 5, .25), .045500264, 1e-9);
  // 10 trials at .1: P(>= 3).
  EXPECT_NEAR(binomial_upper_tail(3, 10, .1), .0701908264, 1e-9);
  EXPECT_NEAR(binomial_upper_tail(10, 10, .1), 1e-10, 1e-20);
  EXPECT_EQ(binomial_upper_tail(0, 10, .1), 1);
  EXPECT_NEAR(sidak_p_value(.01, 100), 1 - std::pow(.99, 100), 1e-12);
  EXPECT_NEAR(sidak_p_value(sidak_level(.001, 4096), 4096), .001, 1e-12);
}

TEST(Significance, WelchOfAnExample) {
  // t = -2.763709471 with 11.36766822 degrees of freedom; the density integrated by Simpson's rule.
  EXPECT_NEAR(welch_test({20.82, 3.72, 8}, {22.98, 1.75, 12}), .0179354811522, 1e-12);
  // A floor that is known, not measured, has no end of degrees of freedom.
  for (const double floor : {1e3, 1e6, 1e9})
    EXPECT_NEAR(welch_test({2 * floor, 3.72, 8}, {0, 1.75, 12}, floor), .0455, 1e-4) << floor;
  // Values without noise are the same to rounding, or not.
  const Moments one{1, 0, 8}, near{1 + 1e-7, 0, 8}, far{1.01, 0, 8};
  EXPECT_GT(welch_test(one, near, 1e-6), .9);
  EXPECT_EQ(welch_test(one, one), 1);
  EXPECT_EQ(welch_test(one, far), 0);
  EXPECT_LT(welch_test(one, far, 1e-6), 1e-300);
  const Moments m = moments_of({1, 2, 4, 9});
  EXPECT_DOUBLE_EQ(m.mean, 4);
  EXPECT_DOUBLE_EQ(m.variance, 38. / 3);
}

TEST(Significance, UniformValuesAreUniform) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> uniform;
  std::vector<double> p_values;
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<double> p(64);
    for (double& x : p) x = uniform(engine);
    p_values.push_back(uniformity_p_value(p));
  }
  // The p-values of the test itself, too: it is exact to about .01.
  EXPECT_GT(uniformity_p_value(p_values), 1e-3);
  for (double& x : p_values) x = std::pow(x, 1.3);
  EXPECT_LT(uniformity_p_value(p_values), 1e-6);
}

// Welch's test where it is needed: variances that differ by a hundred, skewed values.
TEST(Significance, EqualMeansAreFoundDifferentAsOftenAsTheLevelSays) {
  std::mt19937 engine(2);
  std::exponential_distribution<double> skewed;
  constexpr size_t kTrials = 4000;
  size_t below[2] = {};
  const double levels[2] = {.05, .01};
  for (size_t trial = 0; trial < kTrials; ++trial) {
    std::vector<double> a(32), b(32);
    // Each a mean of 64, as a tile's is of more.
    const auto mean = [&] {
      double sum = 0;
      for (int i = 0; i < 64; ++i) sum += skewed(engine) / 64;
      return sum;
    };
    for (double& x : a) x = 1 + .1 * (mean() - 1);
    for (double& x : b) x = mean();
    const double p = welch_test(moments_of(a), moments_of(b));
    for (int i = 0; i < 2; ++i) below[i] += p < levels[i];
  }
  for (int i = 0; i < 2; ++i) {
    EXPECT_GT(binomial_upper_tail(below[i], kTrials, levels[i]), 1e-3) << below[i];
    EXPECT_GT(1 - binomial_upper_tail(below[i] + 1, kTrials, levels[i]), 1e-3) << below[i];
  }
}

// ---- Pictures ----------------------------------------------------------------------------------

/// Runs of a picture whose pixels have the mean (1 + x / width) value(x, y), one colour each, and
/// noise with a tail: one in 20 is eleven times as bright. Relative deviation of a pixel: `noise`.
Runs noisy_runs(std::mt19937& engine, uint32_t side, uint32_t runs, double noise,
                const std::function<double(uint32_t, uint32_t)>& value) {
  std::uniform_real_distribution<double> uniform;
  // u + 10 [u' < .05]: mean 1, variance 1/12 + 4.75.
  const double scale = noise / std::sqrt(1. / 12 + 4.75);
  Runs out{side, side, {}};
  for (uint32_t r = 0; r < runs; ++r) {
    std::vector<float> picture;
    picture.reserve(3 * size_t(side) * side);
    for (uint32_t y = 0; y < side; ++y)
      for (uint32_t x = 0; x < side; ++x) {
        const double sample = uniform(engine) + (uniform(engine) < .05 ? 10 : 0);
        const double v = (1 + scale * (sample - 1)) * (1 + double(x) / side) * value(x, y);
        for (const double c : {.5, 1., .8}) picture.push_back(float(c * v));
      }
    out.pictures.push_back(std::move(picture));
  }
  return out;
}

double flat(uint32_t, uint32_t) {
  return 1;
}

TEST(PictureTests, PicturesOfOneDistributionPass) {
  std::mt19937 engine(3);
  constexpr size_t kTrials = 300;
  size_t failed = 0, pixels = 0;
  for (size_t trial = 0; trial < kTrials; ++trial) {
    const Runs a = noisy_runs(engine, 32, 16, .6, flat), b = noisy_runs(engine, 32, 16, .2, flat);
    const PictureTest test = compare_runs(a, b);
    failed += test.p_value() < .05;
    pixels += test.pixels_passing < .9975;
  }
  // Three channels that go together count as three tests: less often than .05, but not never.
  EXPECT_GT(binomial_upper_tail(failed, kTrials, .05), 1e-3) << failed;
  EXPECT_GT(failed, 0u);
  EXPECT_EQ(pixels, 0u);
}

/// As noisy as bias proofs may be: 64 x 64 pixels, 32 runs, .15 % of the mean.
constexpr double kNoise = .0015 * 64 * 5.6568542 / 1.41421356;

TEST(PictureTests, OnePercentIsFound) {
  std::mt19937 engine(4);
  size_t found = 0;
  constexpr size_t kTrials = 20;
  for (size_t trial = 0; trial < kTrials; ++trial) {
    const Runs a = noisy_runs(engine, 64, 32, kNoise, flat);
    const Runs b = noisy_runs(engine, 64, 32, kNoise, [](uint32_t, uint32_t) { return 1.01; });
    const PictureTest test = compare_runs(a, b);
    EXPECT_NEAR(test.relative_error, .0015, .0003);
    found += !test.passes(1e-3);
  }
  // Each with probability .987: fewer than 18 of 20 with probability .002.
  EXPECT_GE(found, 18u);
}

TEST(PictureTests, ATileIsFound) {
  std::mt19937 engine(5);
  const Runs a = noisy_runs(engine, 64, 32, kNoise, flat);
  const Runs b = noisy_runs(engine, 64, 32, kNoise, [](uint32_t x, uint32_t y) {
    return x / kTile == 2 && y / kTile == 1 ? 1.06 : 1;
  });
  const PictureTest test = compare_runs(a, b);
  EXPECT_LT(test.tiles, 1e-3) << test.text();
  EXPECT_EQ(test.worst.rfind("tile 2,1 ", 0), 0u) << test.worst;
  EXPECT_FALSE(test.passes(1e-3));
}

// As much too bright as too dark, in small pieces: neither the whole nor any tile has it.
TEST(PictureTests, BothSignsAreFound) {
  std::mt19937 engine(6);
  const Runs a = noisy_runs(engine, 64, 32, kNoise, flat);
  const Runs b = noisy_runs(engine, 64, 32, kNoise, [](uint32_t x, uint32_t y) {
    return (x / kShapeTile + y / kShapeTile) % 2 ? 1.04 : .96;
  });
  const PictureTest test = compare_runs(a, b);
  EXPECT_GT(test.whole, 1e-3) << test.text();
  EXPECT_LT(test.shape, 1e-3) << test.text();
  EXPECT_FALSE(test.passes(1e-3));
}

TEST(PictureTests, AFewPixelsAreFound) {
  std::mt19937 engine(7);
  const Runs a = noisy_runs(engine, 64, 32, kNoise, flat);
  // Along an edge, bright on one side and dark on the other: the tiles' means stay.
  const auto along_an_edge = [](double by) {
    return [by](uint32_t x, uint32_t y) { return y != 20 ? 1 : x % 2 ? 1 + by : 1 - by; };
  };
  EXPECT_TRUE(compare_runs(a, noisy_runs(engine, 64, 32, kNoise, along_an_edge(0))).passes(1e-3));
  const PictureTest test = compare_runs(a, noisy_runs(engine, 64, 32, kNoise, along_an_edge(.99)));
  EXPECT_LT(test.pixels_passing, .9975) << test.text();
  EXPECT_FALSE(test.passes(1e-3));
}

TEST(PictureTests, AKnownPictureIsComparedWith) {
  std::mt19937 engine(8);
  const auto level = [](uint32_t x, uint32_t) { return 3 / (1 + double(x) / 64); };
  Runs a = noisy_runs(engine, 64, 32, kNoise, level);
  // All channels alike.
  for (std::vector<float>& picture : a.pictures)
    for (size_t i = 0; i < picture.size(); i += 3) picture[i] = picture[i + 2] = picture[i + 1];
  EXPECT_TRUE(compare_runs(a, known_picture(64, 64, 3)).passes(1e-3));
  EXPECT_FALSE(compare_runs(a, known_picture(64, 64, 3.03f)).passes(1e-3));
}

// What every sample shows alike has no noise: only rounding may differ.
TEST(PictureTests, PicturesWithoutNoiseAreTheSameToRounding) {
  const Runs a = known_picture(24, 20, 1.25f);
  EXPECT_TRUE(compare_runs(a, known_picture(24, 20, 1.25f * 1.000001f)).passes(1e-3));
  EXPECT_FALSE(compare_runs(a, known_picture(24, 20, 1.25f * 1.00005f)).passes(1e-3));
}

// ---- tools/nightly.sh --------------------------------------------------------------------------

TEST(Nightly, JudgesByHowManyAreSmall) {
  const std::filesystem::path folder = std::filesystem::path(YAT_TEST_OUTPUT_DIR) / "nightly";
  std::filesystem::create_directories(folder);
  const auto judge = [&](const std::vector<double>& p) {
    std::string text;
    for (const double x : p) text += "Suite.Test pair " + std::to_string(x) + "\n";
    write_whole(folder / "p.txt", text);
    return run_program(
        {"/usr/bin/env", "bash", YAT_SOURCE_DIR "/tools/nightly.sh", "--judge", "p.txt"}, folder);
  };
  std::vector<double> p;
  for (int i = 0; i < 1000; ++i) p.push_back((i + .5) / 1000);
  const ProgramResult right = judge(p);
  EXPECT_EQ(right.code, 0) << right.out << right.err;
  EXPECT_NE(
      right.out.find("10 of 1000 comparisons below 0.01, 10.0 expected at most: probability of "
                     "as many 0.543"),
      std::string::npos)
      << right.out;
  // A comparison that is biased in each of ten runs.
  for (int i = 0; i < 10; ++i) p.push_back(1e-5);
  const ProgramResult biased = judge(p);
  EXPECT_EQ(biased.code, 1) << biased.out;
  EXPECT_NE(biased.out.find("more than chance"), std::string::npos) << biased.out;
  EXPECT_NE(biased.out.find("(more than once)"), std::string::npos) << biased.out;
  EXPECT_NE(biased.out.find("  Suite.Test pair: "), std::string::npos) << biased.out;
  EXPECT_EQ(judge({}).code, 1);
  EXPECT_EQ(judge({2}).code, 1);
}

}  // namespace
}  // namespace yat

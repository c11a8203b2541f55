// Samples by noise: the numbers, and that they bring no bias.

#include "wavefront/allocation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "film/halves.h"

namespace yat {
namespace {

TEST(Allocation, NiceCountsAreTheNearestByRatio) {
  const std::vector<uint32_t> nice{1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64};
  for (double x = .25; x < 60; x *= 1.003) {
    const auto nearest = *std::min_element(nice.begin(), nice.end(), [&](uint32_t a, uint32_t b) {
      return std::abs(std::log(double(a) / x)) < std::abs(std::log(double(b) / x));
    });
    EXPECT_EQ(nice_count(x), nearest) << x;
  }
  EXPECT_EQ(nice_count(0), 1u);
  EXPECT_EQ(nice_count(std::nan("")), 1u);
  EXPECT_EQ(nice_count(1e300), 1u << 29);
}

TEST(Allocation, WeightsAreSmoothBoundedAndOfMeanOne) {
  EXPECT_EQ(sample_weights({0, 0, 0, 0}, 2, 2), (std::vector<double>{1, 1, 1, 1}));
  for (const double w : sample_weights(std::vector<double>(12, 7.), 4, 3)) EXPECT_NEAR(w, 1, 1e-12);
  constexpr uint32_t kColumns = 40, kRows = 30;
  std::vector<double> variance(kColumns * kRows, 1e-3);
  variance[15 * kColumns + 20] = 1e6;
  const std::vector<double> w = sample_weights(variance, kColumns, kRows);
  double sum = 0;
  for (const double x : w) sum += x;
  EXPECT_NEAR(sum / double(w.size()), 1, .02);
  EXPECT_LE(*std::max_element(w.begin(), w.end()), 8);
  EXPECT_GT(w[15 * kColumns + 20], 7.5);
  // The neighbour has half the variance, the one at the corner a quarter.
  EXPECT_GE(w[15 * kColumns + 21], .7 * w[15 * kColumns + 20]);
  EXPECT_GE(w[14 * kColumns + 19], .49 * w[15 * kColumns + 20]);
  EXPECT_GT(w[0], .1);
}

TEST(Allocation, TheScaleFillsWhatIsAllowed) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> weight(.05, 3);
  std::vector<double> weights[2];
  for (std::vector<double>& half : weights)
    for (int i = 0; i < 200; ++i) half.push_back(weight(random));
  const std::vector<uint32_t> pixels(200, 64);
  for (const uint32_t least : {1u, 16u})
    for (const uint64_t per_pixel : {32u, 100u, 3000u}) {
      const uint64_t most = per_pixel * 200 * 64;
      const double scale = scale_for(weights, pixels, least, most);
      uint64_t total = 0;
      for (const std::vector<double>& half : weights)
        total += total_samples(sample_counts(half, scale, least), pixels);
      EXPECT_LE(total, most);
      EXPECT_GE(total, most * 98 / 100) << least << ' ' << per_pixel;
    }
  EXPECT_EQ(scale_for(weights, pixels, 8, 7 * 200 * 64), 0);
}

TEST(Allocation, TheGainIsThatOfNeymansAllocation) {
  // sqrt(v) = 1 and 3: (1 + 9) / 2 against ((1 + 3) / 2)^2.
  EXPECT_NEAR(gain_of({.5, 1.5}, {1, 9}), 1.25, 1e-12);
  EXPECT_NEAR(gain_of({1, 1}, {1, 9}), 1, 1e-12);
  EXPECT_EQ(gain_of({1, 1}, {0, 0}), 1);
  // Blocks alike, whose variance is hardly known: what one pilot promises itself is no gain by the
  // other.
  std::mt19937 random(9);
  std::exponential_distribution<double> estimate;
  std::vector<double> own(900), other(900);
  for (double& v : own) v = std::pow(estimate(random), 3);
  for (double& v : other) v = std::pow(estimate(random), 3);
  const std::vector<double> weights = sample_weights(own, 30, 30);
  EXPECT_GT(gain_of(weights, own), 1.3);
  EXPECT_LT(gain_of(weights, other), 1);
}

// ---- Bias
// ----------------------------------------------------------------------------------------

constexpr uint32_t kEdge = 40;  // pixels: 5 x 5 blocks
constexpr uint32_t kPilot = 8;
constexpr float kDim = .5f, kBright = 200.5f;
constexpr double kChance = 1. / 2000;
constexpr double kTruth = .6;

using Random = std::minstd_rand;

/// Samples of which one in 2000 brings a sixth of the light.
void sample(FilmPixel& pixel, uint32_t n, Random& random) {
  std::geometric_distribution<uint32_t> dim_ones(kChance);
  for (uint32_t left = n; left > 0;) {
    const uint32_t run = std::min(left, dim_ones(random));
    for (uint32_t i = 0; i < run; ++i) pixel.add(kDim, kDim, kDim);
    left -= run;
    if (left) {
      pixel.add(kBright, kBright, kBright);
      --left;
    }
  }
}
void sample(Film& film, uint32_t n, Random& random) {
  for (size_t i = 0; i < kEdge * kEdge; ++i) sample(film.data()[i], n, random);
}

double mean_of(const std::vector<float>& rgb) {
  double sum = 0;
  for (const float c : rgb) sum += double(c);
  return sum / double(rgb.size());
}

/// (mean of many pictures - truth) / its standard error. own: each half's pilot decides about the
/// half itself.
double z_score(bool own, Weigh weigh, uint32_t seed) {
  constexpr int kPictures = 400;
  ThreadPool pool(1);
  Random random(seed);
  double sum = 0, squares = 0;
  for (int picture = 0; picture < kPictures; ++picture) {
    Film half[2] = {Film(kEdge, kEdge), Film(kEdge, kEdge)};
    std::vector<double> weights[2];
    for (uint32_t h = 0; h < 2; ++h) {
      Film second(kEdge, kEdge);
      sample(half[h], kPilot / 2, random);
      sample(second, kPilot / 2, random);
      weights[own ? h : 1 - h] = sample_weights(
          block_noise(half[h], second, Weigh::kByCount, kWorkBlock, pool), kEdge / 8, kEdge / 8);
      half[h].merge(second);
    }
    for (uint32_t h = 0; h < 2; ++h) {
      const std::vector<uint32_t> counts = sample_counts(weights[h], 3 * kPilot, kPilot);
      for (uint32_t y = 0; y < kEdge; ++y)
        for (uint32_t x = 0; x < kEdge; ++x)
          sample(half[h].at(x, y), counts[y / 8 * (kEdge / 8) + x / 8] - kPilot, random);
    }
    const double mean = mean_of(resolve_halves(half[0], half[1], weigh));
    sum += mean;
    squares += mean * mean;
  }
  const double mean = sum / kPictures;
  const double error = std::sqrt((squares / kPictures - mean * mean) / (kPictures - 1));
  EXPECT_LT(error, .006 * kTruth);
  return (mean - kTruth) / error;
}

TEST(Allocation, TheOtherHalfDecidesWithoutBias) {
  EXPECT_LT(std::abs(z_score(false, Weigh::kEqually, 1)), 3.5);
}

TEST(Allocation, DecidingForOneselfIsBiasedDark) {
  EXPECT_LT(z_score(true, Weigh::kEqually, 2), -6);
  EXPECT_LT(z_score(true, Weigh::kByCount, 3), -6);
}

// What the header says of weights by counts.
TEST(Allocation, WeighingByCountsBringsTheBiasBack) {
  EXPECT_LT(z_score(false, Weigh::kByCount, 4), -6);
}

}  // namespace
}  // namespace yat

// The error of a picture from its two halves.

#include "film/halves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "film/film_parts.h"

namespace yat {
namespace {

/// Adds n samples per pixel of mean 1 and standard deviation `deviation`, uniform.
void add_samples(Film& film, uint32_t n, float deviation, std::mt19937& random) {
  const float width = deviation * std::sqrt(12.f);
  std::uniform_real_distribution<float> noise(-.5f, .5f);
  for (size_t i = 0; i < size_t(film.width()) * film.height(); ++i)
    for (uint32_t s = 0; s < n; ++s) {
      const float value = 1 + width * noise(random);
      film.data()[i].add(value, value, value);
    }
}

TEST(Halves, ThePictureIsTheMeanOfAllSamplesOrOfBothHalves) {
  Film a(2, 1), b(2, 1);
  a.at(0, 0).add(1, 2, 3);
  for (int i = 0; i < 3; ++i) b.at(0, 0).add(5, 6, 7);
  b.at(1, 0).add(9, 9, 9);
  const std::vector<float> by_count = resolve_halves(a, b, Weigh::kByCount);
  EXPECT_EQ(by_count, (std::vector<float>{4, 5, 6, 9, 9, 9}));
  Film all = a;
  all.merge(b);
  EXPECT_EQ(by_count, all.resolve());
  EXPECT_EQ(resolve_halves(a, b, Weigh::kEqually), (std::vector<float>{3, 4, 5, 9, 9, 9}));
  EXPECT_THROW(resolve_halves(a, Film(1, 2), Weigh::kByCount), std::invalid_argument);
}

// Var(s A + (1 - s) B) is known here: each sample has variance v.
TEST(Halves, TheEstimatedVarianceIsThatOfThePicture) {
  constexpr float kDeviation = .5f;
  const double v = double(kDeviation) * double(kDeviation);
  ThreadPool pool(1);
  std::mt19937 random(7);
  struct Case {
    uint32_t a, b;
    Weigh weigh;
    double variance;
  };
  const Case cases[] = {{4, 4, Weigh::kByCount, v / 8},
                        {2, 6, Weigh::kByCount, v / 8},
                        {4, 4, Weigh::kEqually, v / 8},
                        {2, 6, Weigh::kEqually, (v / 2 + v / 6) / 4}};
  for (const Case& c : cases) {
    double sum = 0, squares = 0;
    constexpr int kTrials = 200;
    for (int t = 0; t < kTrials; ++t) {
      Film a(16, 16), b(16, 16);
      add_samples(a, c.a, kDeviation, random);
      add_samples(b, c.b, kDeviation, random);
      const double mse = estimate_noise(a, b, c.weigh, pool).mse;
      sum += mse;
      squares += mse * mse;
    }
    const double mean = sum / kTrials;
    const double error = std::sqrt((squares / kTrials - mean * mean) / (kTrials - 1));
    EXPECT_LT(error, .02 * c.variance);
    EXPECT_NEAR(mean, c.variance, 3.5 * error) << c.a << ' ' << c.b << ' ' << int(c.weigh);
  }
}

TEST(Halves, TheIntervalHoldsTheTruth) {
  constexpr float kDeviation = .2f;
  constexpr uint32_t kCount = 16;
  // Against mean 1; the picture's own mean, and so epsilon, is within a per mille of it.
  const double truth = double(kDeviation) * double(kDeviation) / (2 * kCount) / 1.01;
  ThreadPool pool(1);
  std::mt19937 random(11);
  int held = 0;
  constexpr int kTrials = 300;
  for (int t = 0; t < kTrials; ++t) {
    Film a(24, 24), b(24, 24);
    add_samples(a, kCount, kDeviation, random);
    add_samples(b, kCount, kDeviation, random);
    const NoiseEstimate e = estimate_noise(a, b, Weigh::kByCount, pool);
    EXPECT_EQ(e.pixels, 24u * 24);
    EXPECT_LT(e.high() - e.low(), .6 * truth);
    held += e.low() <= truth && truth <= e.high();
  }
  // 95 % of 300 is 285 +- 3.8; the channels being equal, terms are chi-square, hence some fewer.
  EXPECT_GE(held, 268);
  EXPECT_LE(held, 297);
}

// By the pixel's own mean the term of a stray sample could not exceed 1 per channel.
TEST(Halves, AStraySampleDoesNotHideItself) {
  Film a(9, 9), b(9, 9);
  for (size_t i = 0; i < 81; ++i)
    for (int s = 0; s < 4; ++s) {
      a.data()[i].add(1, 1, 1);
      b.data()[i].add(1, 1, 1);
    }
  a.at(4, 4).add(4000, 1, 1);
  ThreadPool pool(1);
  const NoiseEstimate e = estimate_noise(a, b, Weigh::kEqually, pool);
  const double d = (4000. - 1) / 5;
  EXPECT_NEAR(e.mse, d * d / 4 / 243, 1e-6 * e.mse);
  EXPECT_NEAR(e.rel_mse, d * d / 4 / (1 + e.epsilon) / 243, 1e-6 * e.rel_mse);
  EXPECT_GT(e.rel_mse_se, .5 * e.rel_mse);
}

TEST(Halves, SameBitsForAnyPool) {
  std::mt19937 random(3);
  Film a(37, 19), b(37, 19);
  add_samples(a, 3, .4f, random);
  add_samples(b, 2, .4f, random);
  ThreadPool one(1), many(3);
  const NoiseEstimate x = estimate_noise(a, b, Weigh::kByCount, one);
  const NoiseEstimate y = estimate_noise(a, b, Weigh::kByCount, many);
  EXPECT_EQ(x.rel_mse, y.rel_mse);
  EXPECT_EQ(x.rel_mse_se, y.rel_mse_se);
  EXPECT_EQ(x.mse, y.mse);
}

TEST(FilmParts, LightIsWeighedLikeThePictureAndTheRestByCount) {
  FilmParts parts(1, 1, feature_bit(Feature::kDirect) | feature_bit(Feature::kNormal), 2);
  const auto add = [&](size_t half, float light, float normal) {
    ASSERT_TRUE(parts[half].film.at(0, 0).add(light, light, light));
    parts[half].features->plane(Feature::kDirect).add(0, light, light, light);
    parts[half].features->plane(Feature::kNormal).add(0, 0, 0, normal);
  };
  add(0, 1, 1);
  for (int i = 0; i < 3; ++i) add(1, 5, 0);
  EXPECT_EQ(parts.total_samples(), 4u);
  for (const Weigh weigh : {Weigh::kByCount, Weigh::kEqually}) {
    parts.weigh = weigh;
    const float light = weigh == Weigh::kEqually ? 3.f : 4.f;
    EXPECT_EQ(parts.resolve(), (std::vector<float>{light, light, light}));
    const std::vector<PictureLayer> layers = parts.resolve_features();
    ASSERT_EQ(layers.size(), 2u);
    EXPECT_EQ(layers[0].values, (std::vector<float>{0, 0, .25f}));
    EXPECT_EQ(layers[1].values, (std::vector<float>{light, light, light}));
  }
}

}  // namespace
}  // namespace yat

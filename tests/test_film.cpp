// The film: exact sums, whatever the order.

#include "film/film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

namespace yat {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(Fixed, KeepsEveryFloatOfUsualSizeExactly) {
  std::mt19937 random(1);
  for (int i = 0; i < 200000; ++i) {
    const float x = std::bit_cast<float>(uint32_t(random()));
    if (!(std::fabs(x) >= 0x1p-41f && std::fabs(x) < 0x1p62f)) continue;
    ASSERT_EQ(from_fixed(to_fixed(x)), double(x)) << x;
  }
  EXPECT_EQ(to_fixed(0.f), Fixed(0));
  EXPECT_EQ(to_fixed(-0.f), Fixed(0));
  EXPECT_EQ(to_fixed(1.f), Fixed(1) << 64);
  EXPECT_EQ(to_fixed(-2.5f), -(Fixed(5) << 63));
}

TEST(Fixed, RoundsSmallFloatsToNearestEven) {
  EXPECT_EQ(to_fixed(0x1p-64f), Fixed(1));
  EXPECT_EQ(to_fixed(0x1p-65f), Fixed(0)) << "a tie goes to even";
  EXPECT_EQ(to_fixed(0x1.8p-64f), Fixed(2)) << "a tie goes to even";
  EXPECT_EQ(to_fixed(0x1.000002p-65f), Fixed(1)) << "above the tie";
  EXPECT_EQ(to_fixed(-0x1.8p-64f), Fixed(-2));
  EXPECT_EQ(to_fixed(0x1p-66f), Fixed(0));
  EXPECT_EQ(to_fixed(std::numeric_limits<float>::denorm_min()), Fixed(0));
  std::mt19937 random(2);
  for (int i = 0; i < 200000; ++i) {
    const float x = std::bit_cast<float>(uint32_t(random()));
    if (!(std::fabs(x) < 0x1p-30f)) continue;
    // A double holds x * 2^64 exactly, and rint rounds ties to even.
    ASSERT_EQ(to_fixed(x), Fixed(std::rint(std::ldexp(double(x), 64)))) << x;
  }
}

TEST(Fixed, ClampsWhatDoesNotFit) {
  const Fixed limit = Fixed(1) << 126;
  EXPECT_EQ(to_fixed(0x1p62f), limit);
  EXPECT_EQ(to_fixed(-0x1p100f), -limit);
  EXPECT_EQ(to_fixed(kInfinity), limit);
  EXPECT_EQ(to_fixed(-kInfinity), -limit);
  EXPECT_EQ(to_fixed(kNan), Fixed(0));
  EXPECT_EQ(to_fixed(std::nextafterf(0x1p62f, 0)), Fixed(0xffffff) << (38 + 64));
}

TEST(FilmPixel, RefusesWhatWouldSpoilTheSum) {
  FilmPixel pixel;
  EXPECT_TRUE(pixel.add(1, 2, 3));
  EXPECT_FALSE(pixel.add(kNan, 0, 0));
  EXPECT_FALSE(pixel.add(0, kInfinity, 0));
  EXPECT_FALSE(pixel.add(0, 0, -kInfinity));
  EXPECT_FALSE(pixel.add(0, 0x1p41f, 0));
  EXPECT_TRUE(pixel.add(-1, 0, kLargestSample)) << "filters have negative lobes";
  EXPECT_EQ(pixel.samples, 2u);
  EXPECT_EQ(from_fixed(pixel.r), 0.0);
  EXPECT_EQ(from_fixed(pixel.g), 2.0);
}

TEST(FilmPixel, TenMillionSamplesHaveTheirExactSum) {
  FilmPixel ones, mixed;
  for (int i = 0; i < 10'000'000; ++i) {
    ones.add(1, .1f, 0);
    mixed.add(i % 2 ? 1e-4f : 1e4f, 0, 0);
  }
  EXPECT_EQ(from_fixed(ones.r), 1e7);
  EXPECT_EQ(ones.g, to_fixed(.1f) * 10'000'000);
  EXPECT_EQ(mixed.r, to_fixed(1e-4f) * 5'000'000 + to_fixed(1e4f) * 5'000'000);
}

TEST(Film, AnyMergeOfPartsGivesTheSameBits) {
  constexpr uint32_t kWidth = 5, kHeight = 3, kSamples = 4000;
  std::mt19937 random(3);
  std::lognormal_distribution<float> bright(0.f, 6.f);
  struct Sample {
    uint32_t x, y;
    float r, g, b;
  };
  std::vector<Sample> samples(kSamples);
  for (Sample& s : samples)
    s = {uint32_t(random() % kWidth), uint32_t(random() % kHeight), bright(random), -bright(random),
         bright(random) * 1e-8f};
  Film whole(kWidth, kHeight);
  for (const Sample& s : samples) ASSERT_TRUE(whole.at(s.x, s.y).add(s.r, s.g, s.b));

  for (const uint32_t parts : {1u, 2u, 3u, 17u, 1000u}) {
    std::shuffle(samples.begin(), samples.end(), random);
    std::vector<Film> films(parts, Film(kWidth, kHeight));
    for (const Sample& s : samples) films[random() % parts].at(s.x, s.y).add(s.r, s.g, s.b);
    std::shuffle(films.begin(), films.end(), random);
    Film merged(kWidth, kHeight);
    for (const Film& film : films) merged.merge(film);
    for (uint32_t i = 0; i < kWidth * kHeight; ++i) {
      ASSERT_EQ(merged.data()[i].r, whole.data()[i].r);
      ASSERT_EQ(merged.data()[i].g, whole.data()[i].g);
      ASSERT_EQ(merged.data()[i].b, whole.data()[i].b);
      ASSERT_EQ(merged.data()[i].samples, whole.data()[i].samples);
    }
    EXPECT_EQ(merged.total_samples(), kSamples);
  }
}

TEST(Film, ResolvesToMeansAndBlackWithoutSamples) {
  Film film(2, 1);
  film.at(1, 0).add(1, 2, -4);
  film.at(1, 0).add(2, 2, -4);
  EXPECT_EQ(film.resolve(), (std::vector<float>{0, 0, 0, 1.5f, 2, -4}));
}

TEST(Film, RefusesToMergeAnotherSize) {
  Film film(2, 1);
  EXPECT_THROW(film.merge(Film(1, 2)), std::invalid_argument);
}

}  // namespace
}  // namespace yat

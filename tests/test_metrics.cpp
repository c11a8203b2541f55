#include "metrics/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <random>

#include "base/error.h"
#include "metrics/flip.h"

namespace yat {
namespace {

Image constant(uint32_t width, uint32_t height, float value) {
  Image image{width, height, {}, true};
  image.rgb.assign(image.pixels() * 3, value);
  return image;
}

TEST(Metrics, ConstantDifferenceInClosedForm) {
  const Image r = constant(10, 20, 2.f), x = constant(10, 20, 2.5f);
  const ImageError e = image_error(x, r);
  EXPECT_DOUBLE_EQ(e.mean, 2);
  EXPECT_DOUBLE_EQ(e.epsilon, .04);
  EXPECT_DOUBLE_EQ(e.mse, .25);
  EXPECT_NEAR(e.rel_mse, .25 / 4.04, 1e-14);
  EXPECT_NEAR(e.rel_mse_trimmed, e.rel_mse, 1e-14);
  EXPECT_NEAR(e.mape, .5 / 2.02, 1e-14);
  EXPECT_DOUBLE_EQ(e.bias, .25);
  EXPECT_DOUBLE_EQ(e.peak, 2);
  EXPECT_NEAR(e.psnr, 10 * std::log10(4 / .25), 1e-12);
  EXPECT_EQ(e.largest, .5);
  EXPECT_EQ(e.not_finite, 0u);
  EXPECT_EQ(e.outliers, 0u);
}

TEST(Metrics, EqualPicturesDifferByNothing) {
  const Image r = constant(3, 3, .7f);
  const ImageError e = image_error(r, r);
  EXPECT_EQ(e.mse, 0);
  EXPECT_EQ(e.rel_mse_trimmed, 0);
  EXPECT_EQ(e.psnr, std::numeric_limits<double>::infinity());
  EXPECT_EQ(e.outliers, 0u);
  EXPECT_EQ(flip(r, r).mean, 0);
  EXPECT_EQ(hdr_flip(r, r).mean, 0);
}

// What the trimmed figure hides, the outliers count: two fireflies in normal noise.
TEST(Metrics, FirefliesAreOutliersAndTrimmed) {
  Image r = constant(100, 100, 1.f), x = r;
  std::mt19937 rng(1);
  std::normal_distribution<float> noise(0.f, .1f);
  for (float& v : x.rgb) v += noise(rng);
  const ImageError quiet = image_error(x, r);
  for (const size_t p : {1234u, 7777u})
    for (size_t c = 0; c < 3; ++c) x.rgb[3 * p + c] = 100.f;
  const ImageError e = image_error(x, r);
  EXPECT_EQ(quiet.outliers, 0u);
  EXPECT_EQ(e.outliers, 2u);
  EXPECT_GT(e.rel_mse, 100 * quiet.rel_mse);
  EXPECT_NEAR(e.rel_mse_trimmed, quiet.rel_mse_trimmed, .01 * quiet.rel_mse_trimmed);
  // Ten of 10000 pixels are dropped: the rest of a chi-square of three is a little less.
  EXPECT_LT(quiet.rel_mse_trimmed, quiet.rel_mse);
  EXPECT_GT(quiet.rel_mse_trimmed, .98 * quiet.rel_mse);
  EXPECT_EQ(e.x, 34u);
  EXPECT_EQ(e.y, 12u);
}

TEST(Metrics, PixelsThatAreNoNumbersAreCountedAndLeftOut) {
  const Image r = constant(4, 4, 1.f);
  Image x = r;
  x.rgb[3] = std::numeric_limits<float>::quiet_NaN();
  x.rgb[10] = std::numeric_limits<float>::infinity();
  const ImageError e = image_error(x, r);
  EXPECT_EQ(e.not_finite, 2u);
  EXPECT_EQ(e.mse, 0);
  const PixelCount count = count_beyond(x, r, {1, 0, 1e30});
  EXPECT_EQ(count.beyond_each, 2u);
  EXPECT_TRUE(count.fails({1, 10, 1e30}, 16));
  for (float& v : x.rgb) v = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(image_error(x, r), Error);
}

TEST(Metrics, ThresholdsAreThoseOfIdiff) {
  const Image r = constant(10, 10, 1.f);
  Image x = r;
  for (size_t p = 0; p < 5; ++p) x.rgb[3 * p] = 1.5f;
  EXPECT_TRUE(count_beyond(x, r, {.1, 4, 1e30}).fails({.1, 4, 1e30}, 100));
  EXPECT_FALSE(count_beyond(x, r, {.1, 5, 1e30}).fails({.1, 5, 1e30}, 100));
  EXPECT_TRUE(count_beyond(x, r, {.1, 5, .4}).fails({.1, 5, .4}, 100));
  EXPECT_FALSE(count_beyond(x, r, {.6, 0, 1e30}).fails({.6, 0, 1e30}, 100));
}

TEST(Metrics, SizesMustAgree) {
  EXPECT_THROW(image_error(constant(2, 3, 1), constant(3, 2, 1)), Error);
  EXPECT_THROW(flip(constant(2, 3, 1), constant(3, 2, 1)), Error);
  EXPECT_THROW(count_beyond(constant(2, 3, 1), constant(3, 2, 1), {}), Error);
}

TEST(Metrics, BlackReferenceGivesFiniteFigures) {
  const Image r = constant(4, 4, 0.f), x = constant(4, 4, .5f);
  const ImageError e = image_error(x, r);
  EXPECT_DOUBLE_EQ(e.mse, .25);
  EXPECT_TRUE(std::isfinite(e.mape));
  EXPECT_TRUE(std::isfinite(hdr_flip(x, r).mean));
  EXPECT_GT(hdr_flip(x, r).mean, 0);
}

/// Waves, a ramp and a chequer; the second picture has a dimmer red, a white spot and a dimmer
/// corner.
struct Pair {
  Image reference, picture;
};
Pair test_pictures(bool radiance) {
  constexpr uint32_t w = 64, h = 48;
  Pair pair{{w, h, {}, radiance}, {w, h, {}, radiance}};
  for (uint32_t y = 0; y < h; ++y)
    for (uint32_t x = 0; x < w; ++x) {
      const double fx = x, fy = y;
      const float r[3] = {float(.5 + .4 * std::sin(fx * .3) * std::cos(fy * .2)), float(fx / w),
                          float(.25 + .5 * ((x / 8 + y / 8) % 2))};
      float t[3] = {float(double(r[0]) * .9), r[1], r[2]};
      if (y >= 10 && y < 14 && x >= 20 && x < 24) t[0] = t[1] = t[2] = 1;
      if (y >= 30 && x >= 40) t[2] *= .5f;
      const double scale = radiance ? std::exp2(fx / w * 8 - 4) : 1;
      for (int c = 0; c < 3; ++c) {
        pair.reference.rgb.push_back(float(double(r[c]) * scale));
        pair.picture.rgb.push_back(float(double(t[c]) * scale));
      }
    }
  return pair;
}

// Expected: what the authors' own program (flip-evaluator 1.7) gives for these pictures.
TEST(Flip, AgreesWithTheAuthorsProgram) {
  const Pair pair = test_pictures(false);
  const FlipMap map = flip(pair.picture, pair.reference);
  EXPECT_NEAR(map.mean, 0.2066153884, 2e-4);
  EXPECT_NEAR(map.values[12 * 64 + 22], 0.893731, 1e-3);
  EXPECT_NEAR(map.values[40 * 64 + 50], 0.548772, 1e-3);
  EXPECT_NEAR(map.values[5 * 64 + 5], 0.175136, 1e-3);
}

TEST(Flip, OfRadianceAgreesWithTheAuthorsProgram) {
  const Pair pair = test_pictures(true);
  const FlipMap map = hdr_flip(pair.picture, pair.reference);
  EXPECT_EQ(map.exposures, 5u);
  EXPECT_NEAR(map.first_stop, -2.588737, 1e-3);
  EXPECT_NEAR(map.last_stop, 2.167596, 1e-3);
  EXPECT_NEAR(map.mean, 0.1667441726, 2e-4);
  EXPECT_NEAR(map.values[12 * 64 + 22], 0.735883, 1e-3);
  EXPECT_NEAR(map.values[40 * 64 + 50], 0.461830, 1e-3);
  EXPECT_NEAR(map.values[5 * 64 + 5], 0.136309, 1e-3);
}

// Largest colour difference on the screen, far from any edge.
TEST(Flip, GreenAgainstBlueIsOne) {
  Image green = constant(64, 64, 0.f), blue = green;
  for (size_t p = 0; p < green.pixels(); ++p) green.rgb[3 * p + 1] = blue.rgb[3 * p + 2] = 1;
  EXPECT_NEAR(flip(green, blue).mean, 1, 1e-5);
}

TEST(MetricsImage, MapsAreReadAsTheyWereWritten) {
  const auto folder = std::filesystem::path(::testing::TempDir());
  const std::vector<float> values = {0.f, .25f, .5f, 1.f, 2.f, .125f};
  const std::string exr = (folder / "yat_map.exr").string(),
                    png = (folder / "yat_map.png").string();
  write_map(exr, values, 3, 2);
  const Image floats = read_image(exr);
  ASSERT_EQ(floats.width, 3u);
  ASSERT_EQ(floats.height, 2u);
  EXPECT_TRUE(floats.scene_referred);
  for (size_t p = 0; p < 6; ++p)
    for (size_t c = 0; c < 3; ++c) EXPECT_EQ(floats.rgb[3 * p + c], values[p]);
  write_map(png, values, 3, 2);
  const Image greys = read_image(png);
  EXPECT_FALSE(greys.scene_referred);
  // Display values: level 64 of 255 is .0513 in linear light.
  EXPECT_NEAR(greys.rgb[3], .0513, 1e-3);
  EXPECT_EQ(greys.rgb[9], 1.f);
  EXPECT_EQ(greys.rgb[12], 1.f);
  std::filesystem::remove(exr);
  std::filesystem::remove(png);
  EXPECT_THROW(read_image((folder / "no such picture.exr").string()), Error);
  EXPECT_THROW(write_map((folder / "map.nothing").string(), values, 3, 2), ResourceError);
}

}  // namespace
}  // namespace yat

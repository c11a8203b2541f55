// zsobol: blocks of pixels share (0,2)-nets, each pixel alone is uniform, and the error of a
// picture has little left at low frequencies. Scalar code: test_sampling holds kernels to it.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "chi2.h"
#include "gaussian_blur.h"
#include "kernels/rng_scalar.h"

namespace yat {
namespace {

/// Numbers of sample `sample` of pixel (x, y), 2^bits samples a pixel.
std::pair<float, float> draw(uint32_t seed, uint32_t bits, uint32_t x, uint32_t y, uint32_t sample,
                             Dimension dimension = Dimension::kLight) {
  return random_pair(SamplerKind::kZSobol, {seed, 1u << bits, 1}, dimension, y << 16 | x, sample,
                     2);
}

// Every elementary interval of area 1 / n holds one of the n samples of an aligned block.
TEST(ZSobol, EveryAlignedBlockIsAZeroTwoNet) {
  for (uint32_t bits = 0; bits <= 3; ++bits)
    for (uint32_t level = 0; level <= 3; ++level)
      for (uint32_t trial = 0; trial < 12; ++trial) {
        const uint32_t side = 1u << level;
        // Blocks everywhere, also where index and pixel no longer fit in 32 bits together.
        const uint32_t x0 = (trial * 2654435761u >> 16) / side * side;
        const uint32_t y0 = (trial * 40503u * 977u & 0xffffu) / side * side;
        const uint32_t set = trial % 3;
        std::vector<std::pair<float, float>> points;
        for (uint32_t i = 0; i < side * side; ++i)
          for (uint32_t s = 0; s < 1u << bits; ++s)
            points.push_back(draw(trial, bits, x0 + i % side, y0 + i / side, (set << bits) + s));
        const int log = int(bits + 2 * level);
        ASSERT_EQ(points.size(), size_t(1) << log);
        for (int a = 0; a <= log; ++a) {
          std::set<std::pair<int, int>> cells;
          for (const auto& [u, v] : points)
            cells.insert({int(u * float(1 << a)), int(v * float(1 << (log - a)))});
          EXPECT_EQ(cells.size(), points.size())
              << side << " pixels, " << (1 << bits) << " samples, 2^-" << a << " wide";
        }
      }
}

// Over seeds, a pixel's first sample is uniform, and so is the pair of its first numbers in two
// dimensions: no pixel, wherever it lies in its block, is favoured.
TEST(ZSobol, EachPixelIsUniform) {
  constexpr std::array<std::array<uint32_t, 2>, 4> kPixels = {
      {{0, 0}, {1, 0}, {37, 1021}, {65535, 40000}}};
  for (const auto& [x, y] : kPixels)
    for (const uint32_t bits : {0u, 2u}) {
      SquareHistogram pairs(32), dimensions(32);
      for (uint32_t seed = 0; seed < 1u << 16; ++seed) {
        const auto a = draw(seed, bits, x, y, 0);
        pairs.add(double(a.first), double(a.second));
        dimensions.add(double(a.first), double(draw(seed, bits, x, y, 0, Dimension::kBsdf).first));
      }
      EXPECT_GE(pairs.p_value(), sidak_level(16)) << x << ", " << y;
      EXPECT_GE(dimensions.p_value(), sidak_level(16)) << x << ", " << y;
    }
}

// Pixels far from each other share no sample either, however many samples they have: levels of
// the picture that do not fit in an index are cut off between blocks, never within one.
TEST(ZSobol, FarPixelsDiffer) {
  for (const uint32_t bits : {0u, 1u, 5u, 11u, 12u, 20u})
    for (uint32_t seed = 0; seed < 8; ++seed) {
      std::set<std::pair<float, float>> seen;
      size_t count = 0;
      for (uint32_t step = 1; step < 1u << 16; step *= 2)
        for (const uint32_t place : {step, step << 16, step << 16 | step}) {
          const uint32_t x = place & 0xffffu, y = place >> 16;
          seen.insert(draw(seed, bits, x, y, 0));
          ++count;
        }
      seen.insert(draw(seed, bits, 0, 0, 0));
      // 49 points out of 2^48: chance makes none equal.
      EXPECT_EQ(seen.size(), count + 1) << bits << " bits, seed " << seed;
    }
}

// Rows, columns and diagonals of blocks come first, on every level and independently.
TEST(ZSobol, BlocksAreTurnedAtRandom) {
  for (const int level : {0, 1, 5}) {
    double seen[3] = {};
    for (uint32_t key = 0; key < 40000; ++key) {
      // Bits of the Morton index from the top: those of y at even places once reversed.
      const uint32_t block = key * 2654435761u;
      const auto order = [&](uint32_t y, uint32_t x) {
        const uint32_t below = (1u << (2 * level)) - 1;
        return turn_blocks((block & below) | y << (2 * level) | x << (2 * level + 1),
                           mix_word(key)) >>
                   (2 * level) &
               3u;
      };
      std::set<uint32_t> all = {order(0, 0), order(0, 1), order(1, 0), order(1, 1)};
      ASSERT_EQ(all.size(), 4u);
      const auto half = [&](uint32_t y, uint32_t x) { return order(y, x) & 1u; };
      if (half(0, 0) == half(0, 1))
        ++seen[0];
      else if (half(0, 0) == half(1, 0))
        ++seen[1];
      else
        ++seen[2];
    }
    EXPECT_GE(chi2_p_value({seen[0], seen[1], seen[2]}, {20000, 10000, 10000}), .001) << level;
  }
}

// ---- The error of a picture --------------------------------------------------------------------

constexpr int kSide = 64;

/// What a pixel integrates: a smooth function, or an edge that turns slowly over the picture.
struct Smooth {
  double operator()(double u, double v) const { return 2 * u * v + u * u; }
  double mean() const { return 5. / 6; }
};
struct Edge {
  double cos, sin;
  double operator()(double u, double v) const {
    return cos * (u - .5) + sin * (v - .5) > .1 ? 1 : 0;
  }
  double mean() const {
    constexpr int kSteps = 4096;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double u = (i + .5) / kSteps, v = .5 + (.1 - cos * (u - .5)) / sin;
      sum += std::clamp(1 - v, 0., 1.) / kSteps;
    }
    return sum;
  }
};

/// Of pictures with seeds 1 .. kSeeds: mean squared error of pixels, and of pixels blurred by
/// 1.5 pixels.
struct ErrorPower {
  double all = 0;
  std::vector<double> blurred;  ///< one a seed
};
constexpr uint32_t kSeeds = 40;

/// make(y): what pixels of row y integrate.
template <class Make>
ErrorPower error_of(SamplerKind sampler, uint32_t bits, Make make) {
  ErrorPower power;
  for (uint32_t seed = 1; seed <= kSeeds; ++seed) {
    std::vector<double> error(kSide * kSide);
    for (int y = 0; y < kSide; ++y) {
      const auto f = make(y);
      const double mean = f.mean();
      for (int x = 0; x < kSide; ++x) {
        double sum = 0;
        for (uint32_t s = 0; s < 1u << bits; ++s) {
          const auto [u, v] = random_pair(sampler, {seed, 1u << bits, 1}, Dimension::kLight,
                                          uint32_t(y) << 16 | uint32_t(x), s, 1);
          sum += f(double(u), double(v));
        }
        error[size_t(y * kSide + x)] = sum / (1 << bits) - mean;
      }
    }
    power.all += mean_square(error) / kSeeds;
    power.blurred.push_back(mean_square(blurred(error, kSide, 1.5)));
  }
  return power;
}

// All of the error is as large as with sobol (but for the seeds, which few patterns of a pixel's
// samples share); what a filter leaves of it is not.
TEST(ZSobol, ErrorsOfNeighboursCancel) {
  const auto smooth = [](int) { return Smooth{}; };
  const auto edge = [](int y) { return Edge{std::cos(.7 + y * .008), std::sin(.7 + y * .008)}; };
  for (const uint32_t bits : {0u, 2u, 4u}) {
    const auto compare = [&](const auto& make, double gain, const char* name) {
      const ErrorPower own = error_of(SamplerKind::kSobol, bits, make),
                       shared = error_of(SamplerKind::kZSobol, bits, make);
      EXPECT_NEAR(shared.all / own.all, 1, .12) << name << ", " << (1 << bits) << " samples";
      EXPECT_GT(surely_times_less(own.blurred, shared.blurred), gain)
          << name << ", " << (1 << bits) << " samples";
    };
    compare(smooth, 4, "smooth");
    compare(edge, 2, "edge");
  }
}

}  // namespace
}  // namespace yat

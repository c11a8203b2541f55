// Stratified samplers: every set fills its strata, and sets, pixels and pairs are independent. That
// kernels draw the same bits is tested in test_sampling.cpp.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "chi2.h"
#include "kernels/rng_scalar.h"

namespace yat {
namespace {

struct Grid {
  uint32_t columns, rows;
  uint32_t size() const { return columns * rows; }
};
constexpr Grid kGrids[] = {{1, 1}, {2, 2}, {4, 4}, {3, 5}, {8, 8}, {7, 7}, {10, 13}, {32, 32}};

std::vector<std::pair<float, float>> set_of(SamplerKind sampler, const Grid& grid, uint32_t seed,
                                            uint32_t set) {
  std::vector<std::pair<float, float>> points;
  for (uint32_t i = 0; i < grid.size(); ++i)
    points.push_back(random_pair(sampler, {seed, grid.columns, grid.rows}, Dimension::kBsdf, 77,
                                 set * grid.size() + i, 2));
  return points;
}

/// Whether each of the columns x rows cells of the unit square holds one point, but for rounding at
/// its borders.
bool one_in_each(std::vector<std::pair<float, float>> points, uint32_t columns, uint32_t rows) {
  constexpr double kRound = 1e-6;
  const auto within = [](float x, size_t place, uint32_t n) {
    return x >= 0 && x < 1 && double(x) > double(place) / n - kRound &&
           double(x) < double(place + 1) / n + kRound;
  };
  std::sort(points.begin(), points.end());
  for (size_t column = 0; column < columns; ++column) {
    const auto first = points.begin() + ptrdiff_t(column * rows);
    std::sort(first, first + rows, [](auto& a, auto& b) { return a.second < b.second; });
    for (size_t row = 0; row < rows; ++row)
      if (!within(first[ptrdiff_t(row)].first, column, columns) ||
          !within(first[ptrdiff_t(row)].second, row, rows))
        return false;
  }
  return true;
}

TEST(Strata, EverySetFillsItsCells) {
  for (const Grid& grid : kGrids)
    for (uint32_t trial = 0; trial < 20; ++trial) {
      const uint32_t set = trial < 10 ? trial : (uint32_t(1) << 30) / grid.size() - trial;
      for (const SamplerKind sampler :
           {SamplerKind::kRegular, SamplerKind::kJittered, SamplerKind::kMultiJittered,
            SamplerKind::kCorrelatedMultiJittered})
        EXPECT_TRUE(one_in_each(set_of(sampler, grid, trial, set), grid.columns, grid.rows))
            << grid.columns << " x " << grid.rows << ", set " << set;
      // One in each of n columns and n rows.
      for (const SamplerKind sampler : {SamplerKind::kNRooks, SamplerKind::kMultiJittered,
                                        SamplerKind::kCorrelatedMultiJittered}) {
        const auto points = set_of(sampler, grid, trial, set);
        EXPECT_TRUE(one_in_each(points, grid.size(), 1));
        EXPECT_TRUE(one_in_each(points, 1, grid.size()));
      }
    }
}

TEST(Strata, RegularPointsAreTheMiddlesOfCells) {
  for (const auto& [x, y] : set_of(SamplerKind::kRegular, {8, 4}, 1, 3)) {
    EXPECT_EQ(std::fmod(x * 16, 2.f), 1.f);
    EXPECT_EQ(std::fmod(y * 8, 2.f), 1.f);
  }
}

TEST(Strata, CorrelatedSetsShareOneShuffleOfColumnsAndOneOfRows) {
  const Grid grid{6, 5};
  const auto points = set_of(SamplerKind::kCorrelatedMultiJittered, grid, 3, 1);
  // In every column of cells, the fine column of a point depends on its row alone; likewise rows.
  std::vector<int> fine_x(grid.rows, -1), fine_y(grid.columns, -1);
  for (const auto& [x, y] : points) {
    const int column = int(double(x) * grid.columns), row = int(double(y) * grid.rows);
    const int sub_x = int(double(x) * grid.size()) - column * int(grid.rows);
    const int sub_y = int(double(y) * grid.size()) - row * int(grid.columns);
    if (fine_x[size_t(row)] < 0) fine_x[size_t(row)] = sub_x;
    if (fine_y[size_t(column)] < 0) fine_y[size_t(column)] = sub_y;
    EXPECT_EQ(fine_x[size_t(row)], sub_x);
    EXPECT_EQ(fine_y[size_t(column)], sub_y);
  }
  // Not so without correlation.
  const auto free = set_of(SamplerKind::kMultiJittered, grid, 3, 1);
  std::vector<std::vector<int>> seen(grid.rows);
  for (const auto& [x, y] : free) {
    const int column = int(double(x) * grid.columns);
    seen[size_t(double(y) * grid.rows)].push_back(int(double(x) * grid.size()) -
                                                  column * int(grid.rows));
  }
  bool varies = false;
  for (const auto& row : seen)
    for (const int s : row) varies = varies || s != row[0];
  EXPECT_TRUE(varies);
}

TEST(Strata, DivisionIsExact) {
  using S = Strata<ScalarStrataOps>;
  for (const uint32_t n :
       {1u, 2u, 3u, 5u, 7u, 49u, 63u, 65u, 130u, 999u, 65536u, 1000003u, kLargestSet})
    for (uint32_t i = 0; i < 3000; ++i) {
      const uint32_t a = i < 1000   ? i
                         : i < 2000 ? (i - 1000) * n + (i % 3) - (i > 1000)
                                    : (1u << 30) - 1 - (i - 2000) * 997;
      const auto d = S::divide(a & 0x3fffffffu, n);
      ASSERT_EQ(d.quotient, (a & 0x3fffffffu) / n) << a << " / " << n;
      ASSERT_EQ(d.rest, (a & 0x3fffffffu) % n) << a << " / " << n;
    }
}

// Every place is taken once, and over many keys an index goes everywhere alike: one chi-square
// test over index and place for each size, together at 1 % (Sidak).
TEST(Strata, PermutationsAreFair) {
  const std::vector<uint32_t> sizes = {2, 3, 5, 8, 13, 16, 31};
  const double level = sidak_level(sizes.size());
  for (const uint32_t n : sizes) {
    const uint32_t keys = 20000;
    std::vector<double> seen(size_t(n) * n);
    for (uint32_t key = 0; key < keys; ++key) {
      std::vector<int> taken(n);
      for (uint32_t i = 0; i < n; ++i) {
        const uint32_t place = Strata<ScalarStrataOps>::permute(i, n, key * 0x9e3779b9u);
        ASSERT_LT(place, n);
        ++taken[place];
        ++seen[size_t(i) * n + place];
      }
      for (const int t : taken) ASSERT_EQ(t, 1);
    }
    // Rows and columns sum to `keys`: (n - 1)^2 degrees of freedom.
    double statistic = 0;
    for (const double count : seen) statistic += std::pow(count - double(keys) / n, 2) * n / keys;
    EXPECT_GE(chi2_upper_tail(statistic, double(n - 1) * (n - 1)), level) << n;
  }
}

// What stratification is for: the variance of a set's mean of smooth and of discontinuous
// functions.
TEST(Strata, MeansAreMoreExactThanIndependentOnes) {
  const Grid grid{8, 8};
  const auto variance = [&](SamplerKind sampler, auto f, double mean) {
    double sum = 0;
    for (uint32_t set = 0; set < 400; ++set) {
      double total = 0;
      for (const auto& [x, y] : set_of(sampler, grid, 5, set)) total += f(double(x), double(y));
      sum += std::pow(total / grid.size() - mean, 2);
    }
    return sum / 400;
  };
  const auto smooth = [](double x, double y) { return x * y; };
  const auto edge = [](double x, double y) { return x + .5 * y < .6 ? 1. : 0.; };
  const double smooth_all = variance(SamplerKind::kIndependent, smooth, .25);
  const double edge_all = variance(SamplerKind::kIndependent, edge, .35);
  for (const SamplerKind sampler : {SamplerKind::kJittered, SamplerKind::kMultiJittered,
                                    SamplerKind::kCorrelatedMultiJittered}) {
    EXPECT_LT(variance(sampler, smooth, .25), .05 * smooth_all);
    EXPECT_LT(variance(sampler, edge, .35), .5 * edge_all);
  }
  // N-rooks knows the two axes, not the product's share of both.
  EXPECT_LT(variance(SamplerKind::kNRooks, smooth, .25), .3 * smooth_all);
}

}  // namespace
}  // namespace yat

#pragma once
// Whether two ways of rendering give the same picture on average.
//
// Each way renders the picture several times with independent seeds (a run each); the means over
// the runs are compared, by Welch's test for unequal variances (Jung, Hanika, Dachsbacher 2020),
//
//   whole   of the whole picture, per channel: what all pixels have too much or too little,
//   tiles   per tile of kTile x kTile pixels and channel, Sidak-corrected: what a part has,
//   shape   of the p-values of smaller tiles, which must be uniform (Kolmogorov-Smirnov): what many
//           have a little of, with either sign,
//   pixels  per pixel and channel, Sidak-corrected: all but .25 % must pass at a level of 1 % over
//   all
//           (the rule of Mitsuba 3): what a few pixels have much of.
//
// The first three give a p-value each, and those one p-value by Sidak's correction. Runs, not
// samples, are what is independent: samples of a pixel are not, where a sampler spreads them.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "significance.h"

namespace yat {

/// Pictures of independent seeds, RGB from the top left.
struct Runs {
  uint32_t width = 0, height = 0;
  std::vector<std::vector<float>> pictures;
};

/// Edges [pixels] of the tiles (Jung et al.), and of those whose p-values have their shape tested.
inline constexpr uint32_t kTile = 16, kShapeTile = 8;
/// Least share of pixels and channels that must pass, each at 1 % over all pixels.
inline constexpr double kPixelsPassing = .9975;
/// Relative rounding of a picture's values: single precision, a few hundred operations.
inline constexpr double kPictureRounding = 2e-6;

/// Moments over the runs of tiles' means, [row of tiles][tile][channel].
inline std::vector<Moments> tile_moments(const Runs& runs, uint32_t edge) {
  const uint32_t across = (runs.width + edge - 1) / edge, down = (runs.height + edge - 1) / edge;
  std::vector<std::vector<double>> means(size_t(across) * down * 3,
                                         std::vector<double>(runs.pictures.size()));
  for (size_t r = 0; r < runs.pictures.size(); ++r)
    for (uint32_t y = 0; y < runs.height; ++y)
      for (uint32_t x = 0; x < runs.width; ++x) {
        const uint32_t left = x / edge * edge, top = y / edge * edge;
        const double pixels =
            double(std::min(edge, runs.width - left)) * double(std::min(edge, runs.height - top));
        for (uint32_t c = 0; c < 3; ++c)
          means[3 * (y / edge * across + x / edge) + c][r] +=
              double(runs.pictures[r][3 * (size_t(y) * runs.width + x) + c]) / pixels;
      }
  std::vector<Moments> moments;
  moments.reserve(means.size());
  for (const std::vector<double>& values : means) moments.push_back(moments_of(values));
  return moments;
}

/// Outcome of a comparison.
struct PictureTest {
  double whole = 1, tiles = 1, shape = 1;  ///< p-values
  double pixels_passing = 1;               ///< share of pixels and channels
  /// Standard error of the difference of the whole pictures' means, relative to the mean; of the
  /// channel where it is largest.
  double relative_error = 0;
  double difference = 0;  ///< of the whole pictures' means, relative; of the worst channel
  std::string worst;      ///< the worst tile, for people
  double p_value() const { return sidak_p_value(std::min({whole, tiles, shape}), 3); }
  bool passes(double alpha) const { return p_value() >= alpha && pixels_passing >= kPixelsPassing; }
  std::string text() const {
    return "p " + std::to_string(p_value()) + " (whole " + std::to_string(whole) + ", tiles " +
           std::to_string(tiles) + ", shape " + std::to_string(shape) + "), pixels passing " +
           std::to_string(pixels_passing) + ", mean differs by " +
           std::to_string(100 * difference) + " % (standard error " +
           std::to_string(100 * relative_error) + " %), worst " + worst;
  }
};

namespace detail {

/// Relative rounding as an absolute one.
inline double rounding_of(const Moments& a, const Moments& b, double relative) {
  return relative * std::max(std::fabs(a.mean), std::fabs(b.mean));
}

/// A pixel that few of its samples light may show none of them, and then a variance of nothing:
/// each has that of its surroundings at least.
inline double passing_pixels(const Runs& a, const Runs& b, double relative) {
  const std::vector<Moments> pa = tile_moments(a, 1), pb = tile_moments(b, 1);
  const uint32_t across = (a.width + kShapeTile - 1) / kShapeTile;
  const uint32_t down = (a.height + kShapeTile - 1) / kShapeTile;
  const auto at = [&](uint32_t x, uint32_t y, uint32_t c) {
    return 3 * (size_t(y) * a.width + x) + c;
  };
  std::vector<double> around_a(size_t(across) * down * 3), around_b = around_a;
  std::vector<double> count(around_a.size());
  const auto tile = [&](uint32_t x, uint32_t y, uint32_t c) {
    return 3 * (size_t(y) / kShapeTile * across + x / kShapeTile) + c;
  };
  const auto for_each = [&](const auto& visit) {
    for (uint32_t y = 0; y < a.height; ++y)
      for (uint32_t x = 0; x < a.width; ++x)
        for (uint32_t c = 0; c < 3; ++c) visit(at(x, y, c), tile(x, y, c));
  };
  for_each([&](size_t i, size_t t) {
    around_a[t] += pa[i].variance;
    around_b[t] += pb[i].variance;
    ++count[t];
  });
  const double level = sidak_level(.01, size_t(a.width) * a.height);
  double passing = 0;
  for_each([&](size_t i, size_t t) {
    Moments x = pa[i], y = pb[i];
    x.variance = std::max(x.variance, around_a[t] / count[t]);
    y.variance = std::max(y.variance, around_b[t] / count[t]);
    passing += welch_test(x, y, rounding_of(x, y, relative)) >= level;
  });
  return passing / double(pa.size());
}

}  // namespace detail

/// Both of one size, at least 8 runs each, or known_picture(). Relative differences up to about
/// `rounding` are not looked for.
inline PictureTest compare_runs(const Runs& a, const Runs& b, double rounding = kPictureRounding) {
  PictureTest out;
  const uint32_t all = std::max(a.width, a.height);
  const std::vector<Moments> wa = tile_moments(a, all), wb = tile_moments(b, all);
  double least = 1;
  for (size_t c = 0; c < wa.size(); ++c) {
    const double mean = std::max({wa[c].mean, wb[c].mean, 1e-30});
    const double p = welch_test(wa[c], wb[c], detail::rounding_of(wa[c], wb[c], rounding));
    const double error = std::sqrt(wa[c].squared_error() + wb[c].squared_error()) / mean;
    out.relative_error = std::max(out.relative_error, error);
    if (p <= least) {
      least = p;
      out.difference = (wa[c].mean - wb[c].mean) / mean;
    }
  }
  out.whole = sidak_p_value(least, wa.size());

  const std::vector<Moments> ta = tile_moments(a, kTile), tb = tile_moments(b, kTile);
  const uint32_t across = (a.width + kTile - 1) / kTile;
  least = 2;
  for (size_t i = 0; i < ta.size(); ++i) {
    const double p = welch_test(ta[i], tb[i], detail::rounding_of(ta[i], tb[i], rounding));
    if (p >= least) continue;
    least = p;
    out.worst = "tile " + std::to_string(i / 3 % across) + "," + std::to_string(i / 3 / across) +
                " channel " + std::to_string(i % 3) + ": " + std::to_string(ta[i].mean) +
                " against " + std::to_string(tb[i].mean) + " +- " +
                std::to_string(std::sqrt(ta[i].squared_error() + tb[i].squared_error()));
  }
  out.tiles = sidak_p_value(least, ta.size());

  // One channel: the three go together, and would count the same chance three times. Tiles that
  // vary by rounding alone (a lamp, nothing) say nothing.
  const std::vector<Moments> sa = tile_moments(a, kShapeTile), sb = tile_moments(b, kShapeTile);
  std::vector<double> p;
  for (size_t i = 1; i < sa.size(); i += 3) {
    const double noise = std::sqrt(sa[i].squared_error() + sb[i].squared_error());
    const double floor = detail::rounding_of(sa[i], sb[i], rounding);
    if (noise > 10 * floor) p.push_back(welch_test(sa[i], sb[i], floor));
  }
  out.shape = uniformity_p_value(p);
  out.pixels_passing = detail::passing_pixels(a, b, rounding);
  return out;
}

/// The same value in every pixel and channel, known exactly: the other side of a closed form.
inline Runs known_picture(uint32_t width, uint32_t height, float value) {
  const std::vector<float> picture(3 * size_t(width) * height, value);
  return {width, height, {picture, picture}};
}

}  // namespace yat

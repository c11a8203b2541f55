#include "converge/bias_test.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "base/student.h"

namespace yat {

namespace {

constexpr double kWeights[3] = {.2126, .7152, .0722};
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kRounding = 2e-6;  ///< relative, of pictures in floats
constexpr double kChance = .01;     ///< of any false finding in a picture

/// Degrees of freedom of a difference of two means (Welch 1947, Satterthwaite 1946).
/// a, b: their variances; df of b 0: it is known exactly.
double welch_degrees(double a, double df_a, double b, double df_b) {
  const double parts = a * a / df_a + (df_b > 0 ? b * b / df_b : 0);
  return parts > 0 ? (a + b) * (a + b) / parts : df_a;
}

/// Variance of each pixel's luminance, at least that of its surroundings. Channels of a pixel vary
/// together: the deviation of their weighted sum is at most the weighted sum of deviations, and
/// nearly that where light is white.
std::vector<double> luminance_variance(const std::vector<double>& variance, uint32_t width,
                                       uint32_t height) {
  constexpr uint32_t kTile = 8;
  const uint32_t across = (width + kTile - 1) / kTile, down = (height + kTile - 1) / kTile;
  std::vector<double> out(size_t(width) * height), sum(size_t(across) * down), count(sum.size());
  const auto tile = [&](size_t p) { return p / width / kTile * across + p % width / kTile; };
  for (size_t p = 0; p < out.size(); ++p) {
    double deviation = 0;
    for (size_t c = 0; c < 3; ++c) deviation += kWeights[c] * std::sqrt(variance[3 * p + c]);
    out[p] = deviation * deviation;
    sum[tile(p)] += out[p];
    ++count[tile(p)];
  }
  for (size_t p = 0; p < out.size(); ++p) out[p] = std::max(out[p], sum[tile(p)] / count[tile(p)]);
  return out;
}

}  // namespace

BiasTest test_bias(const PixelMoments& runs, const Reference& reference) {
  if (runs.mean().size() != reference.image.rgb.size())
    throw std::invalid_argument("test_bias: pictures of two sizes");
  BiasTest test;
  test.runs = runs.count();
  test.floor = kNan;
  if (runs.count() < 2) return test;

  const std::vector<double>& mean = runs.mean();
  const std::vector<double> variance = runs.variance();
  const bool known = !reference.variance.empty();
  const double n = runs.count();
  const size_t pixels = mean.size() / 3;
  test.pixels = pixels;
  // 1 - (1 - chance)^(1 / pixels), without its cancellation.
  const double alpha = -std::expm1(std::log1p(-kChance) / double(pixels));
  double squares = 0;
  for (size_t i = 0; i < mean.size(); ++i) {
    const double d = mean[i] - double(reference.image.rgb[i]);
    squares += d * d - variance[i] / n;
  }
  const std::vector<double> of_runs = luminance_variance(variance, runs.width(), runs.height());
  std::vector<double> of_reference(pixels);
  if (known) of_reference = luminance_variance(reference.variance, runs.width(), runs.height());
  for (size_t p = 0; p < pixels; ++p) {
    double d = 0, level = 0;
    for (size_t c = 0; c < 3; ++c) {
      const double r = double(reference.image.rgb[3 * p + c]);
      d += kWeights[c] * (mean[3 * p + c] - r);
      level += kWeights[c] * std::abs(r);
    }
    const double a = of_runs[p] / n, b = of_reference[p];
    if (a + b > 0)
      test.beyond += student_two_sided(d / std::sqrt(a + b),
                                       welch_degrees(a, n - 1, b, reference.degrees)) < alpha;
    else
      test.beyond += std::abs(d) > kRounding * level;
  }
  test.floor = squares / double(mean.size());
  return test;
}

}  // namespace yat

#include "converge/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace yat {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr uint32_t kDraws = 2000;

/// Value at the share `q` of sorted values, between neighbours.
double quantile(std::span<const double> sorted, double q) {
  const double place = q * double(sorted.size() - 1);
  const auto i = size_t(place);
  if (i + 1 >= sorted.size()) return sorted.back();
  return sorted[i] + (place - double(i)) * (sorted[i + 1] - sorted[i]);
}

struct Line {
  double slope, shift;
};
/// Through two points on log-log axes.
Line line_between(double x0, double y0, double x1, double y1) {
  const double slope = std::log(y1 / y0) / std::log(x1 / x0);
  return {slope, std::log(y0) - slope * std::log(x0)};
}

}  // namespace

Interval::Interval() : low(kNan), high(kNan) {}
TimeToError::TimeToError() : seconds(kNan) {}

double mean_of(std::span<const double> values) {
  if (values.empty()) return kNan;
  return std::accumulate(values.begin(), values.end(), 0.) / double(values.size());
}

double median_of(std::span<const double> values) {
  if (values.empty()) return kNan;
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  return quantile(sorted, .5);
}

double deviation_of(std::span<const double> values) {
  if (values.size() < 2) return kNan;
  const double mean = mean_of(values);
  double sum = 0;
  for (const double v : values) sum += (v - mean) * (v - mean);
  return std::sqrt(sum / double(values.size() - 1));
}

Interval bootstrap_interval(uint32_t runs, const RunStatistic& statistic) {
  if (runs < 2) return {};
  std::mt19937 rng(20191);
  std::vector<uint32_t> draw(runs);
  std::vector<double> figures;
  figures.reserve(kDraws);
  for (uint32_t k = 0; k < kDraws; ++k) {
    // Multiply and shift: the standard's distributions differ between libraries.
    for (uint32_t& i : draw) i = uint32_t(uint64_t(uint32_t(rng())) * runs >> 32);
    const double figure = statistic(draw);
    if (std::isfinite(figure)) figures.push_back(figure);
  }
  if (double(figures.size()) < .95 * kDraws) return {};
  std::sort(figures.begin(), figures.end());
  return {quantile(figures, .025), quantile(figures, .975)};
}

double log_slope(std::span<const double> x, std::span<const double> y) {
  double n = 0, mean_x = 0, mean_y = 0;
  const auto used = [&](size_t i) { return x[i] > 0 && y[i] > 0 && std::isfinite(y[i]); };
  for (size_t i = 0; i < x.size(); ++i)
    if (used(i)) {
      n += 1;
      mean_x += std::log(x[i]);
      mean_y += std::log(y[i]);
    }
  if (n < 2) return kNan;
  mean_x /= n;
  mean_y /= n;
  double xx = 0, xy = 0;
  for (size_t i = 0; i < x.size(); ++i)
    if (used(i)) {
      const double d = std::log(x[i]) - mean_x;
      xx += d * d;
      xy += d * (std::log(y[i]) - mean_y);
    }
  return xx > 0 ? xy / xx : kNan;
}

TimeToError time_to_error(std::span<const double> seconds, std::span<const double> errors,
                          double target) {
  std::vector<double> t, e;
  for (size_t i = 0; i < seconds.size(); ++i)
    if (errors[i] > 0 && seconds[i] > 0 && (t.empty() || seconds[i] > t.back())) {
      t.push_back(seconds[i]);
      e.push_back(errors[i]);
    }
  TimeToError found;
  if (t.size() < 2) return found;
  // The first segment that comes down to the target; else the end that is nearer to it.
  size_t k = 0;
  while (k + 1 < t.size() && e[k + 1] > target) ++k;
  found.extrapolated = e[0] < target || k + 1 == t.size();
  k = std::min(k, t.size() - 2);
  if (e[0] < target) k = 0;
  const Line line = line_between(t[k], e[k], t[k + 1], e[k + 1]);
  if (!(line.slope < 0)) return found;
  found.seconds = std::exp((std::log(target) - line.shift) / line.slope);
  return found;
}

}  // namespace yat

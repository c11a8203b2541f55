#include "wavefront/allocation.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace yat {

namespace {

constexpr double kLargestWeight = 8;
constexpr double kShareOfMean = .01;
constexpr uint32_t kMost = uint32_t(1) << 29;

/// Means of three neighbours by weights 1 2 1, along steps of `stride`; ends are repeated.
void smooth(std::vector<double>& values, uint32_t lines, uint32_t line_stride, uint32_t count,
            uint32_t stride) {
  std::vector<double> line(count);
  for (uint32_t l = 0; l < lines; ++l) {
    double* const first = &values[size_t(l) * line_stride];
    for (uint32_t i = 0; i < count; ++i) line[i] = first[size_t(i) * stride];
    for (uint32_t i = 0; i < count; ++i) {
      const double before = line[i ? i - 1 : 0], after = line[std::min(i + 1, count - 1)];
      first[size_t(i) * stride] = .25 * before + .5 * line[i] + .25 * after;
    }
  }
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / double(values.size());
}

}  // namespace

std::vector<double> sample_weights(const std::vector<double>& variance, uint32_t columns,
                                   uint32_t rows) {
  std::vector<double> weights = variance;
  smooth(weights, rows, columns, columns, 1);
  smooth(weights, columns, 1, rows, columns);
  const double floor = kShareOfMean * mean_of(weights);
  if (!(floor > 0)) return std::vector<double>(variance.size(), 1.);
  for (double& w : weights) w = std::sqrt(w + floor);
  // What the limit takes goes to the others; a few rounds suffice, and the mean is then set.
  for (int round = 0; round < 4; ++round) {
    const double mean = mean_of(weights);
    for (double& w : weights) w = std::min(w / mean, kLargestWeight);
  }
  return weights;
}

double gain_of(const std::vector<double>& weights, const std::vector<double>& variance) {
  std::vector<double> weighed(weights.size());
  for (size_t i = 0; i < weights.size(); ++i) weighed[i] = variance[i] / weights[i];
  const double left = mean_of(weighed);
  return left > 0 ? mean_of(variance) * mean_of(weights) / left : 1;
}

uint32_t nice_count(double x) {
  if (!(x > 1)) return 1;
  if (x >= double(kMost)) return kMost;
  // Of p, 1.5 p and 2 p; borders are geometric means.
  const uint32_t p = std::bit_floor(uint32_t(x));
  const double ratio = x / double(p);
  if (ratio * ratio >= 3) return 2 * p;
  if (p == 1) return ratio * ratio >= 2 ? 2 : 1;
  return ratio * ratio >= 1.5 ? p + p / 2 : p;
}

std::vector<uint32_t> sample_counts(const std::vector<double>& weights, double scale,
                                    uint32_t least) {
  std::vector<uint32_t> counts(weights.size());
  std::transform(weights.begin(), weights.end(), counts.begin(),
                 [&](double w) { return std::max(nice_count(scale * w), least); });
  return counts;
}

uint64_t total_samples(const std::vector<uint32_t>& counts, const std::vector<uint32_t>& pixels) {
  uint64_t total = 0;
  for (size_t i = 0; i < counts.size(); ++i) total += uint64_t(counts[i]) * pixels[i];
  return total;
}

double scale_for(const std::vector<double> (&weights)[2], const std::vector<uint32_t>& pixels,
                 uint32_t least, uint64_t most) {
  const auto fits = [&](double scale) {
    uint64_t total = 0;
    for (const std::vector<double>& w : weights)
      total += total_samples(sample_counts(w, scale, least), pixels);
    return total <= most;
  };
  double low = 0, high = double(kMost);
  if (!fits(low)) return 0;
  if (fits(high)) return high;
  // By ratio, from the least scale that could matter.
  low = 1e-3;
  if (!fits(low)) return 0;
  while (high > low * (1 + 1e-6)) {
    const double middle = std::sqrt(low * high);
    (fits(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace yat

#pragma once
// Tests of means and of p-values. All p-values are two-sided and, where nothing is wrong, uniform
// in [0, 1] as far as the means are normal.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "base/student.h"

namespace yat {

/// Mean of `count` independent values and their variance (unbiased, of one value).
struct Moments {
  double mean = 0, variance = 0;
  double count = 0;
  /// Of the mean.
  double squared_error() const { return variance / count; }
};
inline Moments moments_of(const std::vector<double>& values) {
  Moments m;
  m.count = double(values.size());
  for (const double v : values) m.mean += v / m.count;
  for (const double v : values) m.variance += (v - m.mean) * (v - m.mean) / (m.count - 1);
  return m;
}

/// P(|z| > |x|) of the normal distribution.
inline double normal_p_value(double x) {
  return std::erfc(std::fabs(x) / std::numbers::sqrt2);
}

/// Whether a mean with a known standard error > 0 is the known one (z-test).
inline double z_test(double mean, double known, double error) {
  return normal_p_value((mean - known) / error);
}

/// Whether two means are the same, of values with different variances (Welch 1947). `floor`: a
/// standard error of the difference beside that of the values, from rounding; it counts as known
/// exactly.
inline double welch_test(const Moments& a, const Moments& b, double floor = 0) {
  const double ea = a.squared_error(), eb = b.squared_error(), sum = ea + eb + floor * floor;
  const double difference = a.mean - b.mean;
  if (sum == 0) return difference == 0 ? 1 : 0;
  const double spread = ea * ea / (a.count - 1) + eb * eb / (b.count - 1);
  const double x = difference / std::sqrt(sum);
  return spread > 0 ? student_two_sided(x, sum * sum / spread) : normal_p_value(x);
}

/// The least of `tests` p-values as one p-value of all together (Sidak 1967): exact for
/// independent tests, too large (careful) for such as go together.
inline double sidak_p_value(double least, size_t tests) {
  if (least >= 1) return 1;
  return -std::expm1(double(tests) * std::log1p(-least));
}

/// p-value above which each of `tests` tests must be for all to pass with probability 1 - alpha.
inline double sidak_level(double alpha, size_t tests) {
  return -std::expm1(std::log1p(-alpha) / double(tests));
}

/// Whether p-values are uniform (Kolmogorov-Smirnov; Stephens' 1970 approximation for finite
/// counts, good to 1 % from 5 values on). Bias makes them small; a wrong variance bends them either
/// way.
inline double uniformity_p_value(std::vector<double> p) {
  if (p.size() < 5) return 1;
  std::sort(p.begin(), p.end());
  const double n = double(p.size());
  double distance = 0;
  for (size_t i = 0; i < p.size(); ++i)
    distance = std::max({distance, double(i + 1) / n - p[i], p[i] - double(i) / n});
  const double x = (std::sqrt(n) + .12 + .11 / std::sqrt(n)) * distance;
  // The series alternates and does not converge at 0, where the answer is 1.
  if (x < .2) return 1;
  double sum = 0;
  for (int k = 1; k <= 100; ++k) sum += (k % 2 ? 2 : -2) * std::exp(-2. * k * k * x * x);
  return std::clamp(sum, 0., 1.);
}

/// P(at least `failures` of `trials`), each failing with probability `alpha`.
inline double binomial_upper_tail(size_t failures, size_t trials, double alpha) {
  return failures
             ? incomplete_beta(alpha, 1 - alpha, double(failures), double(trials - failures) + 1)
             : 1;
}

}  // namespace yat

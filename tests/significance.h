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

/// Regularised incomplete beta function I_x(a, b): continued fraction (NIST DLMF 8.17.22) by
/// Lentz's method, on the side of x where it converges fast.
inline double incomplete_beta(double a, double b, double x) {
  if (!(x > 0)) return 0;
  if (x >= 1) return 1;
  if (x > (a + 1) / (a + b + 2)) return 1 - incomplete_beta(b, a, 1 - x);
  const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                a * std::log(x) + b * std::log1p(-x)) /
                       a;
  constexpr double kTiny = 1e-300;
  double c = 1, d = 1 - (a + b) * x / (a + 1);
  d = 1 / (std::fabs(d) < kTiny ? kTiny : d);
  double h = d;
  for (int m = 1; m < 10000; ++m) {
    for (const double term : {m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)),
                              -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))}) {
      d = 1 + term * d;
      c = 1 + term / c;
      d = 1 / (std::fabs(d) < kTiny ? kTiny : d);
      if (std::fabs(c) < kTiny) c = kTiny;
      h *= d * c;
    }
    if (std::fabs(d * c - 1) < 1e-15) break;
  }
  return front * h;
}

/// P(|z| > |x|) of the normal distribution.
inline double normal_p_value(double x) {
  return std::erfc(std::fabs(x) / std::numbers::sqrt2);
}

/// P(|t| > |x|) of Student's distribution with any degrees of freedom > 0.
inline double student_p_value(double x, double degrees) {
  return incomplete_beta(degrees / 2, .5, degrees / (degrees + x * x));
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
  return spread > 0 ? student_p_value(x, sum * sum / spread) : normal_p_value(x);
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
  return failures ? incomplete_beta(double(failures), double(trials - failures) + 1, alpha) : 1;
}

}  // namespace yat

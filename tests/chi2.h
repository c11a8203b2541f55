#pragma once
// Pearson's chi-square test of a histogram against expected counts.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace yat {

/// Upper tail of the chi-square distribution: Q(dof/2, x/2), by the series below x < a + 1 and by
/// Lentz's continued fraction above.
inline double chi2_upper_tail(double x, double dof) {
  const double a = dof / 2, z = x / 2;
  if (z <= 0) return 1;
  const double front = std::exp(a * std::log(z) - z - std::lgamma(a));
  if (z < a + 1) {
    double term = 1 / a, sum = term;
    for (int n = 1; n < 10000 && term > sum * 1e-16; ++n) sum += term *= z / (a + n);
    return 1 - front * sum;
  }
  double b = z + 1 - a, c = 1e300, d = 1 / b, h = d;
  for (int n = 1; n < 10000; ++n) {
    const double an = -n * (n - a);
    b += 2;
    d = 1 / (an * d + b);
    c = b + an / c;
    h *= d * c;
    if (std::abs(d * c - 1) < 1e-15) break;
  }
  return front * h;
}

/// p-value of the observed counts under the expected ones. Bins are merged, smallest expectation
/// first, until each expects at least 5. 0 where something was seen that cannot be.
inline double chi2_p_value(const std::vector<double>& observed,
                           const std::vector<double>& expected) {
  std::vector<size_t> order(observed.size());
  std::iota(order.begin(), order.end(), size_t(0));
  std::sort(order.begin(), order.end(),
            [&](size_t i, size_t j) { return expected[i] < expected[j]; });
  double statistic = 0, pool_seen = 0, pool_wanted = 0;
  int bins = 0;
  for (const size_t i : order) {
    if (expected[i] <= 0) {
      if (observed[i] > 0) return 0;
      continue;
    }
    pool_seen += observed[i];
    pool_wanted += expected[i];
    if (pool_wanted < 5) continue;
    statistic += (pool_seen - pool_wanted) * (pool_seen - pool_wanted) / pool_wanted;
    ++bins;
    pool_seen = pool_wanted = 0;
  }
  if (bins < 2) return 1;
  return chi2_upper_tail(statistic, bins - 1);
}

/// Level of each of `tests` tests so that all of them together fail with probability 0.01 (Sidak).
inline double sidak_level(size_t tests) {
  return 1 - std::pow(1 - .01, 1 / double(tests));
}

/// Counts of points of the unit square in a grid that expects the same everywhere.
class SquareHistogram {
 public:
  explicit SquareHistogram(int cells) : cells_(cells), count_(size_t(cells) * size_t(cells)) {}
  void add(double u, double v) {
    const auto cell = [this](double x) {
      return size_t(std::clamp(int(x * cells_), 0, cells_ - 1));
    };
    ++count_[cell(v) * size_t(cells_) + cell(u)];
    ++total_;
  }
  double p_value() const {
    return chi2_p_value(count_, std::vector<double>(count_.size(), total_ / double(count_.size())));
  }

 private:
  int cells_;
  std::vector<double> count_;
  double total_ = 0;
};

}  // namespace yat

#pragma once
// Integrals in double precision, for expected values.

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace yat::accuracy {

inline constexpr double kPi = std::numbers::pi;
inline constexpr int kGaussPoints = 16;

/// Gauss and Legendre's rule: nodes in (-1, 1) and weights, exact for degree 2 kGaussPoints - 1.
/// Nodes are the zeros of the Legendre polynomial, by Newton's method.
struct GaussRule {
  std::array<double, kGaussPoints> node{}, weight{};
  GaussRule() {
    constexpr int n = kGaussPoints;
    for (int i = 0; i < n; ++i) {
      double x = std::cos(kPi * (i + .75) / (n + .5)), slope = 1;
      for (int step = 0; step < 50; ++step) {
        double p = 1, before = 0;
        for (int k = 0; k < n; ++k) {
          const double next = ((2 * k + 1) * x * p - k * before) / (k + 1);
          before = p;
          p = next;
        }
        slope = n * (x * p - before) / (x * x - 1);
        x -= p / slope;
      }
      node[size_t(i)] = x;
      weight[size_t(i)] = 2 / ((1 - x * x) * slope * slope);
    }
  }
};
inline const GaussRule& gauss_rule() {
  static const GaussRule rule;
  return rule;
}

/// Integral of f over [a, b], in `panels` equal parts.
template <class F>
double integrate(double a, double b, int panels, const F& f) {
  const GaussRule& rule = gauss_rule();
  const double half = .5 * (b - a) / panels;
  double sum = 0;
  for (int panel = 0; panel < panels; ++panel) {
    const double middle = a + (2 * panel + 1) * half;
    for (size_t i = 0; i < kGaussPoints; ++i)
      sum += rule.weight[i] * f(middle + half * rule.node[i]);
  }
  return sum * half;
}

/// The same over consecutive intervals: `ends` in rising order, where f may have kinks or steps.
template <class F>
double integrate_between(const std::vector<double>& ends, int panels, const F& f) {
  double sum = 0;
  for (size_t i = 1; i < ends.size(); ++i)
    if (ends[i] > ends[i - 1]) sum += integrate(ends[i - 1], ends[i], panels, f);
  return sum;
}

}  // namespace yat::accuracy

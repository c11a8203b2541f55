#include "base/student.h"

#include <cmath>
#include <numbers>

namespace yat {

namespace {

/// The continued fraction of I_x(a, b), which converges fast for x < (a + 1) / (a + b + 2).
double beta_fraction(double x, double a, double b) {
  constexpr double kTiny = 1e-300;
  const auto away_from_zero = [](double v) { return std::abs(v) < kTiny ? kTiny : v; };
  double c = 1, d = 1 / away_from_zero(1 - (a + b) * x / (a + 1)), product = d;
  for (int m = 1; m <= 500; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    d = 1 / away_from_zero(1 + even * d);
    c = away_from_zero(1 + even / c);
    product *= d * c;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1 / away_from_zero(1 + odd * d);
    c = away_from_zero(1 + odd / c);
    product *= d * c;
    if (std::abs(d * c - 1) < 1e-14) break;
  }
  return product;
}

/// Of x = 1 - y.
double log_of(double x, double y) {
  return y < .5 ? std::log1p(-y) : std::log(x);
}

/// What Stirling's formula leaves out of log Gamma(z): relative error 1e-17 from z = 100 on
/// (Abramowitz and Stegun 1964, 6.1.40).
double stirling_rest(double z) {
  const double zz = 1 / (z * z);
  return (1. / 12 - zz * (1. / 360 - zz / 1260)) / z;
}

/// log Gamma(a + b) - log Gamma(a). Of large a both are large and their difference is not.
double log_gamma_ratio(double a, double b) {
  constexpr double kLarge = 100;
  if (a < kLarge) return std::lgamma(a + b) - std::lgamma(a);
  return (a - .5) * std::log1p(b / a) - b + b * std::log(a + b) + stirling_rest(a + b) -
         stirling_rest(a);
}

}  // namespace

double incomplete_beta(double x, double y, double a, double b) {
  if (x <= 0) return 0;
  if (y <= 0) return 1;
  const double gammas =
      a > b ? log_gamma_ratio(a, b) - std::lgamma(b) : log_gamma_ratio(b, a) - std::lgamma(a);
  const double front = std::exp(gammas + a * log_of(x, y) + b * log_of(y, x));
  if (x < (a + 1) / (a + b + 2)) return front * beta_fraction(x, a, b) / a;
  return 1 - front * beta_fraction(y, b, a) / b;
}

// From so many degrees of freedom on the fraction loses more than a normal number made of t does
// (Wallace 1959); from 1e15 on it would be nonsense.
constexpr double kNormal = 1e7;

double student_two_sided(double t, double df) {
  const double tt = t * t;
  if (std::isinf(tt)) return 0;
  if (df > kNormal) {
    const double z = std::sqrt(df * std::log1p(tt / df)) * ((8 * df + 1) / (8 * df + 3));
    return std::erfc(z / std::numbers::sqrt2);
  }
  return incomplete_beta(df / (df + tt), tt / (df + tt), df / 2, .5);
}

}  // namespace yat

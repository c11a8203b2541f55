#include "accuracy/lobes.h"

#include <algorithm>
#include <cmath>

#include "accuracy/quadrature.h"

namespace yat::accuracy {

namespace {

/// What a lobe sees of one facet: cosines to the normal of eye, light and facet, and eye to facet.
struct Facet {
  double o, i, h, oh;
};

/// distribution(cos_h) and masking(Facet) make the lobe. The facet's azimuth is integrated from 0,
/// towards o, to where the reflected direction meets the horizon: cos(phi) = -cot(o) cot(2 h).
template <class D, class G>
double albedo(double c, const D& distribution, const G& masking) {
  const double eye = std::acos(c), sin_o = std::sqrt(1 - c * c);
  const auto ring = [&](double theta) {
    const double h = std::cos(theta), sin_h = std::sin(theta);
    double last = kPi;
    if (sin_o > 0) {
      const double bound = -c / sin_o / std::tan(2 * theta);
      last = bound >= 1 ? 0 : bound <= -1 ? kPi : std::acos(bound);
    }
    const double sum = integrate(0, last, 8, [&](double phi) {
      const double oh = sin_o * sin_h * std::cos(phi) + c * h, i = 2 * oh * h - c;
      return i > 0 ? masking(Facet{c, i, h, oh}) * oh : 0;
    });
    return 2 * sum * distribution(h) * sin_h / c;
  };
  // All azimuths below the first bound, none above the second.
  const double first = kPi / 4 - eye / 2, second = kPi / 4 + eye / 2;
  return integrate_between({0, first, second}, 256, ring);
}

double ggx(double alpha, double h) {
  const double q = h * h * (alpha * alpha - 1) + 1;
  return alpha * alpha / (kPi * q * q);
}

}  // namespace

double ggx_albedo(double alpha, double c) {
  // Lambda(x) = (sqrt(1 + alpha^2 tan^2) - 1) / 2, G = 1 / (1 + Lambda(o) + Lambda(i)).
  const auto lambda = [alpha](double x) {
    return (std::sqrt(1 + alpha * alpha * (1 - x * x) / (x * x)) - 1) / 2;
  };
  return albedo(
      c, [&](double h) { return ggx(alpha, h); },
      [&](const Facet& f) { return 1 / (1 + lambda(f.o) + lambda(f.i)); });
}

double luxrender_albedo(double alpha, double c) {
  const double r = alpha * alpha;
  const auto g = [r](double x) { return x / (x * (1 - r) + r); };
  return albedo(
      c, [&](double h) { return ggx(alpha, h); }, [&](const Facet& f) { return g(f.o) * g(f.i); });
}

double cook_torrance_albedo(double m, double c) {
  return albedo(
      c,
      [m](double h) {
        const double h2 = h * h;
        return std::exp((h2 - 1) / (h2 * m * m)) / (kPi * m * m * h2 * h2);
      },
      [](const Facet& f) { return std::min({1., 2 * f.h * f.o / f.oh, 2 * f.h * f.i / f.oh}); });
}

}  // namespace yat::accuracy

#pragma once
// Reflectances of smooth dielectric interfaces and slabs, unpolarised at every interface, as yat
// (and most renderers) have them. A slab that knows polarisation transmits a little more at
// oblique angles.

#include <cmath>

#include "accuracy/quadrature.h"

namespace yat::accuracy {

/// From outside at cosine c into index n > 1.
inline double fresnel(double n, double c) {
  const double t = std::sqrt(1 - (1 - c * c) / (n * n));
  const double s = (c - n * t) / (c + n * t), p = (n * c - t) / (n * c + t);
  return (s * s + p * p) / 2;
}

struct Slab {
  double reflected = 0, transmitted = 0;
};
/// All reflections between both faces, in which each way across keeps `kept` of the light.
inline Slab slab(double n, double c, double kept = 1) {
  const double r = fresnel(n, c), round = r * kept, t = (1 - r) * (1 - r) * kept;
  return {r + t * round / (1 - round * round), t / (1 - round * round)};
}

/// CIE 171's 6 mm of clear glass: index 1.52, absorbing so much that 87.9 % pass straight on.
struct ClearGlass {
  static constexpr double kIndex = 1.52, kThickness = .006;
  /// What the report has: Mitalas and Arseneault's polynomial, as Tregenza gives it.
  static double curve(double c) {
    return -.028378 +
           c * (3.156075 + c * (-3.058376 + c * (-1.428919 + c * (4.014235 - c * 1.775827))));
  }
  double kept;  ///< by one way straight across
  ClearGlass() {
    // (1 - r)^2 a / (1 - r^2 a^2) = t
    const double r = fresnel(kIndex, 1), t = curve(1), q = (1 - r) * (1 - r);
    kept = (std::sqrt(q * q + 4 * r * r * t * t) - q) / (2 * r * r * t);
  }
  double absorption() const { return -std::log(kept) / kThickness; }  ///< [1/m]
  double transmitted(double c) const {
    const double inside = std::sqrt(1 - (1 - c * c) / (kIndex * kIndex));
    return slab(kIndex, c, std::pow(kept, 1 / inside)).transmitted;
  }
};

/// Of light from a uniform hemisphere outside: 2 integral F(c) c dc.
inline double mean_fresnel(double n) {
  return integrate(0, 1, 64, [n](double c) { return 2 * c * fresnel(n, c); });
}

}  // namespace yat::accuracy

#include "scene/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace yat {

namespace {

constexpr double kFirst = 380, kLast = 720, kStep = 1;

double lobe(double wavelength, double mean, double below, double above) {
  const double t = (wavelength - mean) / (wavelength < mean ? below : above);
  return std::exp(-.5 * t * t);
}

glm::dvec3 observer(double w) {
  return {1.056 * lobe(w, 599.8, 37.9, 31.0) + .362 * lobe(w, 442.0, 16.0, 26.7) -
              .065 * lobe(w, 501.1, 20.4, 26.2),
          .821 * lobe(w, 568.8, 46.9, 40.5) + .286 * lobe(w, 530.9, 16.3, 31.1),
          1.217 * lobe(w, 437.0, 11.8, 36.0) + .681 * lobe(w, 459.0, 26.0, 13.8)};
}

/// CIE standard illuminant D65, every 10 nm from 380.
double daylight(double wavelength) {
  static constexpr double k[] = {49.98,  54.65,  82.75,  91.49,  93.43,  86.68,  104.87,
                                 117.01, 117.81, 114.86, 115.92, 108.81, 109.35, 107.80,
                                 104.79, 107.69, 104.41, 104.05, 100.00, 96.33,  95.79,
                                 88.69,  90.01,  89.60,  87.70,  83.29,  83.70,  80.03,
                                 80.21,  82.28,  78.28,  69.72,  71.61,  74.35,  61.60};
  const double place = std::clamp((wavelength - kFirst) / 10, 0., double(std::size(k) - 1));
  const auto i = std::min(size_t(place), std::size(k) - 2);
  return k[i] + (place - double(i)) * (k[i + 1] - k[i]);
}

glm::dvec3 to_709(const glm::dvec3& xyz) {
  return {3.24097 * xyz.x - 1.53738 * xyz.y - .49861 * xyz.z,
          -.96924 * xyz.x + 1.87597 * xyz.y + .04156 * xyz.z,
          .05563 * xyz.x - .20398 * xyz.y + 1.05697 * xyz.z};
}

glm::dvec3 integrate(const SpectralCurve& curve) {
  glm::dvec3 xyz(0.);
  for (double w = kFirst; w <= kLast; w += kStep) {
    const double end = w == kFirst || w + kStep > kLast ? .5 : 1;
    xyz += end * kStep * curve(w) * observer(w);
  }
  return xyz;
}

}  // namespace

glm::dvec3 rgb_of_reflectance(const SpectralCurve& curve) {
  static const glm::dvec3 white = to_709(integrate(daylight));
  return to_709(integrate([&](double w) { return curve(w) * daylight(w); })) / white;
}

glm::dvec3 rgb_of_light(const SpectralCurve& curve) {
  constexpr double kLumensPerWatt = 683;
  return kLumensPerWatt * to_709(integrate(curve));
}

SpectralCurve blackbody_curve(double temperature) {
  const auto planck = [temperature](double w) {
    constexpr double kSecondConstant = 1.438776877e7;  // h c / k [nm K]
    return std::pow(w / 560, -5) / std::expm1(kSecondConstant / (w * temperature));
  };
  double peak = 0;
  for (double w = kFirst; w <= kLast; w += kStep) peak = std::max(peak, planck(w));
  // Colder than some 30 K, nothing that a double can tell.
  return [planck, peak](double w) { return peak > 0 ? planck(w) / peak : 0.; };
}

}  // namespace yat

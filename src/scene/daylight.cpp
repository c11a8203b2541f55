#include "scene/daylight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/compile_parts.h"

namespace yat {

namespace {

constexpr double kPi = std::numbers::pi;

/// From 380 to 720 nm, every 10 nm: the sun's radiance outside the atmosphere [W/m2/sr/nm], the CIE
/// 1931 observer, and how much ozone and water vapour absorb. Other gases absorb nothing here.
struct Wavelength {
  double sun, x, y, z, ozone, water;
};
// clang-format off
constexpr Wavelength kWavelengths[] = {
    {16559, 0.001368, 3.9e-05, 0.00645, 0.000833333, 0},
    {16233.7, 0.004243, 0.00012, 0.02005, 0.00116667, 0},
    {21127.5, 0.01431, 0.000396, 0.06785, 0.0015, 0},
    {25888.2, 0.04351, 0.00121, 0.2074, 0.00183333, 0},
    {25829.1, 0.13438, 0.004, 0.6456, 0.00216667, 0},
    {24232.3, 0.2839, 0.0116, 1.3856, 0.0025, 0},
    {26760.5, 0.34828, 0.023, 1.74706, 0.00283333, 0},
    {29658.3, 0.3362, 0.038, 1.77211, 0.003, 0},
    {30545.4, 0.2908, 0.06, 1.6692, 0.006, 0},
    {30057.5, 0.19536, 0.09098, 1.28764, 0.009, 0},
    {30663.7, 0.09564, 0.13902, 0.81295, 0.014, 0},
    {28830.4, 0.03201, 0.20802, 0.46518, 0.021, 0},
    {28712.1, 0.0049, 0.323, 0.272, 0.03, 0},
    {27825, 0.0093, 0.503, 0.1582, 0.04, 0},
    {27100.6, 0.06327, 0.71, 0.07825, 0.048, 0},
    {27233.6, 0.1655, 0.862, 0.04216, 0.063, 0},
    {26361.3, 0.2904, 0.954, 0.0203, 0.075, 0},
    {25503.8, 0.43345, 0.99495, 0.00875, 0.085, 0},
    {25060.2, 0.5945, 0.995, 0.0039, 0.103, 0},
    {25311.6, 0.7621, 0.952, 0.0021, 0.12, 0},
    {25355.9, 0.9163, 0.87, 0.00165, 0.12, 0},
    {25134.2, 1.0263, 0.757, 0.0011, 0.115, 0},
    {24631.5, 1.0622, 0.631, 0.0008, 0.125, 0},
    {24173.2, 1.0026, 0.503, 0.00034, 0.12, 0},
    {23685.3, 0.85445, 0.381, 0.00019, 0.105, 0},
    {23212.1, 0.6424, 0.265, 5e-05, 0.09, 0},
    {22827.7, 0.4479, 0.175, 2e-05, 0.079, 0},
    {22339.8, 0.2835, 0.107, 0, 0.067, 0},
    {21970.2, 0.1649, 0.061, 0, 0.057, 0},
    {21526.7, 0.0874, 0.032, 0, 0.048, 0},
    {21097.9, 0.04677, 0.017, 0, 0.036, 0},
    {20728.3, 0.0227, 0.00821, 0, 0.028, 0.016},
    {20240.4, 0.011359, 0.004102, 0, 0.023, 0.024},
    {19870.8, 0.00579, 0.002091, 0, 0.018, 0.0125},
    {19427.2, 0.002899, 0.001047, 0, 0.014, 1},
};
// clang-format on

}  // namespace

glm::dvec3 sun_radiance(double cos_zenith, double turbidity) {
  const double zenith = std::acos(std::clamp(cos_zenith, -1., 1.));
  // Relative optical mass (Kasten 1965), and Angstrom's turbidity.
  const double m = 1 / (cos_zenith + .00094 * std::pow(1.6386 - zenith, -1.253));
  const double beta = .04608365822050 * turbidity - .04586025928522;
  glm::dvec3 xyz(0.);
  double nanometres = 380;
  for (const Wavelength& w : kWavelengths) {
    const double lambda = nanometres / 1000;
    const double depth = .008735 * m * std::pow(lambda, -4.08) + m * beta * std::pow(lambda, -1.3) +
                         .35 * m * w.ozone +
                         .2385 * w.water * 2 * m / std::pow(1 + 20.07 * w.water * 2 * m, .45);
    xyz += w.sun * std::exp(-depth) * glm::dvec3(w.x, w.y, w.z);
    nanometres += 10;
  }
  return xyz_to_rec709(xyz * (683. * 10));
}

std::optional<SkyRow<Value>> make_sky(const SkySettings& settings, const glm::dvec3& sun) {
  const double t = settings.turbidity, s = std::acos(std::clamp(sun.z, -1., 1.));
  // Per luminance, x, y: A, B, C, D, E.
  double c[3][5] = {{.1787 * t - 1.4630, -.3554 * t + .4275, -.0227 * t + 5.3251,
                     .1206 * t - 2.5771, -.0670 * t + .3703},
                    {-.0193 * t - .2592, -.0665 * t + .0008, -.0004 * t + .2125, -.0641 * t - .8989,
                     -.0033 * t + .0452},
                    {-.0167 * t - .2608, -.0950 * t + .0092, -.0079 * t + .2102,
                     -.0441 * t - 1.6537, -.0109 * t + .0529}};
  for (auto& row : c)
    for (size_t i = 0; i < 5; ++i) row[i] *= settings.factor[i];
  const double chi = (4. / 9 - t / 120) * (kPi - 2 * s);
  const double zenith[3] = {1000 * ((4.0453 * t - 4.9710) * std::tan(chi) - .2155 * t + 2.4192),
                            t * t * (.00166 * s * s * s - .00375 * s * s + .00209 * s) +
                                t * (-.02903 * s * s * s + .06377 * s * s - .03202 * s + .00394) +
                                (.11693 * s * s * s - .21196 * s * s + .06052 * s + .25886),
                            t * t * (.00275 * s * s * s - .00610 * s * s + .00317 * s) +
                                t * (-.04214 * s * s * s + .08970 * s * s - .04153 * s + .00516) +
                                (.15346 * s * s * s - .26756 * s * s + .06670 * s + .26688)};
  double scale[3];
  for (int k = 0; k < 3; ++k) {
    const double at_zenith = (1 + c[k][0] * std::exp(c[k][1])) *
                             (1 + c[k][2] * std::exp(c[k][3] * s) + c[k][4] * sun.z * sun.z);
    scale[k] = zenith[k] / at_zenith;
    if (!std::isfinite(scale[k])) return std::nullopt;
  }
  const auto f = [&](int k, int i) { return float(c[k][i]); };
  return SkyRow<Value>{
      f(0, 0),         f(0, 1),         f(0, 2),      f(0, 3),
      f(0, 4),         f(1, 0),         f(1, 1),      f(1, 2),
      f(1, 3),         f(1, 4),         f(2, 0),      f(2, 1),
      f(2, 2),         f(2, 3),         f(2, 4),      float(std::max(scale[0], 0.) * settings.gain),
      float(scale[1]), float(scale[2]), float(sun.x), float(sun.y),
      float(sun.z)};
}

}  // namespace yat

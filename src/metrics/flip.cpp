#include "metrics/flip.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "base/error.h"

namespace yat {
namespace {

constexpr double kPi = std::numbers::pi;

// The paper's constants (2020, section 4).
constexpr double kColourPower = .7;             ///< q_c
constexpr double kFeaturePower = .5;            ///< q_f
constexpr double kKneeIn = .4, kKneeOut = .95;  ///< p_c, p_t
constexpr double kFeatureWidth = .082;          ///< w [degrees]

/// Of linear Rec.709 to XYZ, from the primaries and white of IEC 61966-2-1. Column-major as GLM is.
glm::dmat3 rgb_to_xyz() {
  const auto xyz = [](double x, double y) { return glm::dvec3(x / y, 1, (1 - x - y) / y); };
  const glm::dmat3 primaries(xyz(.64, .33), xyz(.3, .6), xyz(.15, .06));
  const glm::dvec3 scale = glm::inverse(primaries) * xyz(.3127, .329);
  return glm::dmat3(primaries[0] * scale[0], primaries[1] * scale[1], primaries[2] * scale[2]);
}

struct Colours {
  glm::dmat3 to_xyz = rgb_to_xyz();
  glm::dmat3 from_xyz = glm::inverse(to_xyz);
  glm::dvec3 white = to_xyz * glm::dvec3(1);

  /// Opponent space YCxCz, in which the eye's contrast sensitivity is applied.
  glm::dvec3 opponent(const glm::dvec3& rgb) const {
    const glm::dvec3 p = to_xyz * rgb / white;
    return {116 * p.y - 16, 500 * (p.x - p.y), 200 * (p.y - p.z)};
  }
  glm::dvec3 rgb_of_opponent(const glm::dvec3& o) const {
    const double y = (o.x + 16) / 116;
    return from_xyz * (glm::dvec3(o.y / 500 + y, y, y - o.z / 200) * white);
  }
  /// CIELAB, its chroma scaled by lightness (Hunt effect; 2020, equation 5).
  glm::dvec3 perceived(const glm::dvec3& rgb) const {
    const glm::dvec3 p = to_xyz * rgb / white;
    const auto f = [](double t) {
      constexpr double d = 6. / 29;
      return t > d * d * d ? std::cbrt(t) : t / (3 * d * d) + 4. / 29;
    };
    const double light = 116 * f(p.y) - 16;
    return {light, .01 * light * 500 * (f(p.x) - f(p.y)), .01 * light * 200 * (f(p.y) - f(p.z))};
  }
};

double hyab(const glm::dvec3& a, const glm::dvec3& b) {
  return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

using Plane = std::vector<float>;
using Kernel = std::vector<double>;  ///< 2 r + 1 weights

/// Rows by `along_x`, then columns by `along_y`; beyond the border its pixels go on.
Plane filter(const Plane& in, uint32_t width, uint32_t height, const Kernel& along_x,
             const Kernel& along_y) {
  const auto pass = [&](const Plane& from, const Kernel& kernel, int step_x, int step_y) {
    Plane to(from.size());
    const int r = int(kernel.size() / 2), w = int(width), h = int(height);
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        double sum = 0;
        for (int k = -r; k <= r; ++k) {
          const int sx = std::clamp(x + k * step_x, 0, w - 1),
                    sy = std::clamp(y + k * step_y, 0, h - 1);
          sum += kernel[size_t(k + r)] * double(from[size_t(sy) * width + size_t(sx)]);
        }
        to[size_t(y) * width + size_t(x)] = float(sum);
      }
    return to;
  };
  return pass(pass(in, along_x, 1, 0), along_y, 0, 1);
}

/// f at -r..r.
template <class F>
Kernel kernel_of(int r, F&& f) {
  Kernel out;
  for (int k = -r; k <= r; ++k) out.push_back(f(k));
  return out;
}

double sum_of(const Kernel& kernel) {
  double sum = 0;
  for (const double k : kernel) sum += k;
  return sum;
}

/// Contrast sensitivity of one opponent channel as a filter in space: two Gaussians of amplitudes a
/// and squared widths b (2020, table 1), normalised to a sum of 1 together.
struct Sensitivity {
  double a[2], b[2];
};
constexpr std::array<Sensitivity, 3> kSensitivity = {
    {{{1, 0}, {.0047, 1e-5}}, {{1, 0}, {.0053, 1e-5}}, {{34.1, 13.5}, {.04, .025}}}};

Plane blur(const Plane& in, uint32_t width, uint32_t height, const Sensitivity& s, double ppd) {
  constexpr double kWidest = .04;
  const int r = int(std::ceil(3 * std::sqrt(kWidest / (2 * kPi * kPi)) * ppd));
  Plane out(in.size(), 0.f);
  double total = 0;
  Kernel kernels[2];
  double amplitudes[2];
  for (int i = 0; i < 2; ++i) {
    kernels[i] = kernel_of(r, [&](int k) {
      const double x = k / ppd;
      return std::exp(-kPi * kPi * x * x / s.b[i]);
    });
    amplitudes[i] = s.a[i] * std::sqrt(kPi / s.b[i]);
    total += amplitudes[i] * sum_of(kernels[i]) * sum_of(kernels[i]);
  }
  for (int i = 0; i < 2; ++i) {
    if (s.a[i] == 0) continue;
    const Plane part = filter(in, width, height, kernels[i], kernels[i]);
    const auto weight = float(amplitudes[i] / total);
    for (size_t p = 0; p < out.size(); ++p) out[p] += weight * part[p];
  }
  return out;
}

/// Length of the gradient of a plane by a derivative of a Gaussian, `across` in one direction and
/// `smooth` in the other.
Plane gradient(const Plane& in, uint32_t width, uint32_t height, const Kernel& across,
               const Kernel& smooth) {
  const Plane x = filter(in, width, height, across, smooth),
              y = filter(in, width, height, smooth, across);
  Plane out(in.size());
  for (size_t p = 0; p < out.size(); ++p) out[p] = std::hypot(x[p], y[p]);
  return out;
}

/// Positive weights sum up to 1, negative ones to -1.
void normalise_signs(Kernel& kernel) {
  double positive = 0, negative = 0;
  for (const double k : kernel) (k > 0 ? positive : negative) += k;
  for (double& k : kernel) k /= k > 0 ? positive : -negative;
}

/// What FLIP keeps of one picture.
struct Seen {
  std::vector<glm::dvec3> colour;  ///< perceived, after the eye's blur
  Plane edges, points;
};

Seen look(const std::vector<glm::dvec3>& rgb, uint32_t width, uint32_t height, double ppd,
          const Colours& colours) {
  const size_t n = rgb.size();
  std::array<Plane, 3> planes;
  for (Plane& plane : planes) plane.resize(n);
  Plane achromatic(n);
  for (size_t p = 0; p < n; ++p) {
    const glm::dvec3 o = colours.opponent(rgb[p]);
    for (int c = 0; c < 3; ++c) planes[size_t(c)][p] = float(o[c]);
    achromatic[p] = float((o.x + 16) / 116);
  }
  for (size_t c = 0; c < 3; ++c) planes[c] = blur(planes[c], width, height, kSensitivity[c], ppd);
  Seen out;
  out.colour.resize(n);
  for (size_t p = 0; p < n; ++p) {
    const glm::dvec3 o(planes[0][p], planes[1][p], planes[2][p]);
    out.colour[p] = colours.perceived(glm::clamp(colours.rgb_of_opponent(o), 0., 1.));
  }
  const double deviation = .5 * kFeatureWidth * ppd;
  const int r = int(std::ceil(3 * deviation));
  const auto gauss = [&](int k) { return std::exp(-.5 * k * k / (deviation * deviation)); };
  Kernel smooth = kernel_of(r, gauss);
  const double total = sum_of(smooth);
  for (double& k : smooth) k /= total;
  Kernel edge = kernel_of(r, [&](int k) { return -k * gauss(k); });
  Kernel point =
      kernel_of(r, [&](int k) { return (k * k / (deviation * deviation) - 1) * gauss(k); });
  normalise_signs(edge);
  normalise_signs(point);
  out.edges = gradient(achromatic, width, height, edge, smooth);
  out.points = gradient(achromatic, width, height, point, smooth);
  return out;
}

/// FLIP of two pictures of values in 0..1.
std::vector<float> flip_of(const std::vector<glm::dvec3>& picture,
                           const std::vector<glm::dvec3>& reference, uint32_t width,
                           uint32_t height, double ppd) {
  const Colours colours;
  const Seen x = look(picture, width, height, ppd, colours),
             r = look(reference, width, height, ppd, colours);
  const double largest =
      std::pow(hyab(colours.perceived({0, 1, 0}), colours.perceived({0, 0, 1})), kColourPower);
  std::vector<float> out(picture.size());
  for (size_t p = 0; p < out.size(); ++p) {
    const double d = std::pow(hyab(x.colour[p], r.colour[p]), kColourPower);
    const double knee = kKneeIn * largest;
    const double colour =
        d < knee ? d * kKneeOut / knee : kKneeOut + (d - knee) / (largest - knee) * (1 - kKneeOut);
    const double feature = std::max(std::abs(double(x.edges[p]) - double(r.edges[p])),
                                    std::abs(double(x.points[p]) - double(r.points[p])));
    const double seen = std::pow(feature / std::numbers::sqrt2, kFeaturePower);
    // A colour difference of 0 with a feature difference of 1 is 0^0, which is 1.
    out[p] =
        float(std::clamp(std::pow(std::clamp(colour, 0., 1.), 1 - std::min(seen, 1.)), 0., 1.));
  }
  return out;
}

void require(const Image& picture, const Image& reference) {
  if (picture.width != reference.width || picture.height != reference.height)
    throw Error(fmt::format("error: the pictures are {}x{} and {}x{} pixels: give two of one size",
                            picture.width, picture.height, reference.width, reference.height));
  if (reference.pixels() == 0) throw Error("error: the pictures have no pixels");
}

/// The pixels, each channel by f.
template <class F>
std::vector<glm::dvec3> mapped(const Image& image, F&& f) {
  std::vector<glm::dvec3> out(image.pixels());
  for (size_t p = 0; p < out.size(); ++p)
    for (size_t c = 0; c < 3; ++c) {
      const double v = double(image.rgb[3 * p + c]);
      out[p][int(c)] = f(std::isfinite(v) ? std::max(v, 0.) : 0.);
    }
  return out;
}

double mean_of(const std::vector<float>& values) {
  double sum = 0;
  for (const float v : values) sum += double(v);
  return sum / double(values.size());
}

/// (n2 x^2 + n1 x) / (d2 x^2 + d1 x + d0): the ACES curve as fitted by Narkowicz, with the exposure
/// of .6 that brings it to the original.
struct Aces {
  static constexpr double n2 = .36 * 2.51, n1 = .6 * .03, d2 = .36 * 2.43, d1 = .6 * .59, d0 = .14;
  static double tone(double x) {
    return std::clamp((n2 * x * x + n1 * x) / (d2 * x * x + d1 * x + d0), 0., 1.);
  }
  /// The x > 0 whose tone is t.
  static double inverse(double t) {
    const double a = n2 - t * d2, b = n1 - t * d1, c = -t * d0;
    return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
  }
};

}  // namespace

FlipMap flip(const Image& picture, const Image& reference, double pixels_per_degree) {
  require(picture, reference);
  const auto display = [](double v) { return std::min(v, 1.); };
  FlipMap out;
  out.values = flip_of(mapped(picture, display), mapped(reference, display), reference.width,
                       reference.height, pixels_per_degree);
  out.mean = mean_of(out.values);
  return out;
}

FlipMap hdr_flip(const Image& picture, const Image& reference, double pixels_per_degree) {
  require(picture, reference);
  const std::vector<glm::dvec3> light = mapped(reference, [](double v) { return v; });
  std::vector<double> levels;
  const glm::dmat3 to_xyz = rgb_to_xyz();
  for (const glm::dvec3& rgb : light) levels.push_back((to_xyz * rgb).y);
  std::sort(levels.begin(), levels.end());
  FlipMap out;
  if (levels.back() > 0) {
    // In a picture that is half black, the darkest light there is stands for the median.
    double middle = levels[(levels.size() - 1) / 2];
    if (!(middle > 0)) middle = *std::upper_bound(levels.begin(), levels.end(), 0.);
    const double nearly_white = Aces::inverse(.85);
    out.first_stop = std::log2(nearly_white / levels.back());
    out.last_stop = std::log2(nearly_white / middle);
    out.exposures = uint32_t(std::max(2., std::ceil(out.last_stop - out.first_stop)));
  }
  out.values.assign(reference.pixels(), 0.f);
  for (uint32_t i = 0; i < out.exposures; ++i) {
    const double stop = out.exposures < 2 ? 0
                                          : out.first_stop + (out.last_stop - out.first_stop) * i /
                                                                 (out.exposures - 1);
    const double scale = std::exp2(stop);
    const auto shown = [&](double v) { return Aces::tone(v * scale); };
    const std::vector<float> values = flip_of(mapped(picture, shown), mapped(reference, shown),
                                              reference.width, reference.height, pixels_per_degree);
    for (size_t p = 0; p < values.size(); ++p) out.values[p] = std::max(out.values[p], values[p]);
  }
  out.mean = mean_of(out.values);
  return out;
}

}  // namespace yat

#include "accuracy/cie_sky.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <vector>

#include "accuracy/quadrature.h"
#include "film/output.h"

namespace yat::accuracy {

using Vec = glm::dvec3;

namespace {

constexpr double kCoefficients[15][5] = {
    {4, -.7, 0, -1, 0},       {4, -.7, 2, -1.5, .15},  {1.1, -.8, 0, -1, 0},
    {1.1, -.8, 2, -1.5, .15}, {0, -1, 0, -1, 0},       {0, -1, 2, -1.5, .15},
    {0, -1, 5, -2.5, .3},     {0, -1, 10, -3, .45},    {-1, -.55, 2, -1.5, .15},
    {-1, -.55, 5, -2.5, .3},  {-1, -.55, 10, -3, .45}, {-1, -.32, 10, -3, .45},
    {-1, -.32, 16, -3, .3},   {-1, -.15, 16, -3, .3},  {-1, -.15, 24, -2.8, .15}};

Vec direction(double azimuth, double elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

/// Elevations that the block hides in one azimuth from p; lo = hi where it hides none.
struct Hidden {
  double lo = 0, hi = 0;
};
Hidden hidden(const Vec& p, const Block& block, double azimuth) {
  double near = 0, far = 1e300;
  const double d[2] = {std::cos(azimuth), std::sin(azimuth)};
  for (int axis = 0; axis < 2; ++axis) {
    if (d[axis] == 0) {
      if (p[axis] <= block.least[axis] || p[axis] >= block.most[axis]) return {};
      continue;
    }
    const double a = (block.least[axis] - p[axis]) / d[axis],
                 b = (block.most[axis] - p[axis]) / d[axis];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  if (far <= near) return {};
  const double top = block.most.z - p.z;
  return {std::atan2(block.least.z - p.z, near),
          std::max(std::atan2(top, near), std::atan2(top, far))};
}

/// first, last and the azimuths of the block's corners between them: where hidden() has kinks.
std::vector<double> azimuths(const Vec& p, const Block& block, double first, double last) {
  std::vector<double> ends = {first, last};
  for (const double x : {block.least.x, block.most.x})
    for (const double y : {block.least.y, block.most.y}) {
      const double azimuth = std::atan2(y - p.y, x - p.x);
      if (azimuth > first && azimuth < last) ends.push_back(azimuth);
    }
  std::sort(ends.begin(), ends.end());
  return ends;
}

}  // namespace

CieSky::CieSky(int type, const Vec& sun) : sun_(sun) {
  if (type < 1 || type > 15 || sun.z <= 0) throw std::invalid_argument("CieSky: no such sky");
  const double* k = kCoefficients[type - 1];
  a_ = k[0], b_ = k[1], c_ = k[2], d_ = k[3], e_ = k[4];
  // Rings about the zenith, begun at the sun's azimuth and height, where the formula has a cusp.
  const double azimuth = std::atan2(sun.y, sun.x), height = std::asin(sun.z);
  scale_ = 1 / integrate_between({0, height, kPi / 2}, 16, [&](double elevation) {
             return std::sin(elevation) * std::cos(elevation) *
                    integrate(azimuth, azimuth + 2 * kPi, 16, [&](double around) {
                      return relative(direction(around, elevation));
                    });
           });
}

double CieSky::relative(const Vec& d) const {
  const double chi = std::acos(std::clamp(glm::dot(d, sun_), -1., 1.)), cos_chi = std::cos(chi);
  return (1 + a_ * std::exp(b_ / std::max(d.z, 1e-9))) *
         (1 + c_ * (std::exp(d_ * chi) - std::exp(d_ * kPi / 2)) + e_ * cos_chi * cos_chi);
}

double CieSky::luminance(const Vec& d) const {
  return d.z > 0 ? scale_ * relative(d) : kGround / kPi;
}

void CieSky::write(const std::string& path) const {
  const uint32_t width = 2048, height = 1024;
  std::vector<float> rgb;
  rgb.reserve(size_t(width) * height * 3);
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x)
      rgb.insert(rgb.end(), 3,
                 float(luminance(
                     direction(2 * kPi * (x + .5) / width, kPi / 2 - kPi * (y + .5) / height))));
  write_picture(path, rgb, width, height, {}, {});
}

double through_opening(const Vec& p, const Vec& n, const Rectangle& opening,
                       std::vector<double> steps, int panels,
                       const std::function<double(const Vec&)>& radiance) {
  for (double& step : steps) step = std::clamp(step, 0., 1.);
  steps.insert(steps.end(), {0., 1.});
  std::sort(steps.begin(), steps.end());
  const Vec area = glm::cross(opening.u, opening.v);
  return integrate_between(steps, panels, [&](double t) {
    return integrate(0, 1, panels, [&](double s) {
      const Vec way = opening.corner + s * opening.u + t * opening.v - p;
      const double d2 = glm::dot(way, way), d = std::sqrt(d2), cos = glm::dot(way, n) / d;
      if (cos <= 0) return 0.;
      return radiance(way / d) * cos * std::fabs(glm::dot(area, way)) / (d * d2);
    });
  });
}

double upright_irradiance(const CieSky& sky, const Vec& p, const Block& block) {
  // Integral of cos^2 over the elevation.
  const auto ground = [](double lo, double hi) {
    const auto f = [](double e) { return (e + std::sin(e) * std::cos(e)) / 2; };
    return hi > lo ? CieSky::kGround / kPi * (f(hi) - f(lo)) : 0;
  };
  return integrate_between(azimuths(p, block, 0, kPi), 1, [&](double azimuth) {
    const Hidden h = hidden(p, block, azimuth);
    double sum = ground(-kPi / 2, 0) - ground(h.lo, std::min(h.hi, 0.));
    sum += integrate(std::max(h.hi, 0.), kPi / 2, 1, [&](double elevation) {
      const double c = std::cos(elevation);
      return sky.luminance(direction(azimuth, elevation)) * c * c;
    });
    return sum * std::sin(azimuth);
  });
}

double underside_irradiance(const Vec& p, const Block& block) {
  return integrate_between(azimuths(p, block, -kPi, kPi), 2, [&](double azimuth) {
    const Hidden h = hidden(p, block, azimuth);
    const double lo = std::cos(h.lo), hi = std::cos(std::min(h.hi, 0.));
    return CieSky::kGround / kPi * (1 - (hi * hi - lo * lo)) / 2;
  });
}

}  // namespace yat::accuracy

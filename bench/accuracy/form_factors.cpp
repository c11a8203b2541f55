#include "accuracy/form_factors.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace yat::accuracy {

using Vec = glm::dvec3;

double polygon_irradiance(const Vec& p, const Vec& n, const std::vector<Vec>& corners) {
  // The part above the horizon (Sutherland and Hodgman's clipping by one plane).
  std::vector<Vec> above;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Vec a = corners[i] - p, b = corners[(i + 1) % corners.size()] - p;
    const double ha = glm::dot(a, n), hb = glm::dot(b, n);
    if (ha >= 0) above.push_back(a);
    if ((ha > 0 && hb < 0) || (ha < 0 && hb > 0)) above.push_back(a + (b - a) * (ha / (ha - hb)));
  }
  double sum = 0;
  for (size_t i = 0; i < above.size(); ++i) {
    const Vec a = above[i], b = above[(i + 1) % above.size()], across = glm::cross(a, b);
    const double length = glm::length(across);
    if (length > 0) sum += std::atan2(length, glm::dot(a, b)) * glm::dot(across, n) / length;
  }
  return std::fabs(sum) / 2;
}

double rectangle_irradiance(const Vec& p, const Vec& n, const Vec& corner, const Vec& u,
                            const Vec& v) {
  return polygon_irradiance(p, n, {corner, corner + u, corner + u + v, corner + v});
}

double opposite_form_factor(double a, double b, double c) {
  const double x = a / c, y = b / c, x1 = std::sqrt(1 + x * x), y1 = std::sqrt(1 + y * y);
  return 2 / (std::numbers::pi * x * y) *
         (std::log(x1 * y1 / std::sqrt(1 + x * x + y * y)) + x * y1 * std::atan(x / y1) +
          y * x1 * std::atan(y / x1) - x * std::atan(x) - y * std::atan(y));
}

}  // namespace yat::accuracy

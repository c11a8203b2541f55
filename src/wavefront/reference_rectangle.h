#pragma once
// The oracle's rectangle lights (kernels/lights/rectangle.h). Urena, Fajardo, King 2013 as written.

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>

#include "scene/compiled.h"

namespace yat::reference {

/// A rectangle as a receiver sees it, which is the origin.
struct SphericalRectangle {
  glm::dvec3 corner, x, y, z;  ///< p0; unit along b and c, towards the plane
  double x0, x1, y0, y1, z0;   ///< of the corners; z0 < 0 where the light is seen
  double g0, g1, g2, g3;       ///< angles at the corners
  bool sampled;                ///< by solid angle; else by area: lights/rectangle.h decides alike

  SphericalRectangle(const LightRow<Value>& row, const glm::dvec3& receiver) {
    const glm::dvec3 b(row.b_x, row.b_y, row.b_z), c(row.c_x, row.c_y, row.c_z);
    corner = glm::dvec3(row.a_x, row.a_y, row.a_z) - receiver;
    const double size = glm::length(c);
    x = glm::normalize(b);
    y = c / size;
    z = glm::cross(x, y);
    x0 = glm::dot(corner, x), x1 = x0 + glm::length(b);
    y0 = glm::dot(corner, y), y1 = y0 + size;
    z0 = glm::dot(corner, z);
    const glm::dvec3 n0 = glm::normalize(glm::dvec3(0, z0, -y0)),
                     n1 = glm::normalize(glm::dvec3(-z0, 0, x1)),
                     n2 = glm::normalize(glm::dvec3(0, -z0, y1)),
                     n3 = glm::normalize(glm::dvec3(z0, 0, -x0));
    g0 = std::acos(-glm::dot(n0, n1));
    g1 = std::acos(-glm::dot(n1, n2));
    g2 = std::acos(-glm::dot(n2, n3));
    g3 = std::acos(-glm::dot(n3, n0));
    sampled = -z0 >= size / 64 && glm::length(corner + b / 2. + c / 2.) <= 2 * size;
  }
  double solid_angle() const { return g0 + g1 + g2 + g3 - 2 * std::numbers::pi; }
  /// The point at u, v, seen from the receiver.
  glm::dvec3 point(double u, double v) const {
    const double b0 = -y0 / std::hypot(y0, z0), b1 = y1 / std::hypot(y1, z0);
    const double angle = u * solid_angle() + 2 * std::numbers::pi - g2 - g3;
    const double f = (std::cos(angle) * b0 - b1) / std::sin(angle);
    const double cu = std::copysign(1 / std::hypot(f, b0), f);
    const double xu = -cu * z0 / std::sqrt(1 - cu * cu);
    const double d = std::hypot(xu, z0), h0 = y0 / std::hypot(d, y0), h1 = y1 / std::hypot(d, y1);
    const double h = h0 + v * (h1 - h0);
    return xu * x + h * d / std::sqrt(1 - h * h) * y + z0 * z;
  }
};

}  // namespace yat::reference

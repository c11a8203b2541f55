#include "scene/transforms.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace yat {
namespace {

/// Unit vector of any finite vector but 0, however large or small its components; else nothing.
std::optional<glm::dvec3> direction(glm::dvec3 v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0) || !std::isfinite(largest)) return std::nullopt;
  // In two steps: 1 / largest overflows for a subnormal.
  int exponent = 0;
  std::frexp(largest, &exponent);
  for (int i = 0; i < 3; ++i) v[i] = std::ldexp(v[i], -exponent);
  return v / glm::length(v);
}

}  // namespace

Matrix translation(double x, double y, double z) {
  Matrix m(1.0);
  m[3] = glm::dvec4(x, y, z, 1);
  return m;
}

Matrix scaling(double x, double y, double z) {
  Matrix m(1.0);
  m[0][0] = x;
  m[1][1] = y;
  m[2][2] = z;
  return m;
}

std::optional<Matrix> rotation(double degrees, double x, double y, double z) {
  const std::optional<glm::dvec3> unit = direction({x, y, z});
  if (!unit) return std::nullopt;
  const glm::dvec3 a = *unit;
  const double radians = std::fmod(degrees, 360.0) * (std::numbers::pi / 180);
  const double s = std::sin(radians), c = std::cos(radians);
  Matrix m(1.0);
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      m[column][row] = a[row] * a[column] * (1 - c) + (row == column ? c : 0.0);
  m[0][1] += a.z * s;
  m[1][0] -= a.z * s;
  m[2][0] += a.y * s;
  m[0][2] -= a.y * s;
  m[1][2] += a.x * s;
  m[2][1] -= a.x * s;
  return m;
}

std::optional<Matrix> yart_rotation(double degrees, double x, double y, double z) {
  const double axis[3] = {x, y, z};
  std::optional<Matrix> turned;
  for (int k = 0; k < 3; ++k) {
    if (!(std::abs(std::trunc(axis[k])) >= 1)) continue;
    const Matrix turn = *rotation(degrees, k == 0, k == 1, k == 2);
    turned = turned ? turn * *turned : turn;
  }
  return turned;
}

LookAtResult look_at(std::span<const double, 9> n) {
  LookAtResult result;
  const glm::dvec3 eye(n[0], n[1], n[2]), look(n[3], n[4], n[5]), up(n[6], n[7], n[8]);
  glm::dvec3 d(0, 0, 1);
  if (const auto forward = direction(look - eye))
    d = *forward;
  else
    result.trouble = "the eye and the point looked at are the same, looking along +z";

  const std::optional<glm::dvec3> up_unit = direction(up);
  // Both are unit vectors: below this, rounding decides where "right" is.
  constexpr double kParallel = 1e-10;
  glm::dvec3 r = up_unit ? glm::cross(d, *up_unit) : glm::dvec3(0);
  if (glm::length(r) < kParallel) {
    // The axis that is farthest from the viewing direction; +z and +y come first.
    glm::dvec3 other(0, 0, 1);
    if (std::abs(d.y) < std::abs(d.z)) other = glm::dvec3(0, 1, 0);
    r = glm::cross(d, other);
    if (result.trouble.empty())
      result.trouble = up_unit ? "up is parallel to the viewing direction, another up is used"
                               : "up has no direction, another up is used";
  }
  r = glm::normalize(r);
  const glm::dvec3 u = glm::cross(r, d);
  // Inverse of the matrix with columns r, u, d, eye: its rotation is orthonormal.
  Matrix m(1.0);
  for (int i = 0; i < 3; ++i) {
    m[i][0] = r[i];
    m[i][1] = u[i];
    m[i][2] = d[i];
  }
  m[3] = glm::dvec4(-glm::dot(r, eye), -glm::dot(u, eye), -glm::dot(d, eye), 1);
  result.world_to_camera = m;
  return result;
}

Matrix from_columns(std::span<const double, 16> numbers) {
  Matrix m;
  for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = numbers[size_t(i)];
  return m;
}

bool is_finite(const Matrix& matrix) {
  for (int i = 0; i < 16; ++i)
    if (!std::isfinite(matrix[i / 4][i % 4])) return false;
  return true;
}

}  // namespace yat

#include "scene/analytic_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "scene/compile_parts.h"
#include "scene/tree_parts.h"

namespace yat {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kUlp = 0x1p-24;

/// The end of a range of angles as ShapeRow has it.
void set_sweep(double angle, float& cos, float& sin) {
  cos = float(std::cos(angle));
  sin = float(std::sin(angle));
  // A whole turn is more than half a one; half a turn is not.
  if (angle >= kTurn) cos = 1, sin = -1e-30f;
  if (angle <= kTurn / 2) sin = std::max(sin, 0.f);
}

glm::dmat3 absolute(const glm::dmat3& m) {
  return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])};
}

glm::dmat3 own_to_world(const AnalyticShape& shape, const Placement& placement) {
  return {placement.linear[0] * shape.scale.x, placement.linear[1] * shape.scale.y,
          placement.linear[2] * shape.scale.z};
}

/// The maps of a row: from the scene as stored, and its inverse, exact here.
struct Maps {
  glm::dmat3 to_own, to_scene;
};
Maps maps_of(const AnalyticShape& shape, const Placement& placement) {
  const glm::dmat3 inverse = glm::inverse(own_to_world(shape, placement));
  Maps maps;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) maps.to_own[i][j] = double(float(inverse[i][j]));
  maps.to_scene = glm::inverse(maps.to_own);
  return maps;
}

bool whole_sphere(const AnalyticShape& shape) {
  return shape.kind == ShapeKind::kQuadric && shape.s != 0 && shape.closed_first &&
         shape.closed_last;
}

/// Bounds of all points a linear map makes of the shape.
TopBox mapped_bounds(const AnalyticShape& shape, const glm::dmat3& map) {
  TopBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const double x = map[0][axis], y = map[1][axis], z = map[2][axis];
    // All shapes are within radius 1 of their axis.
    const double around = std::hypot(x, y);
    box.min[axis] = std::min(z * shape.z_first, z * shape.z_last) - around;
    box.max[axis] = std::max(z * shape.z_first, z * shape.z_last) + around;
    if (whole_sphere(shape)) {
      box.max[axis] = std::hypot(x, y, z);
      box.min[axis] = -box.max[axis];
    }
  }
  return box;
}

void add_place(TopBox& box, const glm::dvec3& at, double grow_x, double grow_y, double grow_z) {
  const double grow[3] = {grow_x, grow_y, grow_z};
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] += at[axis] - grow[axis];
    box.max[axis] += at[axis] + grow[axis];
  }
}

double largest(const TopBox& box) {
  double extent = 0;
  for (int axis = 0; axis < 3; ++axis)
    extent = std::max({extent, std::abs(box.min[axis]), std::abs(box.max[axis])});
  return extent;
}

/// Gauss, Legendre with eight points on [-1, 1].
constexpr std::array<std::pair<double, double>, 4> kGauss = {
    {{.1834346424956498, .3626837833783620},
     {.5255324099163290, .3137066458778873},
     {.7966664774136267, .2223810344533745},
     {.9602898564975363, .1012285362903763}}};

template <class F>
double integral(double from, double to, const F& f) {
  constexpr int kPanels = 32;
  double sum = 0;
  for (int panel = 0; panel < kPanels; ++panel) {
    const double half = (to - from) / (2 * kPanels), middle = from + (2 * panel + 1) * half;
    for (const auto& [x, weight] : kGauss)
      sum += weight * half * (f(middle - x * half) + f(middle + x * half));
  }
  return sum;
}

}  // namespace

AnalyticShape make_sphere(double radius, double z_min, double z_max, double phi_max) {
  AnalyticShape shape;
  shape.scale = glm::dvec3(radius);
  shape.a = 1;
  shape.s = -1;
  shape.z_first = std::max(z_min / radius, -1.);
  shape.z_last = std::min(z_max / radius, 1.);
  shape.closed_first = z_min <= -radius;
  shape.closed_last = z_max >= radius;
  shape.phi_max = phi_max;
  // By the angle from +z, in turns.
  const double theta0 = std::acos(shape.z_first) / kTurn, theta1 = std::acos(shape.z_last) / kTurn;
  shape.v_scale = 1 / (theta1 - theta0);
  shape.v_offset = -theta0 / (theta1 - theta0);
  return shape;
}

AnalyticShape make_disk(double radius, double inner, double height, double phi_max) {
  AnalyticShape shape;
  shape.kind = ShapeKind::kDisk;
  shape.scale = glm::dvec3(radius);
  shape.shift = height;
  const double hole = inner / radius;
  shape.a = hole * hole;
  shape.phi_max = phi_max;
  shape.v_scale = -1 / (1 - hole);
  shape.v_offset = 1 / (1 - hole);
  return shape;
}

AnalyticShape make_cylinder(double radius, double z_min, double z_max, double phi_max) {
  return make_hyperboloid({radius, 0, z_min}, {radius, 0, z_max}, phi_max);
}

AnalyticShape make_cone(double radius, double radius2, double height, double phi_max) {
  AnalyticShape shape = make_hyperboloid({radius, 0, 0}, {radius2, 0, height}, phi_max);
  shape.inward = false;  // also where it stands on its head
  return shape;
}

AnalyticShape make_paraboloid(double radius, double z_min, double z_max, double phi_max) {
  AnalyticShape shape;
  shape.scale = {radius, radius, z_max};
  shape.shift = z_max;
  shape.a = shape.e = 1;
  shape.z_first = z_min / z_max - 1;
  shape.z_last = 0;
  shape.closed_first = z_min == 0;
  shape.phi_max = phi_max;
  shape.v_scale = -1 / shape.z_first;
  shape.v_offset = 1;
  return shape;
}

AnalyticShape make_hyperboloid(const glm::dvec3& p1, const glm::dvec3& p2, double phi_max) {
  AnalyticShape shape;
  const double widest = std::max(std::hypot(p1.x, p1.y), std::hypot(p2.x, p2.y));
  const glm::dvec3 middle = .5 * (p1 + p2), half = .5 * (p2 - p1);
  shape.scale = {widest, widest, half.z};
  shape.shift = middle.z;
  shape.a = middle.x / widest, shape.b = half.x / widest;
  shape.c = middle.y / widest, shape.d = half.y / widest;
  shape.z_first = -1;
  shape.z_last = 1;
  shape.phi_max = phi_max;
  shape.v_scale = shape.v_offset = .5;
  // dp/du x dp/dv points to the axis where the line goes down.
  shape.inward = half.z < 0;
  return shape;
}

AnalyticShape make_torus(double major, double minor, double theta_min, double theta_sweep,
                         double phi_max) {
  AnalyticShape shape;
  shape.kind = ShapeKind::kTorus;
  const double widest = major + minor;
  shape.scale = glm::dvec3(widest);
  shape.a = major / widest;
  shape.b = minor / widest;
  shape.c = theta_min;
  shape.d = theta_sweep;
  shape.z_first = -shape.b;
  shape.z_last = shape.b;
  shape.phi_max = phi_max;
  shape.v_scale = kTurn / theta_sweep;
  return shape;
}

double area_of(const AnalyticShape& shape, const glm::dmat3& linear) {
  Placement placement;
  placement.linear = linear;
  const glm::dmat3 map = own_to_world(shape, placement);
  // Area vectors go by the cofactors.
  const glm::dmat3 cofactors(glm::cross(map[1], map[2]), glm::cross(map[2], map[0]),
                             glm::cross(map[0], map[1]));
  const auto around = [&](double phi0) {
    // dA = normal * (area per d phi and per step of the profile), own space.
    const glm::dvec3 out(std::cos(phi0), std::sin(phi0), 0), up(0, 0, 1);
    if (shape.kind == ShapeKind::kDisk) return (1 - shape.a) / 2 * glm::length(cofactors * up);
    if (shape.kind == ShapeKind::kTorus)
      return integral(shape.c, shape.c + shape.d, [&](double theta) {
        return shape.b * (shape.a + shape.b * std::cos(theta)) *
               glm::length(cofactors * (std::cos(theta) * out + std::sin(theta) * up));
      });
    return integral(shape.z_first, shape.z_last, [&](double z) {
      const double x = shape.a + shape.b * z, y = shape.c + shape.d * z;
      const double rho2 = x * x + y * y + z * (shape.e + shape.s * z);
      const double slope = x * shape.b + y * shape.d + .5 * shape.e + shape.s * z;
      const double from = std::atan2(y, x);  // phi is counted from the line that goes round
      const glm::dvec3 there(std::cos(from + phi0), std::sin(from + phi0), 0);
      return glm::length(cofactors * (std::sqrt(std::max(rho2, 0.)) * there - slope * up));
    });
  };
  constexpr int kSteps = 64;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) sum += around((i + .5) / kSteps * shape.phi_max);
  return sum * shape.phi_max / kSteps;
}

TopBox bounds_of(const AnalyticShape& shape, const Placement& placement) {
  TopBox box = mapped_bounds(shape, own_to_world(shape, placement));
  add_place(box, placement.point(shape.origin()), 0, 0, 0);
  return box;
}

TopBox traced_bounds(const AnalyticShape& shape, const Placement& placement,
                     const glm::dvec3& center) {
  const Maps maps = maps_of(shape, placement);
  TopBox box = mapped_bounds(shape, maps.to_scene);
  const glm::dvec3 at(glm::vec3(placement.point(shape.origin()) - center));
  add_place(box, at, 0, 0, 0);
  // As for instances (compile_objects.cpp): the way there and through the maps.
  const glm::dvec3 grow =
      64 * kUlp * largest(box) * (absolute(maps.to_scene) * absolute(maps.to_own) * glm::dvec3(1.));
  add_place(box, glm::dvec3(0.), grow.x, grow.y, grow.z);
  return box;
}

ShapeRow<Value> shape_row(const AnalyticShape& shape, const Placement& placement,
                          bool reverse_orientation, const glm::dvec3& center) {
  ShapeRow<Value> row{};
  const Maps maps = maps_of(shape, placement);
  // Nine fields in a row; glm matrices are columns first.
  const auto set = [](const glm::dmat3& m, float* first) {
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) first[3 * r + c] = float(m[c][r]);
  };
  set(maps.to_own, &row.o_xx);
  set(maps.to_scene, &row.w_xx);
  const glm::vec3 org(placement.point(shape.origin()) - center);
  row.org_x = org.x, row.org_y = org.y, row.org_z = org.z;

  TopBox box = mapped_bounds(shape, maps.to_scene);
  add_place(box, glm::dvec3(org), 0, 0, 0);
  const double extent = largest(box), top = std::max(std::abs(shape.z_first), shape.z_last);
  double radius = 0;
  for (int k = 0; k < 4; ++k)
    radius = std::max(radius,
                      glm::length(maps.to_scene * glm::dvec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, top)));
  if (placement.scale && shape.scale.x == shape.scale.y &&
      std::abs(shape.scale.z) == shape.scale.x)  // round: a sphere of it is known better
    radius = std::min(radius, *placement.scale * shape.scale.x *
                                  (whole_sphere(shape) || shape.kind != ShapeKind::kQuadric
                                       ? 1.001
                                       : std::hypot(1., top)));
  row.radius = tree::round_up(1.01 * radius + 16 * kUlp * extent);
  row.extent = tree::round_up(extent);
  const glm::dvec3 half(1, 1, top);
  const glm::dvec3 there_and_back = absolute(maps.to_own) * (absolute(maps.to_scene) * half);
  const double size = std::max(1., top);
  row.inner_x = tree::round_up(std::max(size, there_and_back.x));
  row.inner_y = tree::round_up(std::max(size, there_and_back.y));
  row.inner_z = tree::round_up(std::max(size, there_and_back.z));
  row.stretch = float(std::cbrt(std::abs(glm::determinant(maps.to_scene))));

  row.a = float(shape.a), row.b = float(shape.b), row.c = float(shape.c), row.d = float(shape.d);
  row.e = float(shape.e), row.s = float(shape.s);
  if (shape.kind == ShapeKind::kTorus) {
    row.c = float(std::cos(shape.c)), row.d = float(std::sin(shape.c));
    set_sweep(shape.d, row.e, row.s);
  }
  row.z_first = float(shape.z_first), row.z_last = float(shape.z_last);
  row.z_min = shape.closed_first ? -2.f : row.z_first;
  row.z_max = shape.closed_last ? 2.f : row.z_last;
  set_sweep(shape.phi_max, row.phi_cos, row.phi_sin);
  row.kind = uint32_t(shape.kind);
  row.u_scale = float(kTurn / shape.phi_max);
  row.v_scale = float(shape.v_scale), row.v_offset = float(shape.v_offset);
  row.inward = shape.inward != reverse_orientation;
  row.light = kNone;
  return row;
}

}  // namespace yat

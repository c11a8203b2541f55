#include "wavefront/reference_shapes.h"

#include <algorithm>
#include <cmath>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>
#include <vector>

namespace yat::reference {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// An angle in [0, 2 pi).
double angle(double x, double y) {
  const double a = std::atan2(y, x);
  return a < 0 ? a + kTurn : a;
}

struct Shape {
  ShapeRow<Value> row;
  ShapeKind kind;
  glm::dmat3 to_own, to_scene;
  Vec org;
  double a, b, c, d, e, s, phi_max;

  explicit Shape(const ShapeRow<Value>& r)
      : row(r),
        kind(ShapeKind(r.kind)),
        to_own(Vec(r.o_xx, r.o_yx, r.o_zx), Vec(r.o_xy, r.o_yy, r.o_zy),
               Vec(r.o_xz, r.o_yz, r.o_zz)),
        to_scene(glm::inverse(to_own)),
        org(r.org_x, r.org_y, r.org_z),
        a(r.a),
        b(r.b),
        c(r.c),
        d(r.d),
        e(r.e),
        s(r.s),
        phi_max(kTurn / double(r.u_scale)) {}

  Vec own(const Vec& scene) const { return to_own * (scene - org); }
  double theta_sweep() const { return kTurn / double(row.v_scale); }
  glm::dvec2 line(double z) const { return {a + b * z, c + d * z}; }
  double phi(const Vec& p) const {
    if (kind != ShapeKind::kQuadric) return angle(p.x, p.y);
    const glm::dvec2 g = line(p.z);
    return angle(g.x * p.x + g.y * p.y, g.x * p.y - g.y * p.x);
  }
  /// The angle in the tube, from where it begins.
  double theta(const Vec& p) const {
    const double t = angle(std::hypot(p.x, p.y) - a, p.z) - angle(c, d);
    return t < 0 ? t + kTurn : t;
  }
  bool is_on(const Vec& p) const {
    if (kind == ShapeKind::kQuadric && !(p.z >= double(row.z_min) && p.z <= double(row.z_max)))
      return false;
    if (kind == ShapeKind::kDisk && !(p.x * p.x + p.y * p.y >= a && p.x * p.x + p.y * p.y <= 1))
      return false;
    if (kind == ShapeKind::kTorus && theta(p) > theta_sweep()) return false;
    return phi(p) <= phi_max;
  }
  /// Unit, own space, on the usual outside.
  Vec normal(const Vec& p) const {
    if (kind == ShapeKind::kDisk) return {0, 0, 1};
    if (kind == ShapeKind::kTorus) {
      const double rho = std::hypot(p.x, p.y);
      return glm::normalize(p - Vec(p.x, p.y, 0) * (a / rho));
    }
    const glm::dvec2 g = line(p.z);
    return glm::normalize(Vec(p.x, p.y, -(g.x * b + g.y * d + e / 2 + s * p.z)));
  }
  /// Area per height and radian of a ring of a quadric: its radius times the length of its profile.
  double ring(double z) const {
    const glm::dvec2 g = line(z);
    const double squared = std::fmax(g.x * g.x + g.y * g.y + e * z + s * z * z, 0);
    const double half_slope = g.x * b + g.y * d + e / 2 + s * z;  // of the squared radius
    return std::sqrt(squared + half_slope * half_slope);
  }
  double own_inverse_density(const Vec& p) const {
    switch (kind) {
      case ShapeKind::kDisk:
        return phi_max * (1 - a) / 2;
      case ShapeKind::kTorus:
        return phi_max * theta_sweep() * b * std::hypot(p.x, p.y);
      default: {
        const auto z0 = double(row.z_first), z1 = double(row.z_last);
        const double place = std::clamp((p.z - z0) / (z1 - z0), 0.0, 1.0);
        const double linear = (1 - place) * ring(z0) + place * ring(z1);
        const double ratio = linear > 0 ? ring(p.z) / linear : 1;
        return phi_max * (z1 - z0) * (ring(z0) + ring(z1)) / 2 * ratio;
      }
    }
  }
  Vec scene_normal(const Vec& n) const { return glm::transpose(to_own) * n; }
};

double value_at(const std::vector<double>& polynomial, double t) {
  double sum = 0;
  for (size_t i = polynomial.size(); i-- > 0;) sum = sum * t + polynomial[i];
  return sum;
}

/// Real roots within (-reach, reach), ascending: between neighbouring roots of the derivative the
/// polynomial is monotone. Coefficients from the constant term up.
std::vector<double> roots(const std::vector<double>& polynomial, double reach) {
  if (polynomial.size() < 2) return {};
  std::vector<double> derivative;
  for (size_t i = 1; i < polynomial.size(); ++i) derivative.push_back(double(i) * polynomial[i]);
  std::vector<double> cuts = {-reach};
  for (const double cut : roots(derivative, reach)) cuts.push_back(cut);
  cuts.push_back(reach);
  std::vector<double> found;
  for (size_t i = 0; i + 1 < cuts.size(); ++i) {
    double low = cuts[i], high = cuts[i + 1];
    const bool rising = value_at(polynomial, high) > 0;
    if (rising == (value_at(polynomial, low) > 0)) continue;
    for (int step = 0; step < 200 && low < high; ++step) {
      const double middle = .5 * (low + high);
      if (middle == low || middle == high) break;
      ((value_at(polynomial, middle) > 0) == rising ? high : low) = middle;
    }
    found.push_back(.5 * (low + high));
  }
  return found;
}

/// Parameters from the origin on at which the line meets the whole surface, ascending.
std::vector<double> crossings(const Shape& shape, const Vec& p, const Vec& d) {
  if (shape.kind == ShapeKind::kDisk) return {-p.z / d.z};
  if (shape.kind == ShapeKind::kQuadric) {
    const glm::dvec2 g = shape.line(p.z), slope = d.z * glm::dvec2(shape.b, shape.d);
    const double a = d.x * d.x + d.y * d.y - glm::dot(slope, slope) - shape.s * d.z * d.z;
    const double b =
        p.x * d.x + p.y * d.y - glm::dot(g, slope) - d.z * (shape.e / 2 + shape.s * p.z);
    const double c = p.x * p.x + p.y * p.y - glm::dot(g, g) - p.z * (shape.e + shape.s * p.z);
    const double discriminant = b * b - a * c;
    if (discriminant < 0) return {};
    const double q = -(b + std::copysign(std::sqrt(discriminant), b));
    std::vector<double> t = {c / q, q / a};
    if (!(t[0] <= t[1])) std::swap(t[0], t[1]);
    return t;
  }
  // (|x|^2 + R^2 - r^2)^2 = 4 R^2 (x^2 + y^2), about the point nearest to the centre.
  const double length = glm::length(d), middle = -glm::dot(p, d) / (length * length);
  const Vec m = p + middle * d, w = d / length;
  const double k = glm::dot(m, m) + shape.a * shape.a - shape.b * shape.b;
  const double four = 4 * shape.a * shape.a;
  const std::vector<double> quartic = {k * k - four * (m.x * m.x + m.y * m.y),
                                       -2 * four * (m.x * w.x + m.y * w.y),
                                       2 * k - four * (w.x * w.x + w.y * w.y), 0, 1};
  std::vector<double> t = roots(quartic, 2);
  for (double& at : t) at = middle + at / length;
  return t;
}

}  // namespace

double meet(const ShapeRow<Value>& row, const Vec& origin, const Vec& direction) {
  const Shape shape(row);
  const Vec p = shape.own(origin), d = shape.to_own * direction;
  for (const double t : crossings(shape, p, d))
    if (t > 0 && std::isfinite(t) && shape.is_on(p + t * d)) return t;
  return kInfinity;
}

Point shape_point(const ShapeRow<Value>& row, const RaySegment& ray, double t) {
  const Shape shape(row);
  Point point{};
  point.t = t;
  point.position = ray.origin + t * ray.direction;
  const Vec n = glm::normalize(shape.scene_normal(shape.normal(shape.own(point.position))));
  point.ng = point.ns = row.inward ? -n : n;
  // The quartic's roots are known to less than others.
  point.offset = (shape.kind == ShapeKind::kTorus ? 1e-8 : 1e-11) * double(row.extent);
  point.parameter = row.parameter;
  point.light = row.light;
  set_texture_axes(point, double(row.radius), [&row](const Vec& p) { return shape_uv(row, p); });
  return point;
}

void set_texture_axes(Point& point, double size,
                      const std::function<glm::dvec2(const Vec&)>& coordinates) {
  const glm::dvec2 here = coordinates(point.position);
  point.u = here.x;
  point.v = here.y;
  const Axes frame(point.ng);
  const double step = 1e-5 * size;
  const auto slope = [&](const Vec& along) {
    glm::dvec2 d =
        coordinates(point.position + step * along) - coordinates(point.position - step * along);
    for (int k = 0; k < 2; ++k)
      if (std::fabs(d[k]) > .5) d[k] -= std::copysign(1.0, d[k]);
    return d / (2 * step);
  };
  // Columns: what u and v change by along x and y.
  const glm::dmat2 change(slope(frame.x), slope(frame.y));
  if (glm::determinant(change) == 0) return;
  const glm::dmat2 back = glm::inverse(change);
  point.along = point.du = back[0][0] * frame.x + back[0][1] * frame.y;
  point.dv = back[1][0] * frame.x + back[1][1] * frame.y;
}

ShapeSamplePoint sample_shape(const ShapeRow<Value>& row, double u, double v) {
  const Shape shape(row);
  const double phi = u * shape.phi_max;
  const auto around = [phi](double x, double y, double z) {
    return Vec(x * std::cos(phi) - y * std::sin(phi), x * std::sin(phi) + y * std::cos(phi), z);
  };
  Vec p;
  if (shape.kind == ShapeKind::kDisk) {
    p = around(std::sqrt(shape.a + v * (1 - shape.a)), 0, 0);
  } else if (shape.kind == ShapeKind::kTorus) {
    const double theta = angle(shape.c, shape.d) + v * shape.theta_sweep();
    p = around(shape.a + shape.b * std::cos(theta), 0, shape.b * std::sin(theta));
  } else {
    // Invert the integral of a density linear from w0 to w1.
    const auto z0 = double(row.z_first), z1 = double(row.z_last);
    const double w0 = shape.ring(z0), w1 = shape.ring(z1);
    const double place =
        v > 0 ? v * (w0 + w1) / (w0 + std::sqrt(w0 * w0 + v * (w1 * w1 - w0 * w0))) : 0;
    const double z = z0 + place * (z1 - z0);
    const glm::dvec2 g = shape.line(z);
    const double curve = std::sqrt(std::fmax(0, 1 + z * (shape.e + shape.s * z)));
    p = around(curve * g.x, curve * g.y, z);
  }
  const Vec outside = shape.scene_normal(shape.normal(p));
  ShapeSamplePoint sample{};
  sample.position = shape.to_scene * p + shape.org;
  sample.normal = glm::normalize(outside) * (row.inward ? -1.0 : 1.0);
  sample.offset = (shape.kind == ShapeKind::kTorus ? 1e-8 : 1e-11) * double(row.extent);
  sample.inverse_density = shape.own_inverse_density(p) *
                           std::fabs(glm::determinant(shape.to_scene)) * glm::length(outside);
  return sample;
}

double inverse_density(const ShapeRow<Value>& row, const Vec& position) {
  const Shape shape(row);
  const Vec p = shape.own(position);
  return shape.own_inverse_density(p) * std::fabs(glm::determinant(shape.to_scene)) *
         glm::length(shape.scene_normal(shape.normal(p)));
}

glm::dvec2 shape_uv(const ShapeRow<Value>& row, const Vec& position) {
  const Shape shape(row);
  const Vec p = shape.own(position);
  const auto scale = double(row.v_scale), offset = double(row.v_offset);
  double along = p.z;
  if (shape.kind == ShapeKind::kDisk) along = std::hypot(p.x, p.y);
  if (shape.kind == ShapeKind::kTorus) along = shape.theta(p) / kTurn;
  if (shape.kind == ShapeKind::kQuadric && shape.s != 0)
    along = std::atan2(std::hypot(p.x, p.y), p.z) / kTurn;
  return {shape.phi(p) / shape.phi_max, along * scale + offset};
}

}  // namespace yat::reference

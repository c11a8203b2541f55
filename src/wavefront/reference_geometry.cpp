#include <cmath>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>

#include "wavefront/reference_shapes.h"

namespace yat::reference {

namespace {

/// Rounding of a double, with room for a chain of operations.
constexpr double kRounding = 1e-12;

double largest(const Vec& v) {
  return std::fmax(std::fabs(v.x), std::fmax(std::fabs(v.y), std::fabs(v.z)));
}

struct Triangle {
  Vec p0, e1, e2;
  explicit Triangle(const TriangleRow<Value>& t)
      : p0(t.p0_x, t.p0_y, t.p0_z),
        e1(Vec(t.p1_x, t.p1_y, t.p1_z) - p0),
        e2(Vec(t.p2_x, t.p2_y, t.p2_z) - p0) {}
};

struct TriangleHit {
  double t, u, v;
};

/// Moeller, Trumbore 1997.
std::optional<TriangleHit> meet(const Triangle& triangle, const Vec& origin, const Vec& direction) {
  const Vec p = glm::cross(direction, triangle.e2);
  const double determinant = glm::dot(triangle.e1, p);
  if (determinant == 0) return {};
  const Vec to_origin = origin - triangle.p0;
  const double u = glm::dot(to_origin, p) / determinant;
  const Vec q = glm::cross(to_origin, triangle.e1);
  const double v = glm::dot(direction, q) / determinant;
  // Neighbours overlap by a rounding error, so that no ray passes between them.
  if (!(u >= -kRounding && v >= -kRounding && u + v <= 1 + kRounding)) return {};
  return TriangleHit{glm::dot(triangle.e2, q) / determinant, u, v};
}

/// Smallest distance > 0 to a sphere, or infinity.
double meet(const SphereRow<Value>& sphere, const Vec& origin, const Vec& direction) {
  const Vec way = origin - Vec(sphere.center_x, sphere.center_y, sphere.center_z);
  const double radius = double(sphere.radius);
  const double a = glm::dot(direction, direction), b = glm::dot(way, direction);
  const double discriminant = b * b - a * (glm::dot(way, way) - radius * radius);
  if (discriminant < 0) return std::numeric_limits<double>::infinity();
  const double root = std::sqrt(discriminant);
  const double near = (-b - root) / a, far = (-b + root) / a;
  return near > 0 ? near : far > 0 ? far : std::numeric_limits<double>::infinity();
}

double meet(const PlaneRow<Value>& plane, const Vec& origin, const Vec& direction) {
  const Vec normal(plane.normal_x, plane.normal_y, plane.normal_z);
  return (double(plane.distance) - glm::dot(normal, origin)) / glm::dot(normal, direction);
}

/// u, v and the derivatives of the position by them: what solves e1 = u1 du + v1 dv, e2 likewise.
void set_texture_coordinates(const TriangleVertexRow<Value>& n, const TriangleHit& hit,
                             const Triangle& triangle, Point& point) {
  const double b0 = 1 - hit.u - hit.v;
  point.u = b0 * double(n.u0) + hit.u * double(n.u1) + hit.v * double(n.u2);
  point.v = b0 * double(n.v0) + hit.u * double(n.v1) + hit.v * double(n.v2);
  const glm::dmat2 uv(glm::dvec2(n.u1, n.v1) - glm::dvec2(n.u0, n.v0),
                      glm::dvec2(n.u2, n.v2) - glm::dvec2(n.u0, n.v0));
  if (glm::determinant(uv) == 0) return;
  const glm::dmat2 back = glm::inverse(uv);
  point.along = point.du = back[0][0] * triangle.e1 + back[0][1] * triangle.e2;
  point.dv = back[1][0] * triangle.e1 + back[1][1] * triangle.e2;
}

Point triangle_point(const Scene& scene, uint32_t prim, const TriangleHit& hit) {
  const TriangleRow<Value> row = scene.triangles.row(prim);
  const Triangle triangle(row);
  Point point{};
  point.t = hit.t;
  point.position = triangle.p0 + hit.u * triangle.e1 + hit.v * triangle.e2;
  point.ng = point.ns = glm::normalize(glm::cross(triangle.e1, triangle.e2));
  point.offset = kRounding * double(row.extent);
  point.bin = scene.prim_bin[prim];
  point.prim = prim;
  point.parameter = row.parameter;
  point.light = row.light;
  const GeometryKind kind = scene.bins[point.bin].geometry;
  if (kind == GeometryKind::kTriangleVertex) {
    const TriangleVertexRow<Value> n = scene.triangle_vertices.row(prim);
    const Vec sum = (1 - hit.u - hit.v) * Vec(n.n0_x, n.n0_y, n.n0_z) +
                    hit.u * Vec(n.n1_x, n.n1_y, n.n1_z) + hit.v * Vec(n.n2_x, n.n2_y, n.n2_z);
    const double side = glm::dot(sum, point.ng);
    if (side != 0) point.ns = glm::normalize(sum) * (side < 0 ? -1.0 : 1.0);
    set_texture_coordinates(n, hit, triangle, point);
  }
  return point;
}

/// An instance's map, and the triangles of its object where it puts them.
struct PlacedObject {
  InstanceRow<Value> row;
  glm::dmat3 linear;
  uint32_t first, end;  ///< rows of Instances::triangles

  PlacedObject(const Scene& scene, uint32_t instance)
      : row(scene.instances.rows.row(instance)),
        linear(Vec(row.w_xx, row.w_yx, row.w_zx), Vec(row.w_xy, row.w_yy, row.w_zy),
               Vec(row.w_xz, row.w_yz, row.w_zz)),
        first(row.first_triangle),
        end(first + scene.instances.objects[row.object].triangles) {}

  Triangle triangle(const TriangleRow<Value>& object) const {
    Triangle t(object);
    t.p0 = linear * t.p0 + Vec(row.org_x, row.org_y, row.org_z);
    t.e1 = linear * t.e1;
    t.e2 = linear * t.e2;
    return t;
  }
  InstanceShapeRow<Value> shape(const Scene& scene, uint32_t triangle) const {
    return scene.instances.shapes.row(row.first_shape +
                                      scene.instances.triangles.row(triangle).parameter);
  }
};

Point instance_point(const Scene& scene, const PlacedObject& placed, uint32_t triangle,
                     const TriangleHit& hit) {
  const TriangleRow<Value> row = scene.instances.triangles.row(triangle);
  const InstanceShapeRow<Value> shape = placed.shape(scene, triangle);
  const Triangle world = placed.triangle(row);
  Point point{};
  point.t = hit.t;
  point.position = world.p0 + hit.u * world.e1 + hit.v * world.e2;
  // What is outside before a mirror is outside after it; the cross product turns round.
  const double side = glm::determinant(placed.linear) < 0 ? -1 : 1;
  point.ng = point.ns = side * glm::normalize(glm::cross(world.e1, world.e2));
  point.offset = kRounding * double(placed.row.extent);
  point.bin = shape.bin;
  point.prim = triangle;
  point.parameter = shape.parameter;
  point.light = row.light == kNone ? kNone : shape.light + row.light;
  if (scene.bins[shape.bin].geometry == GeometryKind::kTriangleVertex) {
    const TriangleVertexRow<Value> n = scene.instances.triangle_vertices.row(triangle);
    const Vec sum = (1 - hit.u - hit.v) * Vec(n.n0_x, n.n0_y, n.n0_z) +
                    hit.u * Vec(n.n1_x, n.n1_y, n.n1_z) + hit.v * Vec(n.n2_x, n.n2_y, n.n2_z);
    const Vec ns = glm::normalize(glm::inverse(glm::transpose(placed.linear)) * sum);
    const double cosine = glm::dot(ns, point.ng);
    if (glm::dot(sum, sum) > 0) point.ns = cosine < 0 ? glm::normalize(ns - cosine * point.ng) : ns;
    set_texture_coordinates(n, hit, world, point);
  }
  return point;
}

Point sphere_point(const SphereRow<Value>& row, const RaySegment& ray, double t) {
  const Vec center(row.center_x, row.center_y, row.center_z);
  const Vec outward = glm::normalize(ray.origin + t * ray.direction - center);
  Point point{};
  point.t = t;
  point.position = center + double(row.radius) * outward;
  point.ng = point.ns = row.inward ? -outward : outward;
  point.offset = kRounding * (largest(center) + double(row.radius));
  point.parameter = row.parameter;
  point.light = row.light;
  set_texture_axes(point, double(row.radius), [&](const Vec& at) { return sphere_uv(row, at); });
  return point;
}

Point plane_point(const PlaneRow<Value>& row, const RaySegment& ray, double t) {
  Point point{};
  point.t = t;
  point.position = ray.origin + t * ray.direction;
  point.ng = point.ns = Vec(row.normal_x, row.normal_y, row.normal_z);
  point.offset = kRounding * (largest(point.position) + std::fabs(double(row.distance)));
  point.parameter = row.parameter;
  point.light = kNone;
  set_texture_axes(point, 1, [&row](const Vec& at) {
    return glm::dvec2(glm::dot(Vec(row.u_x, row.u_y, row.u_z), at) + double(row.u_0),
                      glm::dot(Vec(row.v_x, row.v_y, row.v_z), at) + double(row.v_0));
  });
  return point;
}

}  // namespace

glm::dvec2 sphere_uv(const SphereRow<Value>& row, const Vec& position) {
  const Vec x(row.x_x, row.x_y, row.x_z), z(row.z_x, row.z_y, row.z_z);
  const Vec y = double(row.hand) * glm::cross(z, x);
  const Vec out = position - Vec(row.center_x, row.center_y, row.center_z);
  const double u = std::atan2(glm::dot(out, y), glm::dot(out, x)) / (2 * std::numbers::pi);
  const double from_north = std::acos(glm::dot(glm::normalize(out), z)) / std::numbers::pi;
  return {u < 0 ? u + 1 : u, 1 - from_north};
}

std::optional<Point> nearest(const Scene& scene, const RaySegment& ray) {
  std::optional<Point> best;
  double t_max = ray.t_max;
  for (uint32_t i = 0; i < scene.triangles.size(); ++i) {
    const auto hit = meet(Triangle(scene.triangles.row(i)), ray.origin, ray.direction);
    if (!hit || !(hit->t > 0 && hit->t <= t_max)) continue;
    t_max = hit->t;
    best = triangle_point(scene, i, *hit);
  }
  uint32_t prim = scene.triangles.size();
  for (uint32_t i = 0; i < scene.spheres.size(); ++i, ++prim) {
    const SphereRow<Value> row = scene.spheres.row(i);
    const double t = meet(row, ray.origin, ray.direction);
    if (!(t <= t_max)) continue;
    t_max = t;
    best = sphere_point(row, ray, t);
    best->bin = scene.prim_bin[prim];
    best->prim = prim;
  }
  for (uint32_t i = 0; i < scene.planes.size(); ++i, ++prim) {
    const PlaneRow<Value> row = scene.planes.row(i);
    const double t = meet(row, ray.origin, ray.direction);
    if (!(t > 0 && t <= t_max)) continue;
    t_max = t;
    best = plane_point(row, ray, t);
    best->bin = scene.prim_bin[prim];
    best->prim = prim;
  }
  for (uint32_t i = 0; i < scene.shapes.size(); ++i, ++prim) {
    const ShapeRow<Value> row = scene.shapes.row(i);
    const double t = meet(row, ray.origin, ray.direction);
    if (!(t <= t_max)) continue;
    t_max = t;
    best = shape_point(row, ray, t);
    best->bin = scene.prim_bin[prim];
    best->prim = prim;
  }
  for (uint32_t i = 0; i < scene.instances.rows.size(); ++i) {
    const PlacedObject placed(scene, i);
    for (uint32_t t = placed.first; t < placed.end; ++t) {
      const auto hit =
          meet(placed.triangle(scene.instances.triangles.row(t)), ray.origin, ray.direction);
      if (!hit || !(hit->t > 0 && hit->t <= t_max)) continue;
      t_max = hit->t;
      best = instance_point(scene, placed, t, *hit);
    }
  }
  return best;
}

bool occluded(const Scene& scene, const Vec& from, const Vec& to) {
  const Vec way = to - from;
  const auto between = [](double t) { return t > 0 && t < 1; };
  const auto bin_stops = [&](uint32_t bin) { return scene.bins[bin].passing == Passing::kSolid; };
  const auto stops = [&](uint32_t prim) { return bin_stops(scene.prim_bin[prim]); };
  for (uint32_t i = 0; i < scene.triangles.size(); ++i) {
    const auto hit = meet(Triangle(scene.triangles.row(i)), from, way);
    if (hit && between(hit->t) && stops(i)) return true;
  }
  uint32_t prim = scene.triangles.size();
  for (uint32_t i = 0; i < scene.spheres.size(); ++i, ++prim)
    if (between(meet(scene.spheres.row(i), from, way)) && stops(prim)) return true;
  for (uint32_t i = 0; i < scene.planes.size(); ++i, ++prim)
    if (between(meet(scene.planes.row(i), from, way)) && stops(prim)) return true;
  for (uint32_t i = 0; i < scene.shapes.size(); ++i, ++prim)
    if (between(meet(scene.shapes.row(i), from, way)) && stops(prim)) return true;
  for (uint32_t i = 0; i < scene.instances.rows.size(); ++i) {
    const PlacedObject placed(scene, i);
    for (uint32_t t = placed.first; t < placed.end; ++t) {
      const auto hit = meet(placed.triangle(scene.instances.triangles.row(t)), from, way);
      if (hit && between(hit->t) && bin_stops(placed.shape(scene, t).bin)) return true;
    }
  }
  return false;
}

Vec tangent_of(const Point& point) {
  const auto across = [&](const Vec& v) { return v - glm::dot(v, point.ns) * point.ns; };
  const Vec& n = point.ng;
  Vec t = across(point.along);
  // LuxRender's choice where there is none (Pharr, Humphreys 2004, CoordinateSystem).
  if (!(glm::length(t) > 0))
    t = across(std::fabs(n.x) > std::fabs(n.y) ? Vec(-n.z, 0, n.x) : Vec(0, n.z, -n.y));
  return glm::normalize(t);
}

Axes::Axes(const Vec& normal, const Vec& tangent)
    : x(glm::normalize(tangent - glm::dot(tangent, normal) * normal)),
      y(glm::cross(normal, x)),
      z(normal) {}

Axes::Axes(const Vec& n) : z(n) {
  const double sign = std::copysign(1.0, n.z);
  const double a = -1 / (sign + n.z), b = n.x * n.y * a;
  x = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
  y = {b, sign + n.y * n.y * a, -n.y};
}

glm::dvec2 disc(double u, double v) {
  const double a = 2 * u - 1, b = 2 * v - 1;
  if (a == 0 && b == 0) return {0, 0};
  if (std::fabs(a) > std::fabs(b)) {
    const double angle = std::numbers::pi / 4 * b / a;
    return {a * std::cos(angle), a * std::sin(angle)};
  }
  const double angle = std::numbers::pi / 2 - std::numbers::pi / 4 * a / b;
  return {b * std::cos(angle), b * std::sin(angle)};
}

Vec cosine_hemisphere(double u, double v) {
  const glm::dvec2 p = disc(u, v);
  return {p.x, p.y, std::sqrt(std::fmax(0, 1 - p.x * p.x - p.y * p.y))};
}

Vec cone(double measure, double u, double v) {
  const double cos = 1 - u * measure, sin = std::sqrt(std::fmax(0, 1 - cos * cos));
  const double phi = 2 * std::numbers::pi * v;
  return {sin * std::cos(phi), sin * std::sin(phi), cos};
}

}  // namespace yat::reference

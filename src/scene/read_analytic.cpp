// Statements of analytic shapes -> AnalyticShape (lxs 5.3).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scene/read_shapes.h"

namespace yat {

namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Reads numbers, and remembers whether they were usable.
class Reader {
 public:
  Reader(Parameters& p) : p_(p) { p.accept({"name"}); }

  /// A finite number; anything else makes the shape unusable.
  double number(std::string_view name, double fallback) {
    const auto value = double(p_.number(name, float(fallback)));
    if (!std::isfinite(value)) refuse(name, fmt::format("\"{}\" is {}", name, value));
    return value;
  }
  /// One that must be above 0.
  double size(std::string_view name, double fallback) {
    const double value = number(name, fallback);
    if (!(value > 0)) refuse(name, fmt::format("\"{}\" is {}, but must be above 0", name, value));
    return value;
  }
  /// One that must not be below 0.
  double size_or_zero(std::string_view name, double fallback) {
    const double value = number(name, fallback);
    if (!(value >= 0))
      refuse(name, fmt::format("\"{}\" is {}, but must not be below 0", name, value));
    return value;
  }
  /// phimax, in radians.
  double phi_max() {
    const double degrees = std::clamp(number("phimax", 360), 0., 360.);
    if (!(degrees > 0)) refuse("phimax", "\"phimax\" leaves nothing of it");
    return degrees * kDegree;
  }
  /// Puts two numbers in order.
  void in_order(std::string_view low_name, double& low, std::string_view high_name, double& high) {
    if (low <= high) return;
    p_.diagnostics().warning(p_.loc(low_name), fmt::format("{}: \"{}\" is above \"{}\": they are "
                                                           "exchanged",
                                                           p_.what(), low_name, high_name));
    std::swap(low, high);
  }
  /// Nothing can be rendered. The first reason is told.
  void refuse(std::string_view name, std::string_view reason) {
    if (usable_)
      p_.diagnostics().warning(p_.loc(name), fmt::format("{}: {}: left out", p_.what(), reason));
    usable_ = false;
  }
  bool usable() const { return usable_; }
  Parameters& parameters() { return p_; }

 private:
  Parameters& p_;
  bool usable_ = true;
};

void read_sphere(Reader& in, CompiledShape& shape) {
  const double radius = in.size("radius", 1);
  double z0 = in.number("zmin", -radius), z1 = in.number("zmax", radius);
  const double phi_max = in.phi_max();
  in.in_order("zmin", z0, "zmax", z1);
  z0 = std::clamp(z0, -std::abs(radius), std::abs(radius));
  z1 = std::clamp(z1, -std::abs(radius), std::abs(radius));
  if (!(z1 > z0)) in.refuse("zmin", "nothing is left between \"zmin\" and \"zmax\"");
  if (!in.usable()) return;
  shape.analytic = make_sphere(radius, z0, z1, phi_max);
  const bool whole = z0 == -radius && z1 == radius && phi_max == 360 * kDegree;
  if (whole) shape.kind = CompiledShape::Kind::kSphere;
  shape.radius = radius;
}

void read_disk(Reader& in, CompiledShape& shape) {
  const double height = in.number("height", 0), radius = in.size("radius", 1);
  const double inner = in.size_or_zero("innerradius", 0), phi_max = in.phi_max();
  if (!(inner < radius)) in.refuse("innerradius", "\"innerradius\" is not below \"radius\"");
  if (in.usable()) shape.analytic = make_disk(radius, inner, height, phi_max);
}

void read_cylinder(Reader& in, CompiledShape& shape) {
  const double radius = in.size("radius", 1);
  double z0 = in.number("zmin", -1), z1 = in.number("zmax", 1);
  const double phi_max = in.phi_max();
  in.in_order("zmin", z0, "zmax", z1);
  if (!(z1 > z0)) in.refuse("zmin", "nothing is left between \"zmin\" and \"zmax\"");
  if (in.usable()) shape.analytic = make_cylinder(radius, z0, z1, phi_max);
}

void read_cone(Reader& in, CompiledShape& shape) {
  const double radius = in.size_or_zero("radius", 1), radius2 = in.size_or_zero("radius2", 0);
  const double height = in.number("height", 1), phi_max = in.phi_max();
  if (height == 0) in.refuse("height", "\"height\" is 0");
  if (radius == 0 && radius2 == 0) in.refuse("radius", "both radii are 0");
  if (in.usable()) shape.analytic = make_cone(radius, radius2, height, phi_max);
}

void read_paraboloid(Reader& in, CompiledShape& shape) {
  const double radius = in.size("radius", 1);
  double z0 = in.number("zmin", 0), z1 = in.number("zmax", 1);
  const double phi_max = in.phi_max();
  in.in_order("zmin", z0, "zmax", z1);
  if (!(z1 > 0)) in.refuse("zmax", "\"zmax\" must be above 0");
  z0 = std::max(z0, 0.);  // it begins there
  if (!(z1 > z0)) in.refuse("zmin", "nothing is left between \"zmin\" and \"zmax\"");
  if (in.usable()) shape.analytic = make_paraboloid(radius, z0, z1, phi_max);
}

/// Least distance from the z axis to the segment, both at one height.
double least_radius(const glm::dvec3& p1, const glm::dvec3& p2) {
  const glm::dvec3 way = p2 - p1;
  const double squared = glm::dot(way, way);
  const double at = squared > 0 ? std::clamp(-glm::dot(p1, way) / squared, 0., 1.) : 0;
  const glm::dvec3 p = p1 + at * way;
  return std::hypot(p.x, p.y);
}

void read_hyperboloid(Reader& in, CompiledShape& shape) {
  Parameters& p = in.parameters();
  const glm::dvec3 p1 = p.triple("p1", ParameterType::kPoint, {0, 0, 0});
  const glm::dvec3 p2 = p.triple("p2", ParameterType::kPoint, {1, 1, 1});
  const double phi_max = in.phi_max();
  const double widest = std::max(std::hypot(p1.x, p1.y), std::hypot(p2.x, p2.y));
  if (!std::isfinite(glm::length(p1)) || !std::isfinite(glm::length(p2)))
    in.refuse("p1", "\"p1\" or \"p2\" is not finite");
  if (!(widest > 0)) in.refuse("p1", "\"p1\" and \"p2\" are on its axis");
  if (!in.usable()) return;
  if (p1.z != p2.z) {
    shape.analytic = make_hyperboloid(p1, p2, phi_max);
    return;
  }
  const double inner = least_radius({p1.x, p1.y, 0}, {p2.x, p2.y, 0});
  if (!(inner < widest)) return in.refuse("p1", "\"p1\" and \"p2\" make a circle");
  p.diagnostics().warning(p.loc("p1"), fmt::format("{}: \"p1\" and \"p2\" are at one height: it "
                                                   "is taken as a disk",
                                                   p.what()));
  shape.analytic = make_disk(widest, inner, p1.z, phi_max);
}

void read_torus(Reader& in, CompiledShape& shape) {
  const double major = in.size_or_zero("majorradius", 1), minor = in.size("minorradius", .25);
  double theta0 = in.number("thetamin", 0), theta1 = in.number("thetamax", 360);
  const double phi_max = in.phi_max();
  in.in_order("thetamin", theta0, "thetamax", theta1);
  const double sweep = std::min(theta1 - theta0, 360.);
  if (!(sweep > 0)) in.refuse("thetamin", "nothing is left between \"thetamin\" and \"thetamax\"");
  if (!in.usable()) return;
  if (minor <= major) {
    shape.analytic = make_torus(major, minor, theta0 * kDegree, sweep * kDegree, phi_max);
    return;
  }
  in.parameters().diagnostics().warning(
      in.parameters().loc("minorradius"),
      "a torus that cuts itself (\"minorradius\" above \"majorradius\") is rendered as 65000 "
      "triangles");
  shape.kind = CompiledShape::Kind::kMesh;
  shape.mesh = make_torus_mesh(major, minor, theta0 * kDegree, sweep * kDegree, phi_max);
}

struct Entry {
  std::string_view type;
  void (*read)(Reader&, CompiledShape&);
};
constexpr Entry kShapes[] = {{"sphere", read_sphere},
                             {"disk", read_disk},
                             {"cylinder", read_cylinder},
                             {"cone", read_cone},
                             {"paraboloid", read_paraboloid},
                             {"hyperboloid", read_hyperboloid},
                             {"torus", read_torus}};

}  // namespace

bool is_analytic(std::string_view type) {
  return std::any_of(std::begin(kShapes), std::end(kShapes),
                     [&](const Entry& entry) { return entry.type == type; });
}

bool read_analytic(Parameters& p, std::string_view type, CompiledShape& shape) {
  for (const Entry& entry : kShapes) {
    if (entry.type != type) continue;
    Reader in(p);
    shape.kind = CompiledShape::Kind::kAnalytic;
    entry.read(in, shape);
    if (in.usable() && shape.kind != CompiledShape::Kind::kMesh)
      shape.light_area = area_of(shape.analytic, glm::dmat3(1.));
    return in.usable();
  }
  return false;
}

}  // namespace yat

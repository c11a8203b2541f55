#pragma once
// Analytic shapes between their statement and their row: each in a space of its own of about unit
// size (ShapeRow in scene/primitive_rows.h), and how that lies in the statement's object space.

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <numbers>

#include "scene/compiled.h"
#include "scene/tree_top.h"

namespace yat {

struct Placement;

struct AnalyticShape {
  ShapeKind kind = ShapeKind::kQuadric;
  /// Object space is (scale.x x, scale.y y, scale.z z + shift).
  glm::dvec3 scale{1.0};
  double shift = 0;
  double a = 0, b = 0, c = 0, d = 0, e = 0, s = 0;  ///< as in ShapeRow
  double z_first = 0, z_last = 0;                   ///< all of the surface is between these
  bool closed_first = false, closed_last = false;   ///< no edge there: a pole
  double phi_max = 2 * std::numbers::pi;            ///< (0, 2 pi]
  double v_scale = 1, v_offset = 0;
  bool inward = false;

  glm::dvec3 origin() const { return {0, 0, shift}; }
};

// Angles in radians. The numbers must be such that something is left of the shape (checked where
// statements are read); see lxs 5.3 for what they mean.
AnalyticShape make_sphere(double radius, double z_min, double z_max, double phi_max);
AnalyticShape make_disk(double radius, double inner, double height, double phi_max);
AnalyticShape make_cylinder(double radius, double z_min, double z_max, double phi_max);
/// radius at z = 0, radius2 at z = height.
AnalyticShape make_cone(double radius, double radius2, double height, double phi_max);
/// z = z_max rho^2 / radius^2, 0 <= z_min < z_max.
AnalyticShape make_paraboloid(double radius, double z_min, double z_max, double phi_max);
/// The line from p1 to p2, of different heights, about z.
AnalyticShape make_hyperboloid(const glm::dvec3& p1, const glm::dvec3& p2, double phi_max);
/// minor <= major; theta from theta_min on by theta_sweep.
AnalyticShape make_torus(double major, double minor, double theta_min, double theta_sweep,
                         double phi_max);

/// Area of the surface after a linear map of object space [m2].
double area_of(const AnalyticShape& shape, const glm::dmat3& linear);

/// Bounds of the placed shape, world space [m].
TopBox bounds_of(const AnalyticShape& shape, const Placement& placement);

/// The row of a placed shape about `center`; material, light and `occludes` are left 0.
ShapeRow<Value> shape_row(const AnalyticShape& shape, const Placement& placement,
                          bool reverse_orientation, const glm::dvec3& center);

/// What a ray meets of a shape lies within this box, scene space: its bounds and the rounding of
/// its maps.
TopBox traced_bounds(const AnalyticShape& shape, const Placement& placement,
                     const glm::dvec3& center);

}  // namespace yat

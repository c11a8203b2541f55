#pragma once
// Part of the oracle: analytic shapes in double precision, from their rows.

#include <functional>

#include "wavefront/reference_parts.h"

namespace yat::reference {

/// Smallest t > 0 at which origin + t direction meets the shape, or infinity. The quartic of the
/// torus is solved as what it is, between the roots of its derivatives.
double meet(const ShapeRow<Value>& row, const Vec& origin, const Vec& direction);

/// The hit at distance t. `bin` and `prim` are left to the caller.
Point shape_point(const ShapeRow<Value>& row, const RaySegment& ray, double t);

struct ShapeSamplePoint {
  Vec position, normal;  ///< scene space; the side that shines
  double offset;
  double inverse_density;  ///< per area in the scene
};
/// The point that the numbers (u, v) give, as the kernels choose it.
ShapeSamplePoint sample_shape(const ShapeRow<Value>& row, double u, double v);
/// 1 / density with which sample_shape() gives a point of the shape [m2].
double inverse_density(const ShapeRow<Value>& row, const Vec& position);

/// Texture coordinates of a point of the shape (lxs 5.3).
glm::dvec2 shape_uv(const ShapeRow<Value>& row, const Vec& position);

/// Sets u, v and their derivatives by differences: uv says the coordinates of places within a
/// hundred thousandth of `size` of the point, and may wrap round at 1.
void set_texture_axes(Point& point, double size,
                      const std::function<glm::dvec2(const Vec&)>& coordinates);

}  // namespace yat::reference

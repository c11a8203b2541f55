#pragma once
// Analytic shapes of every kind, placed at random, for tests of their kernels.

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "kernel_columns.h"
#include "scene/analytic_shape.h"
#include "scene/compile_parts.h"
#include "wavefront/reference_shapes.h"

namespace yat {

struct NamedShape {
  std::string name;
  AnalyticShape shape;
};

/// Whole and partial ones, fat and thin.
inline std::vector<NamedShape> all_shapes() {
  constexpr double kDegree = std::numbers::pi / 180, kWhole = 360 * kDegree;
  return {{"ellipsoid", make_sphere(1, -1, 1, kWhole)},
          {"part of a sphere", make_sphere(2, -.5, 1.5, 200 * kDegree)},
          {"disk", make_disk(1, 0, .5, kWhole)},
          {"sector of a ring", make_disk(2, 1.2, 0, 100 * kDegree)},
          {"cylinder", make_cylinder(.5, -1, 2, kWhole)},
          {"needle", make_cylinder(.001, 0, 1, kWhole)},
          {"part of a cylinder", make_cylinder(1, 0, .25, 300 * kDegree)},
          {"cone", make_cone(1, 0, 2, kWhole)},
          {"frustum", make_cone(.5, 1.5, 1, 180 * kDegree)},
          {"paraboloid", make_paraboloid(1, 0, 1, kWhole)},
          {"part of a paraboloid", make_paraboloid(1.5, .5, 3, 90 * kDegree)},
          {"hyperboloid", make_hyperboloid({1, 0, -1}, {0, 1, 1}, kWhole)},
          {"part of a hyperboloid", make_hyperboloid({1, .5, 0}, {-.5, 1, -2}, 250 * kDegree)},
          {"torus", make_torus(1, .25, 0, kWhole, kWhole)},
          {"wire", make_torus(1, 1e-3, 0, kWhole, kWhole)},
          {"horn torus", make_torus(1, 1, 0, kWhole, kWhole)},
          {"part of a torus", make_torus(1, .5, -60 * kDegree, 200 * kDegree, 270 * kDegree)}};
}

/// A rotation, unequal scales within a factor of three, perhaps a mirror, and a place.
inline Placement random_placement(Random& random, double scale, double away) {
  Matrix m(1.);
  m = glm::translate(m, random.direction() * away * scale);
  m = glm::rotate(m, double(random.in(0, 6.28f)), random.direction());
  const auto factor = [&] { return scale * double(random.in(.6f, 1.8f)); };
  m = glm::scale(m, glm::dvec3(factor(), factor(), random.below(2) ? factor() : -factor()));
  Diagnostics silent([](Severity, std::string_view) {});
  return *make_placement(m, {}, "test", silent);
}

/// Rows of one kind, ready for a kernel.
struct ShapeScene {
  RowTable<ShapeRow> rows;
  SceneView view;
  explicit ShapeScene(std::vector<ShapeRow<Value>> list) {
    rows.resize(uint32_t(list.size()));
    ShapesView& shapes = view.geometry.shapes;
    for (uint32_t i = 0; i < list.size(); ++i) {
      list[i].occludes = 1;
      rows.set(i, list[i]);
      RowRange& range = shapes.kinds[list[i].kind];
      if (range.first == range.end) range.first = i;
      range.end = i + 1;
    }
    shapes.rows = rows.view();
  }
};

inline glm::dvec3 origin_of(const Ray<Value>& r) {
  return {r.org_x, r.org_y, r.org_z};
}
inline glm::dvec3 direction_of(const Ray<Value>& r) {
  return {r.dir_x, r.dir_y, r.dir_z};
}
inline Ray<Value> ray_of(const glm::dvec3& org, const glm::dvec3& dir) {
  return {float(org.x), float(org.y), float(org.z), float(dir.x),
          float(dir.y), float(dir.z), kRayFar};
}

/// A random point of the shape and its unit normal.
inline reference::ShapeSamplePoint random_point_of(const ShapeRow<Value>& row, Random& random) {
  return reference::sample_shape(row, double(random.unit()), double(random.unit()));
}

}  // namespace yat

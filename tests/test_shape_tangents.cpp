// dp/du and dp/dv of analytic shapes: the kernels' formulas against differences of the reference's
// texture coordinates.

#include <cmath>

#include "kernels/texture_step.h"
#include "shape_rows.h"

namespace yat {
namespace {

class ShapeTangents : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(ShapeTangents);

glm::dvec3 across(const glm::dvec3& v, const glm::dvec3& n) {
  return glm::normalize(v - glm::dot(v, n) * n);
}

TEST_P(ShapeTangents, AreHowThePlaceMovesWithUAndV) {
  const KernelTable& k = kernels();
  Random random(8);
  for (const NamedShape& named : all_shapes()) {
    const ShapeRow<Value> row =
        shape_row(named.shape, random_placement(random, 1, 2), random.below(2), glm::dvec3(0.));
    const ShapeScene scene({row});
    constexpr uint32_t n = 201;
    std::vector<reference::Point> points;
    Table<Surface> surfaces(n);
    Table<PathState> paths(n);
    for (uint32_t i = 0; i < n; ++i) {
      const auto at = random_point_of(row, random);
      points.push_back(reference::shape_point(row, {at.position, at.normal, 0}, 0));
      const glm::dvec3 ns = glm::normalize(at.normal + .2 * random.direction());
      points.back().ns = ns;
      Surface<Value> s{};
      s.pos_x = float(at.position.x), s.pos_y = float(at.position.y);
      s.pos_z = float(at.position.z);
      s.ng_x = float(at.normal.x), s.ng_y = float(at.normal.y), s.ng_z = float(at.normal.z);
      s.ns_x = float(ns.x), s.ns_y = float(ns.y), s.ns_z = float(ns.z);
      surfaces.set(i, s);
      paths.set(i, {});
    }
    const auto geometry = GeometryKind(uint32_t(GeometryKind::kQuadric) + row.kind);
    Table<SurfaceDerivatives> derivatives(n);
    k.make_derivatives(scene.view, geometry, nullptr, nullptr, surfaces.view(), paths.view(),
                       derivatives.columns(), n);
    GuardedColumn<float> x(n), y(n), z(n);
    k.make_tangents[uint32_t(geometry)](scene.view, surfaces.view(), {x.data(), y.data(), z.data()},
                                        n);
    EXPECT_TRUE(x.untouched() && y.untouched() && z.untouched());
    uint32_t compared = 0;
    for (uint32_t i = 0; i < n; ++i) {
      const reference::Point& p = points[i];
      // Differences say nothing across a seam, nor where one coordinate has a pole.
      const double round = glm::length(p.du), up = glm::length(p.dv);
      const double edge = std::min({p.u, 1 - p.u, p.v, 1 - p.v});
      const bool tip =
          (named.name == "cone" || named.name == "horn torus") &&
          reference::inverse_density(row, p.position) < .1 * area_of(named.shape, glm::dmat3(1.));
      if (edge < 2e-2 || tip || !(round > 0)) continue;
      ++compared;
      // Needles and wires are known less well than they are thick.
      const bool thin = named.name == "needle" || named.name == "wire";
      const double slack = thin ? 3e-2 : 2e-4;
      const SurfaceDerivatives<Value> d = derivatives.row(i);
      expect_near({d.du_x, d.du_y, d.du_z}, p.du, slack * (round + (thin ? 0 : up)),
                  named.name.c_str(), i);
      expect_near({d.dv_x, d.dv_y, d.dv_z}, p.dv, slack * (up + (thin ? 0 : round)),
                  named.name.c_str(), i);
      expect_near({x[i], y[i], z[i]}, across(p.du, p.ns), 10 * slack, named.name.c_str(), i);
    }
    EXPECT_GT(compared, n / 2) << named.name;
  }
}

}  // namespace
}  // namespace yat

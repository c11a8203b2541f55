// Analytic shapes: hits against the scalar reference in double precision, rays that leave them,
// normals and texture coordinates.

#include <fmt/format.h>

#include <cmath>

#include "shape_rows.h"

namespace yat {
namespace {

class Shapes : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(Shapes);

struct Traced {
  Table<Ray> rays;
  Table<Hit> hits;
  std::vector<uint32_t> occluded;
  /// Closest hits, and whether something lies on the way of `reach`.
  Traced(const KernelTable& k, const ShapeScene& scene, const std::vector<Ray<Value>>& list,
         float reach)
      : rays(uint32_t(list.size())), hits(uint32_t(list.size())) {
    const auto n = uint32_t(list.size());
    Table<ShadowRay> shadow(n);
    AlignedArray<uint32_t> stopped(n);
    for (uint32_t i = 0; i < n; ++i) {
      rays.set(i, list[i]);
      hits.set(i, {list[i].t_max, .3f, .4f, kNone});
      const Ray<Value>& r = list[i];
      shadow.set(i, {r.org_x, r.org_y, r.org_z, reach * r.dir_x, reach * r.dir_y, reach * r.dir_z,
                     0, 0, 0, 0});
    }
    const ShapesView& shapes = scene.view.geometry.shapes;
    for (uint32_t kind = 0; kind < kShapeKinds; ++kind) {
      if (shapes.kinds[kind].first == shapes.kinds[kind].end) continue;
      k.intersect_shapes[kind](shapes, 5, rays.view(), hits.columns(), n);
      k.shadow_shapes[kind](shapes, shadow.view(), stopped.data(), n);
    }
    occluded.assign(stopped.data(), stopped.data() + n);
  }
};

/// Whether rounding may decide if the ray meets the shape at t: where it grazes, or at an edge.
bool is_doubtful(const ShapeRow<Value>& row, const Ray<Value>& ray, double t, double slack) {
  const glm::dvec3 d = direction_of(ray);
  const reference::Point at = reference::shape_point(row, {origin_of(ray), d, 1e30}, t);
  const glm::dvec2 uv = reference::shape_uv(row, at.position);
  const double edge = std::min({uv.x, 1 - uv.x, std::abs(uv.y), std::abs(1 - uv.y)});
  // Where a torus comes to its axis, or at the tip of a cone, the surface is smaller than rounding.
  const bool tip = reference::inverse_density(row, at.position) <
                   2e-3 * slack * double(row.radius) * double(row.radius);
  return tip || std::abs(glm::dot(at.ng, d)) < 3e-3 * slack || edge < 1e-4 * slack || uv.x > 1 ||
         uv.y < 0 || uv.y > 1;
}

TEST_P(Shapes, HitsAreTheReferences) {
  Random random(5);
  for (const NamedShape& named : all_shapes()) {
    const ShapeRow<Value> row =
        shape_row(named.shape, random_placement(random, 1, 2), random.below(2), glm::dvec3(0.));
    const ShapeScene scene({row});
    const glm::dvec3 center(row.org_x, row.org_y, row.org_z);
    std::vector<Ray<Value>> rays;
    constexpr uint32_t kRays = 6000;
    for (uint32_t i = 0; i < kRays; ++i) {
      // From around it to its points, a third of them grazing, some from inside, some from far off.
      const auto at = random_point_of(row, random);
      glm::dvec3 dir = random.direction();
      if (i % 3 == 0) dir = glm::normalize(dir - at.normal * (glm::dot(dir, at.normal) * .999));
      const double way = double(row.radius) * (i % 7 == 0 ? 100 : double(random.in(.01f, 4)));
      glm::dvec3 org = at.position - way * dir;
      if (i % 5 == 0) org = center + double(row.radius) * random.point(1.5f);
      rays.push_back(ray_of(org, dir));
    }
    // A power of two, so that shadow rays have the same direction.
    const auto reach = float(std::exp2(std::round(std::log2(double(row.radius)))));
    const Traced traced(kernels(), scene, rays, reach);
    uint32_t hits = 0, doubtful = 0;
    for (uint32_t i = 0; i < kRays; ++i) {
      const Ray<Value>& ray = rays[i];
      const double exact = reference::meet(row, origin_of(ray), direction_of(ray));
      const Hit<Value> hit = traced.hits.row(i);
      // A ray from far off is off by the roundings of its way.
      // What rounding is to the shape as a whole is more to a thin one.
      const bool thin = named.name == "needle" || named.name == "wire";
      const double slack =
          (thin ? 20 : 1) * (1 + glm::length(origin_of(ray) - center) / double(row.radius));
      const bool found = hit.prim != kNone, wanted = std::isfinite(exact);
      if (found) {
        ASSERT_EQ(hit.prim, 5u) << named.name;
        ASSERT_EQ(hit.u, 0.f);
      }
      hits += wanted;
      if (found && wanted) {
        const reference::Point at =
            reference::shape_point(row, {origin_of(ray), direction_of(ray), 1e30}, exact);
        const double off =
            std::abs(double(hit.t) - exact) * std::abs(glm::dot(at.ng, direction_of(ray)));
        if (off <= 3e-6 * slack * double(row.radius)) {
          if (std::abs(exact - double(reach)) > 1e-3 * slack * double(row.radius)) {
            ASSERT_EQ(traced.occluded[i], uint32_t(exact < double(reach)))
                << named.name << " ray " << i;
          }
          continue;
        }
      }
      if (!found && !wanted) {
        ASSERT_EQ(traced.occluded[i], 0u) << named.name << " ray " << i;
        continue;
      }
      // The two chose different crossings: then the nearer is one that rounding decides.
      const double nearer = found ? std::min(double(hit.t), exact) : exact;
      ++doubtful;
      EXPECT_TRUE(is_doubtful(row, ray, nearer, slack))
          << named.name << " ray " << i << ": " << (found ? double(hit.t) : -1) << " for " << exact;
    }
    EXPECT_GT(hits, kRays / 3) << named.name;
    EXPECT_LT(doubtful, kRays / 10) << named.name;
  }
}

TEST_P(Shapes, EveryCountAndManyShapesAtOnce) {
  Random random(6);
  std::vector<ShapeRow<Value>> rows;
  for (uint32_t kind = 0; kind < kShapeKinds; ++kind)
    for (const NamedShape& named : all_shapes())
      if (uint32_t(named.shape.kind) == kind)
        rows.push_back(
            shape_row(named.shape, random_placement(random, .3, 4), false, glm::dvec3(0.)));
  const ShapeScene scene(rows);
  std::vector<Ray<Value>> rays;
  for (uint32_t i = 0; i < 3 * 16 + 1; ++i)
    rays.push_back(ray_of(random.point(2), random.direction()));
  const Traced all(kernels(), scene, rays, 3);
  for (const uint32_t n : tail_counts(kernels().lanes)) {
    const Traced some(kernels(), scene, {rays.begin(), rays.begin() + n}, 3);
    for (uint32_t i = 0; i < n; ++i) {
      EXPECT_EQ(some.hits.row(i).t, all.hits.row(i).t);
      EXPECT_EQ(some.hits.row(i).prim, all.hits.row(i).prim);
      EXPECT_EQ(some.occluded[i], all.occluded[i]);
    }
  }
}

/// Surfaces of hits at given points of one shape.
std::vector<Surface<Value>> surfaces_at(const KernelTable& k, const ShapeScene& scene,
                                        const std::vector<Ray<Value>>& rays,
                                        const std::vector<float>& t) {
  const auto n = uint32_t(rays.size());
  Table<Ray> ray_table(n);
  Table<Hit> hits(n);
  Table<PathState> paths(n), paths_out(n);
  Table<Surface> surfaces(n);
  AlignedArray<uint32_t> order(n);
  for (uint32_t i = 0; i < n; ++i) {
    ray_table.set(i, rays[i]);
    hits.set(i, {t[i], 0, 0, 0});
    order[i] = i;
  }
  const uint32_t kind = scene.rows.row(0).kind;
  k.make_surfaces[uint32_t(GeometryKind::kQuadric) + kind](
      scene.view, order.data(), ray_table.view(), hits.view(), paths.view(), surfaces.columns(),
      paths_out.columns(), n);
  std::vector<Surface<Value>> out;
  for (uint32_t i = 0; i < n; ++i) out.push_back(surfaces.row(i));
  return out;
}

TEST_P(Shapes, SurfacesHavePositionNormalAndUv) {
  Random random(7);
  for (const NamedShape& named : all_shapes()) {
    const bool reverse = random.below(2);
    ShapeRow<Value> row =
        shape_row(named.shape, random_placement(random, 1, 3), reverse, glm::dvec3(0.));
    row.parameter = 7;
    const ShapeScene scene({row});
    std::vector<Ray<Value>> rays;
    std::vector<float> t;
    std::vector<reference::ShapeSamplePoint> points;
    for (uint32_t i = 0; i < 500; ++i) {
      points.push_back(random_point_of(row, random));
      const glm::dvec3 dir = random.direction();
      const auto way = double(random.in(.1f, 3));
      rays.push_back(ray_of(points.back().position - way * dir, dir));
      t.push_back(float(way));
    }
    const auto surfaces = surfaces_at(kernels(), scene, rays, t);
    for (uint32_t i = 0; i < surfaces.size(); ++i) {
      const Surface<Value>& s = surfaces[i];
      const auto& p = points[i];
      const glm::dvec3 ng(s.ng_x, s.ng_y, s.ng_z);
      const double size = double(row.extent);
      // Where the surface is strongly bent, what is known of the place says less of the normal.
      const double bent = named.name == "needle" || named.name == "wire" ? 1000 : 1;
      expect_near({s.pos_x, s.pos_y, s.pos_z}, p.position, 3e-6 * size, named.name.c_str(), i);
      // Nor is it known near the tip of a cone, or where the surface comes to its axis.
      const bool tip = (named.name == "cone" || named.name == "horn torus") &&
                       p.inverse_density < .1 * area_of(named.shape, glm::dmat3(1.));
      if (tip) continue;
      expect_near(ng, p.normal, 4e-6 * bent * size, "normal", i);
      EXPECT_NEAR(glm::length(ng), 1, 1e-6);
      EXPECT_EQ(s.parameter, 7u);
      EXPECT_EQ(s.light, kNone);
      EXPECT_GT(s.offset, 0.f);
      const glm::dvec2 uv = reference::shape_uv(row, p.position);
      if (std::min({uv.x, 1 - uv.x, uv.y, 1 - uv.y}) < 1e-2) continue;  // seams and poles
      EXPECT_NEAR(s.u, uv.x, 1e-4 * bent) << named.name;
      EXPECT_NEAR(s.v, uv.y, 1e-4 * bent) << named.name;
    }
  }
}

// lxs 5.3: places with known u and v, and normals that point out.
TEST_P(Shapes, UvAndNormalsOfKnownPlaces) {
  constexpr double kPi = std::numbers::pi, kWhole = 2 * kPi;
  struct Place {
    AnalyticShape shape;
    glm::dvec3 p, n;
    double u, v;
  };
  const double h = std::sqrt(.5), s = std::sqrt(.75);
  const Place places[] = {
      {make_sphere(1, -1, 1, kWhole), {0, h, -h}, {0, h, -h}, .25, .25},
      {make_sphere(1, -.5, .5, kPi), {0, 1, 0}, {0, 1, 0}, .5, .5},
      {make_sphere(1, 0, 1, kWhole), {-s, 0, .5}, {-s, 0, .5}, .5, 1. / 3},
      {make_disk(2, 1, 3, kWhole), {-1.5, 0, 3}, {0, 0, 1}, .5, .5},
      {make_disk(1, 0, 0, kWhole), {0, -.75, 0}, {0, 0, 1}, .75, .25},
      {make_cylinder(2, 1, 5, kPi), {0, 2, 2}, {0, 1, 0}, .5, .25},
      {make_cone(1, 0, 1, kWhole), {0, .75, .25}, {0, h, h}, .25, .25},
      {make_cone(1, 2, 1, kWhole), {1.5, 0, .5}, {h, 0, -h}, 0, .5},
      {make_paraboloid(1, 0, 1, kWhole), {.5, 0, .25}, {h, 0, -h}, 0, .25},
      {make_paraboloid(2, 1, 4, kWhole),
       {0, s * 2, 3},
       {0, std::sqrt(12. / 13), -std::sqrt(1. / 13)},
       .25,
       2. / 3},
      {make_hyperboloid({1, 0, 0}, {1, 0, 2}, kWhole), {0, 1, .5}, {0, 1, 0}, .25, .25},
      {make_hyperboloid({1, 0, 2}, {1, 0, 0}, kWhole), {0, 1, .5}, {0, -1, 0}, .25, .75},
      {make_torus(2, 1, 0, kWhole, kWhole), {0, 3, 0}, {0, 1, 0}, .25, 0},
      {make_torus(2, 1, 0, kWhole, kWhole), {-2, 0, 1}, {0, 0, 1}, .5, .25},
      {make_torus(2, 1, kPi / 2, kPi, kPi), {0, 1, 0}, {0, -1, 0}, .5, .5}};
  for (const Place& place : places)
    for (const bool mirrored : {false, true})
      for (const bool reverse : {false, true}) {
        Placement placement;
        if (mirrored) {
          Diagnostics silent([](Severity, std::string_view) {});
          placement = *make_placement(glm::scale(Matrix(1.), glm::dvec3(1, -1, 1)), {}, "", silent);
        }
        const ShapeScene scene({shape_row(place.shape, placement, reverse, glm::dvec3(0.))});
        const glm::dvec3 turn(1, mirrored ? -1 : 1, 1), from = turn * (place.p + 2. * place.n);
        const Surface<Value> found =
            surfaces_at(kernels(), scene, {ray_of(from, -turn * place.n)}, {2.f})[0];
        expect_near({found.pos_x, found.pos_y, found.pos_z}, turn * place.p, 2e-6, "position", 0);
        expect_near({found.ng_x, found.ng_y, found.ng_z}, turn * place.n * (reverse ? -1. : 1.),
                    2e-6, "normal", 0);
        // At the seam both ends are right.
        EXPECT_NEAR(std::remainder(double(found.u) - place.u, 1), 0, 1e-6);
        EXPECT_NEAR(std::remainder(double(found.v) - place.v, 1), 0, 1e-6);
      }
}

// S1: what leaves a surface off by Surface::offset meets what lies on its way, and not what it
// left.
TEST_P(Shapes, SpawnedRaysDoNotMeetWhatTheyLeft) {
  Random random(8);
  for (const NamedShape& named : all_shapes()) {
    uint32_t wrong = 0, doubtful = 0, rays_left = 0;
    for (uint32_t trial = 0; trial < 30; ++trial) {
      const double scale = std::pow(10., double(random.in(-5, 5)));
      const double away = trial % 3 == 0 ? 0 : std::pow(10., double(random.in(-1, 3)));
      const ShapeRow<Value> row =
          shape_row(named.shape, random_placement(random, scale, away), false, glm::dvec3(0.));
      const ShapeScene scene({row});
      std::vector<Ray<Value>> rays;
      std::vector<float> t;
      for (uint32_t i = 0; i < 400; ++i) {
        const auto at = random_point_of(row, random);
        const glm::dvec3 dir = random.direction();
        const double way = double(row.radius) * double(random.in(.1f, 3));
        rays.push_back(ray_of(at.position - way * dir, dir));
        t.push_back(float(way));
      }
      const auto surfaces = surfaces_at(kernels(), scene, rays, t);
      std::vector<Ray<Value>> next;
      for (uint32_t i = 0; i < surfaces.size(); ++i) {
        const Surface<Value>& s = surfaces[i];
        const glm::dvec3 ng(s.ng_x, s.ng_y, s.ng_z);
        glm::dvec3 dir = random.direction();
        if (i % 4 == 0) dir = glm::normalize(dir - ng * (glm::dot(dir, ng) * .9999));
        // As the shade kernels start rays, in floats.
        const float offset = glm::dot(ng, dir) > 0 ? s.offset : -s.offset;
        Ray<Value> ray = ray_of({0, 0, 0}, dir);
        ray.org_x = s.pos_x + offset * s.ng_x;
        ray.org_y = s.pos_y + offset * s.ng_y;
        ray.org_z = s.pos_z + offset * s.ng_z;
        next.push_back(ray);
      }
      const Traced traced(kernels(), scene, next, float(row.radius));
      for (uint32_t i = 0; i < next.size(); ++i) {
        const double exact = reference::meet(row, origin_of(next[i]), direction_of(next[i]));
        const Hit<Value> hit = traced.hits.row(i);
        const double found = hit.prim != kNone ? double(hit.t) : HUGE_VAL;
        ++rays_left;
        // What is known of a place far from the origin, or of a slope that hardly is one.
        const double room = 64 * 0x1p-24 * double(row.extent) + 1e-5 * double(row.radius);
        if (found == exact || std::abs(found - exact) < 1e-2 * exact + room) continue;
        const double nearer = std::min(found, exact);
        const double slack = 10 * std::max(1., double(row.extent) / double(row.radius));
        if (is_doubtful(row, next[i], nearer, slack))
          ++doubtful;
        else
          ++wrong;
      }
    }
    EXPECT_EQ(wrong, 0u) << named.name << " of " << rays_left;
    EXPECT_LT(doubtful, rays_left / 20) << named.name;
  }
}

TEST_P(Shapes, BrokenRaysMissAndSpoilNoOther) {
  Random random(9);
  const float bad[] = {NAN, INFINITY, -INFINITY};
  for (const NamedShape& named : all_shapes()) {
    const ShapeScene scene(
        {shape_row(named.shape, random_placement(random, 1, 0), false, glm::dvec3(0.))});
    std::vector<Ray<Value>> rays;
    for (uint32_t i = 0; i < 64; ++i) rays.push_back(ray_of(random.point(3), random.direction()));
    const Traced before(kernels(), scene, rays, 1);
    for (uint32_t i = 0; i < 64; i += 3) {
      float* const field = i % 2 ? &rays[i].org_y : &rays[i].dir_x;
      *field = bad[i % 3 == 0 ? (i / 3) % 3 : 0];
    }
    const Traced after(kernels(), scene, rays, 1);
    for (uint32_t i = 0; i < 64; ++i) {
      if (i % 3 == 0) {
        EXPECT_EQ(after.hits.row(i).prim, kNone) << named.name << " ray " << i;
        EXPECT_EQ(after.occluded[i], 0u);
      } else {
        EXPECT_EQ(after.hits.row(i).t, before.hits.row(i).t) << named.name;
      }
    }
  }
}

}  // namespace
}  // namespace yat

// The surface kernel against scalar double precision at every count.

#include <algorithm>
#include <cmath>

#include "kernel_columns.h"
#include "surface_vectors.h"

namespace yat {
namespace {

constexpr double kRounding = 0x1p-24;

class SurfaceStage : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(SurfaceStage);

struct Shapes {
  static constexpr uint32_t kEach = 40;
  RowTable<TriangleRow> triangles{kEach};
  RowTable<TriangleVertexRow> vertices{kEach};
  RowTable<SphereRow> spheres{kEach};
  RowTable<PlaneRow> planes{kEach};
  SceneView view;
  explicit Shapes(float scale) {
    Random random(2);
    for (uint32_t i = 0; i < kEach; ++i) {
      TriangleRow<Value> t{};
      const glm::dvec3 p0 = random.point(5 * scale), p1 = p0 + random.point(scale),
                       p2 = p0 + random.point(scale);
      put(p0, t.p0_x, t.p0_y, t.p0_z);
      put(p1, t.p1_x, t.p1_y, t.p1_z);
      put(p2, t.p2_x, t.p2_y, t.p2_z);
      for (const float c : {t.p0_x, t.p0_y, t.p0_z, t.p1_x, t.p1_y, t.p1_z, t.p2_x, t.p2_y, t.p2_z})
        t.extent = std::max(t.extent, std::abs(c));
      t.parameter = i + 100;
      t.light = i % 3 ? kNone : i;
      triangles.set(i, t);
      const glm::dvec3 ng = glm::normalize(glm::cross(p1 - p0, p2 - p0));
      TriangleVertexRow<Value> w{};
      // Some meshes' normals point the wrong way, some cancel.
      const double side = i % 5 == 1 ? -1 : 1;
      put(side * glm::normalize(ng + random.direction() * .5), w.n0_x, w.n0_y, w.n0_z);
      put(side * glm::normalize(ng + random.direction() * .5), w.n1_x, w.n1_y, w.n1_z);
      put(side * glm::normalize(ng + random.direction() * .5), w.n2_x, w.n2_y, w.n2_z);
      if (i % 7 == 2)
        w.n0_x = w.n0_y = w.n0_z = w.n1_x = w.n1_y = w.n1_z = w.n2_x = w.n2_y = w.n2_z = 0;
      w.u0 = 0, w.v0 = 1, w.u1 = 2, w.v1 = 3, w.u2 = 5, w.v2 = 7;
      vertices.set(i, w);
      SphereRow<Value> s{};
      put(random.point(5 * scale), s.center_x, s.center_y, s.center_z);
      s.radius = random.in(.1f, 2) * scale;
      s.inward = i % 2;
      s.parameter = i;
      s.light = i % 4 ? kNone : i;
      spheres.set(i, s);
      PlaneRow<Value> p{};
      put(random.direction(), p.normal_x, p.normal_y, p.normal_z);
      p.distance = random.in(-5, 5) * scale;
      p.parameter = i;
      planes.set(i, p);
    }
    view.geometry.triangles = triangles.view();
    view.geometry.triangle_vertices = vertices.view();
    view.geometry.spheres = spheres.view();
    view.geometry.planes = planes.view();
  }
};

TEST_P(SurfaceStage, SurfacesAreWhatDoublePrecisionSays) {
  const KernelTable& k = kernels();
  for (const float scale : {1.f, 1e-6f, 1e6f}) {
    const Shapes shapes(scale);
    for (uint32_t kind = 0; kind <= uint32_t(GeometryKind::kPlane); ++kind)
      for (const uint32_t n : tail_counts(k.lanes)) {
        Random random(3 + n);
        // Rows in order, in order with gaps, and anyhow: near rows are fetched in another way.
        const uint32_t total = n * 8 + 1;
        GuardedTable<Ray> rays(total);
        GuardedTable<Hit> hits(total);
        GuardedTable<PathState> paths(total);
        GuardedColumn<uint32_t> order(n);
        for (uint32_t i = 0; i < n; ++i)
          order[i] = n % 3 == 0 ? i : n % 3 == 1 ? i + i / 3 : (n - 1 - i) * 8;
        std::vector<glm::dvec3> point(n);
        for (uint32_t i = 0; i < n; ++i) {
          const uint32_t shape = random.below(Shapes::kEach);
          Hit<Value> hit{};
          if (kind < 2) {
            const TriangleRow<Value> t = shapes.triangles.row(shape);
            hit.u = random.unit();
            hit.v = random.unit() * (1 - hit.u);
            const glm::dvec3 p0(t.p0_x, t.p0_y, t.p0_z), p1(t.p1_x, t.p1_y, t.p1_z),
                p2(t.p2_x, t.p2_y, t.p2_z);
            point[i] = p0 + double(hit.u) * (p1 - p0) + double(hit.v) * (p2 - p0);
            hit.prim = shape;
          } else if (kind == 2) {
            const SphereRow<Value> s = shapes.spheres.row(shape);
            point[i] = glm::dvec3(s.center_x, s.center_y, s.center_z) +
                       random.direction() * double(s.radius);
            hit.prim = Shapes::kEach + shape;
          } else {
            const PlaneRow<Value> p = shapes.planes.row(shape);
            const glm::dvec3 normal(p.normal_x, p.normal_y, p.normal_z), q = random.point(scale);
            point[i] = q - normal * (glm::dot(normal, q) - double(p.distance));
            hit.prim = 2 * Shapes::kEach + shape;
          }
          Ray<Value> ray{};
          const glm::dvec3 dir = random.direction();
          hit.t = random.in(.1f, 3) * scale;
          put(point[i] - dir * double(hit.t), ray.org_x, ray.org_y, ray.org_z);
          put(dir, ray.dir_x, ray.dir_y, ray.dir_z);
          PathState<Value> path{};
          path.throughput_r = random.unit();
          path.passed = random.unit() * scale;
          path.slot = i * 3;
          path.depth = i;
          path.pixel = 7 * i;
          rays.set(order[i], ray);
          hits.set(order[i], hit);
          paths.set(order[i], path);
        }
        GuardedTable<Surface> surfaces(n);
        GuardedTable<PathState> dense(n);
        k.make_surfaces[kind](shapes.view, order.data(), rays.view(), hits.view(), paths.view(),
                              surfaces.columns(), dense.columns(), n);
        EXPECT_TRUE(surfaces.untouched() && dense.untouched());
        for (uint32_t i = 0; i < n; ++i) {
          const Surface<Value> s = surfaces.row(i);
          const Hit<Value> hit = hits.row(order[i]);
          const Ray<Value> ray = rays.row(order[i]);
          const PathState<Value> path = paths.row(order[i]), copy = dense.row(i);
          for_each_field([](auto, auto a, auto b) { EXPECT_EQ(a, b); }, path, copy);
          EXPECT_EQ(s.prim, hit.prim);
          EXPECT_EQ(wo_of(s), -glm::dvec3(ray.dir_x, ray.dir_y, ray.dir_z));
          EXPECT_EQ(s.distance, hit.t + path.passed);
          glm::dvec3 ng, ns;
          double magnitude = 0;
          if (kind < 2) {
            const TriangleRow<Value> t = shapes.triangles.row(hit.prim);
            const TriangleVertexRow<Value> w = shapes.vertices.row(hit.prim);
            const glm::dvec3 p0(t.p0_x, t.p0_y, t.p0_z), p1(t.p1_x, t.p1_y, t.p1_z),
                p2(t.p2_x, t.p2_y, t.p2_z);
            ng = ns = glm::normalize(glm::cross(p1 - p0, p2 - p0));
            magnitude = double(t.extent);
            EXPECT_EQ(s.parameter, t.parameter);
            EXPECT_EQ(s.light, t.light);
            if (kind == 1) {
              const double u = double(hit.u), v = double(hit.v);
              const glm::dvec3 sum = (1 - u - v) * glm::dvec3(w.n0_x, w.n0_y, w.n0_z) +
                                     u * glm::dvec3(w.n1_x, w.n1_y, w.n1_z) +
                                     v * glm::dvec3(w.n2_x, w.n2_y, w.n2_z);
              const double side = glm::dot(sum, ng);
              if (side != 0) ns = glm::normalize(sum) * (side < 0 ? -1. : 1.);
              expect_close(double(s.u), 2 * u + 5 * v, 1e-5, "u", i);
              expect_close(double(s.v), 1 + 2 * u + 6 * v, 1e-5, "v", i);
            }
          } else if (kind == 2) {
            const SphereRow<Value> sphere = shapes.spheres.row(hit.prim - Shapes::kEach);
            const glm::dvec3 c(sphere.center_x, sphere.center_y, sphere.center_z);
            ng = ns = glm::normalize(point[i] - c) * (sphere.inward ? -1. : 1.);
            magnitude =
                std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)}) + double(sphere.radius);
            EXPECT_EQ(s.light, sphere.light);
          } else {
            const PlaneRow<Value> plane = shapes.planes.row(hit.prim - 2 * Shapes::kEach);
            ng = ns = {plane.normal_x, plane.normal_y, plane.normal_z};
            magnitude = std::max({std::abs(point[i].x), std::abs(point[i].y), std::abs(point[i].z),
                                  double(std::abs(plane.distance))});
            EXPECT_EQ(s.light, kNone);
          }
          const double normal_error = kind == 2 ? 3e-5 : 3e-4;  // small spheres, needle triangles
          expect_near(ng_of(s), ng, normal_error, "ng", i);
          expect_near(ns_of(s), ns, normal_error, "ns", i);
          EXPECT_GE(glm::dot(ns_of(s), ng_of(s)), 0);
          const double offset =
              32 * kRounding * magnitude * (std::abs(ng.x) + std::abs(ng.y) + std::abs(ng.z));
          expect_close(double(s.offset), offset, 1e-3, "offset", i, 1e-30);
          // The offset must cover the error of the position along the normal.
          EXPECT_LT(std::abs(glm::dot(pos_of(s) - point[i], ng)), double(s.offset)) << i;
          expect_near(pos_of(s), point[i], 4e-6 * double(scale) * 5, "pos", i);
        }
      }
  }
}

TEST_P(SurfaceStage, NormalsOfTinyTrianglesAreUnit) {
  const KernelTable& k = kernels();
  for (const float edge : {1e-18f, 1e-12f, 1e-6f, 1.f, 1e12f, 1e18f}) {
    RowTable<TriangleRow> triangles(1);
    TriangleRow<Value> t{};
    t.p1_x = edge, t.p2_y = edge, t.extent = edge;
    triangles.set(0, t);
    SceneView scene{};
    scene.geometry.triangles = triangles.view();
    GuardedTable<Ray> rays(1);
    GuardedTable<Hit> hits(1);
    GuardedTable<PathState> paths(1);
    rays.set(0, {0, 0, 1, 0, 0, -1, kRayFar});
    hits.set(0, {1, .25f, .25f, 0});
    paths.set(0, PathState<Value>{});
    const uint32_t order[16] = {0};
    GuardedTable<Surface> surfaces(1);
    GuardedTable<PathState> dense(1);
    k.make_surfaces[0](scene, order, rays.view(), hits.view(), paths.view(), surfaces.columns(),
                       dense.columns(), 1);
    EXPECT_EQ(surfaces.row(0).ng_z, 1.f) << edge;
    EXPECT_GT(surfaces.row(0).offset, 0.f) << edge;
  }
}

}  // namespace
}  // namespace yat

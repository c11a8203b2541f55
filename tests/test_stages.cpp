// Stage kernels against scalar double precision at every count: classify, surfaces, shading,
// accumulation. Depth, roulette, crossings and drops.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "kernel_columns.h"
#include "kernels/materials/all.h"

namespace yat {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kRounding = 0x1p-24;

class Stages : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(Stages);

void put(const glm::dvec3& v, float& x, float& y, float& z) {
  x = float(v.x), y = float(v.y), z = float(v.z);
}
glm::dvec3 pos_of(const Surface<Value>& s) {
  return {s.pos_x, s.pos_y, s.pos_z};
}
glm::dvec3 ng_of(const Surface<Value>& s) {
  return {s.ng_x, s.ng_y, s.ng_z};
}
glm::dvec3 ns_of(const Surface<Value>& s) {
  return {s.ns_x, s.ns_y, s.ns_z};
}
glm::dvec3 wo_of(const Surface<Value>& s) {
  return {s.wo_x, s.wo_y, s.wo_z};
}

TEST_P(Stages, ClassifyGivesBinsMissesAndLastVertices) {
  const KernelTable& k = kernels();
  Random random(1);
  AlignedArray<uint32_t> prim_bin(100);
  for (uint32_t& b : prim_bin) b = 1 + random.below(600);
  const uint32_t first_lasting = 300;
  for (const uint32_t n : tail_counts(k.lanes)) {
    GuardedTable<Hit> hits(n);
    GuardedColumn<uint32_t> depth(n), bin(n);
    for (uint32_t i = 0; i < n; ++i) {
      hits.set(i, {1, 0, 0, random.below(5) ? random.below(100) : kNone});
      depth[i] = random.below(8) | random.below(3) << 16;
    }
    k.classify_hits(prim_bin.data(), first_lasting, 5, hits.view(), depth.data(), bin.data(), n);
    EXPECT_TRUE(bin.untouched());
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t prim = hits.row(i).prim;
      uint32_t wanted = prim == kNone ? 0 : prim_bin[prim];
      if ((depth[i] & 0xffff) >= 5 && wanted < first_lasting) wanted = 0;
      EXPECT_EQ(bin[i], wanted);
    }
  }
}

// ---- Surfaces --------------------------------------------------------------------------------

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

TEST_P(Stages, SurfacesAreWhatDoublePrecisionSays) {
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

TEST_P(Stages, NormalsOfTinyTrianglesAreUnit) {
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

// ---- Shading ---------------------------------------------------------------------------------

/// Inputs and outputs of one shade call: random surfaces seen from random sides.
struct ShadeCase {
  uint32_t n;
  GuardedTable<Surface> surfaces;
  GuardedTable<PathState> paths;
  GuardedTable<Randoms> randoms;
  GuardedTable<LightSample> lights;
  GuardedTable<Ray> rays;
  GuardedTable<PathState> next;
  GuardedTable<ShadowRay> shadows;
  GuardedColumn<uint32_t> finished;
  ShadeOutput out;
  DropLog drops;
  TransportOptions options;

  explicit ShadeCase(uint32_t rows, uint32_t seed = 1)
      : n(rows),
        surfaces(n),
        paths(n),
        randoms(n),
        lights(n),
        rays(n + 16),
        next(n + 16),
        shadows(n + 16),
        finished(n + 16) {
    options.roulette_depth = 100;
    Random random(seed + rows);
    for (uint32_t i = 0; i < n; ++i) {
      Surface<Value> s{};
      const glm::dvec3 ng = random.direction();
      glm::dvec3 ns = glm::normalize(ng + random.direction() * (i % 2 ? .4 : 0.));
      const glm::dvec3 wo = random.direction();
      put(random.point(5), s.pos_x, s.pos_y, s.pos_z);
      put(ng, s.ng_x, s.ng_y, s.ng_z);
      put(ns, s.ns_x, s.ns_y, s.ns_z);
      put(wo, s.wo_x, s.wo_y, s.wo_z);
      s.offset = 1e-5f;
      s.distance = random.in(1, 2);
      s.parameter = random.below(3);
      s.light = kNone;
      surfaces.set(i, s);
      PathState<Value> p{};
      p.throughput_r = random.unit(), p.throughput_g = random.unit(), p.throughput_b = 1;
      p.pdf = random.unit();
      p.slot = 1000 + i;
      p.pixel = 5000 + i;
      p.sample = 9000 + i;
      p.depth = (i % 5) | 3u << 16;
      paths.set(i, p);
      randoms.set(i, {random.unit(), random.unit(), random.unit(), random.unit(), random.unit(),
                      random.unit(), random.unit()});
      LightSample<Value> l{};
      const glm::dvec3 wi = random.direction();
      put(wi, l.wi_x, l.wi_y, l.wi_z);
      put(pos_of(s) + wi * 3., l.to_x, l.to_y, l.to_z);
      l.weight_r = i % 6 == 5 ? 0 : random.unit();
      l.weight_g = i % 6 == 5 ? 0 : .5f;
      l.weight_b = 0;
      l.pdf = i % 3 ? random.in(.1f, 2) : 0;
      lights.set(i, l);
    }
    out.rays = rays.columns();
    out.paths = next.columns();
    out.shadow_rays = shadows.columns();
    out.finished = finished.data();
  }
  void run(const KernelTable& k, MaterialKind kind, ParameterView parameters, bool with_lights) {
    ShadeInput in{surfaces.view(), paths.view(), randoms.view(), {}, parameters};
    if (with_lights) in.lights = lights.view();
    k.shade[uint32_t(kind)](in, options, out, drops, n);
    EXPECT_TRUE(rays.untouched() && next.untouched() && shadows.untouched() &&
                finished.untouched());
    EXPECT_LE(out.shadow_count, n);
    EXPECT_EQ(out.path_count + out.finished_count, n) << "each path goes on or ends";
  }
};

/// The frame rule of kernels/material.h: normals on wo's side, ng where ns cannot see wo.
struct Normals {
  glm::dvec3 ng, ns;
  explicit Normals(const Surface<Value>& s) : ng(ng_of(s)), ns(ns_of(s)) {
    if (glm::dot(ng, wo_of(s)) <= 0) ng = -ng, ns = -ns;
    if (glm::dot(ns, wo_of(s)) <= 0) ns = ng;
  }
};

RowTable<MatteParameters> matte_rows() {
  RowTable<MatteParameters> rows(3);
  rows.set(0, {.5f, .5f, .5f});
  rows.set(1, {1, .25f, .75f});
  rows.set(2, {.1f, .9f, 0});
  return rows;
}

TEST_P(Stages, MatteShadingIsWhatDoublePrecisionSays) {
  const KernelTable& k = kernels();
  const auto rows = matte_rows();
  for (const uint32_t n : tail_counts(k.lanes)) {
    ShadeCase c(n);
    c.options.max_depth = 4;
    c.run(k, MaterialKind::kMatte, {rows.view().words, 3}, true);
    for (const uint64_t count : c.drops.count) EXPECT_EQ(count, 0u);
    uint32_t shadow = 0, next = 0, ended = 0;
    for (uint32_t i = 0; i < n; ++i) {
      const Surface<Value> s = c.surfaces.row(i);
      const PathState<Value> p = c.paths.row(i);
      const LightSample<Value> l = c.lights.row(i);
      const Normals normals(s);
      const MatteParameters<Value> kd = rows.row(s.parameter);
      const glm::dvec3 albedo(kd.kd_r, kd.kd_g, kd.kd_b);
      const glm::dvec3 throughput(p.throughput_r, p.throughput_g, p.throughput_b);
      const bool last = (p.depth & 0xffff) >= 4;
      const glm::dvec3 wi(l.wi_x, l.wi_y, l.wi_z);
      const double cos = glm::dot(normals.ns, wi), geometric = glm::dot(normals.ng, wi);
      if (!last && l.weight_r > 0 && cos > 0 && geometric > 0) {
        ASSERT_LT(shadow, c.out.shadow_count);
        const ShadowRay<Value> ray = c.shadows.row(shadow++);
        const double ratio = l.pdf > 0 ? cos / kPi / double(l.pdf) : 0;
        const glm::dvec3 add = throughput * albedo / kPi * cos *
                               glm::dvec3(l.weight_r, l.weight_g, l.weight_b) / (1 + ratio * ratio);
        EXPECT_EQ(ray.slot, p.slot);
        expect_near({ray.add_r, ray.add_g, ray.add_b}, add, 2e-6, "direct light", i);
        const glm::dvec3 org(ray.org_x, ray.org_y, ray.org_z), dir(ray.dir_x, ray.dir_y, ray.dir_z);
        expect_near(org, pos_of(s) + normals.ng * double(s.offset), 2e-6, "shadow origin", i);
        expect_near(org + dir, {l.to_x, l.to_y, l.to_z}, 3e-6, "shadow end", i);
      }
      // The next ray: below the geometric horizon it ends.
      const bool goes_on = next < c.out.path_count && c.next.row(next).slot == p.slot;
      if (last) {
        EXPECT_FALSE(goes_on);
      }
      if (!goes_on) {
        ASSERT_LT(ended, c.out.finished_count);
        EXPECT_EQ(c.finished[ended++], p.slot);
        if (!last && i % 2 == 0) ADD_FAILURE() << "ns = ng: no direction lies below";
        continue;
      }
      const PathState<Value> q = c.next.row(next);
      const Ray<Value> ray = c.rays.row(next++);
      const glm::dvec3 dir(ray.dir_x, ray.dir_y, ray.dir_z);
      expect_close(glm::length(dir), 1, 1e-6, "|dir|", i);
      EXPECT_GT(glm::dot(dir, normals.ng), 0);
      expect_near({q.throughput_r, q.throughput_g, q.throughput_b}, throughput * albedo, 1e-6,
                  "throughput", i);
      EXPECT_NEAR(q.pdf, glm::dot(dir, normals.ns) / kPi, 1e-6);
      expect_near({ray.org_x, ray.org_y, ray.org_z}, pos_of(s) + normals.ng * double(s.offset),
                  2e-6, "origin", i);
      EXPECT_EQ(ray.t_max, kRayFar);
      EXPECT_EQ(q.passed, 0.f);
      EXPECT_EQ(q.depth, p.depth + 1) << "one vertex more, crossings kept";
      EXPECT_EQ(q.pixel, p.pixel);
      EXPECT_EQ(q.sample, p.sample);
    }
    EXPECT_EQ(shadow, c.out.shadow_count);
    EXPECT_EQ(next, c.out.path_count);
  }
}

TEST_P(Stages, OutputsAreAppended) {
  const KernelTable& k = kernels();
  const auto rows = matte_rows();
  ShadeCase c(20);
  c.options.max_depth = 3;
  c.out.path_count = 5, c.out.shadow_count = 7, c.out.finished_count = 2;
  ShadeInput in{
      c.surfaces.view(), c.paths.view(), c.randoms.view(), c.lights.view(), {rows.view().words, 3}};
  k.shade[uint32_t(MaterialKind::kMatte)](in, c.options, c.out, c.drops, 20);
  for (uint32_t i = 0; i < 5; ++i) EXPECT_EQ(c.next.row(i).slot, kPattern);
  for (uint32_t i = 0; i < 7; ++i) EXPECT_EQ(c.shadows.row(i).slot, kPattern);
  for (uint32_t i = 0; i < 2; ++i) EXPECT_EQ(c.finished[i], kPattern);
  EXPECT_EQ(c.out.path_count - 5 + c.out.finished_count - 2, 20u);
}

// Invariant 1: a row's result does not depend on where it stands or on what is beside it.
TEST_P(Stages, RowsAreIndependent) {
  const KernelTable& k = kernels();
  const auto rows = matte_rows();
  ShadeCase all(37);
  all.run(k, MaterialKind::kMatte, {rows.view().words, 3}, true);
  std::map<uint32_t, Ray<Value>> ray_of;
  std::map<uint32_t, float> add_of;
  for (uint32_t i = 0; i < all.out.path_count; ++i) ray_of[all.next.row(i).slot] = all.rays.row(i);
  for (uint32_t i = 0; i < all.out.shadow_count; ++i)
    add_of[all.shadows.row(i).slot] = all.shadows.row(i).add_r;
  for (uint32_t i = 0; i < 37; ++i) {
    ShadeCase one(1);
    one.surfaces.set(0, all.surfaces.row(i));
    one.paths.set(0, all.paths.row(i));
    one.randoms.set(0, all.randoms.row(i));
    one.lights.set(0, all.lights.row(i));
    one.run(k, MaterialKind::kMatte, {rows.view().words, 3}, true);
    const uint32_t slot = all.paths.row(i).slot;
    ASSERT_EQ(one.out.path_count, ray_of.count(slot));
    ASSERT_EQ(one.out.shadow_count, add_of.count(slot));
    if (one.out.path_count)
      for_each_field([](auto, auto a, auto b) { EXPECT_EQ(a, b); }, one.rays.row(0), ray_of[slot]);
    if (one.out.shadow_count) {
      EXPECT_EQ(one.shadows.row(0).add_r, add_of[slot]);
    }
  }
}

TEST_P(Stages, GlassAndMirrorGoOnWithoutDensity) {
  const KernelTable& k = kernels();
  RowTable<MirrorParameters> mirror(1);
  mirror.set(0, {.5f, .25f, 1});
  RowTable<GlassParameters> glass(1);
  glass.set(0, {1, 1, 1, 1, 1, 1, 1.5f});
  for (const uint32_t n : tail_counts(k.lanes)) {
    for (const MaterialKind kind : {MaterialKind::kMirror, MaterialKind::kGlass}) {
      ShadeCase c(n);
      c.options.least_depth_after_scatter = 9;  // only for materials that scatter
      c.run(k, kind, {kind == MaterialKind::kMirror ? mirror.view().words : glass.view().words, 1},
            false);
      EXPECT_EQ(c.out.shadow_count, 0u);
      std::map<uint32_t, uint32_t> row_of;
      for (uint32_t i = 0; i < n; ++i) row_of[c.paths.row(i).slot] = i;
      for (uint32_t j = 0; j < c.out.path_count; ++j) {
        const PathState<Value> q = c.next.row(j);
        const Ray<Value> ray = c.rays.row(j);
        const uint32_t i = row_of[q.slot];
        const Surface<Value> s = c.surfaces.row(i);
        const Normals normals(s);
        const glm::dvec3 wo = wo_of(s), dir(ray.dir_x, ray.dir_y, ray.dir_z);
        EXPECT_EQ(q.pdf, 0.f);
        EXPECT_EQ(q.depth, c.paths.row(i).depth + 1);
        const double side = glm::dot(dir, normals.ng) > 0 ? 1 : -1;
        expect_near({ray.org_x, ray.org_y, ray.org_z},
                    pos_of(s) + normals.ng * (double(s.offset) * side), 2e-6, "origin", i);
        const glm::dvec3 reflected = normals.ns * (2 * glm::dot(normals.ns, wo)) - wo;
        if (side > 0) {
          expect_near(dir, reflected, 2e-6, "reflection", i);
        } else {
          const bool outside = glm::dot(ng_of(s), wo) > 0;
          const double eta = outside ? 1 / 1.5 : 1.5;
          const glm::dvec3 tangential = (wo - normals.ns * glm::dot(normals.ns, wo)) * -eta;
          expect_near(dir - normals.ns * glm::dot(normals.ns, dir), tangential, 3e-6, "Snell", i);
        }
      }
    }
  }
}

TEST_P(Stages, NullLetsPathsPassAndCountsCrossings) {
  const KernelTable& k = kernels();
  RowTable<NullParameters> rows(1);
  for (const uint32_t n : tail_counts(k.lanes)) {
    ShadeCase c(n);
    c.options.max_depth = 2;  // does not end a path here: what is behind may still shine
    uint32_t over = 0;
    for (uint32_t i = 3; i < n; i += 5, ++over) {
      PathState<Value> p = c.paths.row(i);
      p.depth = 0xffff0000u | 1;
      c.paths.set(i, p);
    }
    c.run(k, MaterialKind::kNull, {rows.view().words, 1}, false);
    EXPECT_EQ(c.drops.count[uint32_t(DropCause::kCrossings)], over);
    EXPECT_EQ(c.out.finished_count, over);
    uint32_t j = 0;
    for (uint32_t i = 0; i < n; ++i) {
      if (i % 5 == 3) continue;
      const PathState<Value> p = c.paths.row(i), q = c.next.row(j);
      const Surface<Value> s = c.surfaces.row(i);
      const Ray<Value> ray = c.rays.row(j++);
      const glm::dvec3 dir(ray.dir_x, ray.dir_y, ray.dir_z);
      EXPECT_EQ(dir, -wo_of(s));
      EXPECT_EQ(q.depth, p.depth + 0x10000u);
      EXPECT_EQ(q.pdf, p.pdf);
      EXPECT_EQ(q.passed, s.distance);
      EXPECT_EQ(q.throughput_g, p.throughput_g);
      const double side = glm::dot(ng_of(s), dir) > 0 ? 1 : -1;
      expect_near({ray.org_x, ray.org_y, ray.org_z},
                  pos_of(s) + ng_of(s) * (double(s.offset) * side), 2e-6, "origin", i);
    }
    EXPECT_EQ(j, c.out.path_count);
  }
}

TEST_P(Stages, DirectIntegratorEndsAfterScattering) {
  const KernelTable& k = kernels();
  const auto rows = matte_rows();
  ShadeCase c(50);
  c.options.max_depth = 8;
  c.options.least_depth_after_scatter = 8;
  c.run(k, MaterialKind::kMatte, {rows.view().words, 3}, true);
  ASSERT_GT(c.out.path_count, 0u);
  for (uint32_t i = 0; i < c.out.path_count; ++i) EXPECT_EQ(c.next.row(i).depth, 8u | 3u << 16);
}

// Roulette keeps the expectation: over many rows that differ in the roulette number alone, the mean
// throughput is the one without roulette, and no survivor's grows above a third.
TEST_P(Stages, RouletteIsUnbiased) {
  const KernelTable& k = kernels();
  RowTable<MatteParameters> rows(1);
  rows.set(0, {.5f, .2f, .1f});
  constexpr uint32_t n = 10000;
  for (const float sign : {1.f, -1.f}) {  // negative: a filter's lobe
    ShadeCase c(n);
    for (uint32_t i = 0; i < n; ++i) {
      c.surfaces.set(i, c.surfaces.row(0));
      PathState<Value> p = c.paths.row(0);
      p.throughput_r = p.throughput_g = p.throughput_b = .4f * sign;
      p.depth = 3;
      p.slot = i;
      c.paths.set(i, p);
      Randoms<Value> r = c.randoms.row(0);
      r.bsdf_u = .3f, r.bsdf_v = .6f;
      r.roulette = (float(i) + .5f) / n;
      c.randoms.set(i, r);
    }
    c.options.roulette_depth = 3;
    c.run(k, MaterialKind::kMatte, {rows.view().words, 1}, false);
    glm::dvec3 sum(0);
    for (uint32_t i = 0; i < c.out.path_count; ++i) {
      const PathState<Value> q = c.next.row(i);
      EXPECT_LE(std::abs(q.throughput_r), 1.f / 3 + 1e-6f);
      sum += glm::dvec3(q.throughput_r, q.throughput_g, q.throughput_b) / double(n);
    }
    EXPECT_NEAR(c.out.path_count / double(n), .6, 1e-3);
    expect_near(sum, glm::dvec3(.2, .08, .04) * double(sign), 1e-4, "mean throughput", 0);
    for (uint32_t i = 0; i < n; ++i) {
      PathState<Value> p = c.paths.row(i);
      p.depth = 2;
      c.paths.set(i, p);
    }
    c.out.path_count = c.out.finished_count = 0;
    c.run(k, MaterialKind::kMatte, {rows.view().words, 1}, false);
    EXPECT_EQ(c.out.path_count, n) << "not before its depth";
  }
}

// N1: one poisoned lane among others. It is dropped and counted; the others are as without it.
TEST_P(Stages, PoisonedRowsAreDroppedCountedAndAlone) {
  const KernelTable& k = kernels();
  const auto rows = matte_rows();
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = INFINITY;
  struct Poison {
    const char* what;
    DropCause cause;
    uint64_t drops;  ///< direct light and next ray count by themselves
    void (*apply)(ShadeCase&, uint32_t, float);
  };
  const Poison poisons[] = {{"light", DropCause::kLight, 1,
                             [](ShadeCase& c, uint32_t i, float x) {
                               auto l = c.lights.row(i);
                               l.weight_g = x;
                               c.lights.set(i, l);
                             }},
                            {"throughput", DropCause::kOther, 2,
                             [](ShadeCase& c, uint32_t i, float x) {
                               auto p = c.paths.row(i);
                               p.throughput_g = x == -1 ? INFINITY : x;
                               c.paths.set(i, p);
                             }},
                            {"material", DropCause::kBsdf, 2, [](ShadeCase& c, uint32_t i, float) {
                               auto s = c.surfaces.row(i);
                               s.parameter = 3;
                               c.surfaces.set(i, s);
                             }}};
  for (const Poison& poison : poisons)
    for (const float bad : {nan, inf, -1.f}) {
      SCOPED_TRACE(std::string(poison.what) + " " + std::to_string(bad));
      RowTable<MatteParameters> table(4);
      for (uint32_t i = 0; i < 3; ++i) table.set(i, rows.row(i));
      table.set(3, {.5f, bad, .5f});
      ShadeCase clean(53), poisoned(53);
      clean.run(k, MaterialKind::kMatte, {table.view().words, 4}, true);
      // A row that has both a shadow ray and a next ray.
      uint32_t slot = 0;
      for (uint32_t i = 0; i < clean.out.shadow_count; ++i)
        for (uint32_t j = 0; j < clean.out.path_count; ++j)
          if (clean.shadows.row(i).slot == clean.next.row(j).slot) slot = clean.next.row(j).slot;
      ASSERT_NE(slot, 0u);
      poison.apply(poisoned, slot - 1000, bad);
      poisoned.run(k, MaterialKind::kMatte, {table.view().words, 4}, true);
      for (uint32_t cause = 0; cause < kDropCauses; ++cause)
        EXPECT_EQ(poisoned.drops.count[cause], cause == uint32_t(poison.cause) ? poison.drops : 0u);
      ASSERT_EQ(poisoned.drops.kept, poison.drops);
      EXPECT_EQ(poisoned.drops.entry[0].pixel, 5000 + slot - 1000);
      EXPECT_EQ(poisoned.drops.entry[0].sample, 9000 + slot - 1000);
      // All others, bit for bit.
      uint32_t j = 0;
      for (uint32_t i = 0; i < clean.out.shadow_count; ++i) {
        const ShadowRay<Value> ray = clean.shadows.row(i);
        if (ray.slot == slot) continue;
        for_each_field([](auto, auto a, auto b) { EXPECT_EQ(a, b); }, ray,
                       poisoned.shadows.row(j++));
      }
      EXPECT_EQ(j, poisoned.out.shadow_count);
      for (uint32_t i = 0, m = 0; i < clean.out.path_count; ++i) {
        const PathState<Value> path = clean.next.row(i);
        if (path.slot == slot && poison.drops == 2) continue;
        for_each_field([](auto, auto a, auto b) { EXPECT_EQ(a, b); }, path, poisoned.next.row(m++));
      }
    }
}

// Shading normals of every tilt, and unit vectors that are not (B5): nothing but numbers comes out.
TEST_P(Stages, ShadingNormalsBeyondTheHorizonGiveNumbers) {
  const KernelTable& k = kernels();
  const auto rows = matte_rows();
  constexpr uint32_t n = 1000;
  ShadeCase c(n);
  Random random(9);
  for (uint32_t i = 0; i < n; ++i) {
    Surface<Value> s = c.surfaces.row(i);
    const glm::dvec3 ng = ng_of(s);
    glm::dvec3 ns = random.direction();
    if (glm::dot(ns, ng) < 0) ns = -ns;
    glm::dvec3 wo = wo_of(s);
    if (i % 4 == 0) wo = glm::normalize(wo - ng * glm::dot(wo, ng));  // grazing
    if (i % 8 == 1) ns = {0, 0, -1};
    put(ns, s.ns_x, s.ns_y, s.ns_z);
    put(wo, s.wo_x, s.wo_y, s.wo_z);
    c.surfaces.set(i, s);
  }
  c.run(k, MaterialKind::kMatte, {rows.view().words, 3}, true);
  for (const uint64_t count : c.drops.count) EXPECT_EQ(count, 0u);
  for (uint32_t i = 0; i < c.out.path_count; ++i) {
    EXPECT_TRUE(std::isfinite(c.rays.row(i).dir_x) && c.next.row(i).pdf > 0);
    EXPECT_LE(c.next.row(i).throughput_r, 1.f);
  }
  EXPECT_GT(c.out.path_count, n / 2);
}

TEST_P(Stages, FreeShadowRaysAreAddedOnce) {
  const KernelTable& k = kernels();
  Random random(4);
  for (const uint32_t n : tail_counts(k.lanes)) {
    GuardedTable<ShadowRay> rays(n);
    GuardedColumn<uint32_t> occluded(n);
    GuardedTable<SampleSum> sums(2 * n);
    for (uint32_t i = 0; i < 2 * n; ++i) sums.set(i, {float(i), 1, 2, i});
    for (uint32_t i = 0; i < n; ++i) {
      ShadowRay<Value> r{};
      r.add_r = random.unit(), r.add_g = random.unit(), r.add_b = random.unit();
      r.slot = 2 * (n - 1 - i);
      rays.set(i, r);
      occluded[i] = random.below(2);
    }
    k.add_unoccluded(rays.view(), occluded.data(), sums.columns(), n);
    EXPECT_TRUE(sums.untouched(2 * n));
    for (uint32_t i = 0; i < n; ++i) {
      const ShadowRay<Value> r = rays.row(i);
      const SampleSum<Value> s = sums.row(r.slot), other = sums.row(r.slot + 1);
      const float free = occluded[i] ? 0.f : 1.f;
      EXPECT_EQ(s.r, float(r.slot) + free * r.add_r);
      EXPECT_EQ(s.g, 1 + free * r.add_g);
      EXPECT_EQ(s.b, 2 + free * r.add_b);
      EXPECT_EQ(s.pixel, r.slot);
      EXPECT_EQ(other.r, float(r.slot + 1));
    }
  }
}

}  // namespace
}  // namespace yat

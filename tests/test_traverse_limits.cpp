// Traversal where numbers are at their limits: watertightness, poison, huge scenes, self hits.

#include <limits>

#include "per_isa.h"
#include "traverse_scenes.h"

namespace yat {
namespace {

using namespace testing_traverse;

class TraverseLimits : public PerIsa {
 protected:
  ThreadPool pool{1};
  Tree build(const Mesh& mesh) {
    Tree tree = build_tree(mesh.rows.view(), {}, {16, false}, pool);
    EXPECT_EQ(verify_tree(tree, mesh.rows.view()), "");
    return tree;
  }
};
YAT_INSTANTIATE_PER_ISA(TraverseLimits);

// I1. Rays from inside a closed mesh leave it nowhere.
TEST_P(TraverseLimits, ClosedMeshesAreWatertight) {
  struct Place {
    double scale;
    Vec center;
  };
  std::vector<Place> places = {{2, {148376, 1234, -223423}}};
  for (const double scale : {1e-6, 1e-3, 1., 1e3, 1e6}) {
    places.push_back({scale, {}});
    places.push_back({scale, {30 * scale, -1000 * scale, 7 * scale}});
  }
  for (const Place& place : places)
    for (const double jitter : {0.0, 0.1}) {
      const Mesh mesh = closed_sphere(30, place.center, place.scale, jitter);
      const Tree tree = build(mesh);
      Rng rng(31);
      std::vector<Ray<Value>> rays;
      for (uint32_t i = 0; i < 20000; ++i) {
        const Vec o = place.center + random_point(rng, 0.4 * place.scale);
        const Ray<Value> at = make_ray(o, {1, 0, 0});
        const Vec from{double(at.org_x), double(at.org_y), double(at.org_z)};
        const uint32_t prim = rng() % uint32_t(mesh.list.size());
        const Vec a = mesh.corner(prim, int(rng() % 3)), b = mesh.corner(prim, 0);
        Vec d = random_direction(rng);
        if (i % 3 == 1) d = unit(a - from);
        if (i % 3 == 2) d = unit(a + (b - a) * uniform(rng) - from);
        rays.push_back(make_ray(o, d));
      }
      const std::vector<Hit<Value>> hits = trace(kernels(), tree.view, rays);
      uint32_t leaks = 0;
      for (const auto& h : hits) leaks += h.prim == kNone;
      EXPECT_EQ(leaks, 0u) << "scale " << place.scale << " at " << place.center.x << " jitter "
                           << jitter;
    }
}

// Rays from far outside that aim at a closed mesh's inside meet it.
TEST_P(TraverseLimits, FarOriginsStillHit) {
  const Mesh mesh = closed_sphere(24, {}, 1);
  const Tree tree = build(mesh);
  for (const double distance : {3., 30., 1e3, 1e5}) {
    Rng rng(7);
    std::vector<Ray<Value>> rays, segments;
    for (uint32_t i = 0; i < 5000; ++i) {
      const Vec o = random_direction(rng) * distance;
      const Vec target = random_direction(rng) * 0.5;
      rays.push_back(make_ray(o, unit(target - o)));
      segments.push_back(make_ray(o, target - o));
    }
    const std::vector<Hit<Value>> hits = trace(kernels(), tree.view, rays);
    const std::vector<uint32_t> occluded = trace_shadow(kernels(), tree.view, segments);
    for (uint32_t i = 0; i < rays.size(); ++i) {
      ASSERT_NE(hits[i].prim, kNone) << "distance " << distance << " ray " << i;
      ASSERT_NEAR(double(hits[i].t), distance, 1.01 + distance * 1e-6);
      ASSERT_EQ(occluded[i], 1u);
    }
  }
}

// I5. A poisoned ray misses, and its neighbours do not notice.
TEST_P(TraverseLimits, PoisonedRaysMissAlone) {
  const Mesh mesh = soup(500, 0.3, 3);
  const Tree tree = build(mesh);
  const std::vector<Ray<Value>> clean = rays_through(mesh, 300, 4);
  const std::vector<Hit<Value>> expected = trace(kernels(), tree.view, clean);
  std::vector<Ray<Value>> segments = clean;
  const std::vector<uint32_t> clean_shadow = trace_shadow(kernels(), tree.view, segments);
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              inf = std::numeric_limits<float>::infinity();
  for (const float poison : {nan, inf, -inf})
    for (uint32_t field = 0; field < 7; ++field) {
      std::vector<Ray<Value>> rays = clean;
      const auto spoiled = [](uint32_t i) { return i % 7 == 3 || (i > 100 && i < 120); };
      for (uint32_t i = 0; i < rays.size(); ++i)
        if (spoiled(i)) (&rays[i].org_x)[field] = poison;
      const std::vector<Hit<Value>> hits = trace(kernels(), tree.view, rays);
      const std::vector<uint32_t> shadow = trace_shadow(kernels(), tree.view, rays);
      for (uint32_t i = 0; i < rays.size(); ++i) {
        if (spoiled(i)) {
          if (field == 6 && poison == inf) continue;  // No limit at all is a fair wish.
          ASSERT_EQ(hits[i].prim, kNone) << poison << " in field " << field << " ray " << i;
          if (field < 6) {
            ASSERT_EQ(shadow[i], 0u);
          }
        } else {
          ASSERT_TRUE(same_bits(hits[i], expected[i])) << poison << " field " << field;
          ASSERT_EQ(shadow[i], clean_shadow[i]);
        }
      }
    }
  std::vector<Ray<Value>> still(20, make_ray({}, {0, 0, 0}));
  for (const auto& h : trace(kernels(), tree.view, still)) EXPECT_EQ(h.prim, kNone);
  std::vector<Ray<Value>> tiny(20, make_ray({}, {1e-40, 0, 0}));
  trace(kernels(), tree.view, tiny);
}

// I2. Triangles of any size are hit at their middle.
TEST_P(TraverseLimits, TrianglesOfAnySize) {
  for (int e = -18; e <= 18; e += 2) {
    const double s = std::pow(10., e);
    Mesh mesh;
    mesh.add({-s, -s, 2 * s}, {s, -s, 2 * s}, {0, 2 * s, 2 * s});
    mesh.done();
    const Tree tree = build(mesh);
    const std::vector<Ray<Value>> rays(3, make_ray({0, 0, 0}, {0, 0, 1}));
    for (const auto& h : trace(kernels(), tree.view, rays)) {
      ASSERT_EQ(h.prim, 0u) << "size 1e" << e;
      ASSERT_NEAR(double(h.t) / (2 * s), 1, 1e-6);
    }
  }
}

// I8. A cube 5.9e11 wide and 1.2e5 high: no invented hits.
TEST_P(TraverseLimits, HugeFlatBox) {
  Mesh mesh;
  add_box(mesh, {-2.95e11, -2.95e11, -6e4}, {2.95e11, 2.95e11, 6e4});
  mesh.done();
  const Tree tree = build(mesh);
  Rng rng(2);
  std::vector<Ray<Value>> rays;
  for (uint32_t i = 0; i < 5000; ++i) {
    const Vec o{uniform(rng, -1e11, 1e11), uniform(rng, -1e11, 1e11), uniform(rng, -5e4, 5e4)};
    rays.push_back(make_ray(o, random_direction(rng)));
  }
  const std::vector<Hit<Value>> hits = trace(kernels(), tree.view, rays);
  uint32_t inside = 0;
  for (uint32_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(check_hit(mesh, rays[i], hits[i]), "") << "ray " << i;
    // The room is closed. Sheared coordinates are as large as the corners, whose ulp is 32768: a
    // ray that starts nearer than that to the face it moves to may be behind it by rounding, and
    // it alone may escape.
    const Ray<Value>& r = rays[i];
    const double to_face = 6e4 - double(r.dir_z > 0 ? r.org_z : -r.org_z);
    if (to_face <= 32768) continue;
    ++inside;
    EXPECT_NE(hits[i].prim, kNone) << "ray " << i << ", " << to_face << " below its face";
  }
  EXPECT_GT(inside, 3000u);
}

// I4. Degenerate triangles are never hit; what has area between them is.
TEST_P(TraverseLimits, DegenerateTrianglesAreNeverHit) {
  Mesh mesh;
  Rng rng(4);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (uint32_t i = 0; i < 200; ++i) {
    const Vec a = random_point(rng), b = random_point(rng);
    mesh.add(a, a, b);
    mesh.add(a, a, a);
    mesh.add({0, 0, 0}, {1, 2, 3}, {2, 4, 6});
    mesh.add(a, {double(nan), 0, 0}, b);
    mesh.add(a, {double(std::numeric_limits<float>::infinity()), 0, 0}, b);
  }
  mesh.add({-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
  mesh.done();
  const Tree tree = build(mesh);
  EXPECT_EQ(tree.statistics.references, 1u);
  uint32_t found = 0;
  for (const auto& h : trace(kernels(), tree.view, rays_through(mesh, 3000, 9))) {
    ASSERT_TRUE(h.prim == kNone || h.prim == 1000u);
    found += h.prim == 1000u;
  }
  EXPECT_GT(found, 50u);
}

// A far ray is moved near before it is traced; one that ends before it comes near meets nothing.
TEST_P(TraverseLimits, FarRaysThatEndEarlyMissAndAreFree) {
  Mesh mesh;
  add_box(mesh, {-1, -1, -1}, {1, 1, 1});
  mesh.done();
  const Tree tree = build(mesh);
  Rng rng(12);
  std::vector<Ray<Value>> rays, segments;
  for (uint32_t i = 0; i < 300; ++i) {
    const Vec o = random_direction(rng) * uniform(rng, 20, 1e4);
    const Vec to = random_point(rng) * .9;
    const double way = std::sqrt(dot(to - o, to - o));
    const double end = i % 2 ? way - 4 : way;
    rays.push_back(make_ray(o, unit(to - o), float(end)));
    segments.push_back(make_ray(o, unit(to - o) * end));  // for shadows: to t = 1
  }
  const std::vector<Hit<Value>> hits = trace(kernels(), tree.view, rays);
  const std::vector<uint32_t> occluded = trace_shadow(kernels(), tree.view, segments);
  for (uint32_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(hits[i].prim == kNone, i % 2 == 1) << i;
    EXPECT_EQ(occluded[i], uint32_t(i % 2 == 0)) << i;
  }
}

// A shadow ray that enters every box of a tree makes more short lists than may wait for their turn.
TEST_P(TraverseLimits, ShortListsBeyondTheRingLoseNoOccluder) {
  // Large triangles in planes around the rays and parallel to them: all boxes, no hits.
  const Vec along{1, 1, 1}, across = unit(Vec{1, -1, 0}), third = unit(cross(along, across));
  Mesh mesh;
  Rng rng(21);
  for (uint32_t i = 0; i < 20000; ++i) {
    const double angle = uniform(rng, 0, 2 * M_PI), far = uniform(rng, .05, .2);
    const Vec normal = across * std::cos(angle) + third * std::sin(angle);
    const Vec side = cross(unit(along), normal), c = normal * far;
    mesh.add(c - along * uniform(rng, 1, 2) - side, c + along * uniform(rng, 1, 2) - side * .9,
             c + along * uniform(rng, -1, 1) + side * 2);
  }
  std::vector<Ray<Value>> rays;
  for (uint32_t i = 0; i < 60; ++i) {
    const Vec o = along * -.5 + across * uniform(rng, -.03, .03) + third * uniform(rng, -.03, .03);
    rays.push_back(make_ray(o, along));
    if (i % 3 == 0) continue;
    const Vec at = o + along * uniform(rng, .1, .9);
    mesh.add(at - across * 1e-4 - third * 1e-4, at + across * 2e-4 - third * 1e-4,
             at + third * 2e-4);
  }
  mesh.done();
  const Tree tree = build(mesh);
  for (const uint32_t batch : {1u, 2u, 5u, 7u, 60u})
    for (uint32_t begin = 0; begin < 60; begin += batch) {
      const std::vector<Ray<Value>> part(rays.begin() + begin,
                                         rays.begin() + std::min(60u, begin + batch));
      const std::vector<uint32_t> occluded = trace_shadow(kernels(), tree.view, part);
      for (uint32_t i = 0; i < part.size(); ++i)
        ASSERT_EQ(occluded[i], uint32_t((begin + i) % 3 != 0)) << begin + i << " of " << batch;
    }
}

TEST_P(TraverseLimits, EmptyTree) {
  Mesh mesh;
  mesh.done();
  const Tree tree = build(mesh);
  const std::vector<Ray<Value>> rays(33, make_ray({}, {0, 0, 1}, 5));
  for (const auto& h : trace(kernels(), tree.view, rays)) {
    EXPECT_EQ(h.prim, kNone);
    EXPECT_EQ(h.t, 5.f);
  }
  for (const uint32_t o : trace_shadow(kernels(), tree.view, rays)) EXPECT_EQ(o, 0u);
}

// S1. A ray that starts off its triangle by 32 ulp of the vertices' magnitude does not meet it or
// its coplanar neighbour.
TEST_P(TraverseLimits, SpawnedRaysDoNotHitTheirOwnSurface) {
  for (const double scale : {1e-6, 1e-3, 1., 1e3, 1e6})
    for (const double away : {0., 1., 1e3}) {
      Rng rng(17);
      uint32_t self_hits = 0;
      for (uint32_t trial = 0; trial < 60; ++trial) {
        const Vec c = random_direction(rng) * (away * scale);
        // A third of the quads each a hundred and ten thousand times as long as high.
        const double height = trial % 3 == 0 ? 1 : trial % 3 == 1 ? 1e-2 : 1e-4;
        const Vec e1 = random_direction(rng) * scale,
                  e2 = random_direction(rng) * (scale * (away > 1 ? 1 : height));
        Mesh mesh;
        mesh.quad(c, c + e1, c + e1 + e2, c + e2);
        mesh.done();
        const Tree tree = build(mesh);
        std::vector<Ray<Value>> rays;
        for (uint32_t i = 0; i < 500; ++i) {
          const uint32_t prim = i & 1;
          const Vec p0 = mesh.corner(prim, 0), p1 = mesh.corner(prim, 1), p2 = mesh.corner(prim, 2);
          const Vec normal = unit(cross(p1 - p0, p2 - p0));
          const float* const p = &mesh.list[prim].p0_x;
          float magnitude[3] = {};
          for (int k = 0; k < 9; ++k) magnitude[k % 3] = std::max(magnitude[k % 3], std::abs(p[k]));
          const double extent = double(std::max({magnitude[0], magnitude[1], magnitude[2]}));
          const double offset = extent *
                                (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z)) *
                                32 * 0x1p-23;
          double u = uniform(rng), v = uniform(rng);
          if (u + v > 1) u = 1 - u, v = 1 - v;
          // As the surface stage does it: in float, from barycentrics.
          float pos[3];
          const float fu = float(u), fv = float(v), fw = 1.f - fu - fv;
          for (int a = 0; a < 3; ++a) pos[a] = fw * p[a] + fu * p[3 + a] + fv * p[6 + a];
          Vec d = random_direction(rng);
          if (i % 5 == 0) d = unit(d - normal * (dot(d, normal) * 0.999));  // Grazing.
          const double side = dot(d, normal) >= 0 ? 1 : -1;
          const Vec o{double(pos[0]), double(pos[1]), double(pos[2])};
          rays.push_back(make_ray(o + normal * (side * offset), d));
        }
        for (const auto& h : trace(kernels(), tree.view, rays)) self_hits += h.prim != kNone;
      }
      EXPECT_EQ(self_hits, 0u) << "scale " << scale << ", " << away << " scales away";
    }
}

}  // namespace
}  // namespace yat

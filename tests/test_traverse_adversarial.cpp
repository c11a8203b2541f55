// Rays chosen to break the traversal, for every kernel (streams, tiles, shadows), both kinds of
// tree and every instruction set. YAT_TRAVERSE_RAYS=N traces N times as many of them.

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "per_isa.h"
#include "traverse_scenes.h"

namespace yat {
namespace {

using namespace testing_traverse;

uint32_t times(uint32_t n) {
  const char* factor = std::getenv("YAT_TRAVERSE_RAYS");
  return n * (factor ? uint32_t(std::max(1, std::atoi(factor))) : 1);
}

class TraverseAdversarial : public PerIsa {
 protected:
  ThreadPool pool{1};
  std::vector<Tree> trees(const Mesh& mesh) {
    std::vector<Tree> out;
    for (const bool strict : {false, true})
      out.push_back(build_tree(mesh.rows.view(), {}, {16, strict}, pool));
    return out;
  }
  /// What the closest-hit kernels say, which must be the same.
  std::vector<Hit<Value>> hits(const Tree& tree, const std::vector<Ray<Value>>& rays) {
    const std::vector<Hit<Value>> streams = trace(kernels(), tree.view, rays);
    const std::vector<Hit<Value>> tiles = trace_tiles(kernels(), tree.view, rays);
    uint32_t differing = 0;
    for (uint32_t i = 0; i < rays.size(); ++i) differing += !same_bits(streams[i], tiles[i]);
    EXPECT_EQ(differing, 0u) << "rays whose tile says something else";
    return streams;
  }
  void expect_brute_force(const Mesh& mesh, const std::vector<Ray<Value>>& rays, const char* what) {
    std::vector<Hit<Value>> expected;
    for (const auto& r : rays) expected.push_back(brute_force(mesh, r));
    for (const Tree& tree : trees(mesh)) {
      const std::vector<Hit<Value>> found = hits(tree, rays);
      uint32_t wrong = 0;
      for (uint32_t i = 0; i < rays.size(); ++i) wrong += !same_bits(found[i], expected[i]);
      EXPECT_EQ(wrong, 0u) << what;
      // The same rays as segments of their length: 2, or what they are cut to.
      std::vector<Ray<Value>> segments = rays;
      std::vector<Hit<Value>> nearest;
      for (auto& s : segments) {
        const float length = s.t_max < 4 ? s.t_max : 2.f;
        s.dir_x *= length, s.dir_y *= length, s.dir_z *= length, s.t_max = 1;
        nearest.push_back(brute_force(mesh, s));
      }
      const std::vector<uint32_t> stopped = trace_shadow(kernels(), tree.view, segments);
      wrong = 0;
      for (uint32_t i = 0; i < rays.size(); ++i)
        wrong += stopped[i] != uint32_t(nearest[i].prim != kNone && nearest[i].t < 1);
      EXPECT_EQ(wrong, 0u) << what << ", segments";
    }
  }
};
YAT_INSTANTIATE_PER_ISA(TraverseAdversarial);

// I1. No ray leaves a closed mesh, and no segment that ends outside is free.
TEST_P(TraverseAdversarial, ClosedMeshes) {
  struct Place {
    double scale;
    Vec center;
  };
  std::vector<Place> places = {{2, {148376, 1234, -223423}}};
  for (const double scale : {1e-6, 1., 1e6})
    for (const double away : {0., 30., 1e4})
      places.push_back({scale, Vec{.3, -1, .07} * (away * scale)});
  for (const Place& place : places)
    for (const double jitter : {0., .1}) {
      const Mesh mesh = closed_sphere(24, place.center, place.scale, jitter);
      Rng rng(31);
      std::vector<Ray<Value>> rays, segments;
      for (uint32_t i = 0; i < times(3000); ++i) {
        // Tiles of 64 rays from one point, at vertices and edges of neighbouring triangles.
        static Vec o;
        if (i % 64 == 0) o = place.center + random_point(rng, .4 * place.scale);
        const Ray<Value> at = make_ray(o, {1, 0, 0});
        const Vec from{double(at.org_x), double(at.org_y), double(at.org_z)};
        const uint32_t prim = (i / 64 * 41 + rng() % 12) % uint32_t(mesh.list.size());
        const Vec a = mesh.corner(prim, int(rng() % 3)), b = mesh.corner(prim, 0);
        Vec d = random_direction(rng);
        if (i % 3 == 1) d = unit(a - from);
        if (i % 3 == 2) d = unit(a + (b - a) * uniform(rng) - from);
        rays.push_back(make_ray(o, d));
        segments.push_back(make_ray(o, d * (4 * place.scale), 1));
      }
      for (const Tree& tree : trees(mesh)) {
        uint32_t leaks = 0, free = 0;
        for (const auto& h : hits(tree, rays)) leaks += h.prim == kNone;
        for (const uint32_t s : trace_shadow(kernels(), tree.view, segments)) free += !s;
        EXPECT_EQ(leaks, 0u) << "scale " << place.scale << " at " << place.center.y;
        EXPECT_EQ(free, 0u) << "scale " << place.scale << " at " << place.center.y;
      }
    }
}

// I2. A triangle of any size and slenderness is hit at its middle.
TEST_P(TraverseAdversarial, TrianglesOfAnyShape) {
  for (int e = -15; e <= 15; e += 3)
    for (int slender = 0; slender <= 7; ++slender)
      for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1., 1.}) {
          const double s = std::pow(10., e), thin = s * std::pow(10., -slender);
          const auto point = [&](double x, double y, double z) {
            return axis == 0 ? Vec{z, x, y} : axis == 1 ? Vec{y, z, x} : Vec{x, y, z};
          };
          Mesh mesh;
          mesh.add(point(-s, -thin, 2 * side * s), point(s, -thin, 2 * side * s),
                   point(0, 2 * thin, 2 * side * s));
          mesh.done();
          const std::vector<Ray<Value>> rays(3, make_ray({}, point(0, 0, side)));
          std::vector<Ray<Value>> beyond(3, make_ray({}, point(0, 0, 2.001 * side * s), 1)),
              before(3, make_ray({}, point(0, 0, 1.999 * side * s), 1));
          for (const Tree& tree : trees(mesh)) {
            for (const auto& h : hits(tree, rays)) {
              ASSERT_EQ(h.prim, 0u) << "size 1e" << e << ", slender 1e" << slender;
              ASSERT_NEAR(double(h.t) / (2 * s), 1, 1e-6);
            }
            for (const uint32_t o : trace_shadow(kernels(), tree.view, beyond))
              ASSERT_EQ(o, 1u) << "size 1e" << e << ", slender 1e" << slender;
            for (const uint32_t o : trace_shadow(kernels(), tree.view, before)) ASSERT_EQ(o, 0u);
          }
        }
}

// I3. Rays nearly in the plane of slender triangles: no hit that exact numbers rule out.
TEST_P(TraverseAdversarial, GrazingRays) {
  Rng rng(12);
  Mesh mesh;
  for (uint32_t i = 0; i < 60; ++i) {
    const Vec c = random_point(rng), along = random_direction(rng);
    const Vec across = unit(cross(along, random_direction(rng)));
    mesh.add(c, c + along, c + along * .5 + across * std::pow(10., -double(i % 6)));
  }
  mesh.done();
  std::vector<Ray<Value>> rays;
  for (uint32_t i = 0; i < times(2000); ++i) {
    const uint32_t prim = i / 16 % 60;
    const Vec a = mesh.corner(prim, 0), b = mesh.corner(prim, 1), c = mesh.corner(prim, 2);
    const Vec normal = unit(cross(b - a, c - a));
    const Vec in_plane = unit((b - a) * uniform(rng, -1, 1) + (c - a) * uniform(rng, -1, 1));
    const Vec target = a + (b - a) * uniform(rng, -.5, 1.5) + (c - a) * uniform(rng, -.5, 1.5);
    const double angle = std::pow(10., -1. - double(i % 7));
    const Vec d = unit(in_plane + normal * (rng() & 1 ? angle : -angle));
    rays.push_back(make_ray(target - d * uniform(rng, .5, 3), d));
  }
  expect_brute_force(mesh, rays, "grazing");
  for (const Tree& tree : trees(mesh)) {
    const std::vector<Hit<Value>> found = hits(tree, rays);
    for (uint32_t i = 0; i < rays.size(); ++i)
      ASSERT_EQ(check_hit(mesh, rays[i], found[i]), "") << "ray " << i;
  }
}

// I6, K1, K4. Axis-parallel rays, zeros of either sign, denormal directions, origins on faces,
// vertices and split planes: as brute force has it, to the bit.
TEST_P(TraverseAdversarial, AlongAxesAndInPlanes) {
  std::vector<std::pair<const char*, Mesh>> meshes;
  meshes.emplace_back("voxels", voxels(4));
  meshes.emplace_back("stairs", stairs(20, 0));
  meshes.emplace_back("turned stairs", stairs(20, .7));
  for (const uint32_t n : {1u, 2u, 3u, 4u, 200u}) meshes.emplace_back("soup", soup(n, .4, n));
  for (auto& [name, mesh] : meshes) {
    std::vector<Ray<Value>> rays = rays_through(mesh, times(1500), 5, 4);
    Rng rng(6);
    for (uint32_t i = 0; i < times(1500); ++i) {
      const uint32_t prim = rng() % uint32_t(mesh.list.size());
      Vec o = mesh.corner(prim, int(rng() % 3)), d;
      // From a vertex or from elsewhere in its axis planes; along one or two axes.
      for (uint32_t a = 0; a < 3; ++a)
        if (rng() % 3 == 0) (&o.x)[a] = uniform(rng, -4, 4);
      const double tiny = i % 5 == 0 ? 1e-40 : 0;
      for (uint32_t a = 0; a < 3; ++a) (&d.x)[a] = rng() & 1 ? tiny : -tiny;
      (&d.x)[rng() % 3] = rng() & 1 ? 1 : -1;
      if (i & 1) (&d.x)[rng() % 3] = uniform(rng, -1, 1);
      rays.push_back(make_ray(o, d));
    }
    expect_brute_force(mesh, rays, name);
  }
}

// I7. Segments that end some ulps before and behind the nearest hit.
TEST_P(TraverseAdversarial, SegmentsThatEndAtTheHit) {
  const Mesh mesh = soup(300, .3, 21);
  const std::vector<Ray<Value>> rays = rays_through(mesh, times(2000), 3, .9);
  for (const Tree& tree : trees(mesh)) {
    const std::vector<Hit<Value>> nearest = trace(kernels(), tree.view, rays);
    std::vector<Ray<Value>> segments;
    for (uint32_t i = 0; i < rays.size(); ++i) {
      if (nearest[i].prim == kNone) continue;
      Ray<Value> s = rays[i];
      float length = nearest[i].t;
      for (uint32_t k = 0; k < i % 7; ++k) length = std::nextafter(length, i & 8 ? 1e9f : 0.f);
      s.dir_x *= length, s.dir_y *= length, s.dir_z *= length, s.t_max = 1;
      segments.push_back(s);
    }
    const std::vector<Hit<Value>> found = hits(tree, segments);
    const std::vector<uint32_t> stopped = trace_shadow(kernels(), tree.view, segments);
    uint32_t wrong = 0, count = 0;
    for (uint32_t i = 0; i < segments.size(); ++i) {
      wrong += stopped[i] != uint32_t(found[i].prim != kNone && found[i].t < 1);
      count += stopped[i];
    }
    EXPECT_EQ(wrong, 0u);
    EXPECT_GT(count, segments.size() / 5);
    EXPECT_LT(count, segments.size() * 4 / 5);
  }
}

// Lists cannot overflow: every ray meets every box, and memory of exactly the size asked for is
// enough.
TEST_P(TraverseAdversarial, EveryRayInEveryBox) {
  Mesh mesh;
  for (uint32_t i = 0; i < 4000; ++i) {
    const double z = 1 + i * 1e-3;
    mesh.add({-9, -9, z}, {9, -9, z}, {0, 18, z});
  }
  mesh.done();
  Rng rng(2);
  std::vector<Ray<Value>> rays;
  for (uint32_t i = 0; i < 9000; ++i)
    rays.push_back(make_ray({uniform(rng, -1, 1), uniform(rng, -1, 1), 0},
                            {uniform(rng, -.1, .1), uniform(rng, -.1, .1), 1}));
  // Backwards through all of them to the first: no hit shortens the way.
  for (auto& r : rays) r.org_z = 5.5f, r.dir_z = -1;
  const Table<Ray> columns = to_table(rays);
  // Segments through the corner of every box, beside every triangle.
  const Table<ShadowRay> segments{9000};
  for (uint32_t i = 0; i < rays.size(); ++i)
    set_row<ShadowRay>(segments.columns(), i,
                       {-8.5f, 17, 0, rays[i].dir_x, rays[i].dir_y, 9, 0, 0, 0, i});
  for (const Tree& tree : trees(mesh))
    for (const uint32_t n : {1u, 15u, 16u, 333u, 9000u}) {
      constexpr size_t kGuard = 4096;
      const size_t bytes = kernels().traversal_scratch_bytes(tree.view, n);
      AlignedArray<std::byte> memory(bytes + kGuard);
      const auto untouched = [&] {
        return std::all_of(memory.begin() + bytes, memory.begin() + bytes + kGuard,
                           [](std::byte b) { return b == std::byte{0xa5}; });
      };
      std::fill_n(memory.data() + bytes, kGuard, std::byte{0xa5});
      const Table<Hit> out{9000};
      AlignedArray<uint32_t> stopped(9000);
      for (const auto kernel : {kernels().intersect_closest, kernels().intersect_tiles}) {
        kernel(tree.view, columns.view(), out.columns(), n, {memory.data(), bytes});
        ASSERT_TRUE(untouched()) << n;
        for (uint32_t i = 0; i < n; ++i) ASSERT_EQ(out.row(i).prim, 3999u);
      }
      kernels().intersect_shadow[0](tree.view, segments.view(), stopped.data(), n,
                                    {memory.data(), bytes});
      ASSERT_TRUE(untouched()) << n;
      for (uint32_t i = 0; i < n; ++i) ASSERT_EQ(stopped[i], 0u);
    }
}

}  // namespace
}  // namespace yat

// The traversal against brute force: in float to the bit, in double within its rounding bounds.

#include <algorithm>

#include "per_isa.h"
#include "traverse_scenes.h"

namespace yat {
namespace {

using namespace testing_traverse;

class Traverse : public PerIsa {
 protected:
  ThreadPool pool{1};

  Tree build(const Mesh& mesh, uint32_t width, std::span<const uint8_t> occludes = {},
             bool strict = false) {
    Tree tree = build_tree(mesh.rows.view(), occludes, {width, strict}, pool);
    EXPECT_EQ(verify_tree(tree, mesh.rows.view()), "");
    return tree;
  }
  /// The block widths that the kernels of this instruction set read.
  std::vector<uint32_t> widths() {
    std::vector<uint32_t> out;
    for (uint32_t w = kernels().lanes; w <= 16; w *= 2) out.push_back(w);
    return out;
  }

  static bool near(const TreeView& tree, const Ray<Value>& ray) {
    float extent = 0;
    for (int a = 0; a < 3; ++a)
      extent = std::max({extent, std::abs(tree.min[a]), std::abs(tree.max[a])});
    return std::max({std::abs(ray.org_x), std::abs(ray.org_y), std::abs(ray.org_z)}) <=
           kFarExtents * extent;
  }

  void compare(const Mesh& mesh, const std::vector<Ray<Value>>& rays, const char* what) {
    for (const bool strict : {false, true})
      for (const uint32_t width : widths()) {
        const Tree tree = build(mesh, width, {}, strict);
        const std::vector<Hit<Value>> hits = trace(kernels(), tree.view, rays);
        uint32_t wrong = 0, found = 0;
        for (uint32_t i = 0; i < rays.size(); ++i) {
          const Hit<Value> expected = brute_force(mesh, rays[i]);
          found += expected.prim != kNone;
          // Rays from far outside start again near the scene and round differently: those have the
          // check in double only.
          wrong += near(tree.view, rays[i]) && !same_bits(hits[i], expected);
          const std::string error = check_hit(mesh, rays[i], hits[i]);
          ASSERT_EQ(error, "") << what << ", ray " << i << ", block width " << width;
        }
        EXPECT_EQ(wrong, 0u) << what << ": rays that differ from the brute force, width " << width;
        EXPECT_GT(found, rays.size() / 50) << what;
      }
  }
};
YAT_INSTANTIATE_PER_ISA(Traverse);

TEST_P(Traverse, FindsTheNearestHitInSoups) {
  for (const uint32_t n : {1u, 2u, 3u, 4u, 9u, 40u, 300u})
    for (const double size : {0.05, 0.5}) {
      const Mesh mesh = soup(n, size, n);
      // Few small triangles are rarely hit by chance: enough rays are aimed at them.
      compare(mesh, rays_through(mesh, 600, 77 + n), "soup");
    }
}

TEST_P(Traverse, FindsTheNearestHitInLargerSoup) {
  const Mesh mesh = soup(3000, 0.2, 9);
  compare(mesh, rays_through(mesh, 600, 1), "large soup");
}

// A ray that is alone in many lists while its stream goes on: it is handed more boxes than it can
// hold, and has to visit them first.
TEST_P(Traverse, ARayThatIsHandedManyBoxes) {
  Rng rng(17);
  Mesh mesh;
  for (uint32_t i = 0; i < 4000; ++i) {
    // Around the x axis, which no triangle touches.
    const Vec c{uniform(rng, 0, 400), uniform(rng, .05, .4) * (i & 1 ? 1 : -1),
                uniform(rng, -.4, .4)};
    mesh.add(c, c + random_point(rng, .03), c + random_point(rng, .03));
  }
  mesh.done();
  std::vector<Ray<Value>> rays(64, {-1, 0, 0, 1, 0, 0, kRayFar});
  for (const double y : {-.2, .11, .3})
    for (const double x : {1., -1.})
      rays.push_back({x > 0 ? -1.f : 401.f, float(y), .1f, float(x), 0, 0, kRayFar});
  for (const uint32_t width : widths()) {
    const Tree tree = build(mesh, width);
    const std::vector<Hit<Value>> hits = trace(kernels(), tree.view, rays);
    for (uint32_t i = 0; i < rays.size(); ++i)
      ASSERT_TRUE(same_bits(hits[i], brute_force(mesh, rays[i]))) << i;
  }
}

TEST_P(Traverse, FindsTheNearestHitOnSteps) {
  for (const double angle : {0.0, 0.7}) {
    compare(stairs(24, angle), rays_through(stairs(24, angle), 1500, 3), "stairs");
    const Vec far{1000, -500, 300};
    const Mesh mesh = stairs(24, angle, far);
    compare(mesh, rays_through(mesh, 1500, 4, 2, far), "far stairs");
  }
}

TEST_P(Traverse, FindsTheNearestHitInVoxels) {
  const Mesh mesh = voxels(6);
  compare(mesh, rays_through(mesh, 2000, 5, 4, {3, 3, 3}), "voxels");
}

TEST_P(Traverse, RowsAreIndependent) {
  const Mesh mesh = soup(2000, 0.2, 2);
  const Tree tree = build(mesh, 16);
  const std::vector<Ray<Value>> rays = rays_through(mesh, 4000, 6);
  const std::vector<Hit<Value>> whole = trace(kernels(), tree.view, rays);
  for (const uint32_t batch : {1u, 3u, 4u, 7u, 16u, 17u, 64u, 333u}) {
    const std::vector<Hit<Value>> parts = trace(kernels(), tree.view, rays, batch);
    for (uint32_t i = 0; i < rays.size(); ++i)
      ASSERT_TRUE(same_bits(whole[i], parts[i])) << "ray " << i << " in batches of " << batch;
  }
  std::vector<uint32_t> order(rays.size());
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  Rng rng(1);
  std::shuffle(order.begin(), order.end(), rng);
  std::vector<Ray<Value>> shuffled;
  for (const uint32_t i : order) shuffled.push_back(rays[i]);
  const std::vector<Hit<Value>> hits = trace(kernels(), tree.view, shuffled);
  for (uint32_t i = 0; i < order.size(); ++i)
    ASSERT_TRUE(same_bits(whole[order[i]], hits[i])) << "ray " << order[i];
}

TEST_P(Traverse, EveryTailCount) {
  const Mesh mesh = soup(200, 0.3, 8);
  for (const uint32_t width : widths()) {
    const Tree tree = build(mesh, width);
    const std::vector<Ray<Value>> rays = rays_through(mesh, 64, 7);
    for (const uint32_t n : tail_counts(kernels().lanes)) {
      const Table<Ray> columns = to_table(rays);
      Table<Hit> hits{64};
      for (uint32_t i = 0; i < 64; ++i) hits.set(i, {-7, -7, -7, 12345});
      AlignedArray<std::byte> memory(kernels().traversal_scratch_bytes(tree.view, n));
      kernels().intersect_closest(tree.view, columns.view(), hits.columns(), n,
                                  {memory.data(), memory.size()});
      for (uint32_t i = 0; i < n; ++i)
        ASSERT_TRUE(same_bits(hits.row(i), brute_force(mesh, rays[i]))) << i << " of " << n;
      for (uint32_t i = padded_rows(n); i < 64; ++i)
        ASSERT_EQ(hits.row(i).prim, 12345u) << "row " << i << " was written, n = " << n;
    }
  }
}

TEST_P(Traverse, LongCallsAreCutIntoStreams) {
  const Mesh mesh = soup(30, 0.5, 8);
  const Tree tree = build(mesh, 16);
  std::vector<Ray<Value>> rays = rays_through(mesh, 40001, 7, 0.9);
  const std::vector<Hit<Value>> hits = trace(kernels(), tree.view, rays);
  for (uint32_t i = 0; i < rays.size(); ++i)
    ASSERT_TRUE(same_bits(hits[i], brute_force(mesh, rays[i]))) << i;
}

TEST_P(Traverse, AnswersAreTheSameOnEveryInstructionSet) {
  const Mesh mesh = soup(1500, 0.2, 12);
  const Tree tree = build(mesh, 16);
  std::vector<Ray<Value>> rays = rays_through(mesh, 5000, 8);
  const std::vector<Hit<Value>> hits = trace(kernels(), tree.view, rays);
  const KernelTable& lowest = *isas_here().front()->table();
  const std::vector<Hit<Value>> expected = trace(lowest, tree.view, rays);
  for (uint32_t i = 0; i < rays.size(); ++i) ASSERT_TRUE(same_bits(hits[i], expected[i])) << i;
}

// I7: a segment is stopped if and only if the nearest hit is nearer than its end.
TEST_P(Traverse, ShadowsAgreeWithNearestHits) {
  const Mesh mesh = soup(800, 0.2, 13);
  std::vector<uint8_t> occludes(mesh.list.size());
  for (uint32_t i = 0; i < occludes.size(); ++i) occludes[i] = i % 3 != 0;
  Mesh solid;
  for (uint32_t i = 0; i < occludes.size(); ++i)
    if (occludes[i]) solid.list.push_back(mesh.list[i]);
  solid.done();
  for (const uint32_t width : widths()) {
    const Tree tree = build(mesh, width, occludes);
    std::vector<Ray<Value>> rays = rays_through(mesh, 4000, 14, 0.9);
    Rng rng(3);
    for (auto& r : rays) {
      const float length = float(uniform(rng, 0.1, 2));
      r.dir_x *= length, r.dir_y *= length, r.dir_z *= length, r.t_max = 1;
    }
    // Ends exactly on a triangle: not stopped by it.
    for (uint32_t i = 0; i < 200; ++i) {
      const Hit<Value> h = brute_force(mesh, rays[i]);
      if (h.prim == kNone) continue;
      rays[i].dir_x *= h.t, rays[i].dir_y *= h.t, rays[i].dir_z *= h.t;
    }
    for (const uint32_t variant : {0u, 1u}) {
      const Mesh& seen = variant ? solid : mesh;
      const std::vector<uint32_t> occluded = trace_shadow(kernels(), tree.view, rays, variant);
      uint32_t stopped = 0;
      for (uint32_t i = 0; i < rays.size(); ++i) {
        const Hit<Value> h = brute_force(seen, rays[i]);
        ASSERT_EQ(occluded[i], uint32_t(h.prim != kNone && h.t < 1)) << "ray " << i << " t " << h.t;
        stopped += occluded[i];
      }
      EXPECT_GT(stopped, 500u);
      EXPECT_LT(stopped, 3900u);
    }
  }
}

TEST_P(Traverse, LaneCountsAreSane) {
  const Mesh mesh = closed_sphere(24, {}, 1);
  const Tree tree = build(mesh, 16);
  const std::vector<Ray<Value>> rays = rays_through(mesh, 4096, 5, 0.5);
  const Table<Ray> columns = to_table(rays);
  const Table<Hit> hits{4096};
  AlignedArray<std::byte> memory(kernels().traversal_scratch_bytes(tree.view, 4096));
  const LaneCount count = kernels().intersect_closest(tree.view, columns.view(), hits.columns(),
                                                      4096, {memory.data(), memory.size()});
  EXPECT_GE(count.rows, 4096u);
  EXPECT_LE(count.rows, count.steps * kernels().lanes);
}

}  // namespace
}  // namespace yat

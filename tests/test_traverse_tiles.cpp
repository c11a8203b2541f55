// Tiles of rays against the streams: the same answers to the bit, whatever rays share a tile.

#include <algorithm>
#include <limits>

#include "per_isa.h"
#include "traverse_scenes.h"

namespace yat {
namespace {

using namespace testing_traverse;

class TraverseTiles : public PerIsa {
 protected:
  ThreadPool pool{1};

  Tree build(const Mesh& mesh, uint32_t width, bool strict = false) {
    return build_tree(mesh.rows.view(), {}, {width, strict}, pool);
  }
  std::vector<uint32_t> widths() {
    std::vector<uint32_t> out;
    for (uint32_t w = kernels().lanes; w <= 16; w *= 2) out.push_back(w);
    return out;
  }
  /// The trees that a mesh is tried in.
  std::vector<Tree> trees(const Mesh& mesh) {
    std::vector<Tree> out;
    for (const bool strict : {false, true})
      for (const uint32_t width : widths()) out.push_back(build(mesh, width, strict));
    return out;
  }
  void expect_same(const std::vector<Tree>& trees, const std::vector<Ray<Value>>& rays,
                   const char* what) {
    for (const Tree& tree : trees) {
      const std::vector<Hit<Value>> streams = trace(kernels(), tree.view, rays);
      for (const uint32_t batch : {1u << 20, 40u}) {
        const std::vector<Hit<Value>> tiles = trace_tiles(kernels(), tree.view, rays, batch);
        for (uint32_t i = 0; i < rays.size(); ++i)
          ASSERT_TRUE(same_bits(tiles[i], streams[i]))
              << what << ", ray " << i << ", width " << tree.view.block_width << ": row "
              << tiles[i].prim << " at " << tiles[i].t << ", not " << streams[i].prim << " at "
              << streams[i].t;
      }
    }
  }
};
YAT_INSTANTIATE_PER_ISA(TraverseTiles);

/// Where the rays of a camera start.
enum class Start { kPoint, kNearPlane, kLens };

/// Rays of a camera at `eye` that sees `target`, 8 x 8 by 8 x 8: rows as the renderer makes them.
std::vector<Ray<Value>> camera(const Vec& eye, const Vec& target, double spread, uint32_t size,
                               Start start) {
  Rng rng(4);
  const Vec forward = unit(target - eye);
  const Vec right = unit(cross(forward, std::abs(forward.y) > 0.9 ? Vec{1, 0, 0} : Vec{0, 1, 0}));
  const Vec up = cross(right, forward);
  const double away = std::sqrt(dot(target - eye, target - eye));
  std::vector<Ray<Value>> rays;
  for (uint32_t block = 0; block < size * size / 64; ++block)
    for (uint32_t i = 0; i < 64; ++i) {
      const double x = block % (size / 8) * 8 + i % 8 + uniform(rng),
                   y = block / (size / 8) * 8 + i / 8 + uniform(rng);
      const Vec d =
          unit(forward + right * ((x / size - .5) * spread) + up * ((y / size - .5) * spread));
      Vec o = eye;
      if (start == Start::kNearPlane) o = o + d * (0.05 * away / dot(d, forward));
      if (start == Start::kLens)
        o = o + right * uniform(rng, 0, .02 * away) + up * uniform(rng, 0, .02 * away);
      rays.push_back(make_ray(o, d));
    }
  return rays;
}

TEST_P(TraverseTiles, CameraRaysMeetWhatStreamsMeet) {
  Mesh box;
  add_box(box, {-1, -1, -1}, {1, 1, 1});
  box.done();
  const std::vector<Tree> many = trees(soup(3000, 0.1, 9)), few = trees(soup(5, 1, 3)),
                          closed = trees(closed_sphere(40, {}, 1, .1)), room = trees(box);
  for (const Start start : {Start::kPoint, Start::kNearPlane, Start::kLens})
    for (const double spread : {0.02, 0.7, 4.0}) {
      Rng rng(8);
      for (int view = 0; view < 4; ++view) {
        // In the last two views the eye is inside, and turned along an axis.
        const Vec eye = view < 2 ? random_direction(rng) * 4 : random_point(rng, .5);
        const Vec target = view < 3 ? random_point(rng, .2) : eye + Vec{0, 0, -1};
        const auto rays = camera(eye, target, spread, 32, start);
        expect_same(many, rays, "soup");
        expect_same(few, rays, "few");
        expect_same(closed, rays, "sphere");
        expect_same(room, rays, "room");
      }
    }
}

TEST_P(TraverseTiles, CornersAndEdgesOnTheRay) {
  // Coordinates on a grid, rays through its points: edge functions of exactly zero, triangles seen
  // on their edges.
  const Mesh mesh = voxels(5);
  std::vector<Ray<Value>> rays;
  for (const Vec& eye : {Vec{2.5, 2.5, 12}, Vec{2, 2, 12}, Vec{-6, 2, 2.25}, Vec{3, 2, 3}})
    for (int block = 0; block < 16; ++block)
      for (int i = 0; i < 64; ++i) {
        const double x = block % 4 * 1.25 + i % 8 * .15625, y = block / 4 * 1.25 + i / 8 * .15625;
        const Vec at = eye.z > 10 ? Vec{x, y, 5} : Vec{0, x, y};
        rays.push_back(make_ray(eye, at - eye));
      }
  expect_same(trees(mesh), rays, "voxels");
  for (const double angle : {0., .7})
    expect_same(trees(stairs(24, angle)), rays_through(stairs(24, angle), 600, 5), "stairs");
}

TEST_P(TraverseTiles, RaysThatDoNotBelongTogether) {
  const Mesh mesh = soup(400, 0.3, 2);
  expect_same(trees(mesh), rays_through(mesh, 600, 6), "mixture");
  std::vector<Ray<Value>> far = rays_through(mesh, 300, 6);
  for (uint32_t i = 0; i < far.size(); i += 7) far[i].org_x += 5000;
  expect_same(trees(mesh), far, "some from far away");
}

TEST_P(TraverseTiles, EveryTailCount) {
  const Mesh mesh = soup(200, 0.3, 8);
  const Tree tree = build(mesh, 16);
  const std::vector<Ray<Value>> rays = camera({0, 0, 3}, {}, .5, 16, Start::kPoint);
  const std::vector<Hit<Value>> expected = trace(kernels(), tree.view, rays);
  AlignedArray<std::byte> memory(kernels().traversal_scratch_bytes(tree.view, 256));
  for (uint32_t n = 0; n <= 140; ++n) {
    const Table<Ray> columns = to_table(rays);
    Table<Hit> hits{256};
    for (uint32_t i = 0; i < 256; ++i) hits.set(i, {-7, -7, -7, 12345});
    kernels().intersect_tiles(tree.view, columns.view(), hits.columns(), n,
                              {memory.data(), memory.size()});
    for (uint32_t i = 0; i < n; ++i) ASSERT_TRUE(same_bits(hits.row(i), expected[i])) << i;
    for (uint32_t i = padded_rows(n); i < 256; ++i)
      ASSERT_EQ(hits.row(i).prim, 12345u) << "row " << i << " was written, n = " << n;
  }
}

// I5. A poisoned ray misses, and its tile does not notice.
TEST_P(TraverseTiles, PoisonedRaysMissAlone) {
  const Mesh mesh = soup(500, 0.3, 3);
  const Tree tree = build(mesh, 16);
  const std::vector<Ray<Value>> clean = camera({0, 0, 3}, {}, .7, 16, Start::kPoint);
  const std::vector<Hit<Value>> expected = trace_tiles(kernels(), tree.view, clean);
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              inf = std::numeric_limits<float>::infinity();
  for (const float poison : {nan, inf, -inf})
    for (uint32_t field = 0; field < 7; ++field) {
      if (field == 6 && poison == inf) continue;  // No limit at all is a fair wish.
      std::vector<Ray<Value>> rays = clean;
      const auto spoiled = [](uint32_t i) { return i % 7 == 3 || (i > 60 && i < 90); };
      for (uint32_t i = 0; i < rays.size(); ++i)
        if (spoiled(i)) (&rays[i].org_x)[field] = poison;
      const std::vector<Hit<Value>> hits = trace_tiles(kernels(), tree.view, rays);
      for (uint32_t i = 0; i < rays.size(); ++i) {
        if (spoiled(i)) {
          ASSERT_EQ(hits[i].prim, kNone) << poison << " in field " << field << " ray " << i;
        } else {
          ASSERT_TRUE(same_bits(hits[i], expected[i])) << poison << " field " << field;
        }
      }
    }
}

TEST_P(TraverseTiles, EmptyTree) {
  Mesh mesh;
  mesh.done();
  const Tree tree = build(mesh, 16);
  const std::vector<Ray<Value>> rays(33, make_ray({}, {0, 0, 1}, 5));
  for (const auto& h : trace_tiles(kernels(), tree.view, rays)) {
    EXPECT_EQ(h.prim, kNone);
    EXPECT_EQ(h.t, 5.f);
  }
}

TEST_P(TraverseTiles, LaneCountsAreSane) {
  const Mesh mesh = closed_sphere(24, {}, 1);
  const Tree tree = build(mesh, 16);
  const Table<Ray> columns = to_table(camera({0, 0, 3}, {}, .5, 32, Start::kPoint));
  const Table<Hit> hits{1024};
  AlignedArray<std::byte> memory(kernels().traversal_scratch_bytes(tree.view, 1024));
  const LaneCount count = kernels().intersect_tiles(tree.view, columns.view(), hits.columns(), 1024,
                                                    {memory.data(), memory.size()});
  EXPECT_GE(count.rows, 1024u);
  EXPECT_LE(count.rows, count.steps * kernels().lanes);
}

}  // namespace
}  // namespace yat

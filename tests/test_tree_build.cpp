// The tree itself: verified on any input, the same bytes for any number of threads.

#include <gtest/gtest.h>

#include <limits>

#include "traverse_scenes.h"

namespace yat {
namespace {

using namespace testing_traverse;

constexpr TreeShape kShapes[] = {TreeShape::kKd, TreeShape::kObjects, TreeShape::kObjectsAndPlanes};

Tree build(const Mesh& mesh, TreeShape shape, uint32_t width, uint32_t threads,
           std::span<const uint8_t> occludes = {}) {
  ThreadPool pool(threads);
  return build_tree(mesh.rows.view(), occludes, {width, false, shape}, pool);
}

void expect_sound(const Mesh& mesh, const char* what, uint64_t references_at_least) {
  for (const TreeShape shape : kShapes)
    for (const uint32_t width : {4u, 8u, 16u}) {
      const Tree tree = build(mesh, shape, width, 2);
      const TreeStatistics& s = tree.statistics;
      EXPECT_EQ(verify_tree(tree, mesh.rows.view()), "")
          << what << " width " << width << " shape " << int(shape);
      EXPECT_GE(s.references, references_at_least) << what;
      const uint64_t most = shape == TreeShape::kKd ? 8 : shape == TreeShape::kObjects ? 1 : 4;
      EXPECT_LE(s.references, most * mesh.list.size() + 8) << what << " shape " << int(shape);
      EXPECT_LE(s.references, s.blocks * width) << what;
      EXPECT_LE(tree.view.max_depth, 96u) << what;
      EXPECT_EQ(s.shape, shape);
    }
}

// K2
TEST(TreeBuild, EndsOnHardInput) {
  expect_sound(soup(20000, 0.05, 1), "soup", 20000);
  expect_sound(soup(2000, 2, 1), "large triangles", 2000);
  expect_sound(stairs(2000, 0), "stairs", 8000);
  expect_sound(stairs(2000, 0.3), "turned stairs", 8000);
  expect_sound(voxels(12), "voxels", 1000);
  {
    Mesh mesh;  // All centres equal.
    for (int i = 1; i <= 5000; ++i) {
      const double s = 1 + i * 1e-3;
      mesh.add({-s, -s, 0}, {s, -s, 0}, {0, s, 0});
    }
    expect_sound(mesh.done(), "one centre", 5000);
  }
  {
    Mesh mesh;  // Exact copies.
    for (int i = 0; i < 20000; ++i) mesh.add({0, 0, 0}, {1, 0, 0}, {0, 1, 1});
    expect_sound(mesh.done(), "copies", 20000);
  }
  {
    Mesh mesh;  // All in one plane; and flat along two axes but for slivers.
    Rng rng(3);
    for (int i = 0; i < 5000; ++i) {
      const Vec c = random_point(rng);
      mesh.add({c.x, 0, c.z}, {c.x + .1, 0, c.z}, {c.x, 0, c.z + .1});
    }
    expect_sound(mesh.done(), "plane", 5000);
    Mesh line;
    for (int i = 0; i < 5000; ++i) line.add({i + 0., 0, 0}, {i + 1., 0, 0}, {i + .5, 1e-30, 0});
    expect_sound(line.done(), "line", 5000);
  }
  {
    Mesh mesh;  // Coordinates one ulp apart.
    float x = 1;
    for (int i = 0; i < 3000; ++i) {
      const float next = std::nextafter(x, 2.f);
      mesh.add({double(x), 0, 0}, {double(next), 1, 0}, {double(x), 0, 1});
      if (i % 3 == 0) x = next;
    }
    expect_sound(mesh.done(), "ulps", 3000);
  }
  {
    Mesh mesh;  // From the smallest to the largest numbers.
    Rng rng(8);
    for (int i = 0; i < 4000; ++i) {
      const double s = std::pow(10., uniform(rng, -30, 37));
      const Vec c = random_point(rng, s);
      mesh.add(c, c + random_point(rng, s), c + random_point(rng, s));
    }
    expect_sound(mesh.done(), "all magnitudes", 3900);
  }
}

TEST(TreeBuild, GarbageBitsEnd) {
  Mesh mesh;
  Rng rng(5);
  for (int i = 0; i < 20000; ++i) {
    TriangleRow<Value> t{};
    for (int k = 0; k < 9; ++k) {
      const auto bits = uint32_t(rng());
      std::memcpy(&t.p0_x + k, &bits, 4);
    }
    mesh.list.push_back(t);
  }
  expect_sound(mesh.done(), "garbage", 0);
}

TEST(TreeBuild, SmallestInputs) {
  ThreadPool pool(1);
  Mesh empty;
  empty.done();
  const Tree none = build_tree(empty.rows.view(), {}, {}, pool);
  EXPECT_EQ(none.view.node_count, 0u);
  EXPECT_EQ(verify_tree(none, empty.rows.view()), "");
  Mesh one;
  one.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  one.done();
  const Tree tree = build_tree(one.rows.view(), {}, {}, pool);
  EXPECT_EQ(tree.view.node_count, 1u);
  EXPECT_EQ(tree.statistics.leaves, 1u);
  EXPECT_EQ(verify_tree(tree, one.rows.view()), "");
}

void expect_same_bytes(const Tree& a, const Tree& b, const char* what) {
  ASSERT_EQ(a.nodes.size(), b.nodes.size()) << what;
  ASSERT_EQ(a.blocks.size(), b.blocks.size()) << what;
  EXPECT_EQ(0, std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(TreeNode)));
  EXPECT_EQ(0, std::memcmp(a.blocks.data(), b.blocks.data(), a.blocks.size() * sizeof(float)));
  EXPECT_EQ(0, std::memcmp(a.block_occluders.data(), b.block_occluders.data(),
                           a.block_occluders.size() * sizeof(uint32_t)));
  EXPECT_EQ(a.statistics.sah_cost, b.statistics.sah_cost) << what;
  EXPECT_EQ(a.statistics.overlap, b.statistics.overlap) << what;
}

// K3. Large enough for sets that are binned in pieces, and for sets that outgrow their room.
TEST(TreeBuild, SameBytesForAnyThreads) {
  Mesh mesh = soup(36000, 0.03, 6);
  Rng rng(9);
  for (int i = 0; i < 1500; ++i) {
    const Vec c = random_point(rng);
    mesh.add(c, c + random_point(rng, 0.7), c + random_point(rng, 0.7));
  }
  mesh.done();
  std::vector<uint8_t> occludes(mesh.list.size());
  for (uint32_t i = 0; i < occludes.size(); ++i) occludes[i] = i % 5 != 0;
  for (const TreeShape shape : kShapes) {
    // One pool at a time: the least limit of all living pools holds.
    const Tree first = build(mesh, shape, 16, 1, occludes);
    EXPECT_EQ(verify_tree(first, mesh.rows.view()), "");
    for (const uint32_t threads : {1u, 2u, 3u, 7u})
      expect_same_bytes(build(mesh, shape, 16, threads, occludes), first, "shape");
  }
}

// Parted in five pieces at the root, whose parts change places afterwards.
TEST(TreeBuild, SetsOfManyPieces) {
  const Mesh mesh = soup(140000, 0.01, 4);
  const Tree tree = build(mesh, TreeShape::kObjects, 16, 3);
  EXPECT_EQ(verify_tree(tree, mesh.rows.view()), "");
  EXPECT_EQ(tree.statistics.references, mesh.list.size());
  expect_same_bytes(build(mesh, TreeShape::kObjects, 16, 1), tree, "pieces");
}

/// Long thin triangles across the whole box among small ones: partitions of objects overlap.
Mesh beams(uint32_t count, uint32_t small) {
  Mesh mesh = soup(small, 0.01, 2);
  Rng rng(3);
  for (uint32_t i = 0; i < count; ++i) {
    const Vec a = random_point(rng), b = random_point(rng);
    mesh.add(a, b, b + random_point(rng, 0.01));
  }
  mesh.done();
  return mesh;
}

TEST(TreeBuild, ShapeFollowsTheTriangles) {
  ThreadPool pool(2);
  const auto shape_of = [&](const Mesh& mesh, bool strict) {
    const Tree tree = build_tree(mesh.rows.view(), {}, {16, strict}, pool);
    EXPECT_EQ(verify_tree(tree, mesh.rows.view()), "");
    return tree.statistics.shape;
  };
  EXPECT_EQ(shape_of(voxels(12), false), TreeShape::kObjects);
  EXPECT_EQ(shape_of(beams(1500, 6000), false), TreeShape::kObjectsAndPlanes);
  EXPECT_EQ(shape_of(voxels(12), true), TreeShape::kKd);
}

TEST(TreeBuild, PlanesCutWhatPartitionsCannotSeparate) {
  const Mesh mesh = beams(1500, 6000);
  const TreeStatistics objects = build(mesh, TreeShape::kObjects, 16, 1).statistics;
  const TreeStatistics planes = build(mesh, TreeShape::kObjectsAndPlanes, 16, 1).statistics;
  EXPECT_EQ(objects.references, mesh.list.size());
  EXPECT_GT(planes.references, mesh.list.size());
  EXPECT_LT(planes.sah_cost, 0.9 * objects.sah_cost);
}

// A split that takes one wall from the others gains nothing by itself: room around a ball.
TEST(TreeBuild, WallsOfARoomAreParted) {
  Mesh mesh = closed_sphere(40, {}, .5);
  add_box(mesh, {-2, -1, -3}, {2, 1, 3});
  mesh.done();
  ThreadPool pool{1};
  const Tree tree = build_tree(mesh.rows.view(), {}, {16, false}, pool);
  ASSERT_EQ(verify_tree(tree, mesh.rows.view()), "");
  double tests = 0;  // Triangles of large leaves whose box a random line through the room meets.
  for (uint32_t row = 0; row < tree.view.node_count; ++row) {
    const TreeNode& node = tree.view.nodes[row];
    for (uint32_t c = 0; c < 8 && node.child[c] != kNone; ++c) {
      const double x = double(node.max_x[c]) - double(node.min_x[c]),
                   y = double(node.max_y[c]) - double(node.min_y[c]),
                   z = double(node.max_z[c]) - double(node.min_z[c]);
      const double share = (x * y + y * z + z * x) / 44;
      if (!(node.child[c] >> 31) || share < .15) continue;
      const uint32_t block = (node.child[c] & 0x7fffffffu) >> 5;
      const auto* const prims =
          reinterpret_cast<const uint32_t*>(tree.view.blocks + size_t(block) * 160 + 144);
      tests +=
          share * double(std::count_if(prims, prims + 16, [](uint32_t p) { return p != kNone; }));
    }
  }
  // Two for each of six walls, whose areas sum up to twice the room's; at most two walls in one.
  EXPECT_GE(tests, 3.9);
  EXPECT_LE(tests, 8);
}

// A test that cannot fail proves nothing: damage must be seen.
TEST(TreeBuild, VerifySeesDamage) {
  const Mesh mesh = soup(2000, 0.1, 6);
  ThreadPool pool(1);
  const auto broken = [&](auto&& damage) {
    Tree tree = build_tree(mesh.rows.view(), {}, {}, pool);
    damage(tree);
    return verify_tree(tree, mesh.rows.view());
  };
  EXPECT_EQ(broken([](Tree&) {}), "");
  EXPECT_NE(broken([](Tree& t) { t.nodes[1].child[0] = 0; }), "");
  EXPECT_NE(broken([](Tree& t) { t.nodes[0].max_x[1] = t.nodes[0].min_x[1]; }), "");
  EXPECT_NE(broken([](Tree& t) { t.blocks[3] += 1; }), "");
  EXPECT_NE(broken([](Tree& t) { t.nodes[0].order[3][1] ^= 1; }), "");
  EXPECT_NE(broken([](Tree& t) { t.nodes[2].child[0] = kNone; }), "");
}

}  // namespace
}  // namespace yat

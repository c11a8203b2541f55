// The tree itself: verified on any input, the same bytes for any number of threads.

#include <gtest/gtest.h>

#include <limits>

#include "traverse_scenes.h"

namespace yat {
namespace {

using namespace testing_traverse;

void expect_sound(const Mesh& mesh, const char* what, uint64_t references_at_least) {
  ThreadPool pool(2);
  for (const bool strict : {false, true})
    for (const uint32_t width : {4u, 8u, 16u}) {
      const Tree tree = build_tree(mesh.rows.view(), {}, {width, strict}, pool);
      EXPECT_EQ(verify_tree(tree, mesh.rows.view()), "") << what << " width " << width;
      EXPECT_GE(tree.statistics.references, references_at_least) << what;
      EXPECT_LE(tree.statistics.references, (strict ? 8 : 4) * mesh.list.size() + 8) << what;
      EXPECT_LE(tree.view.max_depth, 96u) << what;
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

// K3
TEST(TreeBuild, SameBytesForAnyThreads) {
  const Mesh mesh = soup(30000, 0.05, 6);
  std::vector<uint8_t> occludes(mesh.list.size());
  for (uint32_t i = 0; i < occludes.size(); ++i) occludes[i] = i % 5 != 0;
  for (const bool strict : {false, true}) {
    // One pool at a time: the least limit of all living pools holds.
    const auto build = [&](uint32_t threads) {
      ThreadPool pool(threads);
      return build_tree(mesh.rows.view(), occludes, {16, strict}, pool);
    };
    const Tree first = build(1);
    for (uint32_t threads = 1; threads <= 4; ++threads) {
      const Tree tree = build(threads);
      ASSERT_EQ(tree.nodes.size(), first.nodes.size());
      ASSERT_EQ(tree.blocks.size(), first.blocks.size());
      EXPECT_EQ(0, std::memcmp(tree.nodes.data(), first.nodes.data(),
                               tree.nodes.size() * sizeof(TreeNode)));
      EXPECT_EQ(0, std::memcmp(tree.blocks.data(), first.blocks.data(),
                               tree.blocks.size() * sizeof(float)));
      EXPECT_EQ(0, std::memcmp(tree.block_occluders.data(), first.block_occluders.data(),
                               tree.block_occluders.size() * sizeof(uint32_t)));
    }
  }
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

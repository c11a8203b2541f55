// What is stored: objects once, by the rule of kCopiedTriangles; and a scene that copies could not
// hold.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "instance_scenes.h"
#include "scene/tree_top.h"

namespace yat {
namespace {

const KernelTable& any_kernels() {
  for (const IsaEntry& entry : built_isas())
    if (entry.here) return *entry.table();
  throw std::logic_error("no kernels");
}

std::string two_balls(uint32_t rings, const std::string& places) {
  return view_text("0 -9 2", "0 0 0", 50, 8, 8) +
         "LightSource \"point\" \"point from\" [0 -5 5]\nObjectBegin \"ball\"\n" +
         ball_text(rings, 2 * rings, .1, false) + "ObjectEnd\n" + places + "WorldEnd\n";
}

TEST(InstanceRule, CopiesWhereTheyAreFew) {
  const KernelTable& k = any_kernels();
  const std::string one = instance_text("ball", "0 0 0", ""), two = one + one;
  std::string many;
  for (uint32_t i = 0; i < 1000; ++i) many += one;
  // 4 * 10 * 9 = 360 triangles, 4 * 20 * 19 = 1520.
  for (const auto& [rings, places, shared] :
       {std::tuple{10u, two, 0u}, {10u, many, 1000u}, {20u, one, 0u}, {20u, two, 2u}}) {
    const Scene scene = compile_instances(two_balls(rings, places), k, InstanceMode::kAuto);
    EXPECT_EQ(scene.instances.rows.size(), shared) << rings;
    EXPECT_EQ(scene.triangles.size() == 0, shared > 0) << rings;
  }
}

/// Messages of what cannot be placed stay what they are for copies.
TEST(InstanceRule, BadTransformsAreCopiesThatSayWhatIsWrong) {
  const std::string text = two_balls(
      3, instance_text("ball", "0 0 0", "") + instance_text("ball", "1 0 0", "Scale 1 1 0\n"));
  for (const InstanceMode mode : {InstanceMode::kCopy, InstanceMode::kShare}) {
    std::vector<std::string> said;
    Diagnostics diagnostics(
        [&](Severity, std::string_view line) { said.emplace_back(std::string(line)); });
    CompileOptions options;
    options.instances = mode;
    ThreadPool pool(1);
    const Scene scene =
        compile_scene(parse_scene(text, "test.lxs", ".", diagnostics), options, pool, diagnostics);
    bool found = false;
    for (const std::string& line : said)
      found = found || line.find(
                           "error: the transform of shape \"mesh\" is singular or not "
                           "finite: left out") != line.npos;
    EXPECT_TRUE(found);
    EXPECT_EQ(scene.instances.rows.size(), mode == InstanceMode::kShare ? 1u : 0u);
  }
}

TEST(InstanceRule, EmptyAndUnusedObjects) {
  const std::string text =
      view_text("0 -9 2", "0 0 0", 50, 8, 8) +
      "LightSource \"point\" \"point from\" [0 -5 5]\nObjectBegin \"empty\"\nObjectEnd\n"
      "ObjectBegin \"unseen\"\nMaterial \"null\"\n" +
      ball_text(3, 5, 0, false) + "ObjectEnd\n" + "ObjectBegin \"never\"\n" +
      ball_text(3, 5, 0, false) + "ObjectEnd\n" + ball_text(3, 5, 0, false) +
      instance_text("empty", "0 0 0", "") + instance_text("unseen", "0 0 0", "") + "WorldEnd\n";
  const Scene scene = compile_instances(text, any_kernels(), InstanceMode::kShare);
  EXPECT_TRUE(scene.instances.empty());
  EXPECT_EQ(scene.triangles.size(), 20u);
}

TEST(InstanceMemory, TenThousandTimesSeventyThousand) {
  const KernelTable& k = any_kernels();
  std::string places;
  for (uint32_t i = 0; i < 10000; ++i)
    places += instance_text(
        "ball", fmt::format("{} {} {}", 3. * (i % 100) - 150, 3. * (i / 100), .2 * (i % 7)),
        fmt::format("Rotate {} 0 1 1 Scale {} 1 1\n", 36 * i % 360, 1 + .01 * (i % 50)));
  const Scene one = compile_instances(two_balls(133, instance_text("ball", "0 0 0", "")), k,
                                      InstanceMode::kShare);
  const Scene many = compile_instances(two_balls(133, places), k, InstanceMode::kAuto);
  ASSERT_EQ(many.instances.rows.size(), 10000u);
  const uint32_t triangles = many.instances.triangles.size();
  EXPECT_GT(triangles, 70000u);
  EXPECT_EQ(triangles, one.instances.triangles.size());
  // The object once, and for each instance a row, its share of the tree, and nothing else.
  EXPECT_EQ(many.instances.object_bytes(), one.instances.object_bytes());
  EXPECT_LT(many.instances.instance_bytes(), 10000u * 256);
  EXPECT_LT(many.bytes(), one.bytes() + 10000 * 256);

  PlanOptions options;
  options.max_depth = 3;
  const Film film = render_film(many, make_plan(many, k, options), 0, 4);
  const std::vector<float> rgb = film.resolve();
  uint32_t lit = 0;
  for (const float c : rgb) lit += c > 0;
  EXPECT_GT(lit, 20u);
}

// ---- The tree above
// ------------------------------------------------------------------------------

/// Walks the tree; every box must hold what is below it, every number must come once.
void walk(const Tree& tree, uint32_t node, std::span<const TopBox> boxes, const TopBox& within,
          uint32_t depth, std::set<uint32_t>& seen) {
  ASSERT_LT(node, tree.view.node_count);
  ASSERT_LE(depth, tree.view.max_depth);
  const TreeNode& n = tree.view.nodes[node];
  for (uint32_t c = 0; c < 8; ++c) {
    const TopBox box{{n.min_x[c], n.min_y[c], n.min_z[c]}, {n.max_x[c], n.max_y[c], n.max_z[c]}};
    if (n.child[c] == kNone) {
      EXPECT_GT(box.min[0], box.max[0]);
      continue;
    }
    for (int a = 0; a < 3; ++a) {
      EXPECT_GE(box.min[a], within.min[a]);
      EXPECT_LE(box.max[a], within.max[a]);
    }
    if (n.child[c] >> 31) {
      const uint32_t item = n.child[c] & 0x7fffffffu;
      ASSERT_LT(item, boxes.size());
      EXPECT_TRUE(seen.insert(item).second) << item;
      for (int a = 0; a < 3; ++a) {
        EXPECT_LE(box.min[a], boxes[item].min[a]);
        EXPECT_GE(box.max[a], boxes[item].max[a]);
      }
    } else {
      walk(tree, n.child[c], boxes, box, depth + 1, seen);
    }
  }
}

TEST(TopTree, HoldsEveryBoxOnce) {
  std::mt19937 random(5);
  const auto unit = [&] { return double(random() >> 8) * 0x1p-24; };
  for (const size_t count : {0u, 1u, 2u, 8u, 9u, 1000u})
    for (const bool same : {false, true}) {
      std::vector<TopBox> boxes;
      for (size_t i = 0; i < count; ++i) {
        TopBox box;
        for (int a = 0; a < 3; ++a) {
          box.min[a] = same ? 1 : 1e5 * std::pow(unit(), 4);
          box.max[a] = box.min[a] + (same ? 1 : unit());
        }
        boxes.push_back(box);
      }
      const Tree tree = build_top_tree(boxes);
      std::set<uint32_t> seen;
      const TopBox all{{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, HUGE_VAL, HUGE_VAL}};
      if (count) walk(tree, 0, boxes, all, 1, seen);
      EXPECT_EQ(seen.size(), count);
      EXPECT_EQ(tree.statistics.leaves, count);
    }
}

}  // namespace
}  // namespace yat

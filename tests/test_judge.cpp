// Who is right when two traversals differ.

#include <gtest/gtest.h>

#include <cmath>

#include "judge.h"

namespace yat::bench {
namespace {

/// The triangle (0,0) (1,0) (0,1) at z = 2, and another behind it at z = 3.
BenchScene two_triangles() {
  return scene_of("two", {0, 0, 2, 1, 0, 2, 0, 1, 2, 0, 0, 3, 1, 0, 3, 0, 1, 3});
}

Ray<Value> along_z(float x, float y) {
  return {x, y, 0, 0, 0, 1, kRayFar};
}

TEST(Judge, OnlyTheNearestHitIsRightInside) {
  const Judge judge(two_triangles(), along_z(0.25f, 0.25f), false);
  EXPECT_TRUE(judge.right({2, 0, 0, 0}));
  EXPECT_FALSE(judge.right({3, 0, 0, 1}));
  EXPECT_FALSE(judge.right({kRayFar, 0, 0, kNone}));
}

TEST(Judge, OnlyAMissIsRightOutside) {
  const Judge judge(two_triangles(), along_z(0.6f, 0.6f), false);
  EXPECT_TRUE(judge.right({kRayFar, 0, 0, kNone}));
  EXPECT_FALSE(judge.right({2, 0, 0, 0}));
}

TEST(Judge, NearAnEdgeBothAreRight) {
  const Judge judge(two_triangles(), along_z(-1e-7f, 0.5f), false);
  EXPECT_TRUE(judge.right({2, 0, 0, 0}));
  EXPECT_TRUE(judge.right({3, 0, 0, 1}));
  EXPECT_TRUE(judge.right({kRayFar, 0, 0, kNone}));
}

TEST(Judge, ShadowRaysAreSegments) {
  const auto segment = [](float x, float length) {
    return Ray<Value>{x, 0.25f, 0, 0, 0, length, 0};
  };
  const Hit<Value> stopped{0, 0, 0, 0}, unstopped{0, 0, 0, kNone};
  const Judge longer(two_triangles(), segment(0.25f, 2.5f), true);
  EXPECT_TRUE(longer.right(stopped));
  EXPECT_FALSE(longer.right(unstopped));
  const Judge shorter(two_triangles(), segment(0.25f, 1.9f), true);
  EXPECT_FALSE(shorter.right(stopped));
  EXPECT_TRUE(shorter.right(unstopped));
}

TEST(Judge, CompareTellsTiesFromErrors) {
  const BenchScene scene = two_triangles();
  RaySet set{"test", false, {}};
  for (int i = 0; i < 5; ++i) set.rays.push_back(along_z(0.25f, 0.25f));
  set.rays.push_back(along_z(0, 0.5f));
  const Hit<Value> near{2, 0, 0, 0}, far{3, 0, 0, 1}, miss{kRayFar, 0, 0, kNone};
  const Hit<Value> tie{std::nextafter(2.f, 3.f), 0, 0, 1};
  const std::vector<Hit<Value>> ours = {near, near, far, near, {2.001f, 0, 0, 0}, near};
  const std::vector<Hit<Value>> theirs = {near, tie, near, miss, near, miss};
  const Differences d = compare(scene, set, ours, theirs);
  EXPECT_EQ(d.ties, 1u);
  EXPECT_EQ(d.yat_wrong, 1u);    // Row 2 took the farther one.
  EXPECT_EQ(d.other_wrong, 1u);  // Row 3 missed it.
  EXPECT_EQ(d.yat_t_off, 1u);    // Row 4.
  EXPECT_EQ(d.other_t_off, 0u);
  EXPECT_EQ(d.rounding, 1u);  // Row 5 goes along the edge.
  EXPECT_EQ(d.hit_miss, 2u);
  EXPECT_EQ(d.unjudged, 0u);
  EXPECT_EQ(d.wrong_rows, std::vector<uint32_t>{2});
}

TEST(Judge, TrianglesAsFarAsRoundingCanTellNeedNoJudge) {
  // A second sheet 1e-6 behind the first: which of them is nearer, float cannot say. More rays
  // than are judged.
  const BenchScene scene = scene_of("sheets", {0, 0, 2, 1, 0, 2, 0, 1, 2,  //
                                               0, 0, 2.000001f, 1, 0, 2.000001f, 0, 1, 2.000001f});
  const RaySet set{"test", false, std::vector<Ray<Value>>(300, along_z(0.25f, 0.25f))};
  const std::vector<Hit<Value>> ours(300, {2.00002f, 0, 0, 1}), theirs(300, {2, 0, 0, 0});
  const Differences d = compare(scene, set, ours, theirs);
  EXPECT_EQ(d.rounding, 300u);
  EXPECT_EQ(d.unjudged + d.yat_wrong + d.other_wrong, 0u);
}

}  // namespace
}  // namespace yat::bench

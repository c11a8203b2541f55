#pragma once
// What the parts of the tree build share: boxes, references, the binary tree, the price list.
//
//   triangles ─> references ─> kd splits (plane, clipped, duplicates)   tree_split.cpp
//                              object splits below kObjectSplits        tree_split.cpp
//             ─> binary tree ─> 8-wide tree and blocks                  tree_collapse.cpp

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "scene/tree_build.h"

namespace yat::tree {

struct Box {
  float min[3] = {FLT_MAX, FLT_MAX, FLT_MAX}, max[3] = {-FLT_MAX, -FLT_MAX, -FLT_MAX};

  void add(const Box& other) {
    for (int a = 0; a < 3; ++a) {
      min[a] = std::min(min[a], other.min[a]);
      max[a] = std::max(max[a], other.max[a]);
    }
  }
  bool empty() const { return !(min[0] <= max[0] && min[1] <= max[1] && min[2] <= max[2]); }
  /// Half the surface. In double: finite for any finite box.
  double area() const {
    if (empty()) return 0;
    const auto side = [this](int a) { return double(max[a]) - double(min[a]); };
    const double x = side(0), y = side(1), z = side(2);
    return x * y + y * z + z * x;
  }
};

/// A triangle, or the part of it inside one side of a plane.
struct Reference {
  Box box;  ///< of the part
  uint32_t prim = kNone;
  float center(int axis) const { return 0.5f * box.min[axis] + 0.5f * box.max[axis]; }
};

/// A node of the binary tree. Without children: a leaf.
struct BinaryNode {
  Box box;
  int axis = 0;  ///< of the split; child 0 is the lower side
  std::unique_ptr<BinaryNode> child[2];
  std::vector<uint32_t> prims;  ///< ascending, no duplicates
  bool leaf() const { return !child[0]; }
};

/// What a random ray pays, in units of one traversal step of two boxes.
struct Prices {
  double block_width;
  double root_area;

  static constexpr double kTraversal = 0.5, kBlock = 0.6, kTriangle = 0.025;
  /// Boxes that many rays of a batch enter see long lists: their children are tested, and their
  /// triangles, a register of rays at a time (kernels/traverse_leaf.h), which is cheaper per ray
  /// and costs by the triangle instead of by the block.
  static constexpr double kManyRays = 1.0 / 24, kStreamTraversal = 0.08, kStreamLeaf = 0.1,
                          kStreamTriangle = 0.06;

  bool many_rays(double area) const { return area >= kManyRays * root_area; }
  double traversal(double area) const { return many_rays(area) ? kStreamTraversal : kTraversal; }
  double leaf(size_t n, double area) const {
    const double by_block = kBlock * std::ceil(double(n) / block_width) + kTriangle * double(n);
    if (!many_rays(area)) return by_block;
    return std::min(by_block, kStreamLeaf + kStreamTriangle * double(n));
  }
};

/// kd splits above this many references, object splits at and below it.
inline constexpr size_t kObjectSplits = 1024;
inline constexpr uint32_t kMaxBlocks = 32;  ///< per leaf: five bits in TreeNode::child
/// Binary levels after which sets are halved by index, whatever the price: bounds the depth.
inline constexpr uint32_t kMaxPricedDepth = 64;

struct PlaneSplit {
  double cost = HUGE_VAL;
  int axis = 0;
  float at = 0;
  bool flat_left = true;  ///< references that lie in the plane go to the lower side
};
struct ObjectSplit {
  double cost = HUGE_VAL;
  int axis = 0;
  size_t left = 0;  ///< references on the lower side
};

/// The best plane by the SAH: binned, then exact among the references of the best bins; exact
/// throughout for small sets. cost is infinite where no plane separates anything.
PlaneSplit find_plane(std::span<const Reference> references, const Box& box, const Prices& prices);

/// Distributes references over both sides of the plane, with clipped boxes.
void split_by_plane(const Rows<TriangleRow>& triangles, std::span<const Reference> references,
                    const PlaneSplit& split, std::vector<Reference>& left,
                    std::vector<Reference>& right);

/// The best partition by centroids (binned, exact for small sets), and reorders `references` by it.
/// cost is infinite where all centroids are equal.
ObjectSplit find_object_split(std::span<Reference> references, const Box& box,
                              const Prices& prices);

/// Corner positions of triangle `prim`, as double.
struct Corners {
  double p[3][3];
};
Corners corners_of(const Rows<TriangleRow>& triangles, uint32_t prim);

/// The 8-wide tree of a binary tree; fills everything but build_seconds.
void collapse(const BinaryNode* root, const Rows<TriangleRow>& triangles,
              std::span<const uint8_t> occludes, const TreeOptions& options, Tree& tree);

/// x as float, rounded down or up, finite.
float round_down(double x);
float round_up(double x);

}  // namespace yat::tree

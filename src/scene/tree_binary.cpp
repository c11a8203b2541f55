// The binary tree, from the root down: where to split each set, and how.
//
// Source: Stich, Friedrich, Dietrich, "Spatial Splits in Bounding Volume Hierarchies", 2009, for
// objects and planes in one tree. Departs from it: planes are priced by the cells they cut, not by
// the boxes of what they hold.

#include <algorithm>

#include "scene/tree_parts.h"

namespace yat::tree {

namespace {

/// Overlap of two children, as a share of the root, above which a plane is tried.
constexpr double kOverlap = 0.01;
/// References per triangle there is room for, where planes may duplicate some.
constexpr double kRoom = 1.25;

struct Builder {
  const Rows<TriangleRow>& triangles;
  TreeShape shape;
  BinaryTree& tree;

  size_t leaf_limit() const { return size_t(kMaxBlocks) * tree.prices.block_width; }

  void build(const Set& set, uint32_t depth, BinaryNode& node) const {
    node.box = set.box;
    node.count = set.count;
    const LocalPrices prices(tree.prices, set.box);
    const bool priced = depth < kMaxPricedDepth;
    if (shape == TreeShape::kKd && priced) {
      const PlaneSplit split = find_plane(set, prices);
      if (useful(split, set) && worth(split.cost, set, prices))
        return split_planes(set, split, depth, node);
      if (set.count <= leaf_limit()) return make_leaf(set, node);
      // Too many for a leaf, and no plane separates them.
    }
    if (set.count <= kSmallSet) return build_small(set, depth, tree.prices, tree.arena, node);
    ObjectSplit split;
    if (priced) split = find_object_split(set, prices);
    if (shape == TreeShape::kObjectsAndPlanes && priced && overlaps(split)) {
      const PlaneSplit plane = find_plane(set, prices);
      if (plane.cost < split.cost && useful(plane, set) && worth(plane.cost, set, prices))
        return split_planes(set, plane, depth, node);
    }
    if (!worth(split.cost, set, prices)) return make_leaf(set, node);
    Set left, right;
    split_objects(set, split, left, right);
    descend(left, right, split.axis, depth, node);
  }

  /// A split that is dearer than a leaf is made only where there are too many for a leaf.
  bool worth(float cost, const Set& set, const LocalPrices& prices) const {
    return set.count > leaf_limit() || cost < prices.leaf(set.count);
  }

  /// A plane that cuts nearly everything makes no headway.
  static bool useful(const PlaneSplit& split, const Set& set) {
    return split.cost < HUGE_VALF && std::max(split.left, split.right) < set.count &&
           split.left + split.right <= set.count + set.count / 2;
  }

  bool overlaps(const ObjectSplit& split) const {
    return overlap(split.left, split.right) > kOverlap * tree.prices.root_area;
  }

  void split_planes(const Set& set, const PlaneSplit& split, uint32_t depth,
                    BinaryNode& node) const {
    Set left, right;
    if (!split_by_plane(triangles, set, split, left, right))
      split_by_plane(triangles, moved(set, 2 * (split.left + split.right)), split, left, right);
    descend(left, right, split.axis, depth, node);
  }

  /// The set in new memory, with more room.
  Set moved(const Set& set, size_t room) const {
    auto storage = std::make_unique<Storage>(room);
    Set out = set;
    out.storage = storage.get();
    out.first = 0;
    out.room = room;
    std::copy_n(set.references().data(), set.count, storage->references);
    const std::lock_guard lock(tree.mutex);
    tree.more.push_back(std::move(storage));
    return out;
  }

  void descend(const Set& left, const Set& right, int axis, uint32_t depth,
               BinaryNode& node) const {
    node.axis = axis;
    node.children = tree.arena.take(2);
    const auto lower = [&] { build(left, depth + 1, node.children[0]); };
    const auto upper = [&] { build(right, depth + 1, node.children[1]); };
    if (left.count + right.count > kParallel) {
      parallel_invoke(lower, upper);
    } else {
      lower();
      upper();
    }
  }
};

void add_quality(const BinaryNode& node, const Prices& prices, TreeQuality& sum) {
  const double area = node.box.area() / prices.root_area;
  if (node.leaf()) {
    sum.cost += area * double(prices.block_leaf(node.count));
    return;
  }
  sum.cost += area * double(Prices::kTraversal);
  sum.overlap += overlap(node.children[0].box, node.children[1].box) / prices.root_area;
  add_quality(node.children[0], prices, sum);
  add_quality(node.children[1], prices, sum);
}

}  // namespace

void build_binary(const Rows<TriangleRow>& triangles, TreeShape shape, BinaryTree& tree) {
  const Set set =
      make_references(triangles, shape == TreeShape::kObjects ? 1 : kRoom, tree.storage);
  tree.prices.root_area = set.box.area();
  if (set.count) Builder{triangles, shape, tree}.build(set, 0, tree.root);
}

TreeQuality quality_of(const BinaryTree& tree) {
  TreeQuality sum;
  add_quality(tree.root, tree.prices, sum);
  return sum;
}

}  // namespace yat::tree

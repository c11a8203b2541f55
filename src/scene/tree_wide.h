#pragma once
// Which binary nodes become the children of a wide node.

#include "scene/tree_parts.h"

namespace yat::tree {

/// The children of a wide node, and the little binary tree between it and them.
struct Children {
  BinaryNode* node[8];
  uint32_t count = 0;

  /// Child indices in the order in which a ray of `octant` (bit a: it moves down axis a) meets
  /// them, by the split planes: as TreeNode::order.
  uint32_t order(uint32_t octant) const;

  /// A split of the little tree. Sides below 8: a child; else split side - 8.
  struct Split {
    int32_t axis;
    uint32_t side[2];
  } split[7];
  uint32_t split_count = 0;
};

/// Chooses the wide tree of a binary tree: the one that is cheapest by its prices. Subtrees that
/// are cheaper as one leaf become leaves. Returns its cost: of a random ray through the root's
/// box, in the unit of Prices. Inside ThreadPool::run.
double plan_wide_tree(BinaryTree& tree);

/// The children of a wide node at `node` as planned; of a leaf: the leaf.
Children children_of(BinaryNode& node);

}  // namespace yat::tree

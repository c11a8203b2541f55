// Binary tree to the 8-wide boxed tree of scene/tree_view.h: how many rows each subtree takes, then
// all rows at once.

#include <cstring>
#include <limits>

#include "scene/tree_wide.h"

namespace yat::tree {
namespace {

struct Collapse {
  const Rows<TriangleRow>& triangles;
  std::span<const uint8_t> occludes;
  const Prices& prices;
  double grow;  // [m]
  Tree& tree;

  template <class F>
  static void for_children(const BinaryNode& node, const Children& set, F&& f) {
    if (node.count > kParallel) {
      parallel_ranges(set.count, 1, [&](uint32_t begin, uint32_t end) {
        for (uint32_t i = begin; i != end; ++i) f(i);
      });
    } else {
      for (uint32_t i = 0; i < set.count; ++i) f(i);
    }
  }

  /// Counts the rows that a wide node at `node` and what is below it take.
  void count(BinaryNode& node) const {
    const Children set = children_of(node);
    for_children(node, set, [&](uint32_t i) {
      BinaryNode& child = *set.node[i];
      if (child.leaf()) {
        child.blocks = uint32_t(prices.blocks(child.count));
      } else {
        count(child);
      }
    });
    uint32_t nodes = 1, blocks = 0;
    for (uint32_t i = 0; i < set.count; ++i) {
      if (!set.node[i]->leaf()) nodes += set.node[i]->wide_nodes;
      blocks += set.node[i]->blocks;
    }
    node.wide_nodes = nodes;  // A root that is a leaf counts as both.
    node.blocks = blocks;
  }

  /// Sums over a subtree, in the order of its children.
  struct Sums {
    uint64_t references = 0, leaves = 0;
    uint32_t depth = 0;
    void add(const Sums& other) {
      references += other.references;
      leaves += other.leaves;
      depth = std::max(depth, other.depth);
    }
  };

  Sums add_leaf(const BinaryNode& leaf, uint32_t first) const {
    const uint32_t width = prices.block_width;
    for (uint32_t b = 0; b < leaf.blocks; ++b) {
      float* const block = tree.blocks.data() + size_t(first + b) * width * 10;
      uint32_t bits = 0;
      for (uint32_t k = 0; k < width; ++k) {
        const size_t i = size_t(b) * width + k;
        if (i < leaf.count) {
          const uint32_t prim = leaf.rows[i];
          float words[9];
          std::memcpy(words, triangles.words + size_t(prim) * row_words<TriangleRow>, sizeof words);
          for (uint32_t c = 0; c < 9; ++c) block[c * width + k] = words[c];
          std::memcpy(block + 9 * width + k, &prim, 4);
          if (occludes.empty() || occludes[prim]) bits |= 1u << k;
        } else {
          const uint32_t none = kNone;
          for (uint32_t c = 0; c < 9; ++c)
            block[c * width + k] = std::numeric_limits<float>::quiet_NaN();
          std::memcpy(block + 9 * width + k, &none, 4);
        }
      }
      tree.block_occluders[first + b] = bits;
    }
    return {leaf.count, 1, 0};
  }

  Sums add_node(const BinaryNode& node, const Children& set, uint32_t row, uint32_t block) const {
    TreeNode& out = tree.nodes[row];
    std::memset(&out, 0, sizeof out);
    float* planes[6] = {out.min_x, out.min_y, out.min_z, out.max_x, out.max_y, out.max_z};
    uint32_t child_row[8], child_block[8], next = row + 1;
    for (uint32_t i = 0; i < 8; ++i) {
      const float none = std::numeric_limits<float>::infinity();
      for (int a = 0; a < 3; ++a) {
        planes[a][i] = i < set.count ? round_down(double(set.node[i]->box.low[a]) - grow) : none;
        planes[3 + a][i] =
            i < set.count ? round_up(double(set.node[i]->box.high[a]) + grow) : -none;
      }
      out.child[i] = kNone;
      if (i >= set.count) continue;
      const BinaryNode& child = *set.node[i];
      child_row[i] = next;
      child_block[i] = block;
      out.child[i] = child.leaf() ? 0x80000000u | block << 5 | (child.blocks - 1) : next;
      if (!child.leaf()) next += child.wide_nodes;
      block += child.blocks;
    }
    for (uint32_t octant = 0; octant < 8; ++octant) {
      const uint32_t bits = set.order(octant);
      for (uint32_t byte = 0; byte < 3; ++byte)
        out.order[octant][byte] = uint8_t(bits >> (8 * byte));
    }
    Sums sums[8], all;
    for_children(node, set, [&](uint32_t i) {
      BinaryNode& child = *set.node[i];
      sums[i] = child.leaf() ? add_leaf(child, child_block[i])
                             : add_node(child, children_of(child), child_row[i], child_block[i]);
    });
    for (uint32_t i = 0; i < set.count; ++i) all.add(sums[i]);
    ++all.depth;
    return all;
  }
};

}  // namespace

void collapse(BinaryTree& tree, const Rows<TriangleRow>& triangles,
              std::span<const uint8_t> occludes, Tree& out) {
  BinaryNode& root = tree.root;
  const Prices& prices = tree.prices;
  double extent = 0;
  for (int a = 0; a < 3; ++a) {
    out.view.min[a] = root.box.low[a];
    out.view.max[a] = root.box.high[a];
    extent =
        std::max({extent, std::abs(double(root.box.low[a])), std::abs(double(root.box.high[a]))});
  }
  // The box test and the triangle test round differently; a box must hold every hit that the
  // triangle test can report. Both work on coordinates relative to the ray's origin, which lies
  // within kFarExtents, so |vertex - origin| <= 8 extents. With u = 2^-24 the sheared vertices are
  // off by at most 6 u of that, the planes' distances by 30 u of the extent: 78 u in all; 128 u is
  // taken.
  static_assert(kFarExtents + 1 <= 8);
  const Collapse work{triangles, occludes, prices, extent * 0x1p-17, out};
  out.statistics.sah_cost = plan_wide_tree(tree);
  work.count(root);
  TreeStatistics& s = out.statistics;
  s.nodes = root.wide_nodes;
  s.blocks = root.blocks;
  out.nodes.resize_unset(s.nodes);
  out.blocks.resize_unset(s.blocks * prices.block_width * 10);
  out.block_occluders.resize_unset(s.blocks);
  const Collapse::Sums sums = work.add_node(root, children_of(root), 0, 0);
  s.references = sums.references;
  s.leaves = sums.leaves;
  s.max_depth = sums.depth;
  s.block_fill = double(s.references) / (double(s.blocks) * prices.block_width);
  out.view.nodes = out.nodes.data();
  out.view.blocks = out.blocks.data();
  out.view.block_occluders = out.block_occluders.data();
  out.view.node_count = uint32_t(s.nodes);
  out.view.block_count = uint32_t(s.blocks);
  out.view.max_depth = s.max_depth;
}

}  // namespace yat::tree

// Binary tree to the 8-wide boxed tree of scene/compiled.h.

#include <cstring>
#include <limits>

#include "scene/tree_parts.h"

namespace yat::tree {
namespace {

struct Collapse {
  const Rows<TriangleRow>& triangles;
  std::span<const uint8_t> occludes;
  uint32_t block_width;
  double grow;  // [m]
  double root_area;
  Tree& tree;
  std::vector<TreeNode> nodes;
  std::vector<float> blocks;
  std::vector<uint32_t> block_occluders;

  /// The (up to eight) descendants of `node` that become its children: the largest are opened.
  static std::vector<const BinaryNode*> open(const BinaryNode& node) {
    std::vector<const BinaryNode*> set;
    if (node.leaf()) return {&node};
    set = {node.child[0].get(), node.child[1].get()};
    while (set.size() < 8) {
      size_t widest = set.size();
      double widest_area = -1;
      for (size_t i = 0; i < set.size(); ++i)
        if (!set[i]->leaf() && set[i]->box.area() > widest_area) {
          widest = i;
          widest_area = set[i]->box.area();
        }
      if (widest == set.size()) break;
      const BinaryNode* opened = set[widest];
      set[widest] = opened->child[0].get();
      set.insert(set.begin() + ptrdiff_t(widest) + 1, opened->child[1].get());
    }
    return set;
  }

  /// Children of a node in the order in which a ray of `octant` meets them, by the split planes.
  static void order_of(const BinaryNode& node, const std::vector<const BinaryNode*>& set,
                       uint32_t octant, std::vector<uint32_t>& order) {
    for (size_t i = 0; i < set.size(); ++i)
      if (set[i] == &node) return order.push_back(uint32_t(i));
    const uint32_t first = octant >> node.axis & 1;
    order_of(*node.child[first], set, octant, order);
    order_of(*node.child[first ^ 1], set, octant, order);
  }

  uint32_t add_leaf(const BinaryNode& leaf) {
    const uint32_t count = uint32_t(leaf.prims.size());
    const uint32_t block_count = (count + block_width - 1) / block_width;
    const auto first = uint32_t(block_occluders.size());
    blocks.resize(blocks.size() + size_t(block_count) * block_width * 10,
                  std::numeric_limits<float>::quiet_NaN());
    for (uint32_t b = 0; b < block_count; ++b) {
      float* block = blocks.data() + size_t(first + b) * block_width * 10;
      uint32_t bits = 0;
      for (uint32_t k = 0; k < block_width; ++k) {
        const uint32_t i = b * block_width + k;
        const uint32_t prim = i < count ? leaf.prims[i] : kNone;
        if (prim != kNone) {
          float words[9];
          std::memcpy(words, triangles.words + size_t(prim) * row_words<TriangleRow>, sizeof words);
          for (uint32_t c = 0; c < 9; ++c) block[c * block_width + k] = words[c];
          if (occludes.empty() || occludes[prim]) bits |= 1u << k;
        }
        std::memcpy(block + 9 * block_width + k, &prim, 4);
      }
      block_occluders.push_back(bits);
    }
    tree.statistics.references += count;
    ++tree.statistics.leaves;
    tree.statistics.sah_cost +=
        leaf.box.area() / root_area * (Prices::kBlock * block_count + Prices::kTriangle * count);
    return 0x80000000u | first << 5 | (block_count - 1);
  }

  uint32_t add_node(const BinaryNode& node, uint32_t depth) {
    const auto row = uint32_t(nodes.size());
    nodes.emplace_back();
    tree.statistics.max_depth = std::max(tree.statistics.max_depth, depth + 1);
    tree.statistics.sah_cost += node.box.area() / root_area;
    const std::vector<const BinaryNode*> set = open(node);
    TreeNode out;
    std::memset(&out, 0, sizeof out);
    for (uint32_t i = 0; i < 8; ++i) {
      const bool there = i < set.size();
      const float none = std::numeric_limits<float>::infinity();
      float* planes[6] = {out.min_x, out.min_y, out.min_z, out.max_x, out.max_y, out.max_z};
      for (int a = 0; a < 3; ++a) {
        planes[a][i] = there ? round_down(double(set[i]->box.min[a]) - grow) : none;
        planes[3 + a][i] = there ? round_up(double(set[i]->box.max[a]) + grow) : -none;
      }
      out.child[i] = kNone;
    }
    for (uint32_t octant = 0; octant < 8; ++octant) {
      std::vector<uint32_t> order;
      order_of(node, set, octant, order);
      for (uint32_t i = uint32_t(order.size()); i < 8; ++i) order.push_back(i);
      uint32_t bits = 0;
      for (uint32_t k = 0; k < 8; ++k) bits |= order[k] << (3 * k);
      for (uint32_t byte = 0; byte < 3; ++byte)
        out.order[octant][byte] = uint8_t(bits >> (8 * byte));
    }
    for (uint32_t i = 0; i < set.size(); ++i)
      out.child[i] = set[i]->leaf() ? add_leaf(*set[i]) : add_node(*set[i], depth + 1);
    nodes[row] = out;
    return row;
  }
};

}  // namespace

void collapse(const BinaryNode* root, const Rows<TriangleRow>& triangles,
              std::span<const uint8_t> occludes, const TreeOptions& options, Tree& out) {
  out.statistics.triangles = triangles.count;
  out.view.block_width = options.block_width;
  if (!root) return;
  double extent = 0;
  for (int a = 0; a < 3; ++a) {
    out.view.min[a] = root->box.min[a];
    out.view.max[a] = root->box.max[a];
    extent =
        std::max({extent, std::abs(double(root->box.min[a])), std::abs(double(root->box.max[a]))});
  }
  // The box test and the triangle test round differently; a box must hold every hit that the
  // triangle test can report. Both work on coordinates relative to the ray's origin, which lies
  // within kFarExtents, so |vertex - origin| <= 8 extents. With u = 2^-24 the sheared vertices are
  // off by at most 6 u of that, the planes' distances by 30 u of the extent: 78 u in all; 128 u is
  // taken.
  static_assert(kFarExtents + 1 <= 8);
  const double grow = extent * 0x1p-17;
  Collapse work{triangles, occludes, options.block_width, grow, root->box.area(), out, {}, {}, {}};
  work.add_node(*root, 0);
  out.nodes = AlignedArray<TreeNode>(std::span<const TreeNode>(work.nodes));
  out.blocks = AlignedArray<float>(std::span<const float>(work.blocks));
  out.block_occluders = AlignedArray<uint32_t>(std::span<const uint32_t>(work.block_occluders));
  TreeStatistics& s = out.statistics;
  s.nodes = work.nodes.size();
  s.blocks = work.block_occluders.size();
  s.block_fill = double(s.references) / (double(s.blocks) * options.block_width);
  out.view.nodes = out.nodes.data();
  out.view.blocks = out.blocks.data();
  out.view.block_occluders = out.block_occluders.data();
  out.view.node_count = uint32_t(s.nodes);
  out.view.block_count = uint32_t(s.blocks);
  out.view.max_depth = s.max_depth;
}

}  // namespace yat::tree

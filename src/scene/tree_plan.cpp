// The cheapest 8-wide tree of a binary tree, by dynamic programming from the leaves up: for every
// binary node the cheapest forest of at most i wide nodes and leaves that holds all below it.
//
// Source: Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed
// Wide BVHs", 2017. Departs from it: the price of a wide node grows with its children where rays
// come in long lists, and leaves are priced in blocks.

#include "scene/tree_wide.h"

namespace yat::tree {
namespace {

constexpr uint32_t kWidth = 8;

/// What the programme decided at a node, in BinaryNode::plan.
///   3 bits each for j = 2..8: of a forest of j, how many roots less one lie in the first child
///   6 bits for i = 2..7:      a forest of up to i has more than i - 1 roots
///   3 bits:                   children less one of a wide node here
///   1 bit:                    as one root, the node is a leaf
constexpr uint32_t kLeafBit = 1u << 30;
constexpr uint32_t share_bit(uint32_t j) {
  return 3 * (j - 2);
}
constexpr uint32_t split_bit(uint32_t i) {
  return 21 + i - 2;
}
constexpr uint32_t kWidthBit = 27;

uint32_t share(uint32_t plan, uint32_t j) {
  return (plan >> share_bit(j) & 7) + 1;
}

/// Costs of the forests of up to i roots, i = 1..7, times area.
struct Forests {
  float cost[kWidth];
};

struct Planner {
  const Prices& prices;

  Forests plan(BinaryNode& node) const {
    Forests out;
    const auto area = float(node.box.area() / prices.root_area);
    const size_t limit = size_t(kMaxBlocks) * prices.block_width;
    const float leaf = node.count <= limit ? area * prices.leaf(node.count, area) : HUGE_VALF;
    if (node.leaf()) {
      for (float& c : out.cost) c = leaf;
      node.plan = kLeafBit;
      return out;
    }
    Forests side[2];
    const auto lower = [&] { side[0] = plan(node.children[0]); };
    const auto upper = [&] { side[1] = plan(node.children[1]); };
    if (node.count > kParallel) {
      parallel_invoke(lower, upper);
    } else {
      lower();
      upper();
    }
    uint32_t bits = 0;
    float shared[kWidth + 1];
    for (uint32_t j = 2; j <= kWidth; ++j) {
      shared[j] = HUGE_VALF;
      uint32_t best = 1;
      for (uint32_t k = 1; k < j; ++k) {
        const float cost = side[0].cost[k] + side[1].cost[j - k];
        if (cost < shared[j]) {
          shared[j] = cost;
          best = k;
        }
      }
      bits |= (best - 1) << share_bit(j);
    }
    float wide = HUGE_VALF;
    uint32_t width = kWidth;
    for (uint32_t j = 2; j <= kWidth; ++j) {
      const float cost = shared[j] + area * prices.wide(j, area);
      if (cost < wide) {
        wide = cost;
        width = j;
      }
    }
    bits |= (width - 1) << kWidthBit;
    if (leaf <= wide) bits |= kLeafBit;
    out.cost[1] = std::min(leaf, wide);
    for (uint32_t i = 2; i < kWidth; ++i) {
      out.cost[i] = std::min(out.cost[i - 1], shared[i]);
      if (shared[i] < out.cost[i - 1]) bits |= 1u << split_bit(i);
    }
    node.plan = bits;
    return out;
  }
};

void gather(const BinaryNode& node, std::vector<uint32_t>& rows) {
  if (node.leaf()) {
    rows.insert(rows.end(), node.rows, node.rows + node.count);
  } else {
    gather(node.children[0], rows);
    gather(node.children[1], rows);
  }
}

void merge_leaves(BinaryNode& node, Arena<uint32_t>& arena) {
  if (node.leaf()) return;
  if (node.plan & kLeafBit) {
    std::vector<uint32_t> rows;
    gather(node, rows);
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    node.rows = arena.take(rows.size());
    std::copy(rows.begin(), rows.end(), node.rows);
    node.count = rows.size();
    node.children = nullptr;
    return;
  }
  const auto lower = [&] { merge_leaves(node.children[0], arena); };
  const auto upper = [&] { merge_leaves(node.children[1], arena); };
  if (node.count > kParallel) {
    parallel_invoke(lower, upper);
  } else {
    lower();
    upper();
  }
}

/// Adds the best forest of up to i roots below `node`. Returns its place in the little tree.
uint32_t add_forest(BinaryNode& node, uint32_t i, Children& out);

uint32_t add_split(BinaryNode& node, uint32_t j, Children& out) {
  const uint32_t place = out.split_count++;
  const uint32_t k = share(node.plan, j);
  out.split[place].axis = node.axis;
  out.split[place].side[0] = add_forest(node.children[0], k, out);
  out.split[place].side[1] = add_forest(node.children[1], j - k, out);
  return kWidth + place;
}

uint32_t add_forest(BinaryNode& node, uint32_t i, Children& out) {
  if (!node.leaf()) {
    while (i > 1 && !(node.plan >> split_bit(i) & 1)) --i;
    if (i > 1) return add_split(node, i, out);
  }
  out.node[out.count] = &node;
  return out.count++;
}

}  // namespace

double plan_wide_tree(BinaryTree& tree) {
  const Forests forests = Planner{tree.prices}.plan(tree.root);
  merge_leaves(tree.root, tree.merged_rows);
  return double(forests.cost[1]);
}

Children children_of(BinaryNode& node) {
  Children out;
  if (node.leaf()) {
    out.node[out.count++] = &node;
  } else {
    add_split(node, (node.plan >> kWidthBit & 7) + 1, out);
  }
  return out;
}

uint32_t Children::order(uint32_t octant) const {
  uint32_t bits = 0, n = 0, stack[kWidth], depth = 0;
  stack[depth++] = split_count ? kWidth : 0;
  while (depth) {
    const uint32_t place = stack[--depth];
    if (place < kWidth) {
      bits |= place << (3 * n++);
      continue;
    }
    const Split& s = split[place - kWidth];
    const uint32_t first = octant >> s.axis & 1;
    stack[depth++] = s.side[first ^ 1];
    stack[depth++] = s.side[first];
  }
  for (; n < kWidth; ++n) bits |= n << (3 * n);
  return bits;
}

}  // namespace yat::tree

#include "scene/tree_top.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "scene/tree_parts.h"

namespace yat {
namespace {

constexpr uint32_t kLeaf = 0x80000000u;
constexpr uint32_t kBins = 32;
/// Binary levels after which sets are halved by index, whatever the price: bounds the depth.
constexpr uint32_t kMaxPricedDepth = 40;

TopBox nothing() {
  return {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
}

void add(TopBox& box, const TopBox& other) {
  for (int a = 0; a < 3; ++a) {
    box.min[a] = std::min(box.min[a], other.min[a]);
    box.max[a] = std::max(box.max[a], other.max[a]);
  }
}

/// Half the surface; 0 for no box.
double area(const TopBox& box) {
  const double x = box.max[0] - box.min[0], y = box.max[1] - box.min[1],
               z = box.max[2] - box.min[2];
  return x >= 0 ? x * y + y * z + z * x : 0;
}

double center(const TopBox& box, int axis) {
  return .5 * box.min[axis] + .5 * box.max[axis];
}

struct BinaryNode {
  TopBox box;
  uint32_t item = kNone;  ///< of a leaf
  int axis = 0;
  uint32_t child[2] = {kNone, kNone};
  bool leaf() const { return item != kNone; }
};

struct Split {
  double cost = HUGE_VAL;
  int axis = 0;
  uint32_t bin = 0;  ///< first of the upper side
};

struct Builder {
  std::span<const TopBox> boxes;
  std::vector<BinaryNode> nodes;

  /// Bin of a centre, between the bounds of all centres along the axis.
  static uint32_t bin_of(double at, double low, double high) {
    const double place = (at - low) / (high - low) * kBins;
    return std::min(uint32_t(std::max(place, 0.)), kBins - 1);
  }

  Split find_split(std::span<const uint32_t> items, const TopBox& centers) const {
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = centers.min[axis], high = centers.max[axis];
      if (!(high > low)) continue;
      std::array<TopBox, kBins> bin;
      std::array<uint32_t, kBins> count{};
      bin.fill(nothing());
      for (const uint32_t item : items) {
        const uint32_t b = bin_of(center(boxes[item], axis), low, high);
        add(bin[b], boxes[item]);
        ++count[b];
      }
      std::array<double, kBins> above{};  // cost of bins [i, kBins)
      TopBox sum = nothing();
      uint32_t n = 0;
      for (uint32_t i = kBins; i-- > 1;) {
        add(sum, bin[i]);
        above[i] = area(sum) * double(n += count[i]);
      }
      sum = nothing();
      n = 0;
      for (uint32_t i = 1; i < kBins; ++i) {
        add(sum, bin[i - 1]);
        n += count[i - 1];
        if (n == 0 || n == items.size()) continue;
        const double cost = area(sum) * double(n) + above[i];
        if (cost < best.cost) best = {cost, axis, i};
      }
    }
    return best;
  }

  uint32_t build(std::span<uint32_t> items, uint32_t depth) {
    const auto row = uint32_t(nodes.size());
    nodes.emplace_back();
    TopBox box = nothing(), centers = nothing();
    for (const uint32_t item : items) {
      add(box, boxes[item]);
      TopBox point;
      for (int a = 0; a < 3; ++a) point.min[a] = point.max[a] = center(boxes[item], a);
      add(centers, point);
    }
    nodes[row].box = box;
    if (items.size() == 1) {
      nodes[row].item = items[0];
      return row;
    }
    const Split split = depth < kMaxPricedDepth ? find_split(items, centers) : Split{};
    size_t left = items.size() / 2;
    if (split.cost < HUGE_VAL) {
      const double low = centers.min[split.axis], high = centers.max[split.axis];
      const auto middle = std::stable_partition(items.begin(), items.end(), [&](uint32_t item) {
        return bin_of(center(boxes[item], split.axis), low, high) < split.bin;
      });
      left = size_t(middle - items.begin());
    }
    nodes[row].axis = split.axis;
    const uint32_t first = build(items.first(left), depth + 1);
    const uint32_t second = build(items.subspan(left), depth + 1);
    nodes[row].child[0] = first;
    nodes[row].child[1] = second;
    return row;
  }
};

struct Collapse {
  const std::vector<BinaryNode>& binary;
  double grow;  // [m]
  Tree& tree;
  std::vector<TreeNode> nodes;

  /// The (up to eight) descendants of a node that become its children: the largest are opened.
  std::vector<uint32_t> open(uint32_t root) const {
    if (binary[root].leaf()) return {root};
    std::vector<uint32_t> set = {binary[root].child[0], binary[root].child[1]};
    while (set.size() < 8) {
      size_t widest = set.size();
      double widest_area = -1;
      for (size_t i = 0; i < set.size(); ++i)
        if (!binary[set[i]].leaf() && area(binary[set[i]].box) > widest_area) {
          widest = i;
          widest_area = area(binary[set[i]].box);
        }
      if (widest == set.size()) break;
      const BinaryNode& opened = binary[set[widest]];
      set[widest] = opened.child[0];
      set.insert(set.begin() + ptrdiff_t(widest) + 1, opened.child[1]);
    }
    return set;
  }

  /// Children of a node in the order in which a ray of `octant` meets them, by the splits.
  void order_of(uint32_t node, const std::vector<uint32_t>& set, uint32_t octant,
                std::vector<uint32_t>& order) const {
    for (size_t i = 0; i < set.size(); ++i)
      if (set[i] == node) return order.push_back(uint32_t(i));
    const uint32_t first = octant >> binary[node].axis & 1;
    order_of(binary[node].child[first], set, octant, order);
    order_of(binary[node].child[first ^ 1], set, octant, order);
  }

  uint32_t add_node(uint32_t root, uint32_t depth) {
    const auto row = uint32_t(nodes.size());
    nodes.emplace_back();
    tree.statistics.max_depth = std::max(tree.statistics.max_depth, depth + 1);
    const std::vector<uint32_t> set = open(root);
    TreeNode out;
    std::memset(&out, 0, sizeof out);
    float* planes[6] = {out.min_x, out.min_y, out.min_z, out.max_x, out.max_y, out.max_z};
    for (uint32_t i = 0; i < 8; ++i) {
      constexpr float kEmpty = std::numeric_limits<float>::infinity();
      for (int a = 0; a < 3; ++a) {
        const bool there = i < set.size();
        planes[a][i] = there ? tree::round_down(binary[set[i]].box.min[a] - grow) : kEmpty;
        planes[3 + a][i] = there ? tree::round_up(binary[set[i]].box.max[a] + grow) : -kEmpty;
      }
      out.child[i] = kNone;
    }
    for (uint32_t octant = 0; octant < 8; ++octant) {
      std::vector<uint32_t> order;
      order_of(root, set, octant, order);
      for (uint32_t i = uint32_t(order.size()); i < 8; ++i) order.push_back(i);
      uint32_t bits = 0;
      for (uint32_t k = 0; k < 8; ++k) bits |= order[k] << (3 * k);
      for (uint32_t byte = 0; byte < 3; ++byte)
        out.order[octant][byte] = uint8_t(bits >> (8 * byte));
    }
    for (uint32_t i = 0; i < set.size(); ++i) {
      const BinaryNode& child = binary[set[i]];
      tree.statistics.leaves += child.leaf();
      out.child[i] = child.leaf() ? kLeaf | child.item : add_node(set[i], depth + 1);
    }
    nodes[row] = out;
    return row;
  }
};

}  // namespace

Tree build_top_tree(std::span<const TopBox> boxes, std::span<const uint32_t> items_of) {
  Tree out;
  if (boxes.empty()) return out;
  Builder builder{boxes, {}};
  std::vector<uint32_t> items(boxes.size());
  for (uint32_t i = 0; i < items.size(); ++i) items[i] = i;
  builder.nodes.reserve(2 * boxes.size());
  builder.build(items, 0);

  const TopBox& all = builder.nodes[0].box;
  double extent = 0;
  for (int a = 0; a < 3; ++a) {
    out.view.min[a] = tree::round_down(all.min[a]);
    out.view.max[a] = tree::round_up(all.max[a]);
    extent = std::max({extent, std::abs(all.min[a]), std::abs(all.max[a])});
  }
  // The box test's rounding, for origins within kFarExtents: see tree_collapse.cpp.
  if (!items_of.empty())
    for (BinaryNode& node : builder.nodes)
      if (node.leaf()) node.item = items_of[node.item];
  Collapse work{builder.nodes, extent * 0x1p-17, out, {}};
  work.add_node(0, 0);
  out.nodes = AlignedArray<TreeNode>(std::span<const TreeNode>(work.nodes));
  out.statistics.nodes = work.nodes.size();
  out.statistics.references = boxes.size();
  out.view.nodes = out.nodes.data();
  out.view.node_count = uint32_t(work.nodes.size());
  out.view.max_depth = out.statistics.max_depth;
  return out;
}

}  // namespace yat

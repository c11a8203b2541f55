// Mends the top of a binary tree: takes its largest nodes out, one after the other, and puts each
// back where it enlarges the tree least.
//
// Source: Bittner, Hapala, Havran, "Fast Insertion-Based Optimization of Bounding Volume
// Hierarchies", 2013; Meister, Bittner, "Parallel Reinsertion for Bounding Volume Hierarchy
// Optimization", 2018, for the search. Departs from both: only the largest nodes, which most rays
// meet, and one at a time, so that no order of threads can change the tree.

#include <algorithm>
#include <queue>

#include "scene/tree_parts.h"

namespace yat::tree {
namespace {

constexpr size_t kNodes = 500;  ///< taken out per pass, at most
constexpr size_t kShare = 16;   ///< and at most one of so many
constexpr int kPasses = 4;

/// A node with its key, the largest (or, in a search, the least) first; of equals the first pushed.
struct Entry {
  double key, grown;
  uint32_t number;
  BinaryNode* node;
};
struct Less {
  bool operator()(const Entry& a, const Entry& b) const {
    return a.key != b.key ? a.key < b.key : a.number > b.number;
  }
};
using Queue = std::priority_queue<Entry, std::vector<Entry>, Less>;

void adopt(BinaryNode& node) {
  if (node.leaf()) return;
  node.children[0].parent = node.children[1].parent = &node;
}

Box box_of_children(const BinaryNode& node) {
  Box box = node.children[0].box;
  box.add(node.children[1].box);
  return box;
}

/// Axis and order of the children by their centres, as if a plane had parted them.
void orient(BinaryNode& node) {
  BinaryNode* const c = node.children;
  const F4 apart = splat(0.25f) * c[1].box.low + splat(0.25f) * c[1].box.high -
                   splat(0.25f) * c[0].box.low - splat(0.25f) * c[0].box.high;
  node.axis = 0;
  for (int a = 1; a < 3; ++a)
    if (std::abs(apart[a]) > std::abs(apart[node.axis])) node.axis = a;
  if (!(apart[node.axis] < 0)) return;
  std::swap(c[0], c[1]);
  for (int i = 0; i < 2; ++i) {
    adopt(c[i]);
    c[i].parent = &node;
  }
}

/// Boxes and counts from `node` up to the root.
void refit(BinaryNode* node) {
  for (; node; node = node->parent) {
    node->box = box_of_children(*node);
    node->count = node->children[0].count + node->children[1].count;
    orient(*node);
  }
}

struct Mender {
  BinaryNode& root;

  /// The largest nodes, from large to small.
  std::vector<BinaryNode*> largest(size_t count) const {
    std::vector<BinaryNode*> out;
    Queue queue;
    uint32_t number = 0;
    root.parent = nullptr;
    queue.push({root.box.area(), 0, number++, &root});
    while (!queue.empty() && out.size() < count) {
      BinaryNode* const node = queue.top().node;
      queue.pop();
      out.push_back(node);
      if (node->leaf()) continue;
      adopt(*node);
      for (int i = 0; i < 2; ++i)
        queue.push({node->children[i].box.area(), 0, number++, &node->children[i]});
    }
    return out;
  }

  /// Where a node with this box enlarges the tree least, by less than `limit`; null: nowhere. It
  /// becomes the sibling of what is there.
  BinaryNode* best_place(const Box& box, double limit) const {
    const double area = box.area();
    BinaryNode* best = nullptr;
    uint32_t number = 0;
    Queue queue;
    queue.push({-area, 0, number++, &root});
    while (!queue.empty()) {
      const Entry entry = queue.top();
      queue.pop();
      if (-entry.key >= limit) break;
      BinaryNode* const node = entry.node;
      Box both = node->box;
      both.add(box);
      const double joined = both.area();
      if (node != &root && entry.grown + joined < limit) {
        limit = entry.grown + joined;
        best = node;
      }
      const double grown = entry.grown + joined - node->box.area();
      if (node->leaf() || grown + area >= limit) continue;
      adopt(*node);
      for (int i = 0; i < 2; ++i)
        queue.push({-(grown + area), grown, number++, &node->children[i]});
    }
    return best;
  }

  /// Takes the node out and puts it back, elsewhere if that makes the tree smaller. Nodes move in
  /// memory with their siblings: pointers to them keep their places, not their contents.
  bool move(BinaryNode& node) const {
    BinaryNode* const parent = node.parent;
    if (!parent || !parent->parent) return false;
    // The sibling takes the parent's place; the pair of places becomes free.
    BinaryNode* const pair = parent->children;
    const BinaryNode taken = node;
    BinaryNode* const grandparent = parent->parent;
    double gain = parent->box.area();
    *parent = pair[&node == pair ? 1 : 0];
    parent->parent = grandparent;
    adopt(*parent);
    for (BinaryNode* above = grandparent; above; above = above->parent) {
      gain += above->box.area();
      above->box = box_of_children(*above);
      gain -= above->box.area();
    }
    // A little better is none: it must not go back and forth.
    BinaryNode* const found = best_place(taken.box, gain * (1 - 1e-6));
    BinaryNode& place = found ? *found : *parent;
    BinaryNode* const above = place.parent;
    pair[0] = place;
    pair[1] = taken;
    place = BinaryNode();
    place.children = pair;
    place.parent = above;
    for (int i = 0; i < 2; ++i) {
      adopt(pair[i]);
      pair[i].parent = &place;
    }
    refit(&place);
    if (found) refit(parent->leaf() ? parent->parent : parent);
    return found;
  }
};

size_t count_nodes(const BinaryNode& node, size_t enough) {
  if (node.leaf() || enough <= 1) return 1;
  const size_t lower = count_nodes(node.children[0], enough - 1);
  return 1 + lower + (lower + 1 < enough ? count_nodes(node.children[1], enough - 1 - lower) : 0);
}

}  // namespace

void mend_top(BinaryTree& tree) {
  const size_t nodes = count_nodes(tree.root, kNodes * kShare);
  const Mender mender{tree.root};
  for (int pass = 0; pass < kPasses; ++pass) {
    bool moved = false;
    for (BinaryNode* node : mender.largest(nodes / kShare)) moved = mender.move(*node) || moved;
    if (!moved) break;
  }
}

}  // namespace yat::tree

#pragma once
// Rays of short lists that look for their closest hit, each on its own way through what is below,
// nearest box first. A lone ray costs little to test and much to wait for: its next node or leaf is
// seldom in a near cache. So several walk in turn, a node each, and what a ray needs next has been
// asked for while the others went. A ray's answer does not depend on the order in which boxes are
// entered (invariant 1 holds as before): a box left out by its distance cannot hold a nearer hit.
//
// The closest-hit counterpart of traverse_tasks.h, where any order will do. Source of the box
// order: Wald, Benthin, Boulos, "Getting Rid of Packets", 2008.

#include "kernels/traverse_tasks.h"

namespace yat::YAT_ISA {

/// Longest list whose rays go alone.
inline constexpr uint32_t kWalkRays = 4;
/// A tree of so few nodes is always near: there is nothing to wait for.
inline constexpr uint32_t kFewNodes = 8;
/// Rays under way at a time.
inline constexpr uint32_t kWalks = 16;
/// Boxes that a stream may hand to a ray while that is under way.
inline constexpr uint32_t kHandedBoxes = 24;

/// A child of a node (TreeNode::child) and where the ray enters its box.
struct WalkBox {
  uint32_t child;
  float enter;
};

/// Rays under way. A ray is under way once, however many lists it was in: what comes later joins
/// what it still has to visit, behind that.
struct RayWalks {
  WalkBox* boxes = nullptr;         ///< kWalks times `places`
  uint8_t* walk_of_slot = nullptr;  ///< or kNoWalk
  uint32_t places = 0;
  uint32_t longest = 0;  ///< list whose rays go alone
  uint32_t active = 0;   ///< of `order`: the first ones are under way
  uint8_t order[kWalks] = {};
  uint32_t slot[kWalks] = {};
  uint32_t begin[kWalks] = {}, end[kWalks] = {};  ///< boxes to visit, the last first

  static constexpr uint8_t kNoWalk = 255;
  /// A node adds up to eight boxes and takes one.
  static constexpr uint32_t places_for(uint32_t max_depth) {
    return kHandedBoxes + 7 * (max_depth + 2) + 8;
  }
  static constexpr size_t bytes(uint32_t max_depth) {
    return size_t(kWalks) * places_for(max_depth) * sizeof(WalkBox);
  }
};

/// One step: a node, and leaves before it. False once the ray has nothing to visit.
template <class A, Query Q, class Pass>
YAT_INLINE bool step_walk(Pass& pass, uint32_t walk) noexcept {
  RayWalks& w = pass.walks;
  WalkBox* const boxes = w.boxes + size_t(walk) * w.places;
  const uint32_t slot = w.slot[walk], begin = w.begin[walk];
  const float* const record = pass.records + size_t(slot) * kRecordWords;
  float at[8];
  for (uint32_t end = w.end[walk]; end > begin;) {
    const WalkBox box = boxes[--end];
    if (!(box.enter <= record[kRecordT])) continue;
    if (box.child & kLeafBit) {
      pass.visit_leaf_by_ray(box.child, &slot, &box.enter, 1);
      continue;
    }
    const TreeNode& node = pass.tree.nodes[box.child];
    pass.count.rows += child_count<A>(node);
    pass.count.steps += 8 / kLanes<typename EightBoxes<A>::Arch>;
    const uint32_t first = end;
    for (uint32_t bits = boxes_entered<A, Q>(node, record, at); bits; bits &= bits - 1) {
      const auto c = uint32_t(__builtin_ctz(bits));
      pass.prefetch(node.child[c]);
      uint32_t k = end++;
      for (; k > first && boxes[k - 1].enter < at[c]; --k) boxes[k] = boxes[k - 1];
      boxes[k] = {node.child[c], at[c]};
    }
    if (end > first) {
      w.end[walk] = end;
      return true;
    }
  }
  return false;
}

/// Every ray under way goes a step. Not inlined, for the sake of long lists.
template <class A, Query Q, class Pass>
[[gnu::noinline]] void step_walks(Pass& pass, uint32_t left) noexcept {
  RayWalks& w = pass.walks;
  while (w.active > left)
    for (uint32_t i = 0; i < w.active;) {
      const uint8_t walk = w.order[i];
      if (step_walk<A, Q>(pass, walk)) {
        ++i;
        continue;
      }
      w.walk_of_slot[w.slot[walk]] = RayWalks::kNoWalk;
      w.order[i] = w.order[--w.active];
      w.order[w.active] = walk;
    }
}

/// Sends a ray to a box. Its memory has been asked for.
template <class A, Query Q, class Pass>
YAT_INLINE void send_ray(Pass& pass, uint32_t slot, const WalkBox& box) noexcept {
  RayWalks& w = pass.walks;
  uint32_t walk = w.walk_of_slot[slot];
  if (walk != RayWalks::kNoWalk) {
    if (w.begin[walk] > 0) {
      w.boxes[size_t(walk) * w.places + --w.begin[walk]] = box;
      return;
    }
    step_walks<A, Q>(pass, 0);
  }
  if (w.active == kWalks) step_walks<A, Q>(pass, kWalks - 1);
  walk = w.order[w.active++];
  w.walk_of_slot[slot] = uint8_t(walk);
  w.slot[walk] = slot;
  w.begin[walk] = kHandedBoxes - 1;
  w.end[walk] = kHandedBoxes;
  w.boxes[size_t(walk) * w.places + kHandedBoxes - 1] = box;
}

}  // namespace yat::YAT_ISA

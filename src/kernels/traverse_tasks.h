#pragma once
// Short lists of any-hit rays, put off. A list of a few rays costs little to test and much to wait
// for: the node or leaf that it goes to is seldom in a near cache. Its memory is asked for when the
// list is made, and the list waits in a ring behind some others, whose work hides the delay. Any
// hit ends a ray, so the order of lists changes nothing but the time (invariant 1 holds as before).
//
// Departs from the depth-first order of streams (Wald, Gribble, Boulos, Kensler 2007), which would
// enter a child as soon as it is asked for.

#include "kernels/traverse_leaf.h"

namespace yat::YAT_ISA {

/// An architecture whose float register holds at most eight lanes, for a ray against eight boxes.
template <class A>
struct EightBoxes {
  using Arch = A;
};
#if defined(__AVX512F__)
template <>
struct EightBoxes<xsimd::avx512bw> {
  using Arch = xsimd::fma3<xsimd::avx2>;
};
#endif

/// Of TreeNode::child.
inline constexpr uint32_t kLeafBit = 0x80000000u;

/// Number of a node's children.
template <class A>
YAT_INLINE uint32_t child_count(const TreeNode& node) {
  using B = typename EightBoxes<A>::Arch;
  uint32_t n = 0;
  for (uint32_t first = 0; first < 8; first += kLanes<B>)
    n += count_true<B>(mask_of<B>(UInt<B>::load_aligned(node.child + first) != UInt<B>(kNone)));
  return n;
}

/// One ray against the eight boxes of a node: bit c of the answer for box c, and for closest hits
/// in at[c] the distance where the ray enters it.
template <class A, Query Q>
YAT_INLINE uint32_t boxes_entered(const TreeNode& node, const float* record, float (&at)[8]) {
  using B = typename EightBoxes<A>::Arch;
  constexpr uint32_t L = kLanes<B>;
  static_assert(8 % L == 0);
  const float* const planes = node.min_x;
  const Float<B> zero(0.f), t_max(record[kRecordT]);
  const uint32_t near_x = record[2] < 0.f ? 24 : 0, near_y = record[3] < 0.f ? 32 : 8,
                 near_z = record[4] < 0.f ? 40 : 16;
  uint32_t bits = 0;
  for (uint32_t first = 0; first < 8; first += L) {
    const auto plane = [&](uint32_t offset, uint32_t axis) {
      return xsimd::fma(Float<B>::load_aligned(planes + offset + first), Float<B>(record[2 + axis]),
                        Float<B>(record[5 + axis]));
    };
    const Float<B> enter = xsimd::max(xsimd::max(plane(near_x, 0), plane(near_y, 1)),
                                      xsimd::max(plane(near_z, 2), zero));
    const Float<B> leave = xsimd::min(xsimd::min(plane(24 - near_x, 0), plane(40 - near_y, 1)),
                                      xsimd::min(plane(56 - near_z, 2), t_max));
    if constexpr (Q == Query::kClosest) enter.store_unaligned(at + first);
    bits |= mask_bits<B>(enter <= leave) << first;
  }
  return bits;
}

/// Longest list that is put off. A task is half a cache line.
inline constexpr uint32_t kTaskRays = 6;
/// Lists that wait while others are made: their memory is under way. More would leave the L1 cache
/// before their turn.
inline constexpr uint32_t kTasksAhead = 8;
/// With more waiting, the newest goes first, so that their number is bounded.
inline constexpr uint32_t kManyTasks = 64;

/// A child of a node (TreeNode::child) and the rays, at least one, that enter its box.
struct alignas(32) ShortTask {
  uint32_t child, count;
  uint32_t slots[kTaskRays];
};

/// A ring of tasks in scratch memory.
struct ShortTasks {
  ShortTask* ring = nullptr;
  uint32_t mask = 0;  ///< places - 1
  uint32_t first = 0, count = 0;

  /// Places that are always enough, a power of two. A visit adds up to eight to kTasksAhead. A task
  /// takes one and adds up to eight, so up to kManyTasks + 7 wait before newest goes first; from
  /// there on it is a descent that leaves up to seven siblings on each level.
  static constexpr uint32_t places(uint32_t max_depth) {
    uint32_t n = 2 * kManyTasks;
    while (n < kManyTasks + 8 * (max_depth + 2)) n *= 2;
    return n;
  }

  YAT_INLINE ShortTask& add() { return ring[(first + count++) & mask]; }
  YAT_INLINE const ShortTask& take() {
    --count;
    return ring[(count < kManyTasks ? first++ : first + count) & mask];
  }
};

/// Runs tasks until `left` wait. Pass: a Traversal. Not inlined, for the sake of long lists.
template <class A, Query Q, class Pass>
[[gnu::noinline]] void run_tasks(Pass& pass, uint32_t left) noexcept {
  float at[8];
  const auto entered = [&](const TreeNode& node, uint32_t slot) {
    return boxes_entered<A, Q>(node, pass.records + size_t(slot) * kRecordWords, at);
  };
  while (pass.tasks.count > left) {
    const ShortTask task = pass.tasks.take();
    if (task.child & kLeafBit) {
      pass.visit_leaf_by_ray(task.child, task.slots, nullptr, task.count);
      continue;
    }
    const TreeNode& node = pass.tree.nodes[task.child];
    pass.count.rows += uint64_t(task.count) * child_count<A>(node);
    pass.count.steps += task.count * (8 / kLanes<typename EightBoxes<A>::Arch>);
    if (task.count == 1) {
      for (uint32_t bits = entered(node, task.slots[0]); bits; bits &= bits - 1)
        pass.put_off(node.child[__builtin_ctz(bits)], task.slots, 1);
      continue;
    }
    uint32_t boxes[kTaskRays], any_box = 0;
    for (uint32_t i = 0; i < task.count; ++i) any_box |= boxes[i] = entered(node, task.slots[i]);
    for (; any_box; any_box &= any_box - 1) {
      const auto c = uint32_t(__builtin_ctz(any_box));
      uint32_t slots[kTaskRays], n = 0;
      for (uint32_t i = 0; i < task.count; ++i) {
        slots[n] = task.slots[i];
        n += boxes[i] >> c & 1;
      }
      pass.put_off(node.child[c], slots, n);
    }
  }
}

}  // namespace yat::YAT_ISA

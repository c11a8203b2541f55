#pragma once
// Rays against the 8-wide tree in breadth-first streams: a node is visited once with the list of
// all rays that reach it, tests them against its eight boxes, and hands each child the packed list
// of its rays. Long lists test W rays against one box after the other, short ones a ray against
// eight boxes, and the rays of the shortest leave the stream (traverse_tasks.h, traverse_walks.h).
//
// Row independence (invariant 1): what a ray meets follows from the tree and the ray. Whether
// it enters a box is decided by comparisons of its own numbers, the same in all kinds of test, and
// boxes are padded so that none that holds a hit is missed; of hits the nearest wins, then the
// lower row, in whatever order they are found. So neighbours in the list change nothing.
//
// Source: Wald, Gribble, Boulos, Kensler, "SIMD Ray Stream Tracing", 2007; Tsakok, "Faster
// Incoherent Rays: Multi-BVH Ray Stream Tracing", 2009; padding of boxes: see tree_collapse.cpp.

#include <type_traits>

#include "kernels/traverse_walks.h"

namespace yat::YAT_ISA {

/// Lists this short are tested against boxes ray by ray.
inline constexpr uint32_t kShortList = 4;

constexpr size_t list_words(uint32_t rays) {
  return padded_rows(rays) + kRowPad;  // A packed store may start at the last ray.
}

/// One pass over the tree. Leaves: what visits leaves where they are not blocks of triangles
/// (kernels/traverse_instances.h).
template <class A, Query Q, Passes P, class Leaves = void>
struct Traversal {
  static constexpr uint32_t W = kLanes<A>;
  /// From here on, lists are tested against triangles W rays at a time.
  static constexpr uint32_t kLongList = 2 * W;
  const TreeView& tree;
  float* records;
  uint32_t second_kz, third_kz;  ///< first slots of the classes kz = 1 and 2 of this pass
  uint32_t octant;               ///< of all rays, or (kOne) the one whose order serves them
  LaneCount count;
  Leaves* leaves = nullptr;
  uint32_t stopped = 0;   ///< rays of an any-hit pass that have met something
  ShortTasks tasks = {};  ///< of any-hit passes whose leaves are blocks
  RayWalks walks = {};    ///< of closest-hit passes whose leaves are blocks

  static constexpr bool kPutsOff = Q != Query::kClosest && std::is_void_v<Leaves>;
  static constexpr bool kSendsAlone = Q == Query::kClosest && std::is_void_v<Leaves>;

  YAT_INLINE void note_stopped(uint32_t rays) {
    if constexpr (kPutsOff) stopped += rays;
  }

  YAT_INLINE uint32_t kz_of(uint32_t slot) const {
    return uint32_t(slot >= second_kz) + uint32_t(slot >= third_kz);
  }

  YAT_INLINE void prefetch(uint32_t child) const {
    if (!std::is_void_v<Leaves> && (child & kLeafBit)) {
      if constexpr (!std::is_void_v<Leaves>) leaves->prefetch(child & ~kLeafBit);
    } else if (child & kLeafBit) {
      const float* p = tree.blocks + size_t((child & ~kLeafBit) >> 5) * tree.block_width * 10;
      for (uint32_t line = 0; line < tree.block_width * 10; line += 16)
        __builtin_prefetch(p + line);
    } else {
      const auto* p = reinterpret_cast<const char*>(tree.nodes + child);
      for (uint32_t line = 0; line < sizeof(TreeNode); line += 64) __builtin_prefetch(p + line);
    }
  }

  /// Whether ray i of a list, whose limit is t by now, has found something nearer than the list's
  /// box (closest) or anything at all (any).
  YAT_INLINE static bool is_done(float t, const float* enter, uint32_t i) {
    if constexpr (Q == Query::kClosest) return !(enter[i] <= t);
    return !(t > 0.f);
  }

  /// Drops rays that are done since the list was made.
  YAT_INLINE uint32_t drop_done(uint32_t* slots, float* enter, uint32_t n) const {
    uint32_t kept = 0;
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t slot = slots[i];
      slots[kept] = slot;
      const bool done = is_done(records[size_t(slot) * kRecordWords + kRecordT], enter, i);
      if constexpr (Q == Query::kClosest) enter[kept] = enter[i];
      kept += uint32_t(!done);
    }
    return kept;
  }

  /// A leaf with a list of less than kLongList rays, ray by ray.
  YAT_INLINE void visit_leaf_by_ray(uint32_t child, const uint32_t* slots, const float* enter,
                                    uint32_t n) noexcept {
    const uint32_t first = (child & ~kLeafBit) >> 5, blocks = (child & 31) + 1;
    const uint32_t width = tree.block_width;
    for (uint32_t i = 0; i < n;) {
      // Rays of one kz find the triangles in registers.
      const uint32_t begin = i, kz = kz_of(slots[i]);
      while (++i < n && kz_of(slots[i]) == kz) {
      }
      const float* block = tree.blocks + size_t(first) * width * 10;
      for (uint32_t b = 0; b < blocks; ++b, block += size_t(width) * 10)
        for (uint32_t k = 0; k < width; k += W) {
          if (k && block_prims(block, width)[k] == kNone) break;
          const BlockTriangles<A> triangles(block, width, k, BlockAxes(kz, width),
                                            tree.block_occluders[first + b]);
          for (uint32_t r = begin; r < i; ++r) {
            float* const record = records + size_t(slots[r]) * kRecordWords;
            if (is_done(record[kRecordT], enter, r)) continue;
            note_stopped(test_block<A, Q>(triangles, record, count));
          }
        }
    }
  }

  /// A leaf with a longer list, W rays at a time.
  YAT_INLINE void visit_leaf(uint32_t child, uint32_t* slots, uint32_t n) noexcept {
    const uint32_t first = (child & ~kLeafBit) >> 5, blocks = (child & 31) + 1;
    const uint32_t width = tree.block_width;
    const float* const block = tree.blocks + size_t(first) * width * 10;
    const uint32_t* const occluders = tree.block_occluders + first;
    UInt<A>(slots[0]).store_unaligned(slots + n);  // Padding that is safe to load.
    for (uint32_t i = 0; i < n; i += W) {
      Float<A> ray[8];
      load_rows8<A>(records + kRecordTriangle, slots + i, kRecordWords, ray);
      const uint32_t last = slots[(n - i < W ? n - i : W) + i - 1];
      const uint32_t from = kz_of(slots[i]), to = kz_of(last);
      const UInt<A> slot = load<A>(slots, i);
      for (uint32_t kz = from; kz <= to; ++kz) {
        Mask<A> active = tail_mask<A>(i, n);
        if (from != to) {
          const uint32_t begin = kz == 0 ? 0 : kz == 1 ? second_kz : third_kz;
          const uint32_t end = kz == 0 ? second_kz : kz == 1 ? third_kz : kNone;
          active = active & mask_of<A>(slot >= UInt<A>(begin)) & mask_of<A>(slot < UInt<A>(end));
          if (!any<A>(active)) continue;
        }
        note_stopped(test_rays<A, Q>(block, blocks, width, BlockAxes(kz, width), occluders, ray,
                                     active, records, slots + i, count));
      }
    }
  }

  /// The rays of a list against the boxes of a node: fills a list per child.
  YAT_INLINE void test_rays_by_box(const TreeNode& node, uint32_t children, const uint32_t* slots,
                                   uint32_t n, uint32_t* const (&lists)[8],
                                   float* const (&enters)[8], uint32_t (&lengths)[8]) noexcept {
    const float* const planes = node.min_x;
    const uint32_t near_x = octant & 1 ? 24 : 0, near_y = octant & 2 ? 32 : 8,
                   near_z = octant & 4 ? 40 : 16;
    const Float<A> zero(0.f);
    for (uint32_t i = 0; i < n; i += W) {
      Float<A> ray[8];  // u, 1/dir, -org/dir, t
      load_rows8<A>(records + kRecordBox, slots + i, kRecordWords, ray);
      const UInt<A> slot = load<A>(slots, i);
      const Mask<A> valid = tail_mask<A>(i, n);
      count.rows += uint64_t(n - i < W ? n - i : W) * children;
      count.steps += children;
      for (uint32_t c = 0; c < children; ++c) {
        const auto plane = [&](uint32_t offset, uint32_t axis) {
          return xsimd::fma(Float<A>(planes[offset + c]), ray[1 + axis], ray[4 + axis]);
        };
        Float<A> x0, x1, y0, y1, z0, z1;
        if constexpr (P == Passes::kByOctant) {
          x0 = plane(near_x, 0), x1 = plane(24 - near_x, 0);
          y0 = plane(near_y, 1), y1 = plane(40 - near_y, 1);
          z0 = plane(near_z, 2), z1 = plane(56 - near_z, 2);
        } else {
          const Float<A> ax = plane(0, 0), bx = plane(24, 0), ay = plane(8, 1), by = plane(32, 1),
                         az = plane(16, 2), bz = plane(40, 2);
          x0 = xsimd::min(ax, bx), x1 = xsimd::max(ax, bx);
          y0 = xsimd::min(ay, by), y1 = xsimd::max(ay, by);
          z0 = xsimd::min(az, bz), z1 = xsimd::max(az, bz);
        }
        const Float<A> enter = xsimd::max(xsimd::max(x0, y0), xsimd::max(z0, zero));
        const Float<A> leave = xsimd::min(xsimd::min(x1, y1), xsimd::min(z1, ray[7]));
        const Mask<A> in = (enter <= leave) & valid;
        store_packed<A>(slot, in, lists[c], lengths[c]);
        if constexpr (Q == Query::kClosest) store_packed<A>(enter, in, enters[c], lengths[c]);
        lengths[c] += count_true<A>(in);
      }
    }
  }

  /// The same, ray by ray: one ray against eight boxes.
  YAT_INLINE void test_boxes_by_ray(const TreeNode& node, uint32_t children, const uint32_t* slots,
                                    uint32_t n, uint32_t* const (&lists)[8],
                                    float* const (&enters)[8], uint32_t (&lengths)[8]) noexcept {
    float at[8];
    count.rows += uint64_t(n) * children;
    count.steps += n * (8 / kLanes<typename EightBoxes<A>::Arch>);
    for (uint32_t i = 0; i < n; ++i) {
      const float* const record = records + size_t(slots[i]) * kRecordWords;
      for (uint32_t bits = boxes_entered<A, Q>(node, record, at); bits; bits &= bits - 1) {
        const auto c = uint32_t(__builtin_ctz(bits));
        lists[c][lengths[c]] = slots[i];
        if constexpr (Q == Query::kClosest) enters[c][lengths[c]] = at[c];
        ++lengths[c];
      }
    }
  }

  /// Adds a list of up to kTaskRays rays, of which so many words can be read, to the tasks.
  YAT_INLINE void put_off(uint32_t child, const uint32_t* slots, uint32_t n) noexcept {
    prefetch(child);
    ShortTask& task = tasks.add();
    task.child = child;
    task.count = n;
    __builtin_memcpy(task.slots, slots, sizeof task.slots);
  }

  /// Visits a node with n > 0 rays, and what is below it. arena: free scratch.
  void visit(uint32_t row, const uint32_t* slots, uint32_t n, std::byte* arena) noexcept {
    const TreeNode& node = tree.nodes[row];
    const uint32_t children = child_count<A>(node);
    const uint32_t stopped_before = stopped;
    const size_t words = list_words(n);
    uint32_t* lists[8];
    float* enters[8];
    uint32_t lengths[8] = {};
    for (uint32_t c = 0; c < 8; ++c) {
      lists[c] = reinterpret_cast<uint32_t*>(arena) + words * c;
      enters[c] = reinterpret_cast<float*>(arena) + words * (8 + c);
    }
    arena += words * 4 * (Q == Query::kClosest ? 16 : 8);
    if (n <= kShortList) {
      test_boxes_by_ray(node, children, slots, n, lists, enters, lengths);
    } else {
      test_rays_by_box(node, children, slots, n, lists, enters, lengths);
    }
    for (uint32_t c = 0; c < children; ++c)
      if (kPutsOff && lengths[c] <= kTaskRays) {
        if (lengths[c]) put_off(node.child[c], lists[c], lengths[c]);
        lengths[c] = 0;
      } else if (lengths[c]) {
        prefetch(node.child[c]);
      }
    if constexpr (kPutsOff)
      if (tasks.count > kTasksAhead) run_tasks<A, Q>(*this, kTasksAhead);
    const uint8_t* const bytes = node.order[octant];
    uint32_t order = uint32_t(bytes[0]) | uint32_t(bytes[1]) << 8 | uint32_t(bytes[2]) << 16;
    for (uint32_t k = 0; k < children; ++k, order >>= 3) {
      const uint32_t c = order & 7;
      if (!lengths[c]) continue;
      const uint32_t child = node.child[c];
      const bool leaf = child & kLeafBit;
      uint32_t left = lengths[c];
      if constexpr (kSendsAlone)
        if (left <= walks.longest) {
          for (uint32_t i = 0; i < left; ++i)
            if (!is_done(records[size_t(lists[c][i]) * kRecordWords + kRecordT], enters[c], i))
              send_ray<A, Q>(*this, lists[c][i], {child, enters[c][i]});
          continue;
        }
      if constexpr (!std::is_void_v<Leaves>) {
        if (leaf) {
          left = drop_done(lists[c], enters[c], left);
          if (left) leaves->visit(child & ~kLeafBit, lists[c], left, arena, count);
          continue;
        }
      }
      // A ray that is done misses every box below, and short lists at leaves find out themselves.
      if (leaf && left >= kLongList && (!kPutsOff || stopped != stopped_before))
        left = drop_done(lists[c], enters[c], left);
      if (!left) continue;
      if (leaf && left < kLongList) {
        visit_leaf_by_ray(child, lists[c], enters[c], left);
      } else if (leaf) {
        visit_leaf(child, lists[c], left);
      } else {
        UInt<A>(lists[c][0]).store_unaligned(lists[c] + left);  // Padding that is safe to load.
        visit(child, lists[c], left, arena);
      }
    }
  }
};

/// Bytes of the parts of the scratch memory.
struct ScratchPlan {
  uint32_t rays;
  size_t records, words, total;
  YAT_INLINE ScratchPlan(const TreeView& tree, uint32_t max_rays) {
    rays = max_rays < kStreamRays ? max_rays : kStreamRays;
    records = (size_t(rays) + 1) * kRecordWords * 4;
    words = list_words(rays) * 4;
    // Tasks or walks, rows' slots, shifts and classes, the root's list, and eight lists (slots and
    // distances) per level of the tree, each as long as the stream: nothing can overflow.
    const size_t tasks = size_t(ShortTasks::places(tree.max_depth)) * sizeof(ShortTask);
    const size_t walks = RayWalks::bytes(tree.max_depth) + (size_t(rays) + 63) / 64 * 64;
    total = (tasks > walks ? tasks : walks) + records + words * 4 +
            words * 16 * (size_t(tree.max_depth) + 1) + 64;
  }
};

/// A part of the scratch memory, aligned to 64.
YAT_INLINE std::byte* take_bytes(std::byte*& free, size_t bytes) {
  std::byte* const part = free;
  free += (bytes + 63) / 64 * 64;
  return part;
}

/// Takes memory for a stream, sorts its rays and writes their records. Returns room for the slots
/// of the root's list.
template <class A, Query Q, Passes P, class Columns>
YAT_INLINE uint32_t* open_stream(const TreeView& tree, const Columns& rays, uint32_t n,
                                 const ScratchPlan& plan, std::byte*& free, RayStream& stream) {
  stream.records = reinterpret_cast<float*>(take_bytes(free, plan.records));
  stream.slot_of_row = reinterpret_cast<uint32_t*>(take_bytes(free, plan.words));
  stream.shift = reinterpret_cast<float*>(take_bytes(free, plan.words));
  stream.class_of_row = reinterpret_cast<uint32_t*>(take_bytes(free, plan.words));
  auto* const slots = reinterpret_cast<uint32_t*>(take_bytes(free, plan.words));
  const float extent = extent_of(tree);
  sort_rays<A, Q, P>(tree, extent, rays, n, stream);
  write_records<A, Q, P>(extent, rays, n, stream);
  return slots;
}

/// The passes over the tree; answers stay in the records. slots: from open_stream; free: scratch
/// memory behind it; leaves: see Traversal; common: the octant of most rays, for kOne.
template <class A, Query Q, Passes P, class Leaves>
YAT_INLINE LaneCount trace_passes(const TreeView& tree, const RayStream& stream, uint32_t* slots,
                                  std::byte* free, Leaves* leaves, uint32_t common = 0) {
  constexpr uint32_t W = kLanes<A>;
  LaneCount count;
  using Pass = Traversal<A, Q, P, Leaves>;
  ShortTasks tasks;
  RayWalks walks;
  if constexpr (Pass::kPutsOff) {
    const uint32_t places = ShortTasks::places(tree.max_depth);
    tasks.ring = reinterpret_cast<ShortTask*>(take_bytes(free, places * sizeof(ShortTask)));
    tasks.mask = places - 1;
  }
  if constexpr (Pass::kSendsAlone) {
    walks.boxes = reinterpret_cast<WalkBox*>(take_bytes(free, RayWalks::bytes(tree.max_depth)));
    walks.longest = tree.node_count > kFewNodes ? kWalkRays : 0;
    walks.places = RayWalks::places_for(tree.max_depth);
    walks.walk_of_slot = reinterpret_cast<uint8_t*>(take_bytes(free, stream.left_out));
    __builtin_memset(walks.walk_of_slot, RayWalks::kNoWalk, stream.left_out);
    for (uint32_t i = 0; i < kWalks; ++i) walks.order[i] = uint8_t(i);
  }
  for (uint32_t pass = 0; pass < kClasses<P> / 3; ++pass) {
    const uint32_t* const first = stream.first_slot + 3 * pass;
    const uint32_t m = first[3] - first[0];
    if (m == 0) continue;
    for (uint32_t i = 0; i < m; i += W)
      (lane_index<A>() + UInt<A>(first[0] + i)).store_unaligned(slots + i);
    UInt<A>(first[0]).store_unaligned(slots + m);
    const uint32_t octant = P == Passes::kByOctant ? pass : common;
    Pass traversal{tree, stream.records, first[1], first[2], octant, {}, leaves};
    traversal.tasks = tasks;
    traversal.walks = walks;
    traversal.visit(0, slots, m, free);
    if constexpr (Pass::kSendsAlone) step_walks<A, Q>(traversal, 0);
    if constexpr (traversal.kPutsOff) run_tasks<A, Q>(traversal, 0);
    count.rows += traversal.count.rows;
    count.steps += traversal.count.steps;
  }
  return count;
}

/// Traces rows [0, n), n <= kStreamRays, and leaves the answers in the records.
template <class A, Query Q, Passes P = kUsualPasses<Q>, class Columns>
YAT_INLINE LaneCount trace_stream(const TreeView& tree, const Columns& rays, uint32_t n,
                                  const Scratch& scratch, RayStream& stream,
                                  uint32_t common = 0) noexcept {
  std::byte* free = scratch.memory;
  uint32_t* const slots = open_stream<A, Q, P>(tree, rays, n, ScratchPlan(tree, n), free, stream);
  return trace_passes<A, Q, P>(tree, stream, slots, free, static_cast<void*>(nullptr), common);
}

/// See KernelTable. Hits are watertight, in (0, t_max]; of equal distances the lower primitive row
/// wins. A ray with a NaN or infinite number, or without direction, is a miss.
template <class A>
LaneCount intersect_closest(const TreeView& tree, const Ray<ConstColumn>& rays,
                            const Hit<Column>& hits, uint32_t n, const Scratch& scratch) noexcept {
  LaneCount count;
  for (uint32_t begin = 0; begin < n; begin += kStreamRays) {
    const uint32_t m = n - begin < kStreamRays ? n - begin : kStreamRays;
    const Ray<ConstColumn> in = columns_from(rays, begin);
    const Hit<Column> out = columns_from(hits, begin);
    RayStream stream;
    if (tree.node_count) {
      const LaneCount c = trace_stream<A, Query::kClosest>(tree, in, m, scratch, stream);
      count.rows += c.rows;
      count.steps += c.steps;
    }
    if (!tree.node_count) {
      for (uint32_t i = 0; i < m; ++i) {
        out.t[i] = in.t_max[i];
        out.u[i] = out.v[i] = 0.f;
        out.prim[i] = kNone;
      }
      continue;
    }
    for (uint32_t i = 0; i < m; i += kLanes<A>) {
      Float<A> head[8], tail[8];
      load_rows8<A>(stream.records, stream.slot_of_row + i, kRecordWords, head);
      load_rows8<A>(stream.records + kRecordTriangle, stream.slot_of_row + i, kRecordWords, tail);
      const UInt<A> prim = as_uint<A>(tail[kRecordPrim - kRecordTriangle]);
      Float<A> t = tail[kRecordT - kRecordTriangle];
      if (stream.any_shift) t = t + load<A>(stream.shift, i);
      const Mask<A> miss = mask_of<A>(prim == UInt<A>(kNone));
      store<A>(select<A>(miss, load<A>(in.t_max, i), t), out.t, i);
      store<A>(head[kRecordU], out.u, i);
      store<A>(head[kRecordV], out.v, i);
      store<A>(prim, out.prim, i);
    }
  }
  return count;
}

/// See KernelTable. Q says whether block_occluders are looked at.
template <class A, Query Q>
LaneCount intersect_shadow(const TreeView& tree, const ShadowRay<ConstColumn>& rays,
                           uint32_t* occluded, uint32_t n, const Scratch& scratch) noexcept {
  LaneCount count;
  for (uint32_t begin = 0; begin < n; begin += kStreamRays) {
    const uint32_t m = n - begin < kStreamRays ? n - begin : kStreamRays;
    RayStream stream;
    if (tree.node_count) {
      const LaneCount c = trace_stream<A, Q>(tree, columns_from(rays, begin), m, scratch, stream);
      count.rows += c.rows;
      count.steps += c.steps;
    }
    for (uint32_t i = 0; i < m; i += kLanes<A>) {
      UInt<A> stopped(0u);
      if (tree.node_count) {
        const UInt<A> slot = load<A>(stream.slot_of_row, i);
        const Float<A> t = gather<A>(static_cast<const float*>(stream.records) + kRecordT,
                                     slot * UInt<A>(kRecordWords));
        stopped = select<A>(t < Float<A>(0.f), UInt<A>(1u), UInt<A>(0u));
      }
      store<A>(stopped, occluded + begin, i);
    }
  }
  return count;
}

}  // namespace yat::YAT_ISA

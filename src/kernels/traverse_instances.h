#pragma once
// Rays against instances: a stream goes through the top tree as through any other, and where it
// reaches an instance, the rays of the list are taken to object space and go through the object's
// tree as a stream of their own. Directions are not normalised, so that distances are shared.
//
// A ray starts anew where it enters the instance's sphere, in scene space, before it is mapped
// relative to the instance's origin: what it meets is then known to roundings of the instance's
// size and of its place, however far away the ray began.
//
// Row independence (invariant 1): what is done to a ray at an instance follows from the ray, its
// nearest hit so far and the instance; the order of instances from the ray's octant. Of equal
// distances the scene's own primitives win, then the lower instance, then the lower row.

#include "kernels/sphere_entry.h"
#include "kernels/traverse_top.h"

namespace yat::YAT_ISA {

template <class A>
using InstanceRowW = InstanceRow<Lanes<A>::template Of>;

/// Lists of up to this many rays go through an object's tree in one pass.
inline constexpr uint32_t kMostInOnePass = 256;

/// Bytes of scratch memory for instances.
struct InstanceScratch {
  size_t columns;  ///< a column of the stream
  size_t top;      ///< the top tree's own
  size_t total;
  YAT_INLINE InstanceScratch(const InstancesView& instances, uint32_t max_rays) {
    TreeView deepest;
    deepest.max_depth = instances.tree_depth;
    const ScratchPlan plan(instances.top, max_rays), object(deepest, max_rays);
    columns = list_words(plan.rays) * 4;
    // The caller's: t_max, moved, instance. A leaf's: a ray (7) and its start, then the object's.
    top = plan.total;
    total = 3 * columns + top + 8 * columns + object.total + 1024;
  }
};

template <class A>
size_t instance_scratch_bytes(const InstancesView& instances, uint32_t max_rays) noexcept {
  return InstanceScratch(instances, max_rays).total;
}

/// Leaves of the top tree: an instance each.
template <class A, Query Q>
struct InstanceLeaves {
  static constexpr uint32_t W = kLanes<A>;
  const InstancesView& instances;
  float* records;
  const float* moved;     ///< per slot: distance from the ray's origin to its record's
  uint32_t* instance_of;  ///< per slot: of the nearest hit so far, or kNone

  YAT_INLINE void prefetch(uint32_t instance) const {
    __builtin_prefetch(instances.rows.words + size_t(instance) * row_words<InstanceRow>);
  }

  /// The octant to which most rays belong, axis by axis.
  YAT_INLINE static uint32_t common_octant(const Ray<ConstColumn>& rays, uint32_t n) {
    uint32_t backwards[3] = {};
    const float* const dir[3] = {rays.dir_x, rays.dir_y, rays.dir_z};
    for (uint32_t i = 0; i < n; i += W)
      for (int a = 0; a < 3; ++a)
        backwards[a] += count_true<A>((load<A>(dir[a], i) < Float<A>(0.f)) & tail_mask<A>(i, n));
    return uint32_t(2 * backwards[0] > n) | uint32_t(2 * backwards[1] > n) << 1 |
           uint32_t(2 * backwards[2] > n) << 2;
  }

  /// Takes rays to object space. to: their columns; start: by how much further on they begin than
  /// their records do.
  YAT_INLINE void enter(const InstanceRowW<A>& row, const uint32_t* slots, uint32_t n,
                        const Ray<Column>& to, float* start) const {
    const Vec3<A> center{row.org_x, row.org_y, row.org_z};
    for (uint32_t i = 0; i < n; i += W) {
      Float<A> ray[8];
      load_rows8<A>(records + kRecordRay, slots + i, kRecordWords, ray);
      const Vec3<A> org{ray[1], ray[2], ray[3]}, dir{ray[4], ray[5], ray[6]};
      const Float<A> skip = enter_sphere<A>(center, row.radius, org, dir).skip;
      const Vec3<A> from = start_at(org, dir, skip) - center;
      const auto map = [&row](const Vec3<A>& v) {
        return Vec3<A>{row.o_xx * v.x + row.o_xy * v.y + row.o_xz * v.z,
                       row.o_yx * v.x + row.o_yy * v.y + row.o_yz * v.z,
                       row.o_zx * v.x + row.o_zy * v.y + row.o_zz * v.z};
      };
      const Vec3<A> object_org = map(from), object_dir = map(dir);
      const Float<A> further = skip - gather<A>(moved, load<A>(slots, i));
      store<A>(object_org.x, to.org_x, i);
      store<A>(object_org.y, to.org_y, i);
      store<A>(object_org.z, to.org_z, i);
      store<A>(object_dir.x, to.dir_x, i);
      store<A>(object_dir.y, to.dir_y, i);
      store<A>(object_dir.z, to.dir_z, i);
      store<A>(ray[0] - further, to.t_max, i);
      store<A>(further, start, i);
    }
  }

  /// Hits nearer than those so far, back into the records.
  YAT_INLINE void leave(uint32_t instance, uint32_t first_triangle, const RayStream& stream,
                        const uint32_t* slots, uint32_t n, const float* start) const {
    for (uint32_t i = 0; i < n; i += W) {
      Float<A> found[8];
      load_rows8<A>(stream.records + kRecordTriangle, stream.slot_of_row + i, kRecordWords, found);
      const UInt<A> prim = as_uint<A>(found[kRecordPrim - kRecordTriangle]);
      const Float<A> left = found[kRecordT - kRecordTriangle];
      Mask<A> hit = tail_mask<A>(i, n);
      if constexpr (Q == Query::kClosest) {
        hit = hit & mask_of<A>(prim != UInt<A>(kNone));
      } else {
        hit = hit & (left < Float<A>(0.f));
      }
      uint32_t bits = mask_bits<A>(hit);
      if (!bits) continue;
      if constexpr (Q != Query::kClosest) {
        for (; bits; bits &= bits - 1)
          records[size_t(slots[i + uint32_t(__builtin_ctz(bits))]) * kRecordWords + kRecordT] =
              -1.f;
        continue;
      }
      Float<A> shift = load<A>(start, i);
      if (stream.any_shift) shift = shift + load<A>(stream.shift, i);
      alignas(64) float t[W];
      alignas(64) uint32_t prims[W];
      (left + shift).store_aligned(t);
      prim.store_aligned(prims);
      for (; bits; bits &= bits - 1) {
        const auto lane = uint32_t(__builtin_ctz(bits));
        const uint32_t slot = slots[i + lane];
        float* const record = records + size_t(slot) * kRecordWords;
        const bool nearer = t[lane] < record[kRecordT];
        const bool tie = t[lane] == record[kRecordT] && instance_of[slot] != kNone &&
                         instance < instance_of[slot];
        if (!nearer && !tie) continue;
        const float* const from =
            stream.records + size_t(stream.slot_of_row[i + lane]) * kRecordWords;
        const uint32_t row = first_triangle + prims[lane];
        record[kRecordT] = t[lane];
        record[kRecordU] = from[kRecordU];
        record[kRecordV] = from[kRecordV];
        __builtin_memcpy(record + kRecordPrim, &row, 4);
        instance_of[slot] = instance;
      }
    }
  }

  /// The rays of a list against one instance. arena: free scratch.
  void visit(uint32_t instance, uint32_t* slots, uint32_t n, std::byte* arena,
             LaneCount& count) const noexcept {
    const InstanceRowW<A> row = broadcast<A>(instances.rows, instance);
    const uint32_t* const words = instances.rows.words + size_t(instance) * row_words<InstanceRow>;
    const uint32_t object = words[kObjectWord], first_triangle = words[kFirstTriangleWord];
    UInt<A>(slots[0]).store_unaligned(slots + n);  // Padding that is safe to load.
    const size_t bytes = list_words(n) * 4;
    const auto column = [&] {
      auto* const p = reinterpret_cast<float*>(arena);
      arena += bytes;
      return p;
    };
    Ray<Column> rays;
    for_each_field([&](auto, auto& field) { field = column(); }, rays);
    float* const start = column();
    enter(row, slots, n, rays, start);
    count.rows += n;
    count.steps += (n + W - 1) / W;
    RayStream stream;
    const TreeView& tree = instances.trees[object];
    const Ray<ConstColumn> in = as_const_columns<Ray>(rays);
    // The map has turned the octant that the list's rays share into pieces of up to eight.
    LaneCount below;
    if (Q != Query::kClosest || n <= kMostInOnePass) {
      below =
          trace_stream<A, Q, Passes::kOne>(tree, in, n, {arena, 0}, stream, common_octant(in, n));
    } else {
      below = trace_stream<A, Q>(tree, in, n, {arena, 0}, stream);
    }
    count.rows += below.rows;
    count.steps += below.steps;
    leave(instance, first_triangle, stream, slots, n, start);
  }
};

/// Traces rows [0, n), n <= kStreamRays, and leaves the answers in the records. free: scratch of
/// InstanceScratch::total bytes. instance_of: per slot.
template <class A, Query Q>
YAT_INLINE LaneCount trace_instances(const InstancesView& instances, const Ray<ConstColumn>& rays,
                                     uint32_t n, std::byte* free, RayStream& stream,
                                     uint32_t*& instance_of) noexcept {
  constexpr uint32_t W = kLanes<A>;
  const TreeView& tree = instances.top;
  const ScratchPlan plan(tree, n);
  constexpr Passes P = kUsualPasses<Q>;
  uint32_t* const slots = open_stream<A, Q, P>(tree, rays, n, plan, free, stream);
  auto* const moved = reinterpret_cast<float*>(take_bytes(free, plan.words));
  instance_of = reinterpret_cast<uint32_t*>(take_bytes(free, plan.words));
  const uint32_t left_out = stream.left_out;
  write_raw_rays<A, Q>(rays, n, stream, moved);
  stream.records[size_t(left_out) * kRecordWords + kRecordT] = 0.f;  // Not occluded.
  for (uint32_t i = 0; i <= left_out; i += W) UInt<A>(kNone).store_unaligned(instance_of + i);

  InstanceLeaves<A, Q> leaves{instances, stream.records, moved, instance_of};
  return trace_passes<A, Q, P>(tree, stream, slots, free, &leaves);
}

/// See KernelTable.
template <class A>
LaneCount intersect_instances(const InstancesView& instances, const Ray<ConstColumn>& rays,
                              const Hit<Column>& hits, uint32_t* instance, uint32_t n,
                              const Scratch& scratch) noexcept {
  LaneCount count;
  for (uint32_t begin = 0; begin < n; begin += kStreamRays) {
    const uint32_t m = n - begin < kStreamRays ? n - begin : kStreamRays;
    const Hit<Column> out = columns_from(hits, begin);
    Ray<ConstColumn> in = columns_from(rays, begin);
    in.t_max = out.t;
    RayStream stream;
    uint32_t* instance_of;
    const LaneCount c =
        trace_instances<A, Query::kClosest>(instances, in, m, scratch.memory, stream, instance_of);
    count.rows += c.rows;
    count.steps += c.steps;
    for (uint32_t i = 0; i < m; i += kLanes<A>) {
      Float<A> head[8], tail[8];
      load_rows8<A>(stream.records, stream.slot_of_row + i, kRecordWords, head);
      load_rows8<A>(stream.records + kRecordRay, stream.slot_of_row + i, kRecordWords, tail);
      const UInt<A> prim = as_uint<A>(tail[kRecordPrim - kRecordRay]);
      const Mask<A> hit = mask_of<A>(prim != UInt<A>(kNone));
      store<A>(gather<A>(static_cast<const uint32_t*>(instance_of), load<A>(stream.slot_of_row, i)),
               instance + begin, i);
      if (!any<A>(hit)) continue;
      Float<A> t = tail[kRecordT - kRecordRay];
      if (stream.any_shift) t = t + load<A>(stream.shift, i);
      store<A>(select<A>(hit, t, load<A>(out.t, i)), out.t, i);
      store<A>(select<A>(hit, head[kRecordU], load<A>(out.u, i)), out.u, i);
      store<A>(select<A>(hit, head[kRecordV], load<A>(out.v, i)), out.v, i);
      store<A>(select<A>(hit, prim, load<A>(out.prim, i)), out.prim, i);
    }
  }
  return count;
}

/// See KernelTable. Q says whether block_occluders are looked at.
template <class A, Query Q>
LaneCount shadow_instances(const InstancesView& instances, const ShadowRay<ConstColumn>& rays,
                           uint32_t* occluded, uint32_t n, const Scratch& scratch) noexcept {
  LaneCount count;
  for (uint32_t begin = 0; begin < n; begin += kStreamRays) {
    const uint32_t m = n - begin < kStreamRays ? n - begin : kStreamRays;
    const ShadowRay<ConstColumn> from = columns_from(rays, begin);
    uint32_t* const out = occluded + begin;
    // Rays that something stopped already have no way left.
    auto* const t_max = reinterpret_cast<float*>(scratch.memory);
    for (uint32_t i = 0; i < m; i += kLanes<A>)
      store<A>(select<A>(mask_of<A>(load<A>(out, i) == UInt<A>(0u)), Float<A>(1.f), Float<A>(0.f)),
               t_max, i);
    const Ray<ConstColumn> in{from.org_x, from.org_y, from.org_z, from.dir_x,
                              from.dir_y, from.dir_z, t_max};
    RayStream stream;
    uint32_t* instance_of;
    const LaneCount c = trace_instances<A, Q>(
        instances, in, m, scratch.memory + InstanceScratch(instances, m).columns, stream,
        instance_of);
    count.rows += c.rows;
    count.steps += c.steps;
    for (uint32_t i = 0; i < m; i += kLanes<A>) {
      const UInt<A> slot = load<A>(stream.slot_of_row, i);
      const Float<A> t = gather<A>(static_cast<const float*>(stream.records) + kRecordT,
                                   slot * UInt<A>(kRecordWords));
      const Mask<A> stopped = t < Float<A>(0.f);
      store<A>(select<A>(stopped, UInt<A>(1u), load<A>(static_cast<const uint32_t*>(out), i)), out,
               i);
    }
  }
  return count;
}

}  // namespace yat::YAT_ISA

#pragma once
// Many spheres and shapes: the tree over their bounds, walked like any other, with a shape as leaf.
// What a ray meets is as with one after the other (a ray from far off up to rounding of its way).

#include "kernels/shapes/intersect.h"
#include "kernels/traverse_top.h"

namespace yat::YAT_ISA {

struct ShapeScratch {
  size_t column;  ///< of the stream
  size_t total;
  YAT_INLINE ShapeScratch(const TreeView& tree, uint32_t max_rays) {
    const ScratchPlan plan(tree, max_rays);
    column = list_words(plan.rays) * 4;
    // The caller's t_max, `moved`, then the tree's own.
    total = 2 * column + plan.total + 128;
  }
};

template <class A>
size_t shape_scratch_bytes(const TreeView& tree, uint32_t max_rays) noexcept {
  return ShapeScratch(tree, max_rays).total;
}

/// Leaves of the tree: a sphere or a shape each.
template <class A, Query Q>
struct ShapeLeaves {
  static constexpr uint32_t W = kLanes<A>;
  const GeometryView& geometry;
  float* records;
  const float* moved;  ///< per slot: distance from the ray's origin to its record's

  YAT_INLINE void prefetch(uint32_t item) const {
    const uint32_t spheres = geometry.spheres.count;
    if (item < spheres)
      __builtin_prefetch(geometry.spheres.words + size_t(item) * row_words<SphereRow>);
    else
      __builtin_prefetch(geometry.shapes.rows.words + size_t(item - spheres) * row_words<ShapeRow>);
  }

  template <class Distance>
  YAT_INLINE void visit_with(const Distance& distance, uint32_t prim, const uint32_t* slots,
                             uint32_t n) const {
    for (uint32_t i = 0; i < n; i += W) {
      Float<A> ray[8];
      load_rows8<A>(records + kRecordRay, slots + i, kRecordWords, ray);
      const Float<A> t = distance(RayLines<A>{ray[1], ray[2], ray[3], ray[4], ray[5], ray[6]});
      const Float<A> left = t - gather<A>(moved, load<A>(slots, i));
      const UInt<A> met = as_uint<A>(ray[7]), own(prim);
      Mask<A> hit = tail_mask<A>(i, n) & (t > Float<A>(0.f));
      if constexpr (Q == Query::kClosest) {
        hit = hit & ((left < ray[0]) | ((left == ray[0]) & mask_of<A>(met != UInt<A>(kNone)) &
                                        mask_of<A>(own < met)));
      } else {
        hit = hit & (left < ray[0]);
      }
      uint32_t bits = mask_bits<A>(hit);
      if (!bits) continue;
      alignas(64) float lefts[W];
      left.store_aligned(lefts);
      for (; bits; bits &= bits - 1) {
        const auto lane = uint32_t(__builtin_ctz(bits));
        float* const record = records + size_t(slots[i + lane]) * kRecordWords;
        if constexpr (Q == Query::kClosest) {
          record[kRecordT] = lefts[lane];
          __builtin_memcpy(record + kRecordPrim, &prim, 4);
        } else {
          record[kRecordT] = -1.f;
        }
      }
    }
  }

  template <ShapeKind kKind>
  YAT_INLINE void visit_shape(uint32_t shape, uint32_t prim, const uint32_t* slots,
                              uint32_t n) const {
    const ShapeRowW<A> row = broadcast<A>(geometry.shapes.rows, shape);
    visit_with([&](const RayLines<A>& line) { return shape_distance<A, kKind>(row, line); }, prim,
               slots, n);
  }

  /// The rays of a list against one item of the tree.
  void visit(uint32_t item, uint32_t* slots, uint32_t n, std::byte*,
             LaneCount& count) const noexcept {
    UInt<A>(slots[0]).store_unaligned(slots + n);  // Padding that is safe to load.
    count.rows += n;
    count.steps += (n + W - 1) / W;
    const uint32_t spheres = geometry.spheres.count;
    if (item < spheres) {
      const SphereRow<Value> row = read_row(geometry.spheres, item);
      if (Q != Query::kClosest && !row.occludes) return;
      return visit_with([&](const RayLines<A>& line) { return sphere_distance<A>(row, line); },
                        geometry.triangles.count + item, slots, n);
    }
    const uint32_t shape = item - spheres;
    const uint32_t prim = geometry.triangles.count + spheres + geometry.planes.count + shape;
    const ShapeRow<Value> row = read_row(geometry.shapes.rows, shape);
    if (Q != Query::kClosest && !row.occludes) return;
    switch (ShapeKind(row.kind)) {
      case ShapeKind::kQuadric:
        return visit_shape<ShapeKind::kQuadric>(shape, prim, slots, n);
      case ShapeKind::kDisk:
        return visit_shape<ShapeKind::kDisk>(shape, prim, slots, n);
      case ShapeKind::kTorus:
        return visit_shape<ShapeKind::kTorus>(shape, prim, slots, n);
      case ShapeKind::kCount:
        return;
    }
  }
};

/// Traces rows [0, n), n <= kStreamRays, and leaves the answers in the records.
template <class A, Query Q>
YAT_INLINE LaneCount trace_shapes(const GeometryView& geometry, const TreeView& tree,
                                  const Ray<ConstColumn>& rays, uint32_t n, std::byte* free,
                                  RayStream& stream) noexcept {
  const ScratchPlan plan(tree, n);
  constexpr Passes P = kUsualPasses<Q>;
  uint32_t* const slots = open_stream<A, Q, P>(tree, rays, n, plan, free, stream);
  auto* const moved = reinterpret_cast<float*>(take_bytes(free, plan.words));
  write_raw_rays<A, Q>(rays, n, stream, moved);
  const uint32_t left_out = stream.left_out;
  stream.records[size_t(left_out) * kRecordWords + kRecordT] = 0.f;  // Not occluded.
  ShapeLeaves<A, Q> leaves{geometry, stream.records, moved};
  return trace_passes<A, Q, P>(tree, stream, slots, free, &leaves);
}

/// See KernelTable.
template <class A>
LaneCount intersect_shape_tree(const GeometryView& geometry, const TreeView& tree,
                               const Ray<ConstColumn>& rays, const Hit<Column>& hits, uint32_t n,
                               const Scratch& scratch) noexcept {
  LaneCount count;
  for (uint32_t begin = 0; begin < n; begin += kStreamRays) {
    const uint32_t m = n - begin < kStreamRays ? n - begin : kStreamRays;
    const Hit<Column> out = columns_from(hits, begin);
    Ray<ConstColumn> in = columns_from(rays, begin);
    in.t_max = out.t;
    RayStream stream;
    const LaneCount c =
        trace_shapes<A, Query::kClosest>(geometry, tree, in, m, scratch.memory, stream);
    count.rows += c.rows;
    count.steps += c.steps;
    for (uint32_t i = 0; i < m; i += kLanes<A>) {
      Float<A> tail[8];
      load_rows8<A>(stream.records + kRecordRay, stream.slot_of_row + i, kRecordWords, tail);
      const UInt<A> prim = as_uint<A>(tail[kRecordPrim - kRecordRay]);
      const Mask<A> hit = mask_of<A>(prim != UInt<A>(kNone));
      if (!any<A>(hit)) continue;
      const Float<A> zero(0.f);
      Float<A> t = tail[kRecordT - kRecordRay];
      if (stream.any_shift) t = t + load<A>(stream.shift, i);
      store<A>(select<A>(hit, t, load<A>(out.t, i)), out.t, i);
      store<A>(select<A>(hit, zero, load<A>(out.u, i)), out.u, i);
      store<A>(select<A>(hit, zero, load<A>(out.v, i)), out.v, i);
      store<A>(select<A>(hit, prim, load<A>(out.prim, i)), out.prim, i);
    }
  }
  return count;
}

/// See KernelTable.
template <class A>
LaneCount shadow_shape_tree(const GeometryView& geometry, const ShadowRay<ConstColumn>& rays,
                            uint32_t* occluded, uint32_t n, const Scratch& scratch) noexcept {
  const TreeView& tree = geometry.shapes.tree;
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
    const LaneCount c = trace_shapes<A, Query::kAny>(
        geometry, tree, in, m, scratch.memory + ShapeScratch(tree, m).column, stream);
    count.rows += c.rows;
    count.steps += c.steps;
    for (uint32_t i = 0; i < m; i += kLanes<A>) {
      const UInt<A> slot = load<A>(stream.slot_of_row, i);
      const Float<A> t = gather<A>(static_cast<const float*>(stream.records) + kRecordT,
                                   slot * UInt<A>(kRecordWords));
      store<A>(
          select<A>(t < Float<A>(0.f), UInt<A>(1u), load<A>(static_cast<const uint32_t*>(out), i)),
          out, i);
    }
  }
  return count;
}

}  // namespace yat::YAT_ISA

#pragma once
// Rays against the 8-wide tree in tiles: 64 rays that lie close together, in rows of their own, go
// through the tree as one beam. A node's eight boxes are tested at once against the beam, a leaf's
// box against its four sub-beams of 16 rays, a block's triangles against each sub-beam that is
// left, and the few triangles that survive against 16 rays.
//
// Row independence (invariant 1): a beam leaves out only what none of its rays can hit, exactly
// (traverse_beam.h), and the rays meet the rest in the triangle test of the streams. A ray's answer
// is therefore, to the bit, that of intersect_closest, whatever tile it lies in. Rays that do not
// belong together are served too, only slowly.

#include "kernels/traverse.h"
#include "kernels/traverse_beam.h"

namespace yat::YAT_ISA {

inline constexpr uint32_t kTileRays = 64;
inline constexpr uint32_t kBeamRays = 16;
inline constexpr uint32_t kTileBeams = kTileRays / kBeamRays;

/// A tile that needs more tests than this sees triangles of about a pixel's size: it goes to the
/// streams instead, and after it, untried, up to kMostUntried tiles that follow.
inline constexpr uint32_t kMostTests = 256;
inline constexpr uint32_t kMostUntried = 31;

/// Rays of a tile and their hits so far.
struct Tile {
  alignas(64) float org[3][kTileRays], shear[3][kTileRays];  ///< as in ShearedRay
  alignas(64) float t[kTileRays], u[kTileRays], v[kTileRays];
  alignas(64) uint32_t prim[kTileRays];
  /// 2 * main axis + (1 if it moves backwards along it), or kNone: misses everything.
  alignas(64) uint32_t way[kTileRays];
};

/// A subtree to visit, or a leaf.
struct TileEntry {
  uint32_t child;  ///< as in TreeNode
  uint32_t box;    ///< node row * 8 + place in it
  float nearest;   ///< no ray of the tile takes a hit nearer than this in it
};
constexpr size_t tile_stack_bytes(uint32_t max_depth) {
  return (size_t(max_depth) * 7 + 8) * sizeof(TileEntry);
}

/// See KernelTable. Enough for either kind of traversal.
template <class A>
size_t traversal_scratch_bytes(const TreeView& tree, uint32_t max_rays) noexcept {
  const size_t stream = ScratchPlan(tree, max_rays).total, stack = tile_stack_bytes(tree.max_depth);
  return stream > stack ? stream : stack;
}

/// One pass over the tree with those rays of a tile that go one way. kOneOrigin: from one point.
template <class A>
struct TilePass {
  static constexpr uint32_t W = kLanes<A>;
  static constexpr uint32_t kRegisters = kBeamRays / W;  ///< per beam
  using B = typename EightBoxes<A>::Arch;
  static constexpr uint32_t L = kLanes<B>;
  static_assert(kBeamRays % W == 0 && L >= kTileBeams && 8 % L == 0);

  const TreeView& tree;
  Tile& tile;
  const uint32_t way;
  Beam<float> whole;
  /// The sub-beams: field by field, a beam per lane.
  alignas(64) Beam<float[8]> beams;
  uint32_t live;  ///< bit b: beam b has a ray of this way
  bool one_origin;
  uint32_t tests;  ///< of a sub-beam against a block, and of its rays against a triangle
  LaneCount count;

  uint32_t kz() const { return way / 2; }
  bool backwards() const { return way & 1; }

  YAT_INLINE Mask<A> active(uint32_t row) const {
    return mask_of<A>(UInt<A>::load_aligned(tile.way + row) == UInt<A>(way));
  }

  /// Bounds of the beams. Returns the rows that go this way as bits.
  YAT_INLINE uint64_t bound(uint32_t rows) {
    constexpr float kMost = 3.402823466e38f;
    uint64_t taken = 0;
    const Float<A> most(kMost), least(-kMost);
    live = 0;
    one_origin = true;
    float first[3] = {};
    for (uint32_t b = 0; b < kTileBeams; ++b) {
      Float<A> low[5], high[5], slope = most, t = least;
      for (int f = 0; f < 5; ++f) low[f] = most, high[f] = least;
      uint32_t any_here = 0;
      for (uint32_t r = 0; r < kRegisters; ++r) {
        const uint32_t row = b * kBeamRays + r * W;
        if (row >= rows) break;
        const Mask<A> in = active(row);
        const uint32_t bits = mask_bits<A>(in);
        if (!bits) continue;
        if (!taken)
          for (int a = 0; a < 3; ++a) first[a] = tile.org[a][row + uint32_t(__builtin_ctz(bits))];
        taken |= uint64_t(bits) << row;
        any_here |= bits;
        Mask<A> moved = in;
        for (int a = 0; a < 3; ++a) {
          const Float<A> o = Float<A>::load_aligned(tile.org[a] + row);
          moved = a ? moved | (o != Float<A>(first[a])) : (o != Float<A>(first[a]));
          low[a] = xsimd::min(low[a], select<A>(in, o, most));
          high[a] = xsimd::max(high[a], select<A>(in, o, least));
        }
        one_origin = one_origin && !any<A>(moved & in);
        for (int a = 0; a < 2; ++a) {
          const Float<A> s = Float<A>::load_aligned(tile.shear[a] + row);
          low[3 + a] = xsimd::min(low[3 + a], select<A>(in, s, most));
          high[3 + a] = xsimd::max(high[3 + a], select<A>(in, s, least));
        }
        const Float<A> s = xsimd::abs(Float<A>::load_aligned(tile.shear[2] + row));
        slope = xsimd::min(slope, select<A>(in, s, most));
        t = xsimd::max(t, select<A>(in, Float<A>::load_aligned(tile.t + row), least));
      }
      live |= uint32_t(any_here != 0) << b;
      const bool known = any_here && one_origin;
      for (int a = 0; a < 3; ++a) {
        beams.org_low[a][b] = known ? first[a] : xsimd::reduce_min(low[a]);
        beams.org_high[a][b] = known ? first[a] : xsimd::reduce_max(high[a]);
      }
      for (int a = 0; a < 2; ++a) {
        beams.shear_low[a][b] = xsimd::reduce_min(low[3 + a]);
        beams.shear_high[a][b] = xsimd::reduce_max(high[3 + a]);
      }
      beams.slope[b] = xsimd::reduce_min(slope) * kSlopeMargin;
      beams.t_max[b] = xsimd::reduce_max(t);
    }
    const auto least_of = [](const float* v) {
      const float p = v[0] < v[1] ? v[0] : v[1], q = v[2] < v[3] ? v[2] : v[3];
      return p < q ? p : q;
    };
    for (int a = 0; a < 3; ++a) {
      whole.org_low[a] = least_of(beams.org_low[a]);
      whole.org_high[a] = most_of(beams.org_high[a]);
    }
    for (int a = 0; a < 2; ++a) {
      whole.shear_low[a] = least_of(beams.shear_low[a]);
      whole.shear_high[a] = most_of(beams.shear_high[a]);
    }
    whole.slope = least_of(beams.slope);
    whole.t_max = most_of(beams.t_max);
    return taken;
  }
  static YAT_INLINE float most_of(const float* v) {
    const float p = v[0] > v[1] ? v[0] : v[1], q = v[2] > v[3] ? v[2] : v[3];
    return p > q ? p : q;
  }

  /// The octant by which children are ordered: that of the beam's middle.
  YAT_INLINE uint32_t octant() const {
    const uint32_t back = backwards();
    uint32_t bits = back << kz();
    for (uint32_t a = 0; a < 2; ++a) {
      const bool negative_shear = whole.shear_low[a] + whole.shear_high[a] < 0;
      bits |= uint32_t(negative_shear != bool(back)) << (kz() + 1 + a) % 3;
    }
    return bits;
  }

  /// The triangles `bits` of a block, from `first` on, against the rays of beam b.
  YAT_INLINE void test_beam(const float* block, uint32_t width, uint32_t bits, uint32_t b) {
    const BlockAxes axes(kz(), width);
    const uint32_t* const prims = block_prims(block, width);
    const Float<A> zero(0.f);
    uint32_t improved = 0;
    for (uint32_t r = 0; r < kRegisters; ++r) {
      const uint32_t row = b * kBeamRays + r * W;
      const Mask<A> in = active(row);
      Float<A> org[3], shear[3];
      for (int a = 0; a < 3; ++a) {
        org[a] = Float<A>::load_aligned(tile.org[a] + row);
        shear[a] = Float<A>::load_aligned(tile.shear[a] + row);
      }
      Float<A> t = Float<A>::load_aligned(tile.t + row);
      Float<A> u = Float<A>::load_aligned(tile.u + row), v = Float<A>::load_aligned(tile.v + row);
      UInt<A> prim = UInt<A>::load_aligned(tile.prim + row);
      uint32_t here = 0;
      for (uint32_t left = bits; left; left &= left - 1) {
        const auto k = uint32_t(__builtin_ctz(left));
        const auto vertex = [&](uint32_t i) {
          const float* const p = block + 3 * i * width + k;
          return ShearedVertex<A>(Float<A>(p[axes.x]), Float<A>(p[axes.y]), Float<A>(p[axes.z]),
                                  org, shear);
        };
        const UInt<A> candidate(prims[k]);
        TriangleHits<A> h;
        const bool found = test_triangles<A>(
            vertex(0), vertex(1), vertex(2), shear,
            [&](const Float<A>& distance) {
              return in & (distance > zero) &
                     ((distance < t) | ((distance == t) & mask_of<A>(candidate < prim)));
            },
            [&] { return plane_of<A>(block, width, k, axes, org); }, h);
        if (!found) continue;
        here |= mask_bits<A>(h.hit);
        t = select<A>(h.hit, h.t, t);
        u = select<A>(h.hit, h.u, u);
        v = select<A>(h.hit, h.v, v);
        prim = select<A>(h.hit, candidate, prim);
      }
      const auto triangles = uint32_t(__builtin_popcount(bits));
      count.rows += triangles * count_true<A>(in);
      count.steps += triangles;
      if (!here) continue;
      improved |= here;
      t.store_aligned(tile.t + row);
      u.store_aligned(tile.u + row);
      v.store_aligned(tile.v + row);
      prim.store_aligned(tile.prim + row);
    }
    if (!improved) return;
    Float<A> farthest(-1.f);
    for (uint32_t r = 0; r < kRegisters; ++r) {
      const uint32_t row = b * kBeamRays + r * W;
      farthest = xsimd::max(farthest,
                            select<A>(active(row), Float<A>::load_aligned(tile.t + row), farthest));
    }
    beams.t_max[b] = xsimd::reduce_max(farthest);
    whole.t_max = most_of(beams.t_max);
  }

  template <bool kOneOrigin>
  YAT_INLINE void visit_leaf(const TileEntry& entry) {
    // The leaf's box against the four beams.
    const float* const planes = tree.nodes[entry.box >> 3].min_x + (entry.box & 7);
    Interval<B> box[3];
    Beam<Float<B>> four;
    for (uint32_t a = 0; a < 3; ++a) {
      const uint32_t axis = (kz() + 1 + a) % 3;
      box[a] = {Float<B>(planes[8 * axis]), Float<B>(planes[24 + 8 * axis])};
      four.org_low[a] = Float<B>::load_aligned(beams.org_low[a]);
      four.org_high[a] = Float<B>::load_aligned(beams.org_high[a]);
    }
    for (int a = 0; a < 2; ++a) {
      four.shear_low[a] = Float<B>::load_aligned(beams.shear_low[a]);
      four.shear_high[a] = Float<B>::load_aligned(beams.shear_high[a]);
    }
    four.slope = Float<B>::load_aligned(beams.slope);
    four.t_max = Float<B>::load_aligned(beams.t_max);
    Float<B> nearest;
    const uint32_t met = mask_bits<B>(meets_box<B>(box, four, backwards(), nearest)) & live;
    if (!met) return;

    const uint32_t first = (entry.child & ~kLeafBit) >> 5, blocks = (entry.child & 31) + 1;
    const uint32_t width = tree.block_width;
    const BlockAxes axes(kz(), width);
    const float* block = tree.blocks + size_t(first) * width * 10;
    for (uint32_t n = 0; n < blocks; ++n, block += size_t(width) * 10)
      for (uint32_t left = met; left; left &= left - 1) {
        const auto b = uint32_t(__builtin_ctz(left));
        const Beam<Float<A>> beam = broadcast<A>(beam_of(b));
        uint32_t bits = 0;
        for (uint32_t k = 0; k < width; k += W) {
          Float<A> vertex[3][3];
          for (uint32_t i = 0; i < 3; ++i) {
            const float* const p = block + 3 * i * width + k;
            vertex[i][0] = Float<A>::load_unaligned(p + axes.x);
            vertex[i][1] = Float<A>::load_unaligned(p + axes.y);
            vertex[i][2] = Float<A>::load_unaligned(p + axes.z);
          }
          bits |= mask_bits<A>(meets_triangle<A, kOneOrigin>(vertex, beam, backwards())) << k;
        }
        tests += 1 + uint32_t(__builtin_popcount(bits));
        if (bits) test_beam(block, width, bits, b);
      }
  }
  YAT_INLINE Beam<float> beam_of(uint32_t b) const {
    Beam<float> out;
    for (int a = 0; a < 3; ++a) {
      out.org_low[a] = beams.org_low[a][b];
      out.org_high[a] = beams.org_high[a][b];
    }
    for (int a = 0; a < 2; ++a) {
      out.shear_low[a] = beams.shear_low[a][b];
      out.shear_high[a] = beams.shear_high[a][b];
    }
    out.slope = beams.slope[b];
    out.t_max = beams.t_max[b];
    return out;
  }

  /// Pushes what the beam meets of a node's children, the nearest on top.
  YAT_INLINE TileEntry* visit_node(uint32_t row, uint32_t octant, TileEntry* top) {
    const TreeNode& node = tree.nodes[row];
    alignas(64) float nearest[8];
    uint32_t met = 0;
    const Beam<Float<B>> beam = broadcast<B>(whole);
    for (uint32_t k = 0; k < 8; k += L) {
      Interval<B> box[3];
      for (uint32_t a = 0; a < 3; ++a) {
        const float* const planes = node.min_x + 8 * ((kz() + 1 + a) % 3) + k;
        box[a] = {Float<B>::load_aligned(planes), Float<B>::load_aligned(planes + 24)};
      }
      Float<B> distance;
      met |= mask_bits<B>(meets_box<B>(box, beam, backwards(), distance)) << k;
      distance.store_aligned(nearest + k);
    }
    count.rows += 8;
    count.steps += 8 / L;
    const uint8_t* const bytes = node.order[octant];
    const uint32_t order = uint32_t(bytes[0]) | uint32_t(bytes[1]) << 8 | uint32_t(bytes[2]) << 16;
    for (uint32_t k = 8; k-- > 0;) {
      const uint32_t c = order >> 3 * k & 7;
      // The box of a child that is not there is empty, but infinity minus infinity met it.
      if (!(met >> c & 1) || node.child[c] == kNone) continue;
      *top++ = {node.child[c], row * 8 + c, nearest[c]};
    }
    return top;
  }

  /// False where it was given up, after kMostTests.
  template <bool kOneOrigin>
  YAT_INLINE bool run(TileEntry* const stack) {
    const uint32_t ordered_by = octant();
    TileEntry* top = visit_node(0, ordered_by, stack);
    while (top != stack) {
      const TileEntry entry = *--top;
      if (entry.nearest > whole.t_max) continue;
      if (entry.child & kLeafBit) {
        visit_leaf<kOneOrigin>(entry);
        if (tests > kMostTests) return false;
      } else {
        top = visit_node(entry.child, ordered_by, top);
      }
    }
    return true;
  }
};

/// Reads n <= kTileRays rays. False if one comes from so far that its origin must be moved.
template <class A>
YAT_INLINE bool read_tile(const Ray<ConstColumn>& rays, uint32_t n, float far, Tile& tile) {
  constexpr uint32_t W = kLanes<A>;
  for (uint32_t row = 0; row < n; row += W) {
    const RawRays<A> r = load_raw<A, Query::kClosest>(rays, row);
    const Mask<A> valid = tail_mask<A>(row, n) & can_hit<A>(r);
    if (any<A>(valid & (max_magnitude<A>(r.org) > Float<A>(far)))) return false;
    const MainAxis<A> axis(r.dir);
    const ShearedRay<A> sheared(r, axis);
    for (int a = 0; a < 3; ++a) {
      sheared.org[a].store_aligned(tile.org[a] + row);
      sheared.shear[a].store_aligned(tile.shear[a] + row);
    }
    const UInt<A> kz = axis.number();
    const UInt<A> way =
        kz + kz + select<A>(sheared.shear[2] < Float<A>(0.f), UInt<A>(1u), UInt<A>(0u));
    select<A>(valid, way, UInt<A>(kNone)).store_aligned(tile.way + row);
    r.t_max.store_aligned(tile.t + row);
    Float<A>(0.f).store_aligned(tile.u + row);
    Float<A>(0.f).store_aligned(tile.v + row);
    UInt<A>(kNone).store_aligned(tile.prim + row);
  }
  for (uint32_t row = padded_rows(n); row-- > (n + W - 1) / W * W;) tile.way[row] = kNone;
  return true;
}

/// Traces n <= kTileRays rows as one beam. False where it was given up, and hits hold nothing.
template <class A>
YAT_INLINE bool trace_tile(const TreeView& tree, const Ray<ConstColumn>& rays,
                           const Hit<Column>& hits, uint32_t n, float far, TileEntry* stack,
                           LaneCount& count) {
  constexpr uint32_t W = kLanes<A>;
  Tile tile;
  if (!read_tile<A>(rays, n, far, tile)) return false;
  uint64_t done = 0;
  for (uint32_t row = 0; row < n; ++row) {
    if (done >> row & 1 || tile.way[row] == kNone) continue;
    TilePass<A> pass{tree, tile, tile.way[row], {}, {}, 0, true, 0, {}};
    done |= pass.bound(n);
    const bool finished =
        pass.one_origin ? pass.template run<true>(stack) : pass.template run<false>(stack);
    count.rows += pass.count.rows;
    count.steps += pass.count.steps;
    if (!finished) return false;
  }
  for (uint32_t row = 0; row < n; row += W) {
    store<A>(Float<A>::load_aligned(tile.t + row), hits.t, row);
    store<A>(Float<A>::load_aligned(tile.u + row), hits.u, row);
    store<A>(Float<A>::load_aligned(tile.v + row), hits.v, row);
    store<A>(UInt<A>::load_aligned(tile.prim + row), hits.prim, row);
  }
  return true;
}

/// See KernelTable: intersect_closest for rays that lie close together, 64 by 64.
template <class A>
LaneCount intersect_tiles(const TreeView& tree, const Ray<ConstColumn>& rays,
                          const Hit<Column>& hits, uint32_t n, const Scratch& scratch) noexcept {
  LaneCount count;
  const float far = kFarExtents * extent_of(tree);
  uint32_t untried = 0, patience = 0;
  uint32_t first_given_up = 0;  // Rows from here to `begin` are for the streams.
  const auto give_to_streams = [&](uint32_t end) {
    if (first_given_up == end) return;
    const LaneCount c =
        intersect_closest<A>(tree, columns_from(rays, first_given_up),
                             columns_from(hits, first_given_up), end - first_given_up, scratch);
    count.rows += c.rows;
    count.steps += c.steps;
  };
  for (uint32_t begin = 0; tree.node_count && begin < n; begin += kTileRays) {
    const uint32_t m = n - begin < kTileRays ? n - begin : kTileRays;
    if (untried) {
      --untried;
      continue;
    }
    if (trace_tile<A>(tree, columns_from(rays, begin), columns_from(hits, begin), m, far,
                      reinterpret_cast<TileEntry*>(scratch.memory), count)) {
      give_to_streams(begin);
      first_given_up = begin + m;
      patience = 0;
    } else {
      untried = patience;
      patience = patience * 2 + 1 < kMostUntried ? patience * 2 + 1 : kMostUntried;
    }
  }
  give_to_streams(n);
  return count;
}

}  // namespace yat::YAT_ISA

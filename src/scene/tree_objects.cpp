// Partitions of objects: by bins of centres for large sets, by exact sweeps for small ones.
//
// Source: Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007.

#include <algorithm>
#include <numeric>

#include "scene/tree_parts.h"

namespace yat::tree {

void make_leaf(const Set& set, BinaryNode& node) {
  uint32_t* const rows = set.rows();
  for (size_t i = 0; i < set.count; ++i) rows[i] = set.references()[i].prim();
  std::sort(rows, rows + set.count);
  node.box = set.box;
  node.rows = rows;
  node.count = size_t(std::unique(rows, rows + set.count) - rows);
}

namespace {

constexpr int kBins = 32;

struct Bins {
  Box box[3][kBins];
  uint32_t count[3][kBins] = {};

  void add(std::span<const Reference> references, const BinMap& bin) {
    for (const Reference& r : references) {
      const I4 at = bin(r.half_center());
      const Box b = r.box();
      for (int axis = 0; axis < 3; ++axis) {
        box[axis][at[axis]].add(b);
        ++count[axis][at[axis]];
      }
    }
  }
  void add(const Bins& other) {
    for (int axis = 0; axis < 3; ++axis)
      for (int b = 0; b < kBins; ++b) {
        box[axis][b].add(other.box[axis][b]);
        count[axis][b] += other.count[axis][b];
      }
  }
};

BinMap center_bins(const Set& set) {
  return BinMap(set.half_centers.low, set.half_centers.high, kBins);
}

}  // namespace

ObjectSplit find_object_split(const Set& set, const LocalPrices& prices) {
  ObjectSplit best;
  if (!(prices.area > 0)) return best;
  Bins bins;
  bin_all(set, center_bins(set), bins);
  for (int axis = 0; axis < 3; ++axis) {
    if (!(set.half_centers.high[axis] > set.half_centers.low[axis])) continue;
    float right_area[kBins];
    Box side;
    for (int b = kBins; b-- > 1;) {
      side.add(bins.box[axis][b]);
      right_area[b] = prices.unit(side);
    }
    side = Box();
    size_t left = 0;
    for (int b = 1; b < kBins; ++b) {
      side.add(bins.box[axis][b - 1]);
      left += bins.count[axis][b - 1];
      const size_t right = set.count - left;
      if (left == 0 || right == 0) continue;
      const float cost = prices.split(left, prices.unit(side), right, right_area[b]);
      if (cost < best.cost) {
        best.cost = cost;
        best.axis = axis;
        best.bin = b;
      }
    }
  }
  for (int b = 0; b < kBins; ++b)
    (b < best.bin ? best.left : best.right).add(bins.box[best.axis][b]);
  return best;
}

namespace {

/// References of [first, end) parted by the split: lower ones in front of `middle`.
struct Piece {
  size_t first = 0, middle = 0, end = 0;
  Set left, right;  ///< bounds of centres only

  template <class Lower>
  void part(Reference* references, Lower&& lower) {
    size_t i = first, j = end;
    for (;;) {
      while (i < j && lower(references[i])) left.add_center(references[i++]);
      while (i < j && !lower(references[j - 1])) right.add_center(references[--j]);
      if (i == j) break;
      std::swap(references[i], references[j - 1]);
    }
    middle = i;
  }
};

/// Parts a set and returns where the upper side begins. A large one in pieces: each piece by
/// itself, then what lies on the wrong side of the middle of all changes places. Pieces are of a
/// fixed size: any number of threads makes the same order.
size_t part(const Set& set, const ObjectSplit& split, const BinMap& bin, Set& left, Set& right) {
  Reference* const references = set.storage->references + set.first;
  const auto lower_side = [&](const Reference& r) {
    return bin(r.half_center())[split.axis] < split.bin;
  };
  if (set.count <= kBinGrain) {
    Piece all{0, 0, set.count, {}, {}};
    all.part(references, lower_side);
    left.half_centers = all.left.half_centers;
    right.half_centers = all.right.half_centers;
    return all.middle;
  }
  std::vector<Piece> pieces((set.count + kBinGrain - 1) / kBinGrain);
  parallel_ranges(uint32_t(pieces.size()), 1, [&](uint32_t begin, uint32_t end) {
    for (size_t k = begin; k != end; ++k) {
      Piece& piece = pieces[k];
      piece.first = k * kBinGrain;
      piece.end = std::min(set.count, piece.first + kBinGrain);
      piece.part(references, lower_side);
    }
  });
  size_t middle = 0;
  for (const Piece& piece : pieces) {
    middle += piece.middle - piece.first;
    left.half_centers.add(piece.left.half_centers);
    right.half_centers.add(piece.right.half_centers);
  }
  // Lower ones behind the middle, from the last piece on; upper ones before it, from the first on.
  size_t from = pieces.size();
  size_t lower = 0, lower_end = 0;  // What is left to move of piece `from`.
  for (const Piece& piece : pieces) {
    for (size_t upper = piece.middle; upper < std::min(piece.end, middle); ++upper) {
      while (lower == lower_end) {
        --from;
        lower = std::max(pieces[from].first, middle);
        lower_end = std::max(pieces[from].middle, lower);
      }
      std::swap(references[upper], references[lower++]);
    }
  }
  return middle;
}

}  // namespace

void split_objects(const Set& set, const ObjectSplit& split, Set& left, Set& right) {
  left = right = Set();
  left.storage = right.storage = set.storage;
  Reference* const begin = set.storage->references + set.first;
  size_t i = 0;
  if (split.cost < HUGE_VALF) {
    left.box = split.left;
    right.box = split.right;
    i = part(set, split, center_bins(set), left, right);
  } else {
    // All centres are equal, or no side has an extent: any halves will do.
    i = set.count / 2;
    for (size_t k = 0; k < set.count; ++k) (k < i ? left : right).add(begin[k]);
  }
  left.first = set.first;
  left.count = left.room = i;
  right.first = set.first + i;
  right.count = set.count - i;
  right.room = set.room - i;
}

namespace {

/// A set of at most kSmallSet references, sorted once along each axis; its subsets are ranges of
/// the three orders.
struct Small {
  const Prices& prices;
  NodeArena& arena;
  std::span<const Reference> references;
  uint32_t* rows;
  bool whatever_price;  ///< down to single references
  uint8_t order[3][kSmallSet];

  void sort() {
    const size_t n = references.size();
    uint64_t keys[kSmallSet];
    for (int axis = 0; axis < 3; ++axis) {
      for (size_t i = 0; i < n; ++i) {
        // The bits of floats, made to ascend; equal centres keep their order in the set.
        const auto bits = std::bit_cast<uint32_t>(float(references[i].half_center()[axis]) + 0.f);
        const uint32_t key = bits >> 31 ? ~bits : bits | 0x80000000u;
        keys[i] = uint64_t(key) << 8 | i;
      }
      std::sort(keys, keys + n);
      for (size_t i = 0; i < n; ++i) order[axis][i] = uint8_t(keys[i]);
    }
  }

  void leaf(size_t first, size_t count, BinaryNode& node) const {
    uint32_t* const to = rows + first;
    for (size_t i = 0; i < count; ++i) to[i] = references[order[0][first + i]].prim();
    std::sort(to, to + count);
    node.rows = to;
    node.count = size_t(std::unique(to, to + count) - to);
  }

  /// node.box is the box of the range.
  void build(size_t first, size_t count, uint32_t depth, BinaryNode& node) {
    node.count = count;
    const size_t limit = size_t(kMaxBlocks) * prices.block_width;
    if (count == 1) return leaf(first, count, node);
    const LocalPrices local(prices, node.box);
    float best = HUGE_VALF;
    int best_axis = 0;
    size_t best_left = count / 2;
    Box below, above;
    if (local.area > 0 && depth < kMaxPricedDepth) {
      for (int axis = 0; axis < 3; ++axis) {
        const uint8_t* const sorted = order[axis] + first;
        float right_area[kSmallSet];
        Box box;
        for (size_t i = count; i-- > 1;) {
          box.add(references[sorted[i]].box());
          right_area[i] = local.unit(box);
        }
        box = Box();
        for (size_t i = 1; i < count; ++i) {
          box.add(references[sorted[i - 1]].box());
          const float cost = local.split(i, local.unit(box), count - i, right_area[i]);
          if (cost < best) {
            best = cost;
            best_axis = axis;
            best_left = i;
          }
        }
      }
    }
    const bool worth = best < (whatever_price ? HUGE_VALF : local.leaf(count));
    if (count <= limit && !worth) return leaf(first, count, node);
    // The other orders follow: stable, so that they stay sorted.
    uint64_t lower = 0;
    for (size_t i = 0; i < count; ++i) {
      const uint8_t k = order[best_axis][first + i];
      (i < best_left ? below : above).add(references[k].box());
      if (i < best_left) lower |= uint64_t(1) << k;
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (axis == best_axis) continue;
      uint8_t* const sorted = order[axis] + first;
      uint8_t upper[kSmallSet];
      size_t l = 0, u = 0;
      for (size_t i = 0; i < count; ++i) {
        const uint8_t k = sorted[i];
        const size_t is_lower = lower >> k & 1;
        sorted[l] = k;
        upper[u] = k;
        l += is_lower;
        u += 1 - is_lower;
      }
      std::copy_n(upper, u, sorted + l);
    }
    node.axis = best_axis;
    node.children = arena.take(2);
    node.children[0].box = below;
    node.children[1].box = above;
    build(first, best_left, depth + 1, node.children[0]);
    build(first + best_left, count - best_left, depth + 1, node.children[1]);
  }
};

}  // namespace

void build_small(const Set& set, uint32_t depth, const Prices& prices, NodeArena& arena,
                 BinaryNode& node) {
  Small small{prices, arena, set.references(), set.rows(), false, {}};
  small.sort();
  node.box = set.box;
  small.build(0, set.count, depth, node);
}

namespace {

void part_large_leaves(const Rows<TriangleRow>& triangles, BinaryTree& tree, BinaryNode& node,
                       uint32_t depth) {
  if (!(node.box.area() >= Prices::kManyRays * tree.prices.root_area)) return;
  if (!node.leaf()) {
    const auto lower = [&] { part_large_leaves(triangles, tree, node.children[0], depth + 1); };
    const auto upper = [&] { part_large_leaves(triangles, tree, node.children[1], depth + 1); };
    if (node.count > kParallel) {
      parallel_invoke(lower, upper);
    } else {
      lower();
      upper();
    }
    return;
  }
  if (node.count > kSmallSet) return;
  Reference references[kSmallSet];
  for (size_t i = 0; i < node.count; ++i)
    references[i] =
        make_reference(clipped_box(corners_of(triangles, node.rows[i]), node.box), node.rows[i]);
  Small small{tree.prices, tree.arena, {references, node.count}, node.rows, true, {}};
  small.sort();
  small.build(0, node.count, depth, node);
}

}  // namespace

void part_large_leaves(const Rows<TriangleRow>& triangles, BinaryTree& tree) {
  part_large_leaves(triangles, tree, tree.root, 0);
}

}  // namespace yat::tree

// Splits by planes: finding the best one, and clipping what it cuts.
//
// Source: Wald, Havran, "On building fast kd-Trees for Ray Tracing", 2006, for the sweep and for
// triangles that lie in the plane. Departs from it: boxes are tight, so empty space is not cut off.

#include <algorithm>
#include <cstring>

#include "scene/tree_parts.h"

namespace yat::tree {
namespace {

constexpr int kBins = 256;

struct PlanePrice {
  const LocalPrices& prices;
  const Box& box;

  float operator()(int axis, float at, size_t left, size_t right) const {
    F4 high = box.high, low = box.low;
    high[axis] = low[axis] = at;
    return prices.split(left, left ? prices.unit(box.low, high) : 0.f, right,
                        right ? prices.unit(low, box.high) : 0.f);
  }
};

/// Bounds along one axis of the references that begin or end among the candidates.
struct Candidates {
  float *begins, *ends, *flats, *planes;  ///< sorted
  size_t begin_count = 0, end_count = 0, flat_count = 0, plane_count = 0;
  size_t begun = 0, pending = 0;  ///< references before the first candidate; after the last
};

/// Sweeps the candidates from low to high.
void sweep(Candidates& c, size_t count, int axis, const PlanePrice& price, PlaneSplit& best) {
  const auto take = [&c](float* list, size_t n) {
    std::sort(list, list + n);
    std::copy(list, list + n, c.planes + c.plane_count);
    c.plane_count += n;
  };
  take(c.begins, c.begin_count);
  take(c.ends, c.end_count);
  take(c.flats, c.flat_count);
  std::sort(c.planes, c.planes + c.plane_count);
  c.plane_count = size_t(std::unique(c.planes, c.planes + c.plane_count) - c.planes);
  size_t b = 0, e = 0, f = 0;
  for (size_t i = 0; i < c.plane_count; ++i) {
    const float at = c.planes[i];
    while (b < c.begin_count && c.begins[b] < at) ++b;
    while (e < c.end_count && c.ends[e] <= at) ++e;
    while (f < c.flat_count && c.flats[f] < at) ++f;
    size_t flat = f;
    while (flat < c.flat_count && c.flats[flat] == at) ++flat;
    flat -= f;
    const size_t left = c.begun + b + f;
    const size_t right = c.pending + (c.end_count - e) + (c.flat_count - f - flat);
    // A plane in a face of the box separates only what lies in it.
    if ((at <= price.box.low[axis] || at >= price.box.high[axis]) && flat == 0) continue;
    for (int side = 0; side < (flat ? 2 : 1); ++side) {
      const size_t l = left + (side == 0 ? flat : 0), r = right + (side == 1 ? flat : 0);
      // Cutting off empty space: boxes are tight already, so nothing is gained.
      if (l == 0 || r == 0) continue;
      if (l >= count && r >= count) continue;
      const float cost = price(axis, at, l, r);
      if (cost < best.cost) best = {cost, axis, at, side == 0, l, r};
    }
  }
}

void sweep_all(const Set& set, const PlanePrice& price, PlaneSplit& best) {
  float memory[6 * kSmallSet];
  for (int axis = 0; axis < 3; ++axis) {
    if (!(set.box.high[axis] > set.box.low[axis])) continue;
    Candidates c{memory, memory + kSmallSet, memory + 2 * kSmallSet, memory + 3 * kSmallSet};
    for (const Reference& r : set.references()) {
      const float low = r.low[axis], high = r.high[axis];
      if (low == high) {
        c.flats[c.flat_count++] = low;
      } else {
        c.begins[c.begin_count++] = low;
        c.ends[c.end_count++] = high;
      }
    }
    sweep(c, set.count, axis, price, best);
  }
}

/// Half positions, whose range is finite for any box.
F4 half(F4 x) {
  return x * splat(0.5f);
}

struct Bins {
  uint32_t begins[3][kBins] = {}, ends[3][kBins] = {};

  void add(std::span<const Reference> references, const BinMap& bin) {
    for (const Reference& r : references) {
      const I4 low = bin(half(r.box().low)), high = bin(half(r.high));
      for (int axis = 0; axis < 3; ++axis) {
        ++begins[axis][low[axis]];
        ++ends[axis][high[axis]];
      }
    }
  }
  void add(const Bins& other) {
    for (int axis = 0; axis < 3; ++axis)
      for (int b = 0; b < kBins; ++b) {
        begins[axis][b] += other.begins[axis][b];
        ends[axis][b] += other.ends[axis][b];
      }
  }
};

/// Sweeps the references that begin or end in bins [first, first + 1] of `axis`.
void sweep_bins(const Set& set, int axis, const BinMap& bin, int first, size_t candidates,
                const PlanePrice& price, PlaneSplit& best) {
  const auto memory = std::make_unique_for_overwrite<float[]>(6 * candidates);
  Candidates c{memory.get(), memory.get() + candidates, memory.get() + 2 * candidates,
               memory.get() + 3 * candidates};
  for (const Reference& r : set.references()) {
    const int low_bin = bin(half(r.box().low))[axis], high_bin = bin(half(r.high))[axis];
    const bool begins = low_bin == first || low_bin == first + 1;
    const float low = r.low[axis], high = r.high[axis];
    if (low == high && begins) {
      c.flats[c.flat_count++] = low;
      continue;
    }
    if (low_bin < first) ++c.begun;
    if (high_bin > first + 1) ++c.pending;
    if (begins) c.begins[c.begin_count++] = low;
    if (high_bin == first || high_bin == first + 1) c.ends[c.end_count++] = high;
  }
  sweep(c, set.count, axis, price, best);
}

}  // namespace

PlaneSplit find_plane(const Set& set, const LocalPrices& prices) {
  PlaneSplit best;
  if (!(prices.area > 0)) return best;
  const PlanePrice price{prices, set.box};
  if (set.count <= kSmallSet) {
    sweep_all(set, price, best);
    return best;
  }
  const BinMap bin(half(set.box.low), half(set.box.high), kBins);
  Bins bins;
  bin_all(set, bin, bins);
  float best_binned = HUGE_VALF;
  int best_axis = -1, best_bin = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(set.box.high[axis] > set.box.low[axis])) continue;
    const double width = set.box.side(axis) / kBins;
    size_t left = 0, right = set.count;
    for (int b = 1; b < kBins; ++b) {
      left += bins.begins[axis][b - 1];
      right -= bins.ends[axis][b - 1];
      if (left == 0 || right == 0) continue;
      const float at = float(double(set.box.low[axis]) + b * width);
      const float cost = price(axis, at, left, right);
      if (cost < best_binned) {
        best_binned = cost;
        best_axis = axis;
        best_bin = b;
      }
    }
  }
  if (best_axis < 0) return best;
  size_t candidates = 0;
  for (int b = best_bin - 1; b <= best_bin; ++b)
    candidates = candidates + bins.begins[best_axis][b] + bins.ends[best_axis][b];
  sweep_bins(set, best_axis, bin, best_bin - 1, candidates, price, best);
  return best;
}

bool split_by_plane(const Rows<TriangleRow>& triangles, const Set& set, const PlaneSplit& split,
                    Set& left, Set& right) {
  const size_t total = split.left + split.right;
  if (total > set.room) return false;
  const int axis = split.axis;
  const float at = split.at;
  Reference* const begin = set.storage->references + set.first;
  left = right = Set();
  std::vector<Reference> upper;  // Upper parts of the references that the plane cuts.
  upper.reserve(total - std::min(total, set.count));
  size_t i = 0, j = set.count;
  while (i < j) {
    const Reference r = begin[i];
    const float low = r.low[axis], high = r.high[axis];
    if (low == at && high == at ? split.flat_left : high <= at) {
      left.add(r);
      ++i;
    } else if (low >= at) {
      right.add(r);
      std::swap(begin[i], begin[--j]);
    } else {
      const Corners corners = corners_of(triangles, r.prim());
      Box low_box = r.box(), high_box = low_box;
      low_box.high[axis] = high_box.low[axis] = at;
      begin[i] = make_reference(clipped_box(corners, low_box), r.prim());
      left.add(begin[i++]);
      upper.push_back(make_reference(clipped_box(corners, high_box), r.prim()));
      right.add(upper.back());
    }
  }
  left.count = i;
  const size_t kept = set.count - i;
  right.count = kept + upper.size();
  // Free room goes to both sides by their size; the upper side moves up by what the lower gets.
  const size_t shift = size_t(double(set.room - total) * (double(i) / double(total)));
  if (shift < kept) {
    std::copy_n(begin + i, shift, begin + set.count);
  } else {
    std::copy_n(begin + i, kept, begin + i + shift);
  }
  std::copy(upper.begin(), upper.end(), begin + i + shift + kept);
  left.storage = right.storage = set.storage;
  left.first = set.first;
  left.room = i + shift;
  right.first = set.first + left.room;
  right.room = set.room - left.room;
  return true;
}

}  // namespace yat::tree

// Where to split a set of references: planes (with clipping) and partitions of objects.

#include <algorithm>
#include <cstring>
#include <vector>

#include "scene/tree_parts.h"

namespace yat::tree {

float round_down(double x) {
  const float f = float(std::clamp(x, -double(FLT_MAX), double(FLT_MAX)));
  return double(f) > x ? std::max(std::nextafter(f, -FLT_MAX), -FLT_MAX) : f;
}
float round_up(double x) {
  return -round_down(-x);
}

Corners corners_of(const Rows<TriangleRow>& triangles, uint32_t prim) {
  float words[9];
  std::memcpy(words, triangles.words + size_t(prim) * row_words<TriangleRow>, sizeof words);
  Corners out;
  for (int i = 0; i < 9; ++i) out.p[i / 3][i % 3] = double(words[i]);
  return out;
}

namespace {

/// Tight box of the part of a triangle inside `box`, rounded outwards. Sutherland & Hodgman 1974,
/// in double: the coordinates are exact in it and the cut points' error is far below a float's.
Box clipped_box(const Corners& corners, const Box& box) {
  double polygon[2][10][3];
  int count = 3, from = 0;
  std::memcpy(polygon[0], corners.p, sizeof corners.p);
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const double plane = side ? double(box.max[axis]) : double(box.min[axis]);
      const double sign = side ? -1 : 1;
      int kept = 0;
      auto& in = polygon[from];
      auto& out = polygon[from ^ 1];
      for (int i = 0; i < count; ++i) {
        const double* p = in[i];
        const double* q = in[i + 1 == count ? 0 : i + 1];
        const double dp = (p[axis] - plane) * sign, dq = (q[axis] - plane) * sign;
        if (dp >= 0) std::memcpy(out[kept++], p, sizeof out[0]);
        if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) {
          const double s = dp / (dp - dq);
          for (int a = 0; a < 3; ++a) out[kept][a] = p[a] + s * (q[a] - p[a]);
          out[kept++][axis] = plane;
        }
      }
      count = kept;
      from ^= 1;
    }
  }
  if (count == 0) return box;  // Rounding ate the part: keep the whole box, which is safe.
  Box out;
  for (int a = 0; a < 3; ++a) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int i = 0; i < count; ++i) {
      low = std::min(low, polygon[from][i][a]);
      high = std::max(high, polygon[from][i][a]);
    }
    out.min[a] = std::max(round_down(low), box.min[a]);
    out.max[a] = std::min(round_up(high), box.max[a]);
  }
  return out.empty() ? box : out;
}

constexpr int kPlaneBins = 256;
constexpr int kObjectBins = 32;
constexpr size_t kExact = 64;  // Sets up to this size are swept exactly.

/// A monotone map of positions to bins: equal positions share a bin, greater ones never lie lower.
struct BinMap {
  double low, scale;
  int bins;
  BinMap(double from, double to, int n) : low(from), scale(double(n) / (to - from)), bins(n) {}
  int operator()(float x) const { return std::clamp(int((double(x) - low) * scale), 0, bins - 1); }
};

struct PlanePrice {
  const Box& box;
  const Prices& prices;
  double area;

  double operator()(int axis, float at, size_t left, size_t right) const {
    if (left == 0 && right == 0) return HUGE_VAL;
    Box low = box, high = box;
    low.max[axis] = high.min[axis] = at;
    const double low_area = low.area(), high_area = high.area();
    return prices.traversal(area) + ((left ? low_area * prices.leaf(left, low_area) : 0) +
                                     (right ? high_area * prices.leaf(right, high_area) : 0)) /
                                        area;
  }
};

/// Sweeps the planes at the bounds of the references that begin or end in [first, last] bins.
void sweep_planes(std::span<const Reference> references, int axis, const BinMap* bin, int first,
                  int last, const PlanePrice& price, PlaneSplit& best) {
  std::vector<float> begins, ends, flats, planes;
  size_t begun = 0, pending = 0;  // Before the range; after it.
  for (const Reference& r : references) {
    const float low = r.box.min[axis], high = r.box.max[axis];
    const int low_bin = bin ? (*bin)(low) : first, high_bin = bin ? (*bin)(high) : first;
    if (low == high && low_bin >= first && low_bin <= last) {
      flats.push_back(low);
      continue;
    }
    if (low_bin < first) ++begun;
    if (high_bin > last) ++pending;
    if (low_bin >= first && low_bin <= last) begins.push_back(low);
    if (high_bin >= first && high_bin <= last) ends.push_back(high);
  }
  for (auto* list : {&begins, &ends, &flats}) {
    std::sort(list->begin(), list->end());
    planes.insert(planes.end(), list->begin(), list->end());
  }
  std::sort(planes.begin(), planes.end());
  planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
  size_t b = 0, e = 0, f = 0;
  for (const float at : planes) {
    while (b < begins.size() && begins[b] < at) ++b;
    while (e < ends.size() && ends[e] <= at) ++e;
    while (f < flats.size() && flats[f] < at) ++f;
    size_t flat = f;
    while (flat < flats.size() && flats[flat] == at) ++flat;
    flat -= f;
    const size_t left = begun + b + f;
    const size_t right = pending + (ends.size() - e) + (flats.size() - f - flat);
    // A plane in a face of the box separates only what lies in it.
    if ((at <= price.box.min[axis] || at >= price.box.max[axis]) && flat == 0) continue;
    for (int side = 0; side < (flat ? 2 : 1); ++side) {
      const size_t l = left + (side == 0 ? flat : 0), r = right + (side == 1 ? flat : 0);
      if (l == 0 || r == 0) {
        // Cutting off empty space: boxes are tight already, so nothing is gained.
        continue;
      }
      if (l >= references.size() && r >= references.size()) continue;
      const double cost = price(axis, at, l, r);
      if (cost < best.cost) best = {cost, axis, at, side == 0};
    }
  }
}

}  // namespace

PlaneSplit find_plane(std::span<const Reference> references, const Box& box, const Prices& prices) {
  PlaneSplit best;
  const double area = box.area();
  if (!(area > 0)) return best;
  const PlanePrice price{box, prices, area};
  if (references.size() <= kExact) {
    for (int axis = 0; axis < 3; ++axis)
      if (box.max[axis] > box.min[axis]) sweep_planes(references, axis, nullptr, 0, 0, price, best);
    return best;
  }
  double best_binned = HUGE_VAL;
  int best_axis = -1, best_bin = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(box.max[axis] > box.min[axis])) continue;
    const BinMap bin(double(box.min[axis]), double(box.max[axis]), kPlaneBins);
    std::array<uint32_t, kPlaneBins> begins{}, ends{};
    for (const Reference& r : references) {
      ++begins[size_t(bin(r.box.min[axis]))];
      ++ends[size_t(bin(r.box.max[axis]))];
    }
    size_t left = 0, right = references.size();
    for (int b = 1; b < kPlaneBins; ++b) {
      left += begins[size_t(b - 1)];
      right -= ends[size_t(b - 1)];
      if (left == 0 || right == 0) continue;
      const auto at = float(bin.low + double(b) / bin.scale);
      const double cost = price(axis, at, left, right);
      if (cost < best_binned) {
        best_binned = cost;
        best_axis = axis;
        best_bin = b;
      }
    }
  }
  if (best_axis < 0) return best;
  const BinMap bin(double(box.min[best_axis]), double(box.max[best_axis]), kPlaneBins);
  sweep_planes(references, best_axis, &bin, best_bin - 1, best_bin, price, best);
  return best;
}

void split_by_plane(const Rows<TriangleRow>& triangles, std::span<const Reference> references,
                    const PlaneSplit& split, std::vector<Reference>& left,
                    std::vector<Reference>& right) {
  const int axis = split.axis;
  for (const Reference& r : references) {
    const float low = r.box.min[axis], high = r.box.max[axis];
    if (low == split.at && high == split.at) {
      (split.flat_left ? left : right).push_back(r);
    } else if (high <= split.at) {
      left.push_back(r);
    } else if (low >= split.at) {
      right.push_back(r);
    } else {
      const Corners corners = corners_of(triangles, r.prim);
      Box low_box = r.box, high_box = r.box;
      low_box.max[axis] = high_box.min[axis] = split.at;
      left.push_back({clipped_box(corners, low_box), r.prim});
      right.push_back({clipped_box(corners, high_box), r.prim});
    }
  }
}

namespace {

ObjectSplit exact_object_split(std::span<Reference> references, double area, const Prices& prices) {
  const size_t n = references.size();
  ObjectSplit best;
  std::array<Reference, kExact> sorted, chosen;
  std::array<double, kExact> right_area;
  for (int axis = 0; axis < 3; ++axis) {
    std::copy(references.begin(), references.end(), sorted.begin());
    // Clipped parts of one triangle may coincide: (centre, prim) still orders them for good,
    // because equal keys are then equal in all that counts here.
    std::sort(sorted.begin(), sorted.begin() + ptrdiff_t(n),
              [axis](const Reference& a, const Reference& b) {
                const float ca = a.center(axis), cb = b.center(axis);
                return ca != cb ? ca < cb : a.prim < b.prim;
              });
    Box box;
    for (size_t i = n; i-- > 1;) {
      box.add(sorted[i].box);
      right_area[i] = box.area();
    }
    box = Box();
    const double before = best.cost;
    for (size_t i = 1; i < n; ++i) {
      box.add(sorted[i - 1].box);
      const double left_area = box.area();
      const double cost =
          prices.traversal(area) + (left_area * prices.leaf(i, left_area) +
                                    right_area[i] * prices.leaf(n - i, right_area[i])) /
                                       area;
      if (cost < best.cost) best = {cost, axis, i};
    }
    if (best.cost < before) chosen = sorted;
  }
  if (best.left) std::copy_n(chosen.begin(), n, references.begin());
  return best;
}

}  // namespace

ObjectSplit find_object_split(std::span<Reference> references, const Box& box,
                              const Prices& prices) {
  const double area = box.area();
  if (!(area > 0)) return {};
  if (references.size() <= kExact) return exact_object_split(references, area, prices);
  Box centers;
  for (const Reference& r : references)
    for (int a = 0; a < 3; ++a) {
      centers.min[a] = std::min(centers.min[a], r.center(a));
      centers.max[a] = std::max(centers.max[a], r.center(a));
    }
  ObjectSplit best;
  int best_bin = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(centers.max[axis] > centers.min[axis])) continue;
    const BinMap bin(double(centers.min[axis]), double(centers.max[axis]), kObjectBins);
    std::array<Box, kObjectBins> boxes;
    std::array<size_t, kObjectBins> counts{};
    for (const Reference& r : references) {
      const auto b = size_t(bin(r.center(axis)));
      boxes[b].add(r.box);
      ++counts[b];
    }
    std::array<double, kObjectBins> right_area;
    Box side;
    for (size_t b = kObjectBins; b-- > 1;) {
      side.add(boxes[b]);
      right_area[b] = side.area();
    }
    side = Box();
    size_t left = 0;
    for (size_t b = 1; b < kObjectBins; ++b) {
      side.add(boxes[b - 1]);
      left += counts[b - 1];
      const size_t right = references.size() - left;
      if (left == 0 || right == 0) continue;
      const double left_area = side.area();
      const double cost =
          prices.traversal(area) + (left_area * prices.leaf(left, left_area) +
                                    right_area[b] * prices.leaf(right, right_area[b])) /
                                       area;
      if (cost < best.cost) {
        best = {cost, axis, left};
        best_bin = int(b);
      }
    }
  }
  if (best.left == 0) return best;
  const BinMap bin(double(centers.min[best.axis]), double(centers.max[best.axis]), kObjectBins);
  // By hand: in libstdc++ 12, std::stable_partition warns of its own deprecated parts under clang.
  std::vector<Reference> right;
  right.reserve(references.size() - best.left);
  size_t kept = 0;
  for (const Reference& r : references) {
    if (bin(r.center(best.axis)) < best_bin)
      references[kept++] = r;
    else
      right.push_back(r);
  }
  std::copy(right.begin(), right.end(), references.begin() + ptrdiff_t(kept));
  return best;
}

}  // namespace yat::tree

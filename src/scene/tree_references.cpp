// Triangles to references; clipping them to cells.

#include <cstring>

#include "scene/tree_parts.h"

namespace yat::tree {

float round_down(double x) {
  const float f = float(std::clamp(x, -double(FLT_MAX), double(FLT_MAX)));
  return double(f) > x ? std::max(std::nextafter(f, -FLT_MAX), -FLT_MAX) : f;
}
float round_up(double x) {
  return -round_down(-x);
}

Storage::Storage(size_t capacity)
    : reference_memory(allocate_unset(capacity * sizeof(Reference))),
      row_memory(allocate_unset(capacity * sizeof(uint32_t))),
      references(reinterpret_cast<Reference*>(reference_memory.get())),
      rows(reinterpret_cast<uint32_t*>(row_memory.get())) {}

Corners corners_of(const Rows<TriangleRow>& triangles, uint32_t prim) {
  float words[9];
  std::memcpy(words, triangles.words + size_t(prim) * row_words<TriangleRow>, sizeof words);
  Corners out;
  for (int i = 0; i < 9; ++i) out.p[i / 3][i % 3] = double(words[i]);
  return out;
}

// Sutherland & Hodgman 1974, in double: the coordinates are exact in it and the cut points' error
// is far below a float's.
Box clipped_box(const Corners& corners, const Box& box) {
  double polygon[2][10][3];
  int count = 3, from = 0;
  std::memcpy(polygon[0], corners.p, sizeof corners.p);
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const double plane = side ? double(box.high[axis]) : double(box.low[axis]);
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
    // Adding 0 makes -0 into 0: equal boxes have equal bits then.
    out.low[a] = std::max(round_down(low), float(box.low[a])) + 0.f;
    out.high[a] = std::min(round_up(high), float(box.high[a])) + 0.f;
  }
  return out.empty() ? box : out;
}

namespace {

constexpr uint32_t kGrain = 4096;

/// A triangle as a reference. False if no ray can hit it.
bool reference_of(const uint32_t* row, uint32_t prim, Reference& out) {
  float p[9];
  std::memcpy(p, row, sizeof p);
  const F4 a = {p[0], p[1], p[2], 0}, b = {p[3], p[4], p[5], 0}, c = {p[6], p[7], p[8], 0};
  // Adding 0 makes -0 into 0: equal boxes have equal bits then.
  const Box box{min_of(a, min_of(b, c)) + F4{}, max_of(a, max_of(b, c)) + F4{}};
  float sum = 0;  // NaN if any is NaN or infinite.
  for (const float x : p) sum += x * 0.f;
  if (!(sum == 0)) return false;
  double e1[3], e2[3];
  for (int k = 0; k < 3; ++k) {
    e1[k] = double(p[3 + k]) - double(p[k]);
    e2[k] = double(p[6 + k]) - double(p[k]);
  }
  out = make_reference(box, prim);
  return e1[1] * e2[2] != e1[2] * e2[1] || e1[2] * e2[0] != e1[0] * e2[2] ||
         e1[0] * e2[1] != e1[1] * e2[0];
}

}  // namespace

Set make_references(const Rows<TriangleRow>& triangles, double room,
                    std::unique_ptr<Storage>& storage) {
  Set set;
  const size_t capacity = size_t(double(triangles.count) * room) + 64;
  storage = std::make_unique<Storage>(capacity);
  set.storage = storage.get();
  set.room = capacity;
  const uint32_t pieces = (triangles.count + kGrain - 1) / kGrain;
  std::vector<Set> piece(pieces);
  parallel_ranges(pieces, 1, [&](uint32_t begin, uint32_t end) {
    for (uint32_t i = begin; i != end; ++i) {
      Set& s = piece[i];
      s.first = size_t(i) * kGrain;
      const uint32_t last = std::min(triangles.count, (i + 1) * kGrain);
      for (uint32_t prim = i * kGrain; prim < last; ++prim) {
        Reference r;
        if (!reference_of(triangles.words + size_t(prim) * row_words<TriangleRow>, prim, r))
          continue;
        storage->references[s.first + s.count++] = r;
        s.add(r);
      }
    }
  });
  for (const Set& s : piece) {
    if (set.count != s.first)
      std::copy_n(storage->references + s.first, s.count, storage->references + set.count);
    set.count += s.count;
    set.box.add(s.box);
    set.half_centers.add(s.half_centers);
  }
  return set;
}

}  // namespace yat::tree

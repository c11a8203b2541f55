#pragma once
// Triangle tests over leaf blocks: many rays against one triangle after the other, or one ray
// against a block of triangles. Both round alike, so a ray's answer does not tell which was used.
//
// Watertight: the vertices are sheared so that the ray runs along the z axis from the origin; a
// shared vertex gets the same two coordinates in every triangle, and the edge functions are a
// difference of two rounded products, whose sign is never wrong, only lost to zero. Zero counts as
// inside (Woop, Benthin, Wald 2013, without the double-precision fallback, which only decides which
// of two neighbours owns an edge). No fused multiply-add here: it would round the two products
// differently.

#include "kernels/traverse_rays.h"

namespace yat::YAT_ISA {

/// Bound of the error of a hit's distance times the sum of the edge functions, in units of the
/// vertices' coordinates: see test_triangles.
inline constexpr float kDistanceError = 80 * 0x1p-24f;

/// What the test of W (ray, triangle) pairs gives. Lanes not in `hit` hold nothing of use.
template <class A>
struct TriangleHits {
  Mask<A> hit;
  Float<A> t, u, v;
};

/// Vertex coordinates relative to the ray, with rotated axes, sheared in x and y.
template <class A>
struct ShearedVertex {
  Float<A> x, y, z;
  YAT_INLINE ShearedVertex(const Float<A>& px, const Float<A>& py, const Float<A>& pz,
                           const Float<A> (&org)[3], const Float<A> (&shear)[3]) {
    z = pz - org[2];
    x = (px - org[0]) - shear[0] * z;
    y = (py - org[1]) - shear[1] * z;
  }
};

/// Whether the plane of a triangle is met ahead of the ray's origin, told from its corners relative
/// to the origin (before the shear): x, y, z with the third axis the ray's main one. The distance
/// by edge functions says that for all but slender triangles: its error grows with their length
/// over their height, here only with their length. Of the three products of edges that give the
/// normal the smallest is taken, per component (with long edges cancellation would leave little of
/// it). Where the plane goes through the origin, yes.
template <class A>
struct TrianglePlane {
  Float<A> x[3], y[3], z[3];

  YAT_INLINE Mask<A> is_ahead(const Float<A> (&shear)[3]) const {
    const auto normal = [](const Float<A>(&p)[3], const Float<A>(&q)[3]) {
      const Float<A> p1 = p[1] - p[0], p2 = p[2] - p[1], p3 = p[0] - p[2];
      const Float<A> q1 = q[1] - q[0], q2 = q[2] - q[1], q3 = q[0] - q[2];
      const auto smaller = [](const Float<A>& a, const Float<A>& b, const Float<A>& c,
                              const Float<A>& d, Float<A>& value, Float<A>& size) {
        const Float<A> first = a * b, second = c * d;
        const Float<A> largest = xsimd::max(xsimd::abs(first), xsimd::abs(second));
        const Mask<A> better = largest < size;
        value = select<A>(better, first - second, value);
        size = xsimd::min(size, largest);
      };
      Float<A> value(0.f), size(3.402823466e38f);
      smaller(p1, q2, q1, p2, value, size);
      smaller(p2, q3, q2, p3, value, size);
      smaller(p3, q1, q3, p1, value, size);
      return value;
    };
    const Float<A> nx = normal(y, z), ny = normal(z, x), nz = normal(x, y);
    const Float<A> distance = (nx * x[0] + ny * y[0]) + nz * z[0];
    const Float<A> slope = (nx * shear[0] + ny * shear[1]) + nz;
    const UInt<A> behind = as_uint<A>(distance) ^ as_uint<A>(slope) ^ as_uint<A>(shear[2]);
    return !(negative<A>(behind) & (distance != Float<A>(0.f)));
  }
};

/// The test of W pairs. `range(t)` says which distances count. False if surely no lane hits: a
/// branch there pays, a second one on `hit` is too hard to predict.
///
/// Where a triangle is seen on its edge, all three edge functions may be lost to zero or to an ulp
/// for a ray that runs along it far outside. Such a hit is not reported: along x and along y the
/// sheared vertices must not all have one sign. What a box or a beam of rays cannot meet can then
/// be told from coordinates alone (kernels/traverse_tile.h). Nothing is lost by it: of the
/// triangles that a ray touches in a closed mesh, one is met by the ray moved by nothing towards
/// negative x and y, and its vertices have both signs.
///
/// A hit nearer than its distance can be wrong counts only if the plane lies ahead: rays would meet
/// the slender triangle that they just left. `corners()` gives the TrianglePlane.
template <class A, class Range, class Corners>
YAT_INLINE bool test_triangles(const ShearedVertex<A>& a, const ShearedVertex<A>& b,
                               const ShearedVertex<A>& c, const Float<A> (&shear)[3], Range&& range,
                               Corners&& corners, TriangleHits<A>& out) {
  const Float<A> zero(0.f);
  const Float<A> e0 = c.x * b.y - c.y * b.x;
  const Float<A> e1 = a.x * c.y - a.y * c.x;
  const Float<A> e2 = b.x * a.y - b.y * a.x;
  // A NaN may slip through here (min and max drop it), but not through `range`: t is NaN then.
  const Mask<A> inside =
      (xsimd::min(xsimd::min(e0, e1), e2) >= zero) | (xsimd::max(xsimd::max(e0, e1), e2) <= zero);
  if (!any<A>(inside)) return false;
  const Float<A> det = (e0 + e1) + e2;
  const Float<A> inverse = Float<A>(1.f) / det;
  const Float<A> w = e0 * inverse;
  out.u = e1 * inverse;
  out.v = e2 * inverse;
  const Float<A> z = (w * a.z + out.u * b.z) + out.v * c.z;
  out.t = z * shear[2];
  const auto signs_differ = [](const Float<A>& p, const Float<A>& q, const Float<A>& r) {
    return (as_uint<A>(p) ^ as_uint<A>(q)) | (as_uint<A>(q) ^ as_uint<A>(r));
  };
  const UInt<A> around = signs_differ(a.x, b.x, c.x) & signs_differ(a.y, b.y, c.y);
  out.hit = inside & (det != zero) & negative<A>(around) & range(out.t);
  // A sheared coordinate is off by at most 6 roundings of the larger of itself and z (|shear| <=
  // 1), an edge function by 26 of two such, the distance by that of three times the vertices' z.
  const auto reach = [](const Float<A>& p, const Float<A>& q, const Float<A>& r) {
    return xsimd::max(xsimd::abs(p), xsimd::max(xsimd::abs(q), xsimd::abs(r)));
  };
  const Float<A> across = xsimd::max(reach(a.x, b.x, c.x), reach(a.y, b.y, c.y));
  const Float<A> along = reach(a.z, b.z, c.z);
  const Float<A> error = (Float<A>(kDistanceError) * across) * xsimd::max(across, along) * along;
  const Mask<A> doubtful = out.hit & (xsimd::abs(z * det) <= error);
  if (any<A>(doubtful)) out.hit = out.hit & (corners().is_ahead(shear) | !doubtful);
  return true;
}

/// Where the coordinates of a block lie for a ray that moves most along `kz`.
struct BlockAxes {
  uint32_t x, y, z;  ///< offsets in words of the first vertex; + 3 * width for the next
  YAT_INLINE BlockAxes(uint32_t kz, uint32_t width)
      : x((kz + 1) % 3 * width), y((kz + 2) % 3 * width), z(kz * width) {}
};

YAT_INLINE const uint32_t* block_prims(const float* block, uint32_t width) {
  return reinterpret_cast<const uint32_t*>(block + 9 * width);
}

/// The plane of triangle k of a block for W rays.
template <class A>
YAT_INLINE TrianglePlane<A> plane_of(const float* block, uint32_t width, uint32_t k,
                                     const BlockAxes& axes, const Float<A> (&org)[3]) {
  TrianglePlane<A> plane;
  for (uint32_t i = 0; i < 3; ++i) {
    const float* const p = block + 3 * i * width + k;
    plane.x[i] = Float<A>(p[axes.x]) - org[0];
    plane.y[i] = Float<A>(p[axes.y]) - org[1];
    plane.z[i] = Float<A>(p[axes.z]) - org[2];
  }
  return plane;
}

/// W triangles of a block in registers, for one ray after the other.
template <class A>
struct BlockTriangles {
  Float<A> x[3], y[3], z[3];
  const uint32_t* prims;
  uint32_t occluders;
  YAT_INLINE BlockTriangles(const float* block, uint32_t width, uint32_t first,
                            const BlockAxes& axes, uint32_t block_occluders)
      : prims(block_prims(block, width) + first), occluders(block_occluders >> first) {
    for (uint32_t k = 0; k < 3; ++k) {
      const float* const p = block + 3 * k * width + first;
      x[k] = Float<A>::load_unaligned(p + axes.x);
      y[k] = Float<A>::load_unaligned(p + axes.y);
      z[k] = Float<A>::load_unaligned(p + axes.z);
    }
  }
};

/// One ray against W triangles: leaves its answer in the record. Returns 1 if it hits one, else 0.
template <class A, Query Q>
YAT_INLINE uint32_t test_block(const BlockTriangles<A>& block, float* record, LaneCount& count) {
  constexpr uint32_t W = kLanes<A>;
  const Float<A> org[3] = {Float<A>(record[9]), Float<A>(record[10]), Float<A>(record[11])};
  const Float<A> shear[3] = {Float<A>(record[12]), Float<A>(record[13]), Float<A>(record[14])};
  const Float<A> zero(0.f);
  const auto vertex = [&](uint32_t k) {
    return ShearedVertex<A>(block.x[k], block.y[k], block.z[k], org, shear);
  };
  count.rows += W;
  ++count.steps;
  const Float<A> t_max(record[kRecordT]);
  TriangleHits<A> h;
  const bool found = test_triangles<A>(
      vertex(0), vertex(1), vertex(2), shear,
      [&](const Float<A>& t) {
        return Q == Query::kClosest ? (t > zero) & (t <= t_max) : (t > zero) & (t < t_max);
      },
      [&] {
        TrianglePlane<A> plane;
        for (uint32_t k = 0; k < 3; ++k) {
          plane.x[k] = block.x[k] - org[0];
          plane.y[k] = block.y[k] - org[1];
          plane.z[k] = block.z[k] - org[2];
        }
        return plane;
      },
      h);
  if (!found) return 0;
  uint32_t bits = mask_bits<A>(h.hit);
  if constexpr (Q == Query::kAnyMasked) bits &= block.occluders;
  if (!bits) return 0;
  if constexpr (Q != Query::kClosest) {
    record[kRecordT] = -1.f;
  } else {
    alignas(64) float t[W];
    h.t.store_aligned(t);
    uint32_t best = uint32_t(__builtin_ctz(bits));
    for (bits &= bits - 1; bits; bits &= bits - 1) {
      const uint32_t lane = uint32_t(__builtin_ctz(bits));
      // Primitives ascend within a block: of equal distances the first lane wins.
      if (t[lane] < t[best]) best = lane;
    }
    const uint32_t prim = block.prims[best];
    uint32_t held;
    __builtin_memcpy(&held, record + kRecordPrim, 4);
    if (t[best] < record[kRecordT] || prim < held) {
      alignas(64) float u[W], v[W];
      h.u.store_aligned(u);
      h.v.store_aligned(v);
      record[kRecordT] = t[best];
      record[kRecordU] = u[best];
      record[kRecordV] = v[best];
      __builtin_memcpy(record + kRecordPrim, &prim, 4);
    }
  }
  return 1;
}

/// W rays of one kz (lanes in `active`) against every triangle of `blocks` blocks: leaves their
/// answers in the records. Returns how many hit one.
template <class A, Query Q>
YAT_INLINE uint32_t test_rays(const float* block, uint32_t blocks, uint32_t width,
                              const BlockAxes& axes, const uint32_t* occluders,
                              const Float<A> (&ray)[8], Mask<A> active, float* records,
                              const uint32_t* slots, LaneCount& count) {
  constexpr uint32_t W = kLanes<A>;
  const Float<A> org[3] = {ray[1], ray[2], ray[3]};
  const Float<A> shear[3] = {ray[4], ray[5], ray[6]};
  const Float<A> zero(0.f);
  Float<A> t = ray[0], u = zero, v = zero;
  UInt<A> prim = as_uint<A>(ray[7]);
  uint32_t improved = 0, tests = 0, useful = 0;
  uint32_t live = mask_bits<A>(active);
  const uint32_t lanes = uint32_t(__builtin_popcount(live));
  for (uint32_t b = 0; b < blocks; ++b, block += size_t(width) * 10) {
    const uint32_t* const prims = block_prims(block, width);
    for (uint32_t k = 0; k < width && prims[k] != kNone; ++k) {
      const auto vertex = [&](uint32_t i) {
        const float* const p = block + 3 * i * width + k;
        return ShearedVertex<A>(Float<A>(p[axes.x]), Float<A>(p[axes.y]), Float<A>(p[axes.z]), org,
                                shear);
      };
      if constexpr (Q == Query::kAnyMasked)
        if (!(occluders[b] >> k & 1)) continue;
      ++tests;
      if constexpr (Q != Query::kClosest) useful += uint32_t(__builtin_popcount(live));
      const UInt<A> candidate(prims[k]);
      TriangleHits<A> h;
      const bool found = test_triangles<A>(
          vertex(0), vertex(1), vertex(2), shear,
          [&](const Float<A>& distance) {
            const Mask<A> ahead = active & (distance > zero);
            if constexpr (Q == Query::kClosest) {
              return ahead & ((distance < t) | ((distance == t) & mask_of<A>(candidate < prim)));
            } else {
              return ahead & (distance < t);
            }
          },
          [&] { return plane_of<A>(block, width, k, axes, org); }, h);
      if (!found) continue;
      improved |= mask_bits<A>(h.hit);
      if constexpr (Q == Query::kClosest) {
        t = select<A>(h.hit, h.t, t);
        u = select<A>(h.hit, h.u, u);
        v = select<A>(h.hit, h.v, v);
        prim = select<A>(h.hit, candidate, prim);
      } else {
        live &= ~mask_bits<A>(h.hit);
        if (!live) break;
      }
    }
    if (Q != Query::kClosest && !live) break;
  }
  count.rows += Q == Query::kClosest ? uint64_t(tests) * lanes : useful;
  count.steps += tests;
  if (!improved) return 0;
  if constexpr (Q != Query::kClosest) {
    for (uint32_t bits = improved; bits; bits &= bits - 1)
      records[size_t(slots[__builtin_ctz(bits)]) * kRecordWords + kRecordT] = -1.f;
  } else {
    alignas(64) float ts[W], us[W], vs[W];
    alignas(64) uint32_t prims[W];
    t.store_aligned(ts);
    u.store_aligned(us);
    v.store_aligned(vs);
    prim.store_aligned(prims);
    for (uint32_t bits = improved; bits; bits &= bits - 1) {
      const auto lane = uint32_t(__builtin_ctz(bits));
      float* const record = records + size_t(slots[lane]) * kRecordWords;
      record[kRecordT] = ts[lane];
      record[kRecordU] = us[lane];
      record[kRecordV] = vs[lane];
      __builtin_memcpy(record + kRecordPrim, prims + lane, 4);
    }
  }
  return uint32_t(__builtin_popcount(improved));
}

}  // namespace yat::YAT_ISA

#pragma once
// Rays as the traversal reads them: one cache line per ray, sorted by class.
//
//   word  0 1  2 3 4   5 6 7    8  9 10 11   12 13 14  15
//         v u  1/dir  -org/dir  t  org'      shear     prim
//              \______________/            box tests load words 1..8
//                              \_________________________/  triangle tests load words 8..15
//
// org' is the origin with its axes rotated so that the third is the one along which the ray moves
// most (axis kz, then shear = dir'_x / dir'_z, dir'_y / dir'_z, 1 / dir'_z: Woop, Benthin, Wald
// 2013). A ray's class is its direction octant and kz. Slots are sorted by class, and lists keep
// the order of slots, so that nearly every register holds rays of one kz.

#include "kernels/table.h"
#include "soa/simd.h"

namespace yat::YAT_ISA {

enum class Query { kClosest, kAny, kAnyMasked };

inline constexpr uint32_t kRecordWords = 16;
inline constexpr uint32_t kRecordV = 0, kRecordU = 1, kRecordBox = 1, kRecordT = 8,
                          kRecordTriangle = 8, kRecordPrim = 15;
/// Rays traced together; a longer call is cut. 64-byte records: 4 MB.
inline constexpr uint32_t kStreamRays = 65536;
/// Which rays go through the tree together.
enum class Passes {
  kByOctant,  ///< those of one octant: near and far sides are known, and the best order of children
  kOne,       ///< all: lists are longer, but each box's sides must be compared
};
template <Query Q>
inline constexpr Passes kUsualPasses = Q == Query::kClosest ? Passes::kByOctant : Passes::kOne;

/// octant * 3 + kz, or kz.
template <Passes P>
inline constexpr uint32_t kClasses = P == Passes::kByOctant ? 24 : 3;

/// Records and order of the rays of one stream, in scratch memory.
struct RayStream {
  float* records;         ///< slot -> record; one more than there are rays, for those left out
  uint32_t* slot_of_row;  ///< the last slot for all that are left out: misses
  float* shift;           ///< per row: distance by which the origin was moved along dir
  uint32_t* class_of_row;
  uint32_t first_slot[kClasses<Passes::kByOctant> + 1];
  uint32_t left_out;  ///< the last slot
  bool any_shift;
};

/// Where a far ray comes near the scene. The tests' rounding errors grow with the distance from
/// the origin to the vertices, so a ray from far outside starts again one extent before the bounds.
/// False if it never meets them.
YAT_INLINE bool shift_of_far_ray(const TreeView& tree, double extent, const float (&org)[3],
                                 const float (&dir)[3], double& shift) {
  double enter = 0, leave = 1e300, fastest = 0;
  for (int a = 0; a < 3; ++a) {
    const double o = double(org[a]), d = double(dir[a]);
    const double low = double(tree.min[a]) - 1e-5 * extent,
                 high = double(tree.max[a]) + 1e-5 * extent;
    const double speed = d < 0 ? -d : d;
    fastest = speed > fastest ? speed : fastest;
    if (d == 0) {
      if (o < low || o > high) return false;
      continue;
    }
    double t0 = (low - o) / d, t1 = (high - o) / d;
    if (t0 > t1) {
      const double t = t0;
      t0 = t1;
      t1 = t;
    }
    // The direction itself is only known to an ulp: let the ray be that much wider.
    const double slack = 4e-7 * (t1 < 0 ? -t1 : t1);
    enter = t0 - slack > enter ? t0 - slack : enter;
    leave = t1 + slack < leave ? t1 + slack : leave;
  }
  if (enter > leave) return false;
  shift = enter - extent / fastest;
  if (shift < 0) shift = 0;
  return true;
}

/// Registers of W rays, as they are in the columns.
template <class A>
struct RawRays {
  Float<A> org[3], dir[3], t_max;
};

template <class A, Query Q, class Columns>
YAT_INLINE RawRays<A> load_raw(const Columns& rays, uint32_t row) {
  RawRays<A> raw;
  raw.org[0] = load<A>(rays.org_x, row);
  raw.org[1] = load<A>(rays.org_y, row);
  raw.org[2] = load<A>(rays.org_z, row);
  raw.dir[0] = load<A>(rays.dir_x, row);
  raw.dir[1] = load<A>(rays.dir_y, row);
  raw.dir[2] = load<A>(rays.dir_z, row);
  if constexpr (requires { rays.t_max; }) {
    raw.t_max = load<A>(rays.t_max, row);
  } else {
    raw.t_max = Float<A>(1.f);
  }
  return raw;
}

template <class A>
YAT_INLINE Float<A> max_magnitude(const Float<A> (&v)[3]) {
  return xsimd::max(xsimd::abs(v[0]), xsimd::max(xsimd::abs(v[1]), xsimd::abs(v[2])));
}

/// The axis along which a ray moves most (the first of equals): lanes where it is x; where it is y,
/// if it is not x.
template <class A>
struct MainAxis {
  Mask<A> x, y;
  YAT_INLINE explicit MainAxis(const Float<A> (&dir)[3]) {
    const Float<A> ax = xsimd::abs(dir[0]), ay = xsimd::abs(dir[1]), az = xsimd::abs(dir[2]);
    x = (ax >= ay) & (ax >= az);
    y = ay >= az;
  }
  /// 0, 1 or 2.
  YAT_INLINE UInt<A> number() const {
    return select<A>(x, UInt<A>(0u), select<A>(y, UInt<A>(1u), UInt<A>(2u)));
  }
  /// Component `k` of a vector whose axes are rotated so that the third is the main one.
  YAT_INLINE Float<A> rotated(const Float<A> (&v)[3], uint32_t k) const {
    return select<A>(x, v[(k + 1) % 3], select<A>(y, v[(k + 2) % 3], v[k]));
  }
};

/// A ray as the triangle test takes it.
template <class A>
struct ShearedRay {
  Float<A> org[3], shear[3];
  YAT_INLINE ShearedRay(const RawRays<A>& r, const MainAxis<A>& axis) {
    for (uint32_t k = 0; k < 3; ++k) org[k] = axis.rotated(r.org, k);
    shear[2] = Float<A>(1.f) / axis.rotated(r.dir, 2);
    shear[0] = axis.rotated(r.dir, 0) * shear[2];
    shear[1] = axis.rotated(r.dir, 1) * shear[2];
  }
};

/// Lanes whose ray can hit anything: finite, with a direction, of positive length. NaN fails every
/// comparison.
template <class A>
YAT_INLINE Mask<A> can_hit(const RawRays<A>& r) {
  const Float<A> largest(3.402823466e38f), zero(0.f);
  Mask<A> valid = (r.t_max > zero) & (max_magnitude<A>(r.dir) > zero);
  for (int a = 0; a < 3; ++a)
    valid = valid & (xsimd::abs(r.org[a]) <= largest) & (xsimd::abs(r.dir[a]) <= largest);
  return valid;
}

/// Largest |coordinate| of the tree's bounds.
YAT_INLINE float extent_of(const TreeView& tree) {
  float extent = 0;
  for (int a = 0; a < 3; ++a) {
    const float low = tree.min[a] < 0 ? -tree.min[a] : tree.min[a];
    const float high = tree.max[a] < 0 ? -tree.max[a] : tree.max[a];
    extent = low > extent ? low : extent;
    extent = high > extent ? high : extent;
  }
  return extent;
}

/// Classes of the rays of rows [first, first + n) and the slots that follow from them.
template <class A, Query Q, Passes P, class Columns>
YAT_INLINE void sort_rays(const TreeView& tree, float extent, const Columns& rays, uint32_t n,
                          RayStream& stream) noexcept {
  constexpr uint32_t W = kLanes<A>;
  constexpr uint32_t kLeftOut = kClasses<P>;
  // Four counters per class: neighbouring rows are often of one class, and an addition to memory
  // must wait for the one before.
  uint32_t count[4][kClasses<P> + 1] = {};
  stream.any_shift = false;
  for (uint32_t row = 0; row < n; row += W) {
    const RawRays<A> r = load_raw<A, Q>(rays, row);
    const Mask<A> valid = tail_mask<A>(row, n) & can_hit<A>(r);
    UInt<A> cls = MainAxis<A>(r.dir).number();
    if constexpr (P == Passes::kByOctant) {
      const Float<A> zero(0.f);
      cls = cls + select<A>(r.dir[0] < zero, UInt<A>(3u), UInt<A>(0u)) +
            select<A>(r.dir[1] < zero, UInt<A>(6u), UInt<A>(0u)) +
            select<A>(r.dir[2] < zero, UInt<A>(12u), UInt<A>(0u));
    }
    cls = select<A>(valid, cls, UInt<A>(kLeftOut));
    store<A>(cls, stream.class_of_row, row);
    const Mask<A> far = valid & (max_magnitude<A>(r.org) > Float<A>(kFarExtents * extent));
    if (any<A>(far)) {
      if (!stream.any_shift) {
        for (uint32_t i = 0; i < n + W; ++i) stream.shift[i] = 0.f;
        stream.any_shift = true;
      }
      for (uint32_t bits = mask_bits<A>(far); bits; bits &= bits - 1) {
        const uint32_t i = row + uint32_t(__builtin_ctz(bits));
        const float org[3] = {rays.org_x[i], rays.org_y[i], rays.org_z[i]};
        const float dir[3] = {rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]};
        float end = 1.f;
        if constexpr (requires { rays.t_max; }) end = rays.t_max[i];
        double shift = 0;
        // One that ends before it comes near is a miss too.
        if (shift_of_far_ray(tree, double(extent), org, dir, shift) && float(shift) < end) {
          stream.shift[i] = float(shift);
        } else {
          stream.class_of_row[i] = kLeftOut;
        }
      }
    }
    const uint32_t last = n - row < W ? n : row + W;
    for (uint32_t i = row; i < last; ++i) ++count[i & 3][stream.class_of_row[i]];
  }
  uint32_t slot = 0;
  for (uint32_t c = 0; c < kClasses<P>; ++c) {
    stream.first_slot[c] = slot;
    slot += (count[0][c] + count[1][c]) + (count[2][c] + count[3][c]);
  }
  stream.first_slot[kClasses<P>] = stream.left_out = slot;
}

/// Writes the records of the sorted rays.
template <class A, Query Q, Passes P, class Columns>
YAT_INLINE void write_records(float extent, const Columns& rays, uint32_t n,
                              RayStream& stream) noexcept {
  constexpr uint32_t W = kLanes<A>;
  const float floor = extent > .1f ? extent * 1e-36f : 1e-37f;
  uint32_t next[kClasses<P> + 1];
  for (uint32_t c = 0; c < kClasses<P>; ++c) next[c] = stream.first_slot[c];
  const uint32_t left_out = stream.left_out;
  for (uint32_t row = 0; row < n; row += W) {
    RawRays<A> r = load_raw<A, Q>(rays, row);
    if (stream.any_shift) {
      const Float<A> shift = load<A>(stream.shift, row);
      if (any<A>(shift > Float<A>(0.f))) {
        alignas(64) float org[3][W];
        for (int a = 0; a < 3; ++a) r.org[a].store_aligned(org[a]);
        const float* dir[3] = {rays.dir_x, rays.dir_y, rays.dir_z};
        for (uint32_t i = row; i < row + W && i < n; ++i)
          if (stream.shift[i] > 0.f)
            for (int a = 0; a < 3; ++a)
              org[a][i - row] =
                  float(double(org[a][i - row]) + double(stream.shift[i]) * double(dir[a][i]));
        for (int a = 0; a < 3; ++a) r.org[a] = Float<A>::load_aligned(org[a]);
        r.t_max = r.t_max - shift;
      }
    }
    alignas(64) uint32_t slot[W];
    for (uint32_t i = 0; i < W; ++i) {
      const uint32_t cls = row + i < n ? stream.class_of_row[row + i] : kClasses<P>;
      slot[i] = cls < kClasses<P> ? next[cls]++ : left_out;
    }
    load<A>(slot, 0).store_unaligned(stream.slot_of_row + row);
    // A zero component would make 0 x infinity. 1e-18 of the largest moves the ray by nothing that
    // a float can see; the floor keeps the distances of planes finite.
    const Float<A> least = xsimd::max(max_magnitude<A>(r.dir) * Float<A>(1e-18f), Float<A>(floor));
    Float<A> inverse[3], offset[3];
    for (int a = 0; a < 3; ++a) {
      // The sign is that of `dir < 0`, as in the octant: -0 counts as positive.
      const Float<A> tiny = select<A>(r.dir[a] < Float<A>(0.f), -least, least);
      const Float<A> d = select<A>(xsimd::abs(r.dir[a]) < least, tiny, r.dir[a]);
      inverse[a] = Float<A>(1.f) / d;
      offset[a] = -(r.org[a] * inverse[a]);
    }
    const ShearedRay<A> sheared(r, MainAxis<A>(r.dir));
    const Float<A> none = as_float<A>(UInt<A>(kNone));
    float* const to = stream.records;
    store_rows4<A>(Float<A>(0.f), Float<A>(0.f), inverse[0], inverse[1], to, slot, kRecordWords);
    store_rows4<A>(inverse[2], offset[0], offset[1], offset[2], to + 4, slot, kRecordWords);
    store_rows4<A>(r.t_max, sheared.org[0], sheared.org[1], sheared.org[2], to + 8, slot,
                   kRecordWords);
    store_rows4<A>(sheared.shear[0], sheared.shear[1], sheared.shear[2], none, to + 12, slot,
                   kRecordWords);
  }
  stream.records[size_t(left_out) * kRecordWords + kRecordT] = 0.f;  // Not occluded.
}

}  // namespace yat::YAT_ISA

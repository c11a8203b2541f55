#pragma once
// Trees whose leaves hold something else than blocks of triangles: an instance, or a shape.
//
// Records of such a tree's rays (kernels/traverse_rays.h) hold the ray as it came in the place of
// the triangle test's numbers: words 8..15 are t, origin, direction, prim.

#include "kernels/traverse.h"

namespace yat::YAT_ISA {

inline constexpr uint32_t kRecordRay = 8;

/// Writes them for an open stream, and into `moved`, per slot, the distance from the ray's origin
/// to where its record begins.
template <class A, Query Q>
YAT_INLINE void write_raw_rays(const Ray<ConstColumn>& rays, uint32_t n, const RayStream& stream,
                               float* moved) {
  constexpr uint32_t W = kLanes<A>;
  for (uint32_t row = 0; row < n; row += W) {
    const RawRays<A> r = load_raw<A, Q>(rays, row);
    const uint32_t* const slot = stream.slot_of_row + row;
    Float<A> shift(0.f);
    if (stream.any_shift) shift = load<A>(stream.shift, row);
    store_rows4<A>(r.t_max - shift, r.org[0], r.org[1], r.org[2], stream.records + kRecordRay, slot,
                   kRecordWords);
    store_rows4<A>(r.dir[0], r.dir[1], r.dir[2], as_float<A>(UInt<A>(kNone)),
                   stream.records + kRecordRay + 4, slot, kRecordWords);
    alignas(64) float shifts[W];
    shift.store_aligned(shifts);
    for (uint32_t i = 0; i < W; ++i) moved[slot[i]] = shifts[i];
  }
}

}  // namespace yat::YAT_ISA

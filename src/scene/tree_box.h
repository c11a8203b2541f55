#pragma once
// Boxes and references of the tree build, four floats to a word.

#include <bit>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace yat::tree {

/// x, y, z and a fourth lane that boxes ignore. A vector of the compiler, which every processor
/// has: the build is not compiled per instruction set.
using F4 = float __attribute__((vector_size(16)));
using I4 = int32_t __attribute__((vector_size(16)));

inline F4 splat(float x) {
  return F4{x, x, x, x};
}
/// Where either is NaN: b.
inline F4 min_of(F4 a, F4 b) {
  return a < b ? a : b;
}
inline F4 max_of(F4 a, F4 b) {
  return a > b ? a : b;
}

struct Box {
  F4 low = splat(FLT_MAX), high = splat(-FLT_MAX);

  void add(const Box& other) {
    low = min_of(low, other.low);
    high = max_of(high, other.high);
  }
  bool empty() const { return !(low[0] <= high[0] && low[1] <= high[1] && low[2] <= high[2]); }
  double side(int axis) const { return double(high[axis]) - double(low[axis]); }
  /// Half the surface. In double: finite for any finite box.
  double area() const {
    if (empty()) return 0;
    const double x = side(0), y = side(1), z = side(2);
    return x * y + y * z + z * x;
  }
};

/// Area of what two boxes share.
inline double overlap(const Box& a, const Box& b) {
  return Box{max_of(a.low, b.low), min_of(a.high, b.high)}.area();
}

/// A triangle, or the part of it in a cell. The fourth lane of `low` holds its row.
struct Reference {
  F4 low, high;

  uint32_t prim() const { return std::bit_cast<uint32_t>(float(low[3])); }
  /// Without the row, whose bits are a denormal number, slow to reckon with.
  Box box() const {
    const I4 xyz = {-1, -1, -1, 0};
    return {std::bit_cast<F4>(std::bit_cast<I4>(low) & xyz), high};
  }
  /// Half the centre: finite for any finite box. The fourth lane is 0.
  F4 half_center() const { return splat(0.25f) * box().low + splat(0.25f) * high; }
};
static_assert(sizeof(Reference) == 32);

inline Reference make_reference(const Box& box, uint32_t prim) {
  Reference r{box.low, box.high};
  r.low[3] = std::bit_cast<float>(prim);
  r.high[3] = 0;
  return r;
}

/// Half surfaces in float, in units that fit a set: `scale` brings its box to about one.
struct AreaUnit {
  F4 scale;
  double to_double;  ///< of an area in this unit, in squared lengths

  explicit AreaUnit(const Box& box) {
    const double side = std::fmax(box.side(0), std::fmax(box.side(1), box.side(2)));
    int exponent = 0;
    if (side > 0) std::frexp(side, &exponent);
    // Denormal scales would round; sets that large or small are the same in all that counts.
    exponent = exponent > 126 ? 126 : exponent < -126 ? -126 : exponent;
    scale = splat(std::ldexp(1.f, -exponent));
    to_double = std::ldexp(1.0, 2 * exponent);
  }
  float operator()(F4 low, F4 high) const {
    const F4 d = max_of(high * scale - low * scale, F4{});
    return d[0] * (d[1] + d[2]) + d[1] * d[2];
  }
  float operator()(const Box& box) const { return (*this)(box.low, box.high); }
};

/// A monotone map of positions to bins along three axes: equal positions share a bin, greater
/// ones never lie lower.
struct BinMap {
  F4 base, scale, last;

  BinMap(F4 from, F4 to, int bins) : base(from), last(splat(float(bins - 1))) {
    for (int a = 0; a < 4; ++a) {
      const float range = a < 3 ? to[a] - from[a] : 0.f;
      const float s = range > 0 ? float(bins) / range : 0.f;
      scale[a] = s < FLT_MAX ? s : FLT_MAX;
    }
  }
  /// Bins of three positions; the fourth lane is 0 to last.
  I4 operator()(F4 at) const {
    F4 t = (at - base) * scale;
    t = t > F4{} ? t : F4{};  // NaN, too, becomes 0.
    t = t < last ? t : last;
    return __builtin_convertvector(t, I4);
  }
};

}  // namespace yat::tree

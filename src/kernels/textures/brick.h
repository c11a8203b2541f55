#pragma once
// In 0: x, y, z; in 1: bricks, in 2: mortar, in 3: what bricks are multiplied with. A wall in
// running or stacked bond (lxs 8.4): with p = (P + mortar + .001) / size, and an offset of the
// bond, row = floor(z), brick where frac(x + row run), frac(y - row run) and frac(z) leave the
// mortar.

#include "kernels/texture.h"

namespace yat {

template <template <class> class Of>
struct BrickParameters {
  Of<float> width, depth, height;  ///< of a brick with its mortar
  Of<float> mortar;                ///< its thickness
  Of<float> run;                   ///< shift from row to row, in bricks
  Of<float> offset_y;
  YAT_FIELDS(width, depth, height, mortar, run, offset_y)
};
static_assert(all_fields_listed<BrickParameters>);

inline constexpr TextureTraits kBrickTraits{.name = "brick"};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct Brick {
  template <uint32_t kForm>
  static YAT_INLINE void evaluate(const BrickParameters<Lanes<A>::template Of>& p,
                                  const TextureRow<A>& row) {
    const Float<A> border = p.mortar + Float<A>(.001f);
    const Float<A> x = (row.in(0, 0) + border) / p.width;
    const Float<A> y = (row.in(0, 1) + border) / p.depth + p.offset_y;
    const Float<A> z = (row.in(0, 2) + border) / p.height;
    const Float<A> course = xsimd::floor(z), shifted_x = x + course * p.run,
                   shifted_y = y - course * p.run;
    const Mask<A> inside = (shifted_x - xsimd::floor(shifted_x) > p.mortar / p.width) &
                           (shifted_y - xsimd::floor(shifted_y) > p.mortar / p.depth) &
                           (z - course > p.mortar / p.height);
    for (uint32_t k = 0; k < 3 && row.wants(k); ++k)
      row.out(k, xsimd::select(inside, row.in(1, k) * row.in(3, k), row.in(2, k)));
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

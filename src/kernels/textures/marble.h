#pragma once
// In 0: x, y, z. With m = y scale + variation fbm(scale p), t = 1/2 + 1/2 sin m: the cubic Bezier
// curve through nine greys and blues at t, times 1.5 (lxs 8.5). Out: linear Rec.709.

#include "kernels/texture.h"
#if defined(YAT_ISA)
#include "kernels/gradient_noise.h"
#endif
namespace yat {

/// Nine colours, by channel.
constexpr float kMarbleColours[3][9] = {{.58f, .58f, .58f, .5f, .6f, .58f, .58f, .2f, .58f},
                                        {.58f, .58f, .58f, .5f, .59f, .58f, .58f, .2f, .58f},
                                        {.6f, .6f, .6f, .5f, .58f, .6f, .6f, .33f, .6f}};

template <template <class> class Of>
struct MarbleParameters {
  Of<float> octaves, roughness, scale, variation;
  YAT_FIELDS(octaves, roughness, scale, variation)
};
static_assert(all_fields_listed<MarbleParameters>);

inline constexpr TextureTraits kMarbleTraits{.name = "marble"};

#if defined(YAT_ISA)
namespace YAT_ISA {

/// The control points of marble, one channel.
template <class A>
YAT_INLINE Float<A> marble_colour(const Float<A>& segment, int channel, uint32_t k) {
  const UInt<A> i = xsimd::bitwise_cast<uint32_t>(xsimd::to_int(segment)) + UInt<A>(k);
  return gather<A>(kMarbleColours[channel], xsimd::min(i, UInt<A>(8u)));
}

template <class A>
struct Marble {
  template <uint32_t kForm>
  static YAT_INLINE void evaluate(const MarbleParameters<Lanes<A>::template Of>& p,
                                  const TextureRow<A>& row) {
    const Float<A> zero(0.f), one(1.f), half(.5f);
    const Vec3<A> at{p.scale * row.in(0, 0), p.scale * row.in(0, 1), p.scale * row.in(0, 2)};
    const Float<A> m = at.y + p.variation * noise_octaves<A, false>(at, p.roughness, p.octaves);
    const Float<A> turns = m * Float<A>(1.f / kTwoPi);
    const Float<A> wave = sin_cos_turns<A>(turns - xsimd::floor(turns)).sin;
    const Float<A> t = Float<A>(6.f) * (half + half * wave);
    // floor(6 t) is 6 only where the wave is at its top: the end of the last segment.
    const Float<A> segment = xsimd::min(xsimd::max(xsimd::floor(t), zero), Float<A>(5.f));
    const Float<A> x = t - segment, y = one - x;
    Float<A> rgb[3];
    for (int c = 0; c < 3; ++c)
      rgb[c] = Float<A>(1.5f) * (y * y * y * marble_colour<A>(segment, c, 0) +
                                 Float<A>(3.f) * y * y * x * marble_colour<A>(segment, c, 1) +
                                 Float<A>(3.f) * y * x * x * marble_colour<A>(segment, c, 2) +
                                 x * x * x * marble_colour<A>(segment, c, 3));
    row.out(Spectrum<A>{rgb[0], rgb[1], rgb[2]});
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

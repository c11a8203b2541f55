#pragma once
// In 0: x, y, z. Blender's textures with gradient noise for its noise (lxs 8.5); out: how far from
// tex1 to tex2, clamp(contrast (v - 1/2) + bright - 1/2), v the raw value:
//   0 clouds  turbulence t(p): octaves k = 0..depth of n(2^k p / size) / 2^k, normalised to 0..1
//   1 wood    waves of 10 (x + y + z) or 20 |p|, with noise turbulence n(p / size) inside
//   2 marble  a wave of 5 (x + y + z) + turbulence t(p), its square root or fourth root
//   3 blend   a ramp along x, its shapes or a sphere's
//   4 stucci  noise a way of turbulence / 200 further along z, without contrast and brightness

#include "kernels/texture.h"
#if defined(YAT_ISA)
#include "kernels/gradient_noise.h"
#endif
namespace yat {

enum class BlenderWave : uint32_t { kSine, kSaw, kTriangle };
// Flags of the variant: type from bit 8 (4 bits), then these, wave from bit 13.
inline constexpr uint32_t kBlenderHard = 1u << 12, kBlenderFlip = 1u << 15;

template <template <class> class Of>
struct BlenderParameters {
  Of<float> size, depth, turbulence;  ///< noisesize, noisedepth, turbulence
  Of<float> bright, contrast;
  YAT_FIELDS(size, depth, turbulence, bright, contrast)
};
static_assert(all_fields_listed<BlenderParameters>);

inline constexpr TextureTraits kBlenderTraits{.name = "blender", .forms = 5};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct Blender {
  using Parameters = BlenderParameters<Lanes<A>::template Of>;

  /// Noise in 0..1.
  static YAT_INLINE Float<A> noise(const Vec3<A>& p) {
    return Float<A>(.5f) + Float<A>(.5f) * gradient_noise<A>(p);
  }
  static YAT_INLINE Float<A> turbulence(const Parameters& p, const Vec3<A>& at, bool hard) {
    const Float<A> zero(0.f), one(1.f), two(2.f), half(.5f);
    Vec3<A> place = (one / p.size) * at;
    Float<A> sum(0.f), total(0.f), weight(1.f), k(0.f);
    for (;;) {
      const Mask<A> on = k <= p.depth;
      if (!any<A>(on)) return sum / total;
      const Float<A> n = noise(place), t = hard ? xsimd::abs(two * n - one) : n;
      sum = sum + xsimd::select(on, weight * t, zero);
      total = total + xsimd::select(on, weight, zero);
      weight = half * weight;
      place = two * place;
      k = k + one;
    }
  }
  /// A wave of period 2 pi in 0..1.
  static YAT_INLINE Float<A> wave(const Float<A>& a, BlenderWave shape) {
    const Float<A> turns = a * Float<A>(1.f / kTwoPi), f = turns - xsimd::floor(turns), one(1.f),
                   half(.5f);
    if (shape == BlenderWave::kSaw) return f;
    if (shape == BlenderWave::kTriangle) {
      // Blender's: 1 at whole periods, 0 between.
      return xsimd::abs(Float<A>(2.f) * f - one);
    }
    return half + half * sin_cos_turns<A>(f).sin;
  }

  template <uint32_t kForm>
  static YAT_INLINE void evaluate(const Parameters& p, const TextureRow<A>& row) {
    const uint32_t type = row.step.variant >> 8 & 15;
    const bool hard = (row.step.variant & kBlenderHard) != 0;
    const auto shape = BlenderWave(row.step.variant >> 13 & 3);
    const Float<A> zero(0.f), one(1.f), half(.5f);
    const Vec3<A> at{row.in(0, 0), row.in(0, 1), row.in(0, 2)};
    Float<A> v;
    if constexpr (kForm == 0) v = turbulence(p, at, hard);
    if constexpr (kForm == 1) {
      v = type % 2 == 0 ? Float<A>(10.f) * (at.x + at.y + at.z) : Float<A>(20.f) * length(at);
      if (type >= 2) {
        const Float<A> n = noise((one / p.size) * at);
        v = v + p.turbulence * (hard ? xsimd::abs(Float<A>(2.f) * n - one) : n);
      }
      v = wave(v, shape);
    }
    if constexpr (kForm == 2) {
      v = wave(Float<A>(5.f) * (at.x + at.y + at.z) + p.turbulence * turbulence(p, at, hard),
               shape);
      if (type >= 1) v = xsimd::sqrt(v);
      if (type >= 2) v = xsimd::sqrt(v);
    }
    if constexpr (kForm == 3) {
      const bool flip = (row.step.variant & kBlenderFlip) != 0;
      const Float<A> x = flip ? at.y : at.x, y = flip ? at.x : at.y;
      const Float<A> ramp = half * (one + x);
      if (type == 0) v = ramp;
      if (type == 1) v = xsimd::select(ramp < zero, zero, ramp * ramp);
      if (type == 2) {
        const Float<A> t = xsimd::min(xsimd::max(ramp, zero), one);
        v = t * t * (Float<A>(3.f) - Float<A>(2.f) * t);
      }
      if (type == 3) v = Float<A>(.25f) * (Float<A>(2.f) + x + y);
      if (type >= 4 && type <= 5) {
        v = xsimd::max(one - length(at), zero);
        if (type == 5) v = v * v;
      }
      if (type == 6) {
        const Float<A> turns = angle_in_turns<A>(x, y);  // atan2 from -pi on
        v = xsimd::select(turns < half, turns + half, turns - half);
      }
    }
    if constexpr (kForm == 4) {
      const Float<A> first = noise((one / p.size) * at);
      Float<A> way = p.turbulence * Float<A>(1.f / 200);
      if (type >= 1) way = way * first * first;
      v = noise((one / p.size) * Vec3<A>{at.x, at.y, at.z + way});
      row.out(0, type == 2 ? one - v : v);
      return;
    }
    const Float<A> shown = (v - half) * p.contrast + p.bright - half;
    row.out(0, xsimd::min(xsimd::max(shown, zero), one));
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

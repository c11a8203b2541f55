#pragma once
// In 0: x, y, z. Sums of gradient noise (lxs 8.5):
//   0 fbm, 1 wrinkled: sum of magnitudes, 2 windy: |fbm of 3 octaves at p / 10| fbm of 6 octaves

#include "kernels/texture.h"
#if defined(YAT_ISA)
#include "kernels/gradient_noise.h"
#endif
namespace yat {

template <template <class> class Of>
struct NoiseParameters {
  Of<float> octaves, roughness;  ///< forms 0 and 1
  YAT_FIELDS(octaves, roughness)
};
static_assert(all_fields_listed<NoiseParameters>);

inline constexpr TextureTraits kNoiseTraits{.name = "noise", .forms = 3};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct Noise {
  template <uint32_t kForm>
  static YAT_INLINE void evaluate(const NoiseParameters<Lanes<A>::template Of>& p,
                                  const TextureRow<A>& row) {
    const Vec3<A> at{row.in(0, 0), row.in(0, 1), row.in(0, 2)};
    if constexpr (kForm == 2) {
      const Float<A> half(.5f);
      row.out(0, xsimd::abs(noise_octaves<A, false>(Float<A>(.1f) * at, half, Float<A>(3.f))) *
                     noise_octaves<A, false>(at, half, Float<A>(6.f)));
    } else {
      row.out(0, noise_octaves < A, kForm == 1 > (at, p.roughness, p.octaves));
    }
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

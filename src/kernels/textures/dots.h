#pragma once
// In 0: s, t; in 1: inside of dots; in 2: outside. A unit cell has a dot where noise says so, of
// radius .35, moved off the cell's centre by noise (lxs 8.4).

#include "kernels/texture.h"
#if defined(YAT_ISA)
#include "kernels/gradient_noise.h"
#endif
namespace yat {

template <template <class> class Of>
struct DotsParameters {
  Of<uint32_t> unused;
  YAT_FIELDS(unused)
};
static_assert(all_fields_listed<DotsParameters>);

inline constexpr TextureTraits kDotsTraits{.name = "dots"};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct Dots {
  template <uint32_t kForm>
  static YAT_INLINE void evaluate(const DotsParameters<Lanes<A>::template Of>&,
                                  const TextureRow<A>& row) {
    const Float<A> half(.5f), s = row.in(0, 0), t = row.in(0, 1);
    const Float<A> cs = xsimd::floor(s + half), ct = xsimd::floor(t + half);
    const auto noise = [&](float ds, float dt) {
      return gradient_noise<A>({cs + Float<A>(ds), ct + Float<A>(dt), half});
    };
    const Float<A> shift(.15f);
    const Float<A> x = s - (cs + shift * noise(1.5f, 2.8f)),
                   y = t - (ct + shift * noise(4.5f, 9.8f));
    const Mask<A> inside =
        (noise(.5f, .5f) > Float<A>(0.f)) & (x * x + y * y < Float<A>(.35f * .35f));
    for (uint32_t k = 0; k < 3 && row.wants(k); ++k)
      row.out(k, xsimd::select(inside, row.in(1, k), row.in(2, k)));
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

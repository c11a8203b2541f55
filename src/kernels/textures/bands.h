#pragma once
// Linear Rec.709 to transport bands, as a reflectance (scene/colour_model.h).
//
// Form: 0 nothing more; 1 the bands are raised to `gamma`. That is how an image's gamma acts where
// colours are spectra: on each wavelength of the stored colour's spectrum (lxs 8.3).

#include "kernels/texture.h"
#if defined(YAT_ISA)
#include "kernels/power.h"
#endif

namespace yat {

template <template <class> class Of>
struct BandsParameters {
  Of<float> gamma;  ///< > 0; form 1
  YAT_FIELDS(gamma)
};
static_assert(all_fields_listed<BandsParameters>);

inline constexpr uint32_t kBandsRaised = 1;  ///< form
inline constexpr TextureTraits kBandsTraits{.name = "bands", .forms = 2};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct Bands {
  template <uint32_t kForm>
  static YAT_INLINE void evaluate(const BandsParameters<Lanes<A>::template Of>& p,
                                  const TextureRow<A>& row) {
    const Spectrum<A> c = row.colour(0);
    const ColourTriple<Float<A>> bands =
        bands_of<Float<A>>({c.r, c.g, c.b}, row.input.basis,
                           [](const Float<A>& a, const Float<A>& b) { return xsimd::min(a, b); });
    if constexpr (kForm == kBandsRaised) {
      const auto raise = [&](const Float<A>& x) {
        return power<A>(xsimd::max(x, Float<A>(0.f)), p.gamma);
      };
      row.out(Spectrum<A>{raise(bands.r), raise(bands.g), raise(bands.b)});
    } else {
      row.out(Spectrum<A>{bands.r, bands.g, bands.b});
    }
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

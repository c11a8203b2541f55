#pragma once
// Linear Rec.709 to transport bands, as a reflectance (scene/colour_model.h).

#include "kernels/texture.h"

namespace yat {

template <template <class> class Of>
struct BandsParameters {
  Of<uint32_t> unused;
  YAT_FIELDS(unused)
};
static_assert(all_fields_listed<BandsParameters>);

inline constexpr TextureTraits kBandsTraits{.name = "bands"};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct Bands {
  template <uint32_t kForm>
  static YAT_INLINE void evaluate(const BandsParameters<Lanes<A>::template Of>&,
                                  const TextureRow<A>& row) {
    const Spectrum<A> c = row.colour(0);
    const ColourTriple<Float<A>> bands =
        bands_of<Float<A>>({c.r, c.g, c.b}, row.input.basis,
                           [](const Float<A>& a, const Float<A>& b) { return xsimd::min(a, b); });
    row.out(Spectrum<A>{bands.r, bands.g, bands.b});
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

#pragma once
// A surface that is not there for light: paths and shadow rays pass it unchanged.

#include "kernels/material.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct NullParameters {
  Of<uint32_t> unused;
  YAT_FIELDS(unused)
};
static_assert(all_fields_listed<NullParameters>);

inline constexpr MaterialTraits kNullTraits{.name = "null",
                                            .delta = true,
                                            .see_through = true,
                                            .needs_lobe = false,
                                            .needs_direction = false};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct Null : Delta<A> {
  using Parameters = NullParameters<Lanes<A>::template Of>;

  static YAT_INLINE Spectrum<A> transmittance(const Parameters&, const BsdfView<A>&) {
    const Float<A> one(1.f);
    return {one, one, one};
  }
  static YAT_INLINE BsdfSample<A> sample(const Parameters&, const BsdfView<A>& view,
                                         const Float<A>&, const Float<A>&, const Float<A>&) {
    const Float<A> one(1.f);
    return {-view.wo, {one, one, one}, Float<A>(0.f)};
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

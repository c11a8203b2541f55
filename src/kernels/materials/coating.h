#pragma once
// LuxRender's glossycoating: the coat of glossy on the outside of any material (lxs 7.3). A surface
// with it is split: rows go to the coat's lobe (a glossy without a base) or to the base, which then
// sees all light through the coat (kernels/coat.h); what either brings is divided by its chance.

#include "kernels/materials/coated_diffuse.h"
#include "soa/fields.h"

namespace yat {

template <template <class> class Of>
struct CoatingParameters {
  Of<float> ks_r, ks_g, ks_b;  ///< reflectance head-on, 0..1
  Of<float> ka_r, ka_g, ka_b;  ///< absorption [1/m], >= 0
  Of<float> depth;             ///< thickness [m], >= 0
  Of<float> index;             ///< refractive index that Ks counts times; 0: in full
  Of<float> base;              ///< about the share of light that the base gives back, 0..1
  Of<uint32_t> first, second;  ///< rows of the lobe's and of the base's own tables
  YAT_FIELDS(ks_r, ks_g, ks_b, ka_r, ka_g, ka_b, depth, index, base, first, second)
};
static_assert(all_fields_listed<CoatingParameters>);

inline constexpr MaterialTraits kCoatingTraits{.name = "coating",
                                               .delta = false,
                                               .see_through = false,
                                               .needs_lobe = false,
                                               .needs_direction = false,
                                               .splits = true};

#if defined(YAT_ISA)
namespace YAT_ISA {

template <class A>
struct Coating {
  using Parameters = CoatingParameters<Lanes<A>::template Of>;

  static YAT_INLINE Coat<Lanes<A>::template Of> coat(const Parameters& p, const Mask<A>& outside) {
    const Spectrum<A> r0 = coat_reflectance<A>({p.ks_r, p.ks_g, p.ks_b}, p.index);
    Coat<Lanes<A>::template Of> c;
    c.r0_r = r0.r;
    c.r0_g = r0.g;
    c.r0_b = r0.b;
    c.absorbs_r = p.depth * p.ka_r;
    c.absorbs_g = p.depth * p.ka_g;
    c.absorbs_b = p.depth * p.ka_b;
    c.outside = select<A>(outside, UInt<A>(1u), UInt<A>(0u));
    return c;
  }

  /// Of the base: what its light keeps through the coat against what the coat reflects. An eighth
  /// is left to each side that brings anything, as these are estimates.
  static YAT_INLINE Float<A> share(const Parameters& p, const BsdfView<A>& view) {
    const Float<A> one(1.f), zero(0.f), least(.125f);
    const Spectrum<A> reflected =
        coat_fresnel<A>(coat_reflectance<A>({p.ks_r, p.ks_g, p.ks_b}, p.index), view.wo.z);
    const Float<A> lobe = largest(reflected);
    const Float<A> base = p.base * largest(coat_absorption<A>({p.ka_r, p.ka_g, p.ka_b}, p.depth,
                                                              one + one / view.wo.z) *
                                           one_minus<A>(reflected));
    const Float<A> share = base / (lobe + base);
    const Float<A> used = xsimd::select(base > zero, xsimd::max(share, least), zero);
    return xsimd::select(view.outside & (lobe > zero), xsimd::min(used, one - least), one);
  }
};

}  // namespace YAT_ISA
#endif

}  // namespace yat

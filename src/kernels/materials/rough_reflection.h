#pragma once
// Materials that are one microfacet lobe times a Fresnel reflectance.

#include "kernels/materials/fresnel.h"
#include "kernels/materials/microfacet.h"

#if defined(YAT_ISA)
namespace yat::YAT_ISA {

/// What such a material is made of: Material has Parameters with uroughness and vroughness, and
/// fresnel(parameters, cos) in three bands.
template <class A, class Material, class Parameters>
struct RoughReflection {
  static YAT_INLINE Spectrum<A> evaluate(const Parameters& p, const BsdfView<A>& view,
                                         const Vec3<A>& wi) {
    const MicrofacetLobe<A> lobe = MicrofacetLobe<A>::of(p.uroughness, p.vroughness);
    const Vec3<A> h = MicrofacetLobe<A>::half_vector(view.wo, wi);
    return only<A>(wi.z > Float<A>(0.f),
                   lobe.evaluate(view.wo, wi, h) * Material::fresnel(p, dot(view.wo, h)));
  }
  static YAT_INLINE Float<A> pdf(const Parameters& p, const BsdfView<A>& view, const Vec3<A>& wi) {
    const MicrofacetLobe<A> lobe = MicrofacetLobe<A>::of(p.uroughness, p.vroughness);
    return only<A>(wi.z > Float<A>(0.f),
                   lobe.pdf(view.wo, MicrofacetLobe<A>::half_vector(view.wo, wi)));
  }
  static YAT_INLINE BsdfSample<A> sample(const Parameters& p, const BsdfView<A>& view,
                                         const Float<A>&, const Float<A>& u, const Float<A>& v) {
    const auto s = MicrofacetLobe<A>::of(p.uroughness, p.vroughness).sample(view.wo, u, v);
    return {s.wi, s.weight * Material::fresnel(p, s.cos_h), s.pdf};
  }
};

}  // namespace yat::YAT_ISA
#endif

#pragma once
// The BSDF alone, for tests and benchmarks: local frame, z the normal.

#include "kernels/shade.h"

namespace yat::YAT_ISA {

/// wo and the side it is on. Flipping z maps the inner side onto the frame that materials see.
template <class A>
struct BatchView {
  BsdfView<A> view;
  Mask<A> inside;
  YAT_INLINE Float<A> turn(const Float<A>& z) const { return xsimd::select(inside, -z, z); }
};
template <class A>
YAT_INLINE BatchView<A> load_view(const KernelTable::BsdfBatch& batch, uint32_t i) {
  BatchView<A> b;
  const Float<A> z = load<A>(batch.wo_z, i);
  b.inside = !(z > Float<A>(0.f));
  b.view.outside = !b.inside;
  b.view.distance = Float<A>(1.f);
  b.view.wo = {load<A>(batch.wo_x, i), load<A>(batch.wo_y, i), b.turn(z)};
  return b;
}

/// See KernelTable::bsdf_evaluate.
template <class A, template <class> class Material, template <template <class> class> class Record>
void bsdf_evaluate(const ParameterView& view, const KernelTable::BsdfBatch& batch,
                   uint32_t n) noexcept {
  for (uint32_t i = 0; i < n; i += kLanes<A>) {
    const auto parameters =
        load_parameters<A, Record>(view, only<A>(tail_mask<A>(i, n), load<A>(batch.parameter, i)));
    const BatchView<A> b = load_view<A>(batch, i);
    const Vec3<A> wi{load<A>(batch.wi_x, i), load<A>(batch.wi_y, i),
                     b.turn(load<A>(batch.wi_z, i))};
    const Spectrum<A> f = Material<A>::evaluate(parameters, b.view, wi);
    store<A>(f.r, batch.f_r, i);
    store<A>(f.g, batch.f_g, i);
    store<A>(f.b, batch.f_b, i);
    store<A>(Material<A>::pdf(parameters, b.view, wi), batch.pdf, i);
  }
}

/// See KernelTable::bsdf_sample.
template <class A, template <class> class Material, template <template <class> class> class Record>
void bsdf_sample(const ParameterView& view, const KernelTable::BsdfBatch& batch,
                 uint32_t n) noexcept {
  for (uint32_t i = 0; i < n; i += kLanes<A>) {
    const auto parameters =
        load_parameters<A, Record>(view, only<A>(tail_mask<A>(i, n), load<A>(batch.parameter, i)));
    const BatchView<A> b = load_view<A>(batch, i);
    const BsdfSample<A> s = Material<A>::sample(parameters, b.view, load<A>(batch.u_lobe, i),
                                                load<A>(batch.u, i), load<A>(batch.v, i));
    store<A>(s.wi.x, batch.wi_x, i);
    store<A>(s.wi.y, batch.wi_y, i);
    store<A>(b.turn(s.wi.z), batch.wi_z, i);
    store<A>(s.weight.r, batch.f_r, i);
    store<A>(s.weight.g, batch.f_g, i);
    store<A>(s.weight.b, batch.f_b, i);
    store<A>(s.pdf, batch.pdf, i);
  }
}

}  // namespace yat::YAT_ISA

#pragma once
// What a texture kind is to the kernels. A header of textures/ declares, for NAME:
//
//   NAMEParameters<Of>, kNAMETraits                        everywhere (compile and plan read them)
//   template <class A> struct NAME {                       where YAT_ISA is defined
//     template <uint32_t kForm>
//     static void evaluate(parameters, const TextureRow<A>& row)
//   };
//
// evaluate() reads inputs with row.in(k) or row.colour(k), the surface through row.input, and calls
// row.out(k, value) for every column that it makes. A form is a variant compiled on its own.

#include <string_view>

#include "kernels/texture_step.h"
#include "scene/registry.h"

namespace yat {

struct TextureTraits {
  std::string_view name;
  uint32_t forms = 1;  ///< kForm is below this
};

/// Throws std::logic_error for kCount.
TextureTraits texture_traits(StepKind kind);

}  // namespace yat

#if defined(YAT_ISA)
#include "kernels/material.h"

namespace yat::YAT_ISA {

/// W rows of a chunk, as a step sees them.
template <class A>
struct TextureRow {
  const TextureInput& input;
  const TextureStepView& step;
  uint32_t first;
  Mask<A> present;  ///< rows that there are: others hold anything

  YAT_INLINE Float<A> in(uint32_t k, uint32_t channel = 0) const {
    return load<A>(step.in[k][channel], first);
  }
  YAT_INLINE Spectrum<A> colour(uint32_t k) const { return {in(k, 0), in(k, 1), in(k, 2)}; }
  YAT_INLINE void out(uint32_t k, const Float<A>& value) const {
    store<A>(value, step.out[k], first);
  }
  YAT_INLINE bool wants(uint32_t k) const { return step.out[k] != nullptr; }
  YAT_INLINE void out(const Spectrum<A>& c) const {
    out(0, c.r);
    out(1, c.g);
    out(2, c.b);
  }
  YAT_INLINE Vec3<A> position() const {
    return {load<A>(input.surfaces.pos_x, first), load<A>(input.surfaces.pos_y, first),
            load<A>(input.surfaces.pos_z, first)};
  }
  YAT_INLINE Float<A> width() const { return load<A>(input.derivatives.width, first); }
};

}  // namespace yat::YAT_ISA
#endif

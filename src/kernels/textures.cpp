// Steps of texture programs, and what they leave for shading.

// g++ 12 takes its own AVX-512 headers' undefined registers for mistakes (GCC bug 105593).
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include <utility>

#include "kernels/bump.h"
#include "kernels/derivatives.h"
#include "kernels/groups.h"
#include "kernels/parameter_columns.h"
#include "kernels/textures/all.h"

namespace yat::YAT_ISA {

namespace {

template <class A, template <class> class Texture, template <template <class> class> class Record,
          uint32_t kForm>
void run_form(const TextureInput& input, const TextureStepView& step, uint32_t n) noexcept {
  for (uint32_t i = 0; i < n; i += kLanes<A>) {
    const Mask<A> present = tail_mask<A>(i, n);
    const auto parameters = load_parameters<A, Record>(
        step.constants, only<A>(present, load<A>(input.surfaces.parameter, i)));
    Texture<A>::template evaluate<kForm>(parameters, TextureRow<A>{input, step, i, present});
  }
}

using RunForm = void (*)(const TextureInput&, const TextureStepView&, uint32_t) noexcept;

template <template <class> class Texture, template <template <class> class> class Record,
          uint32_t... kForms>
void run_texture(const TextureInput& input, const TextureStepView& step, uint32_t n) noexcept {
  static constexpr RunForm kRun[] = {&run_form<NativeArch, Texture, Record, kForms>...};
  kRun[(step.variant & 255) % sizeof...(kForms)](input, step, n);
}

template <template <class> class Texture, template <template <class> class> class Record,
          uint32_t... kForms>
constexpr RunForm texture_runner(std::integer_sequence<uint32_t, kForms...>) {
  return &run_texture<Texture, Record, kForms...>;
}

}  // namespace

void fill_textures(KernelTable& table) {
#define YAT_TEXTURE(file, Type)                                                            \
  table.run_texture[uint32_t(StepKind::k##Type)] = texture_runner<Type, Type##Parameters>( \
      std::make_integer_sequence<uint32_t, k##Type##Traits.forms>());
  YAT_TEXTURES(YAT_TEXTURE)
#undef YAT_TEXTURE
  table.spread_parameters = &spread_parameters<NativeArch>;
  table.make_derivatives = &make_derivatives<NativeArch>;
  table.move_surfaces = &move_surfaces<NativeArch>;
  table.bend_normals = &bend_normals<NativeArch>;
  table.map_normals = &map_normals<NativeArch>;
}

}  // namespace yat::YAT_ISA

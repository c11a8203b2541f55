#pragma once
// The kernels of one material, into their slots of the table. For the translation units of the
// families of materials alone: this is where shading is instantiated.

#include "kernels/bsdf_batch.h"
#include "kernels/split.h"
#include "kernels/table.h"
#include "kernels/veil.h"

namespace yat::YAT_ISA {

/// traits: a function without parameters that returns the material's, so that they are constants.
template <template <class> class Material, template <template <class> class> class Record>
void fill_material(KernelTable& table, MaterialKind kind, auto traits) {
  using A = NativeArch;
  constexpr MaterialTraits t = traits();
  const uint32_t k = uint32_t(kind);
  if constexpr (t.splits) {
    table.split[k] = &split<A, Material, Record>;
  } else {
    if constexpr (t.see_through)
      table.shade[k] = &shade_see_through<A>;
    else
      table.shade[k] =
          &shade_scattering<A, Material, Record, t.delta, t.needs_lobe, t.needs_direction, t.veil>;
    if constexpr (!t.see_through && !t.delta) table.connect[k] = &connect<A, Material, Record>;
    table.bsdf_evaluate[k] = &bsdf_evaluate<A, Material, Record>;
    table.bsdf_sample[k] = &bsdf_sample<A, Material, Record>;
  }
  if constexpr (t.see_through || t.veil) table.veil[k] = &veil<A, Material, Record>;
}

/// For the lists of scene/registry.h, in a function that has `table`.
#define YAT_FILL_MATERIAL(file, Type)                                 \
  fill_material<Type, Type##Parameters>(table, MaterialKind::k##Type, \
                                        [] { return k##Type##Traits; });

}  // namespace yat::YAT_ISA

#include "kernels/shade.h"

#include "kernels/bsdf_batch.h"
#include "kernels/groups.h"
#include "kernels/materials/all.h"

namespace yat::YAT_ISA {

namespace {

template <template <class> class Material, template <template <class> class> class Record>
void fill_material(KernelTable& table, MaterialKind kind, auto traits) {
  using A = NativeArch;
  constexpr MaterialTraits t = traits();
  const uint32_t k = uint32_t(kind);
  if constexpr (!t.splits) {
    if constexpr (t.see_through)
      table.shade[k] = &shade_see_through<A>;
    else
      table.shade[k] =
          &shade_scattering<A, Material, Record, t.delta, t.needs_lobe, t.needs_direction>;
    table.bsdf_evaluate[k] = &bsdf_evaluate<A, Material, Record>;
    table.bsdf_sample[k] = &bsdf_sample<A, Material, Record>;
  }
}

}  // namespace

void fill_shade(KernelTable& table) {
#define YAT_MATERIAL(file, Type)                                      \
  fill_material<Type, Type##Parameters>(table, MaterialKind::k##Type, \
                                        [] { return k##Type##Traits; });
  YAT_MATERIALS(YAT_MATERIAL)
#undef YAT_MATERIAL
}

}  // namespace yat::YAT_ISA

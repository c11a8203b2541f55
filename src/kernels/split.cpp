// Built once per instruction set: what only scenes need in which materials are made of others, or
// let a part of the light pass.

#include "kernels/split.h"

#include "kernels/groups.h"
#include "kernels/materials/all.h"
#include "kernels/veil.h"

namespace yat::YAT_ISA {

namespace {

template <template <class> class Material, template <template <class> class> class Record>
void fill_material(KernelTable& table, MaterialKind kind, auto traits) {
  using A = NativeArch;
  constexpr MaterialTraits t = traits();
  if constexpr (t.splits) table.split[uint32_t(kind)] = &split<A, Material, Record>;
  if constexpr (t.see_through || t.veil) table.veil[uint32_t(kind)] = &veil<A, Material, Record>;
}

}  // namespace

void fill_split(KernelTable& table) {
  using A = NativeArch;
#define YAT_MATERIAL(file, Type)                                      \
  fill_material<Type, Type##Parameters>(table, MaterialKind::k##Type, \
                                        [] { return k##Type##Traits; });
  YAT_MATERIALS(YAT_MATERIAL)
#undef YAT_MATERIAL
  table.choose_child = &choose_child<A>;
  table.take_rows = &take_rows<A>;
  table.start_veils = &start_veils<A>;
  table.share_weight = &share_weight<A>;
  table.pass_veils = &pass_veils<A>;
  table.end_veils = &end_veils<A>;
}

}  // namespace yat::YAT_ISA

// Built once per instruction set: what only scenes need in which materials are made of others, or
// let a part of the light pass.

#include "kernels/split.h"

#include "kernels/fill_material.h"
#include "kernels/groups.h"
#include "kernels/materials/coating.h"
#include "kernels/materials/double_side.h"
#include "kernels/materials/mix.h"
#include "kernels/materials/null.h"
#include "kernels/veil.h"

namespace yat::YAT_ISA {

void fill_split(KernelTable& table) {
  using A = NativeArch;
  YAT_COMPOSITE_MATERIALS(YAT_FILL_MATERIAL)
  table.choose_child = &choose_child<A>;
  table.take_rows = &take_rows<A>;
  table.chances = &chances<A, Mix, MixParameters>;
  table.coats = &coats<A, Coating, CoatingParameters>;
  table.take_coats = &take_coats<A>;
  table.weigh_child = &weigh_child<A>;
  table.start_veils = &start_veils<A>;
  table.share_weight = &share_weight<A>;
  table.pass_veils = &pass_veils<A>;
  table.end_veils = &end_veils<A>;
}

}  // namespace yat::YAT_ISA

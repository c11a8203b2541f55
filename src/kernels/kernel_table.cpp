// Built once per instruction set: the table of that set's kernels. Each group of kernels fills its
// own slots (kernels/groups.h), so that a group is one translation unit.

#include "kernels/groups.h"
#include "soa/simd.h"

namespace yat::YAT_ISA {

#define YAT_STRING2(x) #x
#define YAT_STRING(x) YAT_STRING2(x)

const KernelTable* kernel_table() {
  static const KernelTable table = [] {
    KernelTable t{};
    t.isa = YAT_STRING(YAT_ISA);
    t.lanes = kLanes<NativeArch>;
    fill_generate(t);
    fill_surface(t);
    fill_light(t);
    fill_environment(t);
    fill_diffuse_materials(t);
    fill_coated_materials(t);
    fill_layered_materials(t);
    fill_metal_materials(t);
    fill_glass_materials(t);
    fill_light_tree(t);
    fill_varying_emission(t);
    fill_split(t);
    fill_textures(t);
    fill_accumulate(t);
    fill_traverse(t);
    fill_quadrics(t);
    fill_disks(t);
    fill_tori(t);
    fill_shape_tree(t);
    fill_instances(t);
    return t;
  }();
  return &table;
}

}  // namespace yat::YAT_ISA

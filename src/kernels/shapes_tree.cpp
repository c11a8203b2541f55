#include "kernels/groups.h"
#include "kernels/shapes/tree.h"

namespace yat::YAT_ISA {

void fill_shape_tree(KernelTable& table) {
  using A = NativeArch;
  table.shape_scratch_bytes = &shape_scratch_bytes<A>;
  table.intersect_shape_tree = &intersect_shape_tree<A>;
  table.shadow_shape_tree = &shadow_shape_tree<A>;
}

}  // namespace yat::YAT_ISA

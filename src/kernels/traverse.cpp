// Built once per instruction set: intersection kernels.

#include "kernels/traverse_tile.h"

#include "kernels/groups.h"
#include "kernels/quadrics.h"

namespace yat::YAT_ISA {

void fill_traverse(KernelTable& table) {
  using A = NativeArch;
  table.traversal_scratch_bytes = &traversal_scratch_bytes<A>;
  table.intersect_closest = &intersect_closest<A>;
  table.intersect_tiles = &intersect_tiles<A>;
  table.intersect_shadow[0] = &intersect_shadow<A, Query::kAny>;
  table.intersect_shadow[1] = &intersect_shadow<A, Query::kAnyMasked>;
  table.intersect_spheres = &intersect_spheres<A>;
  table.intersect_planes = &intersect_planes<A>;
  table.shadow_spheres = &shadow_spheres<A>;
  table.shadow_planes = &shadow_planes<A>;
}

}  // namespace yat::YAT_ISA

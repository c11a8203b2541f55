// Built once per instruction set: what only scenes with shared objects need.

#include "kernels/classify.h"
#include "kernels/groups.h"
#include "kernels/surface_instance.h"
#include "kernels/tangents.h"
#include "kernels/traverse_instances.h"

namespace yat::YAT_ISA {

void fill_instances(KernelTable& table) {
  using A = NativeArch;
  table.instance_scratch_bytes = &instance_scratch_bytes<A>;
  table.intersect_instances = &intersect_instances<A>;
  table.shadow_instances[0] = &shadow_instances<A, Query::kAny>;
  table.shadow_instances[1] = &shadow_instances<A, Query::kAnyMasked>;
  table.classify_instance_hits = &classify_instance_hits<A>;
  table.make_instance_surfaces[0] = &make_instance_surfaces<A, false>;
  table.make_instance_surfaces[1] = &make_instance_surfaces<A, true>;
  table.make_instance_tangents[0] = &make_instance_tangents<A, false>;
  table.make_instance_tangents[1] = &make_instance_tangents<A, true>;
}

}  // namespace yat::YAT_ISA

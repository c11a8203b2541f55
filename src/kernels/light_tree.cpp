#include "kernels/light_tree.h"

#include "kernels/emission.h"
#include "kernels/environment.h"
#include "kernels/groups.h"
#include "kernels/light_sample.h"

namespace yat::YAT_ISA {

void fill_light_tree(KernelTable& table) {
  using A = NativeArch;
  table.add_tree_emission = &add_emission<A, true>;
  table.add_tree_environment = &add_environment<A, true>;
  table.sample_tree_lights[uint32_t(LightKind::kTriangle)] =
      &sample_tree_lights<A, uint32_t(LightKind::kTriangle)>;
  table.sample_tree_lights[kPlainLights] = &sample_tree_lights<A, kPlainLights>;
  table.sample_tree_lights[kAnyLights] = &sample_tree_lights<A, kAnyLights>;
}

}  // namespace yat::YAT_ISA

#include "kernels/environment.h"

#include "kernels/groups.h"
#include "kernels/light_sample.h"

namespace yat::YAT_ISA {

void fill_environment(KernelTable& table) {
  using A = NativeArch;
  table.sample_lights[kAnyLights] = &sample_lights<A, kAnyLights>;
  table.add_environment = &add_environment<A>;
}

}  // namespace yat::YAT_ISA

#include "kernels/groups.h"
#include "kernels/light_sample.h"

namespace yat::YAT_ISA {

void fill_light(KernelTable& table) {
  using A = NativeArch;
  table.sample_lights[uint32_t(LightKind::kTriangle)] = &sample_lights<A, LightKind::kTriangle>;
  table.sample_lights[uint32_t(LightKind::kSphere)] = &sample_lights<A, LightKind::kSphere>;
  table.sample_lights[uint32_t(LightKind::kPoint)] = &sample_lights<A, LightKind::kPoint>;
  table.sample_lights[uint32_t(LightKind::kDistant)] = &sample_lights<A, LightKind::kDistant>;
  table.sample_lights[uint32_t(LightKind::kCount)] = &sample_lights<A, LightKind::kCount>;
}

}  // namespace yat::YAT_ISA

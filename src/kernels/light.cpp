#include "kernels/groups.h"
#include "kernels/light_sample.h"

namespace yat::YAT_ISA {

void fill_light(KernelTable& table) {
  using A = NativeArch;
  table.sample_lights[uint32_t(LightKind::kTriangle)] =
      &sample_lights<A, uint32_t(LightKind::kTriangle)>;
  table.sample_lights[uint32_t(LightKind::kSphere)] =
      &sample_lights<A, uint32_t(LightKind::kSphere)>;
  table.sample_lights[uint32_t(LightKind::kPoint)] = &sample_lights<A, uint32_t(LightKind::kPoint)>;
  table.sample_lights[uint32_t(LightKind::kDistant)] =
      &sample_lights<A, uint32_t(LightKind::kDistant)>;
  table.sample_lights[uint32_t(LightKind::kRectangle)] =
      &sample_lights<A, uint32_t(LightKind::kRectangle)>;
  table.sample_lights[kPlainLights] = &sample_lights<A, kPlainLights>;
}

}  // namespace yat::YAT_ISA

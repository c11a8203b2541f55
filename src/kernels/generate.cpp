#include "kernels/camera.h"
#include "kernels/draw.h"
#include "kernels/groups.h"

namespace yat::YAT_ISA {

void fill_generate(KernelTable& table) {
  using A = NativeArch;
  table.draw[uint32_t(SamplerKind::kIndependent)] = &draw<A, SamplerKind::kIndependent>;
  table.draw[uint32_t(SamplerKind::kSobol)] = &draw<A, SamplerKind::kSobol>;
  table.generate_camera_rays[0] = &generate_camera_rays<A, false>;
  table.generate_camera_rays[1] = &generate_camera_rays<A, true>;
}

}  // namespace yat::YAT_ISA

#include "kernels/camera.h"
#include "kernels/draw.h"
#include "kernels/groups.h"

namespace yat::YAT_ISA {

namespace {

template <SamplerKind kKind>
void fill_draw(KernelTable& table) {
  table.draw[uint32_t(kKind)] = &draw<NativeArch, kKind>;
}
template <CameraKind kKind>
void fill_camera(KernelTable& table) {
  table.generate_camera_rays[uint32_t(kKind)] = &generate_camera_rays<NativeArch, kKind>;
}

}  // namespace

void fill_generate(KernelTable& table) {
  fill_draw<SamplerKind::kIndependent>(table);
  fill_draw<SamplerKind::kSobol>(table);
  fill_draw<SamplerKind::kRegular>(table);
  fill_draw<SamplerKind::kJittered>(table);
  fill_draw<SamplerKind::kNRooks>(table);
  fill_draw<SamplerKind::kMultiJittered>(table);
  fill_draw<SamplerKind::kCorrelatedMultiJittered>(table);
  fill_draw<SamplerKind::kZSobol>(table);
  fill_camera<CameraKind::kPinhole>(table);
  fill_camera<CameraKind::kThinLens>(table);
  fill_camera<CameraKind::kPolygonLens>(table);
  fill_camera<CameraKind::kOrthographic>(table);
  fill_camera<CameraKind::kEnvironment>(table);
  fill_camera<CameraKind::kFisheye>(table);
}

}  // namespace yat::YAT_ISA

// Built once per instruction set: shading and the BSDF batches. Coats on both sides, and several
// lobes.

#include "kernels/fill_material.h"
#include "kernels/groups.h"
#include "kernels/materials/car_paint.h"
#include "kernels/materials/glossy_translucent.h"

namespace yat::YAT_ISA {

void fill_layered_materials(KernelTable& table) {
  YAT_LAYERED_MATERIALS(YAT_FILL_MATERIAL)
}

}  // namespace yat::YAT_ISA

// Built once per instruction set: shading and the BSDF batches. Coats on a diffuse base.

#include "kernels/fill_material.h"
#include "kernels/groups.h"
#include "kernels/materials/glossy.h"
#include "kernels/materials/glossy_lossy.h"
#include "kernels/materials/glossy_single.h"

namespace yat::YAT_ISA {

void fill_coated_materials(KernelTable& table) {
  YAT_COATED_MATERIALS(YAT_FILL_MATERIAL)
}

}  // namespace yat::YAT_ISA

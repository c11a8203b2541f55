// Built once per instruction set: shading and the BSDF batches. Diffuse materials.

#include "kernels/fill_material.h"
#include "kernels/groups.h"
#include "kernels/materials/matte.h"
#include "kernels/materials/matte_translucent.h"
#include "kernels/materials/oren_nayar.h"
#include "kernels/materials/scatter.h"
#include "kernels/materials/velvet.h"

namespace yat::YAT_ISA {

void fill_diffuse_materials(KernelTable& table) {
  YAT_DIFFUSE_MATERIALS(YAT_FILL_MATERIAL)
}

}  // namespace yat::YAT_ISA

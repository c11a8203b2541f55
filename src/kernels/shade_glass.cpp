// Built once per instruction set: shading and the BSDF batches. Glass and mirrors.

#include "kernels/fill_material.h"
#include "kernels/groups.h"
#include "kernels/materials/absorbing_glass.h"
#include "kernels/materials/architectural_glass.h"
#include "kernels/materials/glass.h"
#include "kernels/materials/glass_film.h"
#include "kernels/materials/mirror.h"
#include "kernels/materials/mirror_film.h"
#include "kernels/materials/rough_glass.h"

namespace yat::YAT_ISA {

void fill_glass_materials(KernelTable& table) {
  YAT_GLASS_MATERIALS(YAT_FILL_MATERIAL)
}

}  // namespace yat::YAT_ISA

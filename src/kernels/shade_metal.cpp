// Built once per instruction set: shading and the BSDF batches. Metals.

#include "kernels/fill_material.h"
#include "kernels/groups.h"
#include "kernels/materials/cook_torrance.h"
#include "kernels/materials/metal.h"
#include "kernels/materials/metal_colour.h"
#include "kernels/materials/metal_index.h"
#include "kernels/materials/shiny_metal.h"

namespace yat::YAT_ISA {

void fill_metal_materials(KernelTable& table) {
  YAT_METAL_MATERIALS(YAT_FILL_MATERIAL)
}

}  // namespace yat::YAT_ISA

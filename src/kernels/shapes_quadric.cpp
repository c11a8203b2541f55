#include "kernels/shapes/fill.h"

namespace yat::YAT_ISA {

void fill_quadrics(KernelTable& table) {
  fill_shape<ShapeKind::kQuadric>(table);
}

}  // namespace yat::YAT_ISA

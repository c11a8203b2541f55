#include "kernels/shapes/fill.h"

namespace yat::YAT_ISA {

void fill_tori(KernelTable& table) {
  fill_shape<ShapeKind::kTorus>(table);
}

}  // namespace yat::YAT_ISA

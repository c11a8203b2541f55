#include "kernels/shapes/fill.h"

namespace yat::YAT_ISA {

void fill_disks(KernelTable& table) {
  fill_shape<ShapeKind::kDisk>(table);
}

}  // namespace yat::YAT_ISA

#include "kernels/accumulate.h"

#include "kernels/groups.h"

namespace yat::YAT_ISA {

void fill_accumulate(KernelTable& table) {
  table.add_unoccluded = &add_unoccluded<NativeArch>;
}

}  // namespace yat::YAT_ISA

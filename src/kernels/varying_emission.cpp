#include "kernels/varying_emission.h"

#include "kernels/groups.h"

namespace yat::YAT_ISA {

void fill_varying_emission(KernelTable& table) {
  using A = NativeArch;
  table.sample_varying_lights[0] = &sample_varying_lights<A, false>;
  table.sample_varying_lights[1] = &sample_varying_lights<A, true>;
  table.make_light_points = &make_light_points<A>;
  table.apply_emission_maps = &apply_emission_maps<A>;
  table.multiply_colours = &multiply_colours<A>;
}

}  // namespace yat::YAT_ISA

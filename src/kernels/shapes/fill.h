#pragma once
// All kernels of one kind of analytic shape, for the source that builds them.

#include "kernels/groups.h"
#include "kernels/shapes/intersect.h"
#include "kernels/shapes/surface.h"
#include "kernels/shapes/tangents.h"

namespace yat::YAT_ISA {

template <ShapeKind kKind>
void fill_shape(KernelTable& table) {
  using A = NativeArch;
  constexpr auto k = uint32_t(kKind);
  table.intersect_shapes[k] = &intersect_shapes<A, kKind>;
  table.shadow_shapes[k] = &shadow_shapes<A, kKind>;
  table.make_surfaces[uint32_t(GeometryKind::kQuadric) + k] = &make_shape_surfaces<A, kKind>;
  table.make_tangents[uint32_t(GeometryKind::kQuadric) + k] = &make_shape_tangents<A, kKind>;
}

}  // namespace yat::YAT_ISA

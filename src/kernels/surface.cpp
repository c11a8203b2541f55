#include "kernels/surface.h"

#include "kernels/classify.h"
#include "kernels/emission.h"
#include "kernels/groups.h"
#include "kernels/tangents.h"

namespace yat::YAT_ISA {

void fill_surface(KernelTable& table) {
  using A = NativeArch;
  table.classify_hits = &classify_hits<A>;
  table.make_surfaces[uint32_t(GeometryKind::kTriangleFlat)] =
      &make_surfaces<A, GeometryKind::kTriangleFlat>;
  table.make_surfaces[uint32_t(GeometryKind::kTriangleVertex)] =
      &make_surfaces<A, GeometryKind::kTriangleVertex>;
  table.make_surfaces[uint32_t(GeometryKind::kSphere)] = &make_surfaces<A, GeometryKind::kSphere>;
  table.make_surfaces[uint32_t(GeometryKind::kPlane)] = &make_surfaces<A, GeometryKind::kPlane>;
  table.make_tangents[uint32_t(GeometryKind::kTriangleFlat)] =
      &make_tangents<A, GeometryKind::kTriangleFlat>;
  table.make_tangents[uint32_t(GeometryKind::kTriangleVertex)] =
      &make_tangents<A, GeometryKind::kTriangleVertex>;
  table.make_tangents[uint32_t(GeometryKind::kSphere)] = &make_tangents<A, GeometryKind::kSphere>;
  table.make_tangents[uint32_t(GeometryKind::kPlane)] = &make_tangents<A, GeometryKind::kPlane>;
  table.add_emission = &add_emission<A>;
}

}  // namespace yat::YAT_ISA

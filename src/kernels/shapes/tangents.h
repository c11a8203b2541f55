#pragma once
// dp/du and dp/dv of analytic shapes.

#include "kernels/shapes/any.h"
#include "kernels/tangents.h"

namespace yat::YAT_ISA {

/// At a point of the surface, scene space. index: row of ShapesView::rows.
template <class A, ShapeKind kKind>
YAT_INLINE Tangents<A> shape_tangents(const ShapesView& shapes, const UInt<A>& index,
                                      const Vec3<A>& pos) {
  const ShapeRowW<A> row = gather<A>(shapes.rows, index);
  const Tangents<A> own =
      ShapeOf<A, kKind>::tangents(row, to_shape(row, pos - shape_origin<A>(row)));
  return {vector_to_scene(row, own.du), vector_to_scene(row, own.dv)};
}

/// See KernelTable::make_tangents.
template <class A, ShapeKind kKind>
void make_shape_tangents(const SceneView& scene, const Surface<ConstColumn>& surfaces,
                         const Tangent<Column>& tangents, uint32_t n) noexcept {
  const UInt<A> first(first_shape(scene.geometry));
  for (uint32_t row = 0; row < n; row += kLanes<A>) {
    const auto normals = SurfaceNormals<A>::load_rows(surfaces, row);
    const UInt<A> index = only<A>(tail_mask<A>(row, n), load<A>(surfaces.prim, row) - first);
    const Vec3<A> along =
        shape_tangents<A, kKind>(scene.geometry.shapes, index, position_of<A>(surfaces, row)).du;
    store_tangent<A>(tangent_across<A>(along, normals.ng, normals.ns), tangents, row);
  }
}

}  // namespace yat::YAT_ISA

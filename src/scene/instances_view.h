#pragma once
// Shared objects and where they are placed (part of scene/compiled.h).

#include <cstdint>

#include "scene/primitive_rows.h"
#include "scene/tree_view.h"
#include "soa/columns.h"
#include "soa/fields.h"

namespace yat {

/// Where an object is placed. The map is x = w * p + org, w and org exactly as stored: p in object
/// space (origin in the middle of the object), x in scene space. What a ray needs comes first and
/// fills one cache line.
template <template <class> class Of>
struct InstanceRow {
  Of<float> o_xx, o_xy, o_xz, o_yx, o_yy, o_yz, o_zx, o_zy, o_zz;  ///< inverse of w, rounded
  Of<float> org_x, org_y, org_z;                                   ///< scene space [m]
  Of<float> radius;             ///< of a sphere about org that holds the instance [m]
  Of<uint32_t> object;          ///< row of InstancesView::trees
  Of<uint32_t> first_triangle;  ///< of its object, row of InstancesView::triangles
  Of<uint32_t> first_shape;     ///< row of InstancesView::shapes of its object's first shape
  Of<float> w_xx, w_xy, w_xz, w_yx, w_yy, w_yz, w_zx, w_zy, w_zz;
  Of<float> extent;                     ///< largest |coordinate| of the instance, scene space [m]
  Of<float> inner_x, inner_y, inner_z;  ///< scale of rounding along each axis of object space
  YAT_FIELDS(o_xx, o_xy, o_xz, o_yx, o_yy, o_yz, o_zx, o_zy, o_zz, org_x, org_y, org_z, radius,
             object, first_triangle, first_shape, w_xx, w_xy, w_xz, w_yx, w_yy, w_yz, w_zx, w_zy,
             w_zz, extent, inner_x, inner_y, inner_z)
};
static_assert(all_fields_listed<InstanceRow>);

/// Places of fields in an InstanceRow, for whom one field is enough.
inline constexpr uint32_t kObjectWord = 13, kFirstTriangleWord = 14, kFirstShapeWord = 15;

/// What one shape of an object is in an instance. `bin` is the first word of a row.
template <template <class> class Of>
struct InstanceShapeRow {
  Of<uint32_t> bin;
  Of<uint32_t> parameter;  ///< row of its material kind's parameter table
  Of<uint32_t> light;      ///< light row of its first emissive triangle, or kNone
  YAT_FIELDS(bin, parameter, light)
};
static_assert(all_fields_listed<InstanceShapeRow>);

/// Objects whose triangles are stored once, and where they are. In `triangles`, `parameter` is the
/// number of the shape in its object, `light` that of the triangle among the emissive ones of its
/// shape, or kNone. Trees name triangles by their number in the object.
struct InstancesView {
  TreeView top;                     ///< leaves hold an instance row each in their low 31 bits
  const TreeView* trees = nullptr;  ///< one per object, object space
  Rows<InstanceRow> rows;
  Rows<InstanceShapeRow> shapes;
  Rows<TriangleRow> triangles;                ///< object space
  Rows<TriangleVertexRow> triangle_vertices;  ///< count = triangles, or 0
  const uint32_t* triangle_shape = nullptr;   ///< TriangleRow::parameter as a column, for sorting
  uint32_t tree_depth = 0;                    ///< of the deepest object's tree
  bool all_occlude = true;
};

}  // namespace yat

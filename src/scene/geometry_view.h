#pragma once
// All that rays can meet, but shared objects (part of scene/compiled.h).
//
// Primitive rows: triangles first, then spheres, planes and the other analytic shapes:
//   [0, triangles)  [triangles, + spheres)  [.., + planes)  [.., + shapes)
// Triangles of shared objects are not among them: a hit there names an instance and a row of
// InstancesView::triangles.

#include <cstdint>

#include "scene/primitive_rows.h"
#include "scene/tree_view.h"
#include "soa/columns.h"

namespace yat {

/// Rows [first, end) of a table.
struct RowRange {
  uint32_t first = 0, end = 0;
};

/// The analytic shapes but whole spheres and planes, or those of them that are veils.
struct ShapesView {
  Rows<ShapeRow> rows;          ///< all of the scene, sorted by kind
  RowRange kinds[kShapeKinds];  ///< rows of each kind
  /// Over these shapes and spheres alike: a leaf holds one in its low 31 bits, a row of
  /// GeometryView::spheres, or the number of all spheres + a row of `rows`. node_count = 0: there
  /// are so few that each is tried.
  TreeView tree;
};

struct GeometryView {
  TreeView tree;
  Rows<TriangleRow> triangles;
  Rows<TriangleVertexRow> triangle_vertices;  ///< count = triangles, or 0 if no mesh has them
  Rows<SphereRow> spheres;
  Rows<PlaneRow> planes;
  ShapesView shapes;
  const uint32_t* prim_bin = nullptr;  ///< per primitive row: its bin (Plan)
  bool all_occlude = true;             ///< no see-through triangle: shadow rays need no mask
};

/// What lets a part of the light pass, again: for shadow rays that nothing else stops.
struct VeilView {
  TreeView tree;  ///< over the triangles; leaves hold rows of GeometryView::triangles
  Rows<SphereRow> spheres;
  Rows<PlaneRow> planes;
  uint32_t first_sphere = 0, first_plane = 0;  ///< primitive rows of the first of each
  ShapesView shapes;
};

}  // namespace yat

#pragma once
// Objects stored once and placed many times: two levels of trees. Owns what an InstancesView shows.

#include <cstdint>
#include <string>
#include <vector>

#include "scene/compiled.h"
#include "scene/tree_build.h"
#include "soa/columns.h"

namespace yat {

/// An object whose triangles and tree are shared by its instances.
struct SharedObject {
  std::string name;
  uint32_t first_triangle = 0, triangles = 0;  ///< rows of Instances::triangles
  uint64_t instances = 0;
  Tree tree;  ///< object space
};

struct Instances {
  std::vector<SharedObject> objects;
  RowTable<InstanceRow> rows;
  RowTable<InstanceShapeRow> shapes;
  RowTable<TriangleRow> triangles;
  RowTable<TriangleVertexRow> triangle_vertices;
  AlignedArray<uint32_t> triangle_shape;
  AlignedArray<TreeView> trees;
  Tree top;
  bool all_occlude = true;
  // If asked for (CompileOptions::ids): SurfaceIds::object per row, ::material per row of shapes.
  std::vector<uint32_t> object_ids, material_ids;

  bool empty() const { return rows.size() == 0; }
  /// Views into this object; valid while it lives.
  InstancesView view() const;
  /// Of the objects: triangles and trees, each once.
  size_t object_bytes() const;
  /// Of what each instance adds: its row, its shapes and its share of the top tree.
  size_t instance_bytes() const;
};

}  // namespace yat

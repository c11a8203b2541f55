#include "scene/instances.h"

#include <algorithm>

namespace yat {

InstancesView Instances::view() const {
  InstancesView view;
  view.top = top.view;
  view.trees = trees.data();
  view.rows = rows.view();
  view.shapes = shapes.view();
  view.triangles = triangles.view();
  view.triangle_vertices = triangle_vertices.view();
  view.triangle_shape = triangle_shape.data();
  for (const SharedObject& object : objects)
    view.tree_depth = std::max(view.tree_depth, object.tree.view.max_depth);
  view.all_occlude = all_occlude;
  return view;
}

size_t Instances::object_bytes() const {
  size_t sum =
      triangles.bytes() + triangle_vertices.bytes() + triangle_shape.bytes() + trees.bytes();
  for (const SharedObject& object : objects) sum += object.tree.bytes();
  return sum;
}

size_t Instances::instance_bytes() const {
  return rows.bytes() + shapes.bytes() + top.bytes();
}

}  // namespace yat

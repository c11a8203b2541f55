#pragma once
// Loop subdivision of triangle meshes.

#include <cstdint>

#include "scene/compile_parts.h"

namespace yat {

/// More triangles than this do not come out of subdivision: about 3 GB of scene.
inline constexpr uint64_t kMaxSubdivided = 1 << 24;

struct SubdivisionOptions {
  int levels = 0;
  bool smooth_normals = true;   ///< of the limit surface; else none, and the mesh is flat
  bool sharp_boundary = false;  ///< open edges stay the polygons that they are
};

/// Subdivides the mesh and moves its vertices to the limit surface (Loop 1987; boundaries become
/// cubic B-splines; masks of limit positions and tangents: Hoppe et al. 1994, "Piecewise smooth
/// surface reconstruction"). Vertices at one place are one vertex; texture coordinates go linearly,
/// and their seams stay. An edge of more than two triangles, or of two that run along it in the
/// same direction, is a boundary; a vertex where other than two boundaries meet stays where it is.
///
/// levels > 0, and mesh.triangles() << 2 levels at most kMaxSubdivided.
void subdivide(Mesh& mesh, const SubdivisionOptions& options);

}  // namespace yat

#pragma once
// Scenes and recorded rays for the traversal benchmarks.

#include <cstdint>
#include <string>
#include <vector>

#include "kernels/table.h"
#include "scene/tree_build.h"

namespace yat::bench {

struct BenchScene {
  std::string name;
  std::vector<float> corners;  ///< 9 floats per triangle
  RowTable<TriangleRow> rows;
  float eye[3], target[3], light[4][3];  ///< light: corner, edge, edge, unused
  uint32_t triangles() const { return uint32_t(corners.size() / 9); }
};

/// The Cornell box (Goral et al. 1984, measurements of the Cornell program of computer graphics):
/// room, two blocks, lamp: 32 triangles.
BenchScene cornell_box();
/// A displaced sphere of about `triangles` triangles in a closed room.
BenchScene rough_sphere(uint32_t triangles);
/// The mesh of a binary little-endian PLY file in a closed room. Throws std::runtime_error.
BenchScene mesh_in_room(const std::string& file);

/// Rays of one kind. Closest-hit rays have a unit direction; shadow rays are segments, t in (0, 1).
struct RaySet {
  std::string name;
  bool shadow = false;
  std::vector<Ray<Value>> rays;
};

/// Camera rays in 8x8 tiles, then for two bounces the shadow rays to the lamp and the next diffuse
/// rays in wavefront order.
std::vector<RaySet> record_rays(const BenchScene& scene, const KernelTable& kernels,
                                const TreeView& tree, uint32_t width, uint32_t height);

}  // namespace yat::bench

#pragma once
// Triangles for the build and traversal benchmarks: generated, or meshes from files.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "scene/compiled.h"
#include "soa/columns.h"

namespace yat::bench {

/// Where the rays of a scene start and which lamp its shadow rays go to.
struct Viewpoint {
  glm::dvec3 eye{0.0}, target{0.0};                ///< world space [m]; up is +y
  glm::dvec3 lamp{0.0}, lamp_x{0.0}, lamp_y{0.0};  ///< a corner and the two edges from it [m]
};

struct BenchScene {
  std::string name;
  std::vector<float> corners;  ///< 9 floats per triangle
  RowTable<TriangleRow> rows;  ///< the same as the tree build reads them
  Viewpoint view;
  uint32_t triangles() const { return uint32_t(corners.size() / 9); }
};

/// The Cornell box (Goral et al. 1984, measurements of the Cornell program of computer graphics):
/// room, two blocks, lamp: 32 triangles.
BenchScene cornell_box();

/// A displaced sphere of about `triangles` triangles in a closed room.
BenchScene rough_sphere(uint32_t triangles);

/// A closed hall of about `triangles` triangles (at least 5000): fluted columns, heads on
/// pedestals, an uneven floor, and walls, ceiling and beams of two triangles a side. The view goes
/// down its length; most triangles of a large one are smaller than a pixel.
BenchScene columns_hall(uint32_t triangles);

/// The mesh of a PLY file in a closed room three times its size. Throws PlyError.
BenchScene mesh_in_room(const std::string& file);

/// The mesh of a PLY file as it is (+y is up), seen from its middle along the longer horizontal
/// axis, with a lamp a tenth as large above the middle. Throws PlyError.
BenchScene mesh_as_it_is(const std::string& file);

/// A generated scene by name: "cornell", "sphere" or "hall", the latter two with an optional count
/// of triangles after a colon ("hall:1500000"). Throws UsageError.
BenchScene generated_scene(const std::string& name);

/// A scene of these triangles, 9 floats each.
BenchScene scene_of(std::string name, std::vector<float> corners);

}  // namespace yat::bench

#pragma once
// Reads PLY meshes (Turk 1994: ascii 1.0, binary_little_endian 1.0, binary_big_endian 1.0) into
// plain vectors.
//
// Nothing in the file is trusted: element counts are held against the file's size before memory is
// taken, list lengths against what is left of it, indices against the number of vertices.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace yat {

/// A PLY file that cannot be used. what(): "mesh.ply: reason", without the place in the scene file,
/// which the caller knows.
class PlyError : public Error {
 public:
  using Error::Error;
};

/// Triangles of one file, in object space as written.
///
/// Normals rule (LuxRender's `plymesh`): a mesh from a PLY file is never flat. When `normals` is
/// empty, or the shape says `smooth`, the compiler computes vertex normals as the normalised
/// unweighted mean of the unit normals of the adjacent faces.
struct PlyMesh {
  std::vector<float> positions;       ///< 3 per vertex; may hold NaN or infinity if the file does
  std::vector<float> normals;         ///< 3 per vertex as written (any length), or empty
  std::vector<float> uvs;             ///< 2 per vertex, or empty
  std::vector<uint32_t> triangles;    ///< 3 per triangle, each < vertices()
  uint64_t faces = 0;                 ///< faces of the file
  uint64_t quads = 0;                 ///< of these, split along the shorter diagonal
  uint64_t polygons = 0;              ///< of these with 5 or more corners, split into fans
  uint64_t skipped = 0;               ///< of these with fewer than 3 corners, left out
  bool colours = false;               ///< the file has colours of vertices, which are not read
  std::vector<std::string> warnings;  ///< what to tell the user, each "mesh.ply: what"

  uint32_t vertices() const { return uint32_t(positions.size() / 3); }
};

/// Reads a file. Throws PlyError (missing, unreadable, malformed, truncated, index out of range).
///
/// vertex  `x y z` of any scalar type; `nx ny nz` if all three are there; texture coordinates from
///         the first complete pair of `s t`, `u v`, `texture_u texture_v`, `u0 v0`.
/// face    a list `vertex_indices` or `vertex_index`, of any integer types.
/// Everything else in the file is skipped.
PlyMesh read_ply(const std::string& path);

/// The same from memory; `name` is shown in messages.
PlyMesh parse_ply(std::string_view data, std::string_view name);

}  // namespace yat

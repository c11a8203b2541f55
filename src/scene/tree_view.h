#pragma once
// A tree over primitives as kernels read it (part of scene/compiled.h).

#include <cstdint>

namespace yat {

/// Up to eight boxes and what is in them. 256 bytes, aligned to 64.
/// child[i]: bit 31 set = leaf: low 31 bits are (first block << 5 | blocks - 1), at most 32 blocks;
/// bit 31 clear = node row; kNone = no child (its box is empty: min > max, so that no ray enters).
struct alignas(64) TreeNode {
  float min_x[8], min_y[8], min_z[8], max_x[8], max_y[8], max_z[8];  ///< rounded outwards [m]
  uint32_t child[8];
  uint8_t order[8]
               [3];  ///< per direction octant (bit 0: x < 0, 1: y < 0, 2: z < 0): eight 3-bit child
                     ///< indices, nearest first, child k in bits 3k..3k+2 of the little-endian 24
  uint8_t unused[8];
};
static_assert(sizeof(TreeNode) == 256);

/// Rays whose origin has a coordinate beyond this many extents (the largest |coordinate| of the
/// tree's bounds) start again nearer; those from within are traced as they are, and the boxes of
/// the tree are padded for their rounding errors. Cameras that look at a whole scene are within.
inline constexpr float kFarExtents = 7;

/// The tree over all triangles. Blocks hold `block_width` triangles as columns of block_width
/// floats: x0 y0 z0 x1 y1 z1 x2 y2 z2, then the primitive rows (uint32, kNone and NaN vertices in
/// unused places). Node 0 is the root; node_count = 0 means there are no triangles.
struct TreeView {
  const TreeNode* nodes = nullptr;
  const float* blocks = nullptr;              ///< block b starts at b * block_width * 10
  const uint32_t* block_occluders = nullptr;  ///< bit k of word b: triangle k stops shadow rays
  uint32_t node_count = 0;
  uint32_t block_count = 0;
  uint32_t block_width = 16;  ///< 4, 8 or 16
  uint32_t max_depth = 0;     ///< nodes on the longest way from the root to a leaf
  float min[3] = {0, 0, 0}, max[3] = {0, 0, 0};  ///< bounds of all triangles
};

}  // namespace yat

#pragma once
// The acceleration structure over triangles: SAH build and collapse to the 8-wide boxed tree.

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "base/parallel.h"
#include "scene/compiled.h"
#include "soa/columns.h"

namespace yat {

/// From this overlap of siblings in a tree of objects on, planes are tried.
inline constexpr double kMuchOverlap = 6;

/// How a tree is split.
enum class TreeShape {
  kKd,                ///< by planes only; triangles that a plane cuts are on both sides
  kObjects,           ///< by partitions of the triangles only
  kObjectsAndPlanes,  ///< by planes where partitions would overlap too much
};

struct TreeOptions {
  uint32_t block_width = 16;         ///< triangles per leaf block: 4, 8 or 16
  bool strict_kd_tree = false;       ///< kKd (--tree kd)
  std::optional<TreeShape> shape{};  ///< this one; without: the better for these triangles
};

struct TreeStatistics {
  TreeShape shape = TreeShape::kObjects;
  uint64_t triangles = 0;   ///< in the input, degenerate ones included
  uint64_t references = 0;  ///< in leaves, duplicates counted
  uint64_t nodes = 0, leaves = 0, blocks = 0;
  uint32_t max_depth = 0;  ///< 8-wide nodes on the longest way down
  double sah_cost = 0;     ///< expected cost of a random ray through the bounds, in the
                           ///< prices of tree_parts.h
  /// Of sibling boxes in the tree of objects, in areas of the bounds; 0 if none was built.
  double overlap = 0;
  /// Of a ray in lists of its own, for both shapes where both were built, else 0.
  double objects_cost = 0, planes_cost = 0;
  double block_fill = 0;  ///< references / (blocks * block_width)
  double build_seconds = 0;
};

/// Owns what a TreeView shows.
struct Tree {
  AlignedArray<TreeNode> nodes;
  AlignedArray<float> blocks;
  AlignedArray<uint32_t> block_occluders;
  TreeStatistics statistics;
  TreeView view;  ///< pointers into the arrays above (they do not move with the struct)
  size_t bytes() const { return nodes.bytes() + blocks.bytes() + block_occluders.bytes(); }
};

/// Builds the tree. Triangles with a NaN or infinite vertex, or without area, are in no leaf.
/// occludes: one bit-per-triangle answer as bytes (1 stops shadow rays), or empty: all do.
/// The bytes of the tree are the same for any number of threads. Ends on any input.
Tree build_tree(const Rows<TriangleRow>& triangles, std::span<const uint8_t> occludes,
                const TreeOptions& options, ThreadPool& pool);

/// Checks the finished tree against its triangles: every box holds what is below it, every triangle
/// of area is in a leaf that it overlaps, children are in range, no cycle. Empty if all is well,
/// else what is wrong.
std::string verify_tree(const Tree& tree, const Rows<TriangleRow>& triangles);

}  // namespace yat

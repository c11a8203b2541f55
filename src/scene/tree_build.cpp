// The tree build as callers see it: which way to split, and the steps in turn.

#include "scene/tree_build.h"

#include <chrono>

#include "scene/tree_parts.h"

namespace yat {
namespace {

using namespace tree;

/// How much cheaper the tree with planes must be.
constexpr double kPlaneGain = 0.95;

/// A tree of objects; where it overlaps much, one with planes as well, and the cheaper of both.
std::unique_ptr<BinaryTree> best_tree(const Rows<TriangleRow>& triangles,
                                      const TreeOptions& options, uint32_t workers,
                                      TreeStatistics& statistics) {
  const auto build = [&](TreeShape shape) {
    auto out = std::make_unique<BinaryTree>(workers);
    out->prices.block_width = options.block_width;
    build_binary(triangles, shape, *out);
    // A strict kd-tree keeps its order: nothing but planes.
    if (shape != TreeShape::kKd && out->root.count) mend_top(*out);
    return out;
  };
  std::optional<TreeShape> wanted = options.shape;
  if (options.strict_kd_tree) wanted = TreeShape::kKd;
  statistics.shape = wanted.value_or(TreeShape::kObjects);
  std::unique_ptr<BinaryTree> best = build(statistics.shape);
  if (wanted || best->root.count == 0) return best;
  const TreeQuality quality = quality_of(*best);
  statistics.overlap = quality.overlap;
  if (quality.overlap < kMuchOverlap) return best;
  best->storage->drop_references();
  std::unique_ptr<BinaryTree> other = build(TreeShape::kObjectsAndPlanes);
  statistics.objects_cost = quality.cost;
  statistics.planes_cost = quality_of(*other).cost;
  if (!(statistics.planes_cost < kPlaneGain * quality.cost)) return best;
  statistics.shape = TreeShape::kObjectsAndPlanes;
  return other;
}

}  // namespace

Tree build_tree(const Rows<TriangleRow>& triangles, std::span<const uint8_t> occludes,
                const TreeOptions& options, ThreadPool& pool) {
  const auto start = std::chrono::steady_clock::now();
  Tree out;
  out.statistics.triangles = triangles.count;
  out.view.block_width = options.block_width;
  pool.run([&] {
    const auto best = best_tree(triangles, options, pool.threads(), out.statistics);
    if (best->root.count == 0) return;
    if (out.statistics.shape != TreeShape::kKd) part_large_leaves(triangles, *best);
    // Leaves have their rows: the references can go before the tree comes.
    best->storage->drop_references();
    for (const auto& storage : best->more) storage->drop_references();
    collapse(*best, triangles, occludes, out);
  });
  out.statistics.build_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return out;
}

}  // namespace yat

// The binary tree: kd splits on top, object splits below, leaves where the SAH says so.
//
// Planes keep large triangles from dragging boxes over each other, at the price of duplicates;
// below kObjectSplits references the duplicates cost more than the overlap. Every node is the root
// of a set that depends on nothing but its references, so threads cannot change the tree.

#include "scene/tree_build.h"

#include <algorithm>
#include <chrono>

#include "scene/tree_parts.h"

namespace yat {
namespace tree {
namespace {

constexpr size_t kParallel = 4096;  // References below which a subtree is one task.

struct Builder {
  const Rows<TriangleRow>& triangles;
  TreeOptions options;
  Prices prices;

  static Box box_of(std::span<const Reference> references) {
    Box box;
    for (const Reference& r : references) box.add(r.box);
    return box;
  }

  size_t leaf_limit() const { return size_t(kMaxBlocks) * options.block_width; }

  std::unique_ptr<BinaryNode> make_leaf(std::span<const Reference> references,
                                        const Box& box) const {
    auto node = std::make_unique<BinaryNode>();
    node->box = box;
    node->prims.reserve(references.size());
    for (const Reference& r : references) node->prims.push_back(r.prim);
    std::sort(node->prims.begin(), node->prims.end());
    node->prims.erase(std::unique(node->prims.begin(), node->prims.end()), node->prims.end());
    return node;
  }

  template <class F, class G>
  static void both(size_t references, F&& f, G&& g) {
    if (references > kParallel) {
      parallel_invoke(f, g);
    } else {
      f();
      g();
    }
  }

  std::unique_ptr<BinaryNode> build(std::vector<Reference> references, uint32_t depth) const {
    if (depth >= kMaxPricedDepth) return build_objects(references, depth);
    if (!options.strict_kd_tree && references.size() <= kObjectSplits)
      return build_objects(references, depth);
    const Box box = box_of(references);
    const PlaneSplit split = find_plane(references, box, prices);
    const double leaf = prices.leaf(references.size(), box.area());
    if (references.size() <= leaf_limit() && !(split.cost < leaf))
      return make_leaf(references, box);
    std::vector<Reference> left, right;
    if (split.cost < HUGE_VAL) {
      left.reserve(references.size());
      right.reserve(references.size());
      split_by_plane(triangles, references, split, left, right);
    }
    // A plane that cuts nearly everything makes no headway; neither does none.
    const size_t n = references.size();
    if (left.empty() || right.empty() || std::max(left.size(), right.size()) * 20 > n * 19 ||
        left.size() + right.size() > n + n / 2) {
      return n <= leaf_limit() && options.strict_kd_tree ? make_leaf(references, box)
                                                         : build_objects(references, depth);
    }
    references = {};
    auto node = std::make_unique<BinaryNode>();
    node->box = box;
    node->axis = split.axis;
    both(
        n, [&] { node->child[0] = build(std::move(left), depth + 1); },
        [&] { node->child[1] = build(std::move(right), depth + 1); });
    return node;
  }

  std::unique_ptr<BinaryNode> build_objects(std::span<Reference> references, uint32_t depth) const {
    const size_t n = references.size();
    const Box box = box_of(references);
    if (n == 1) return make_leaf(references, box);
    ObjectSplit split;
    if (depth < kMaxPricedDepth) split = find_object_split(references, box, prices);
    if (n <= leaf_limit() && !(split.cost < prices.leaf(n, box.area())))
      return make_leaf(references, box);
    if (split.left == 0 || split.left == n) split.left = n / 2;
    auto node = std::make_unique<BinaryNode>();
    node->box = box;
    node->axis = split.axis;
    both(
        n, [&] { node->child[0] = build_objects(references.first(split.left), depth + 1); },
        [&] { node->child[1] = build_objects(references.subspan(split.left), depth + 1); });
    return node;
  }
};

/// The triangles that can be hit: finite and with area.
std::vector<Reference> make_references(const Rows<TriangleRow>& triangles) {
  std::vector<Reference> references;
  references.reserve(triangles.count);
  for (uint32_t prim = 0; prim < triangles.count; ++prim) {
    const Corners c = corners_of(triangles, prim);
    Reference r{{}, prim};
    bool finite = true;
    double e1[3], e2[3];
    for (int a = 0; a < 3; ++a) {
      for (int v = 0; v < 3; ++v) {
        finite = finite && std::isfinite(c.p[v][a]);
        r.box.min[a] = std::min(r.box.min[a], float(c.p[v][a]));
        r.box.max[a] = std::max(r.box.max[a], float(c.p[v][a]));
      }
      e1[a] = c.p[1][a] - c.p[0][a];
      e2[a] = c.p[2][a] - c.p[0][a];
    }
    const bool area = e1[1] * e2[2] != e1[2] * e2[1] || e1[2] * e2[0] != e1[0] * e2[2] ||
                      e1[0] * e2[1] != e1[1] * e2[0];
    if (finite && area) references.push_back(r);
  }
  return references;
}

}  // namespace
}  // namespace tree

Tree build_tree(const Rows<TriangleRow>& triangles, std::span<const uint8_t> occludes,
                const TreeOptions& options, ThreadPool& pool) {
  const auto start = std::chrono::steady_clock::now();
  Tree out;
  std::vector<tree::Reference> references = tree::make_references(triangles);
  std::unique_ptr<tree::BinaryNode> root;
  if (!references.empty()) {
    const tree::Prices prices{double(options.block_width),
                              tree::Builder::box_of(references).area()};
    const tree::Builder builder{triangles, options, prices};
    pool.run([&] { root = builder.build(std::move(references), 0); });
  }
  tree::collapse(root.get(), triangles, occludes, options, out);
  out.statistics.build_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return out;
}

}  // namespace yat

// Checks a finished tree against its triangles, trusting nothing that the build believes.

#include <fmt/format.h>

#include <cstring>

#include "scene/tree_parts.h"

namespace yat {
namespace {

using tree::Corners;

constexpr uint32_t kPoints = 16;

/// Points of a triangle: corners, edge points, inner points.
void point_of(const Corners& c, uint32_t i, double (&p)[3]) {
  constexpr double weight[kPoints][2] = {
      {0, 0},   {1, 0},   {0, 1},   {.5, 0},    {0, .5},    {.5, .5}, {1 / 3., 1 / 3.}, {.25, 0},
      {.75, 0}, {0, .25}, {0, .75}, {.25, .75}, {.75, .25}, {.1, .1}, {.8, .1},         {.1, .8}};
  for (int a = 0; a < 3; ++a)
    p[a] =
        c.p[0][a] + weight[i][0] * (c.p[1][a] - c.p[0][a]) + weight[i][1] * (c.p[2][a] - c.p[0][a]);
}

struct Verify {
  const Tree& tree;
  const Rows<TriangleRow>& triangles;
  std::vector<uint8_t> visited;
  std::vector<uint8_t> block_used;
  std::vector<uint32_t> covered;  // Per triangle, a bit per point found in a leaf's box.
  uint64_t references = 0;
  std::string wrong;

  bool fail(std::string what) {
    if (wrong.empty()) wrong = std::move(what);
    return false;
  }

  bool node(uint32_t row, const double (&low)[3], const double (&high)[3], uint32_t depth) {
    if (row >= tree.view.node_count) return fail(fmt::format("node {} is out of range", row));
    if (visited[row]++) return fail(fmt::format("node {} has two parents", row));
    if (depth > tree.view.max_depth) return fail(fmt::format("node {} is below max_depth", row));
    const TreeNode& n = tree.view.nodes[row];
    const float* planes[6] = {n.min_x, n.min_y, n.min_z, n.max_x, n.max_y, n.max_z};
    for (uint32_t octant = 0; octant < 8; ++octant) {
      uint32_t bits = 0, seen = 0;
      for (uint32_t byte = 0; byte < 3; ++byte)
        bits |= uint32_t(n.order[octant][byte]) << (8 * byte);
      for (uint32_t k = 0; k < 8; ++k) seen |= 1u << (bits >> (3 * k) & 7);
      if (seen != 255) return fail(fmt::format("node {}: order misses a child", row));
    }
    bool ended = false;
    for (uint32_t i = 0; i < 8; ++i) {
      if (n.child[i] == kNone) {
        ended = true;
        if (!(planes[0][i] > planes[3][i]))
          return fail(fmt::format("node {}: child {} is absent but has a box", row, i));
        continue;
      }
      if (ended) return fail(fmt::format("node {}: a gap before child {}", row, i));
      double child_low[3], child_high[3];
      for (int a = 0; a < 3; ++a) {
        child_low[a] = double(planes[a][i]);
        child_high[a] = double(planes[3 + a][i]);
        if (!(child_low[a] <= child_high[a]) || child_low[a] < low[a] || child_high[a] > high[a])
          return fail(fmt::format("node {}: box of child {} leaves its parent's", row, i));
      }
      const bool ok = n.child[i] & 0x80000000u ? leaf(n.child[i], child_low, child_high)
                                               : node(n.child[i], child_low, child_high, depth + 1);
      if (!ok) return false;
    }
    return true;
  }

  bool leaf(uint32_t code, const double (&low)[3], const double (&high)[3]) {
    const uint32_t first = (code & 0x7fffffffu) >> 5, count = (code & 31) + 1;
    const uint32_t width = tree.view.block_width;
    for (uint32_t b = first; b < first + count; ++b) {
      if (b >= tree.view.block_count) return fail(fmt::format("block {} is out of range", b));
      if (block_used[b]++) return fail(fmt::format("block {} is in two leaves", b));
      const float* block = tree.view.blocks + size_t(b) * width * 10;
      bool ended = false;
      for (uint32_t k = 0; k < width; ++k) {
        uint32_t prim;
        std::memcpy(&prim, block + 9 * width + k, 4);
        if (prim == kNone) {
          ended = true;
          for (uint32_t c = 0; c < 9; ++c)
            if (!std::isnan(block[c * width + k]))
              return fail(fmt::format("block {}: unused place {} holds a vertex", b, k));
          continue;
        }
        if (ended || prim >= triangles.count)
          return fail(fmt::format("block {}: bad primitive in place {}", b, k));
        ++references;
        const Corners c = tree::corners_of(triangles, prim);
        for (int axis = 0; axis < 3; ++axis) {
          double least = HUGE_VAL, most = -HUGE_VAL;
          for (int v = 0; v < 3; ++v) {
            if (double(block[uint32_t(3 * v + axis) * width + k]) != c.p[v][axis])
              return fail(fmt::format("block {}: triangle {} has other vertices", b, prim));
            least = std::min(least, c.p[v][axis]);
            most = std::max(most, c.p[v][axis]);
          }
          if (least > high[axis] || most < low[axis])
            return fail(fmt::format("triangle {} does not overlap its leaf", prim));
        }
        for (uint32_t i = 0; i < kPoints; ++i) {
          double p[3];
          point_of(c, i, p);
          bool inside = true;
          for (int a = 0; a < 3; ++a) inside = inside && p[a] >= low[a] && p[a] <= high[a];
          if (inside) covered[prim] |= 1u << i;
        }
      }
    }
    return true;
  }
};

}  // namespace

std::string verify_tree(const Tree& tree, const Rows<TriangleRow>& triangles) {
  Verify work{tree,
              triangles,
              std::vector<uint8_t>(tree.view.node_count),
              std::vector<uint8_t>(tree.view.block_count),
              std::vector<uint32_t>(triangles.count),
              0,
              {}};
  const double low[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, high[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  if (tree.view.node_count && !work.node(0, low, high, 1)) return work.wrong;
  for (uint32_t row = 0; row < tree.view.node_count; ++row)
    if (!work.visited[row]) return fmt::format("node {} hangs nowhere", row);
  for (uint32_t b = 0; b < tree.view.block_count; ++b)
    if (!work.block_used[b]) return fmt::format("block {} is in no leaf", b);
  if (work.references != tree.statistics.references)
    return fmt::format("{} references found, {} counted", work.references,
                       tree.statistics.references);
  for (uint32_t prim = 0; prim < triangles.count; ++prim) {
    const Corners c = tree::corners_of(triangles, prim);
    double cross = 0;
    bool finite = true;
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3;
      const double u = (c.p[1][a] - c.p[0][a]) * (c.p[2][b] - c.p[0][b]);
      const double v = (c.p[1][b] - c.p[0][b]) * (c.p[2][a] - c.p[0][a]);
      cross = std::max(cross, u != v ? 1.0 : 0.0);
      for (int k = 0; k < 3; ++k) finite = finite && std::isfinite(c.p[k][a]);
    }
    const bool wanted = finite && cross > 0;
    if (wanted && work.covered[prim] != (1u << kPoints) - 1)
      return fmt::format("triangle {} is not covered by its leaves (points {:x})", prim,
                         work.covered[prim]);
    if (!wanted && work.covered[prim])
      return fmt::format("triangle {} has no area but is in a leaf", prim);
  }
  return {};
}

}  // namespace yat

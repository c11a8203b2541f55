// Built without vectorisation (common.cmake), as plain code that knows no SIMD words is.

#include "scalar_trace.h"

#include <cmath>
#include <utility>

namespace yat::bench {
namespace {

constexpr uint32_t kLeafBit = 0x80000000u;

struct ToDo {
  uint32_t child;
  float enter;
};

/// A ray as boxes and triangles are tested against it.
struct ScalarRay {
  float org[3], dir[3], inverse[3];
  float t_max;
  uint32_t kx, ky, kz, octant = 0;  ///< kz: the axis along which the ray moves most
  float shear_x, shear_y, shear_z;

  ScalarRay(const float (&o)[3], const float (&d)[3], float far) : t_max(far) {
    for (uint32_t a = 0; a < 3; ++a) {
      org[a] = o[a];
      dir[a] = d[a];
      // No 0 x infinity: a zero component moves the ray by nothing that a float can see.
      const float tiny = d[a] < 0 ? -1e-18f : 1e-18f;
      inverse[a] = 1.f / (std::abs(d[a]) < 1e-18f ? tiny : d[a]);
      octant |= uint32_t(d[a] < 0) << a;
    }
    kz = std::abs(d[0]) >= std::abs(d[1]) ? 0 : 1;
    if (std::abs(d[2]) > std::abs(d[kz])) kz = 2;
    kx = (kz + 1) % 3;
    ky = (kz + 2) % 3;
    shear_z = 1.f / dir[kz];
    shear_x = dir[kx] * shear_z;
    shear_y = dir[ky] * shear_z;
  }
};

struct Found {
  float t, u = 0, v = 0;
  uint32_t prim = kNone;
};

/// Watertight test (Woop, Benthin, Wald 2013, without its fallback: zero counts as inside).
bool test_triangle(const ScalarRay& ray, const float* corner, uint32_t stride, uint32_t prim,
                   Found& found) {
  float x[3], y[3], z[3];
  for (uint32_t k = 0; k < 3; ++k) {
    const float* const p = corner + 3 * k * stride;
    z[k] = p[ray.kz * stride] - ray.org[ray.kz];
    x[k] = (p[ray.kx * stride] - ray.org[ray.kx]) - ray.shear_x * z[k];
    y[k] = (p[ray.ky * stride] - ray.org[ray.ky]) - ray.shear_y * z[k];
  }
  const float e0 = x[2] * y[1] - y[2] * x[1];
  const float e1 = x[0] * y[2] - y[0] * x[2];
  const float e2 = x[1] * y[0] - y[1] * x[0];
  if ((e0 < 0 || e1 < 0 || e2 < 0) && (e0 > 0 || e1 > 0 || e2 > 0)) return false;
  const float det = e0 + e1 + e2;
  if (det == 0) return false;
  const float t = (e0 * z[0] + e1 * z[1] + e2 * z[2]) / det * ray.shear_z;
  if (!(t > 0 && (t < found.t || (t == found.t && prim < found.prim)))) return false;
  found = {t, e1 / det, e2 / det, prim};
  return true;
}

bool enters(const ScalarRay& ray, const TreeNode& node, uint32_t child, float t_max, float& enter) {
  const float* const low[3] = {node.min_x, node.min_y, node.min_z};
  const float* const high[3] = {node.max_x, node.max_y, node.max_z};
  float from = 0, to = t_max;
  for (uint32_t a = 0; a < 3; ++a) {
    float t0 = (low[a][child] - ray.org[a]) * ray.inverse[a];
    float t1 = (high[a][child] - ray.org[a]) * ray.inverse[a];
    if (ray.octant >> a & 1) std::swap(t0, t1);
    from = t0 > from ? t0 : from;
    to = t1 < to ? t1 : to;
  }
  enter = from;
  return from <= to;
}

/// Depth first, the nearer child first. any: the first hit will do.
template <bool any>
void trace(const TreeView& tree, const ScalarRay& ray, ToDo* const stack, Found& found) {
  if (!tree.node_count) return;
  uint32_t height = 0;
  stack[height++] = {0, 0};
  while (height) {
    const ToDo next = stack[--height];
    if (next.enter > found.t) continue;
    if (next.child & kLeafBit) {
      const uint32_t first = (next.child & ~kLeafBit) >> 5, blocks = (next.child & 31) + 1;
      const uint32_t width = tree.block_width;
      for (uint32_t b = 0; b < blocks; ++b) {
        const float* const block = tree.blocks + size_t(first + b) * width * 10;
        const auto* const prims = reinterpret_cast<const uint32_t*>(block + 9 * width);
        for (uint32_t k = 0; k < width && prims[k] != kNone; ++k)
          if (test_triangle(ray, block + k, width, prims[k], found) && any) return;
      }
      continue;
    }
    const TreeNode& node = tree.nodes[next.child];
    const uint8_t* const bytes = node.order[ray.octant];
    const uint32_t order = uint32_t(bytes[0]) | uint32_t(bytes[1]) << 8 | uint32_t(bytes[2]) << 16;
    for (uint32_t i = 8; i-- > 0;) {
      const uint32_t child = order >> 3 * i & 7;
      float enter;
      if (node.child[child] != kNone && enters(ray, node, child, found.t, enter))
        stack[height++] = {node.child[child], enter};
    }
  }
}

bool usable(const float (&org)[3], const float (&dir)[3], float t_max) {
  bool finite = t_max > 0;
  for (int a = 0; a < 3; ++a) finite = finite && std::isfinite(org[a]) && std::isfinite(dir[a]);
  return finite && (dir[0] != 0 || dir[1] != 0 || dir[2] != 0);
}

}  // namespace

size_t scalar_scratch_bytes(const TreeView& tree, uint32_t) noexcept {
  return (size_t(tree.max_depth) * 8 + 8) * sizeof(ToDo);
}

LaneCount scalar_closest(const TreeView& tree, const Ray<ConstColumn>& rays,
                         const Hit<Column>& hits, uint32_t n, const Scratch& scratch) noexcept {
  auto* const stack = reinterpret_cast<ToDo*>(scratch.memory);
  for (uint32_t i = 0; i < n; ++i) {
    const float org[3] = {rays.org_x[i], rays.org_y[i], rays.org_z[i]};
    const float dir[3] = {rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]};
    Found found{rays.t_max[i]};
    if (usable(org, dir, rays.t_max[i]))
      trace<false>(tree, ScalarRay(org, dir, rays.t_max[i]), stack, found);
    hits.t[i] = found.t;
    hits.u[i] = found.u;
    hits.v[i] = found.v;
    hits.prim[i] = found.prim;
  }
  return {};
}

LaneCount scalar_shadow(const TreeView& tree, const ShadowRay<ConstColumn>& rays,
                        uint32_t* occluded, uint32_t n, const Scratch& scratch) noexcept {
  auto* const stack = reinterpret_cast<ToDo*>(scratch.memory);
  for (uint32_t i = 0; i < n; ++i) {
    const float org[3] = {rays.org_x[i], rays.org_y[i], rays.org_z[i]};
    const float dir[3] = {rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]};
    // Below 1: a hit at the end does not count.
    Found found{1};
    found.prim = 0;
    bool stopped = false;
    if (usable(org, dir, 1)) {
      trace<true>(tree, ScalarRay(org, dir, 1), stack, found);
      stopped = found.t < 1;
    }
    occluded[i] = stopped;
  }
  return {};
}

}  // namespace yat::bench

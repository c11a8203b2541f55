#pragma once
// Triangle soups and meshes for the tests of tree and traversal, rays through them, and the
// brute-force answer in double.

#include <cfloat>
#include <cmath>
#include <cstring>
#include <functional>
#include <random>
#include <vector>

#include "kernels/dispatch.h"
#include "scene/tree_build.h"
#include "soa/records.h"

namespace yat::testing_traverse {

struct Vec {
  double x = 0, y = 0, z = 0;
  Vec operator+(const Vec& o) const { return {x + o.x, y + o.y, z + o.z}; }
  Vec operator-(const Vec& o) const { return {x - o.x, y - o.y, z - o.z}; }
  Vec operator*(double s) const { return {x * s, y * s, z * s}; }
};
inline double dot(const Vec& a, const Vec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec cross(const Vec& a, const Vec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Vec unit(const Vec& a) {
  return a * (1 / std::sqrt(dot(a, a)));
}

struct Mesh {
  RowTable<TriangleRow> rows;
  std::vector<TriangleRow<Value>> list;

  void add(const Vec& a, const Vec& b, const Vec& c) {
    TriangleRow<Value> t{};
    t.p0_x = float(a.x), t.p0_y = float(a.y), t.p0_z = float(a.z);
    t.p1_x = float(b.x), t.p1_y = float(b.y), t.p1_z = float(b.z);
    t.p2_x = float(c.x), t.p2_y = float(c.y), t.p2_z = float(c.z);
    list.push_back(t);
  }
  void quad(const Vec& a, const Vec& b, const Vec& c, const Vec& d) {
    add(a, b, c);
    add(a, c, d);
  }
  /// Calls before the rows are read.
  const Mesh& done() {
    rows.resize(uint32_t(list.size()));
    for (uint32_t i = 0; i < list.size(); ++i) rows.set(i, list[i]);
    return *this;
  }
  Vec corner(uint32_t prim, int k) const {
    const TriangleRow<Value>& t = list[prim];
    const float* p = &t.p0_x + 3 * k;
    return {double(p[0]), double(p[1]), double(p[2])};
  }
};

using Rng = std::mt19937;
inline double uniform(Rng& rng, double low = 0, double high = 1) {
  return low + (high - low) * (double(rng() >> 8) * 0x1p-24);
}
inline Vec random_point(Rng& rng, double size = 1) {
  const double x = uniform(rng, -size, size), y = uniform(rng, -size, size);
  return {x, y, uniform(rng, -size, size)};
}
inline Vec random_direction(Rng& rng) {
  for (;;) {
    const Vec v = random_point(rng);
    const double l = dot(v, v);
    if (l > 0.01 && l <= 1) return unit(v);
  }
}

inline Mesh soup(uint32_t n, double size, uint32_t seed) {
  Rng rng(seed);
  Mesh mesh;
  for (uint32_t i = 0; i < n; ++i) {
    const Vec c = random_point(rng);
    const Vec a = random_point(rng, size), b = random_point(rng, size);
    mesh.add(c, c + a, c + b);
  }
  mesh.done();
  return mesh;
}

/// A staircase of axis-aligned quads whose corners share coordinates; turned about a fixed axis.
inline Mesh stairs(uint32_t steps, double angle, const Vec& at = {}) {
  Mesh mesh;
  const double c = std::cos(angle), s = std::sin(angle);
  const auto turn = [&](double x, double y, double z) {
    const double y2 = c * y - s * z, z2 = s * y + c * z;
    return Vec{c * x - s * y2, s * x + c * y2, z2} + at;
  };
  for (uint32_t i = 0; i < steps; ++i) {
    const double a = double(i) / steps, b = double(i + 1) / steps;
    mesh.quad(turn(a, 0, a), turn(b, 0, a), turn(b, 1, a), turn(a, 1, a));
    mesh.quad(turn(b, 0, a), turn(b, 0, b), turn(b, 1, b), turn(b, 1, a));
  }
  mesh.done();
  return mesh;
}

inline void add_box(Mesh& mesh, const Vec& a, const Vec& b) {
  const auto p = [&](int i) {
    return Vec{i & 1 ? b.x : a.x, i & 2 ? b.y : a.y, i & 4 ? b.z : a.z};
  };
  constexpr int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                               {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : faces) mesh.quad(p(f[0]), p(f[1]), p(f[2]), p(f[3]));
}

/// Boxes on an integer grid, with gaps: many coplanar faces.
inline Mesh voxels(uint32_t n) {
  Mesh mesh;
  for (uint32_t x = 0; x < n; ++x)
    for (uint32_t y = 0; y < n; ++y)
      for (uint32_t z = 0; z < n; ++z)
        if ((x * 7 + y * 3 + z * 5) % 4 == 0)
          add_box(mesh, {double(x), double(y), double(z)}, {x + 1., y + 1., z + 1.});
  mesh.done();
  return mesh;
}

/// A closed sphere of 2 n (n - 1) triangles with shared vertices, jittered if wanted.
inline Mesh closed_sphere(uint32_t n, const Vec& center, double radius, double jitter = 0) {
  Mesh mesh;
  Rng rng(5);
  std::vector<std::vector<Vec>> ring(n + 1, std::vector<Vec>(n));
  for (uint32_t i = 0; i <= n; ++i)
    for (uint32_t j = 0; j < n; ++j) {
      const double theta = M_PI * i / n, phi = 2 * M_PI * j / n;
      const bool pole = i == 0 || i == n;
      const double r = radius * (1 + (pole ? 0 : jitter * uniform(rng, -1, 1)));
      ring[i][j] = center + (pole ? Vec{0, 0, i ? -radius : radius}
                                  : Vec{r * std::sin(theta) * std::cos(phi),
                                        r * std::sin(theta) * std::sin(phi), r * std::cos(theta)});
    }
  for (uint32_t i = 0; i < n; ++i)
    for (uint32_t j = 0; j < n; ++j) {
      const uint32_t k = (j + 1) % n;
      if (i > 0) mesh.add(ring[i][j], ring[i + 1][j], ring[i][k]);
      if (i + 1 < n) mesh.add(ring[i][k], ring[i + 1][j], ring[i + 1][k]);
    }
  mesh.done();
  return mesh;
}

inline Ray<Value> make_ray(const Vec& o, const Vec& d, float t_max = kRayFar) {
  return {float(o.x), float(o.y), float(o.z), float(d.x), float(d.y), float(d.z), t_max};
}

/// A mixture: random, at vertices and edges, along axes through vertices, in planes of vertices.
inline std::vector<Ray<Value>> rays_through(const Mesh& mesh, uint32_t n, uint32_t seed,
                                            double reach = 2, const Vec& center = {}) {
  Rng rng(seed);
  std::vector<Ray<Value>> rays;
  const auto prims = uint32_t(mesh.list.size());
  for (uint32_t i = 0; i < n; ++i) {
    Vec o = center + random_point(rng, reach), d = random_direction(rng);
    const uint32_t prim = rng() % prims;
    const Vec corner = mesh.corner(prim, int(rng() % 3));
    const int axis = int(rng() % 3);
    double* const od[2] = {&o.x + axis, &d.x + axis};
    switch (i % 6) {
      case 1:
        d = unit(corner - o);
        break;
      case 2:
        d = unit(corner + (mesh.corner(prim, 0) - corner) * uniform(rng) - o);
        break;
      case 3:  // Along an axis, through a vertex.
        d = axis == 0 ? Vec{1, 0, 0} : axis == 1 ? Vec{0, 1, 0} : Vec{0, 0, 1};
        if (rng() & 1) d = d * -1;
        o = corner - d * uniform(rng, 0, reach);
        if (rng() & 1) o = corner;
        break;
      case 4:  // In an axis plane through a vertex.
        *od[0] = (&corner.x)[axis];
        *od[1] = rng() & 1 ? 0.0 : -0.0;
        d = unit(d);
        break;
      default:
        break;
    }
    float t_max = kRayFar;
    if (i % 11 == 5) t_max = float(uniform(rng, 0, 2 * reach));
    rays.push_back(make_ray(o, d, t_max));
  }
  return rays;
}

inline Table<Ray> to_table(const std::vector<Ray<Value>>& rays) {
  Table<Ray> table{uint32_t(rays.size())};
  for (uint32_t i = 0; i < rays.size(); ++i) table.set(i, rays[i]);
  return table;
}

using ClosestKernel = decltype(KernelTable::intersect_closest);

/// A kernel's answer for every ray, in calls of at most `batch` rays.
inline std::vector<Hit<Value>> trace_by(ClosestKernel kernel, const KernelTable& k,
                                        const TreeView& tree, const std::vector<Ray<Value>>& rays,
                                        uint32_t batch) {
  std::vector<Hit<Value>> out;
  const AlignedArray<std::byte> memory(
      k.traversal_scratch_bytes(tree, std::min(batch, uint32_t(rays.size()))));
  const Scratch scratch{const_cast<std::byte*>(memory.data()), memory.size()};
  for (size_t begin = 0; begin < rays.size(); begin += batch) {
    const std::vector<Ray<Value>> part(
        rays.begin() + ptrdiff_t(begin),
        rays.begin() + ptrdiff_t(std::min(rays.size(), begin + batch)));
    const Table<Ray> columns = to_table(part);
    const Table<Hit> hits{uint32_t(part.size())};
    kernel(tree, columns.view(), hits.columns(), uint32_t(part.size()), scratch);
    for (uint32_t i = 0; i < part.size(); ++i) out.push_back(hits.row(i));
  }
  return out;
}
inline std::vector<Hit<Value>> trace(const KernelTable& k, const TreeView& tree,
                                     const std::vector<Ray<Value>>& rays,
                                     uint32_t batch = 1u << 20) {
  return trace_by(k.intersect_closest, k, tree, rays, batch);
}
inline std::vector<Hit<Value>> trace_tiles(const KernelTable& k, const TreeView& tree,
                                           const std::vector<Ray<Value>>& rays,
                                           uint32_t batch = 1u << 20) {
  return trace_by(k.intersect_tiles, k, tree, rays, batch);
}

/// Are the segments of the rays stopped? Ray i goes from org along dir (not unit) for t in (0, 1).
inline std::vector<uint32_t> trace_shadow(const KernelTable& k, const TreeView& tree,
                                          const std::vector<Ray<Value>>& rays,
                                          uint32_t variant = 0) {
  const auto n = uint32_t(rays.size());
  const Table<ShadowRay> columns{n};
  for (uint32_t i = 0; i < n; ++i) {
    const Ray<Value>& r = rays[i];
    set_row<ShadowRay>(columns.columns(), i,
                       {r.org_x, r.org_y, r.org_z, r.dir_x, r.dir_y, r.dir_z, 0, 0, 0, i});
  }
  AlignedArray<uint32_t> occluded(n);
  AlignedArray<std::byte> memory(k.traversal_scratch_bytes(tree, n));
  k.intersect_shadow[variant](tree, columns.view(), occluded.data(), n,
                              {memory.data(), memory.size()});
  return {occluded.begin(), occluded.end()};
}

inline bool same_bits(const Hit<Value>& a, const Hit<Value>& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

/// What the plain formula says of one ray and one triangle, in double.
struct Exact {
  double t = HUGE_VAL;  ///< along the ray, where it meets the triangle's plane
  double inside = -1;   ///< smallest barycentric weight: >= 0 inside, in units of the triangle
  double border = 0;    ///< uncertainty of `inside` that float positions bring
  double t_error = 0;   ///< the same for t
};

/// Rounding bound: both vertices and origin are taken as exact; the float test may be off by a few
/// roundings of the largest coordinate difference.
inline Exact exact_hit(const Mesh& mesh, uint32_t prim, const Ray<Value>& ray) {
  const Vec o{double(ray.org_x), double(ray.org_y), double(ray.org_z)};
  const Vec d{double(ray.dir_x), double(ray.dir_y), double(ray.dir_z)};
  const Vec a = mesh.corner(prim, 0) - o, b = mesh.corner(prim, 1) - o,
            c = mesh.corner(prim, 2) - o;
  const Vec n = cross(b - a, c - a);
  const double det = dot(n, d);
  Exact out;
  const double size =
      std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z), std::abs(b.x), std::abs(b.y),
                std::abs(b.z), std::abs(c.x), std::abs(c.y), std::abs(c.z)});
  const double speed = std::sqrt(dot(d, d));
  const double error = 32 * 0x1p-24 * size;  // Of a sheared coordinate.
  if (det == 0) {
    out.border = HUGE_VAL;
    out.t_error = HUGE_VAL;
    return out;
  }
  out.t = dot(n, a) / det;
  const double w0 = dot(d, cross(c, b)) / -det, w1 = dot(d, cross(a, c)) / -det;
  out.inside = std::min({w0, w1, 1 - w0 - w1});
  const double longest =
      std::sqrt(std::max({dot(b - a, b - a), dot(c - a, c - a), dot(c - b, c - b)}));
  // Moving the ray by `error` across changes a weight by error * edge / projected area.
  out.border = 4 * error * longest * speed / std::abs(det);
  // ... and the distance by that much along the slope of the plane.
  out.t_error = 4 * error * std::sqrt(dot(n, n)) / std::abs(det) + 1e-6 * std::abs(out.t);
  return out;
}

}  // namespace yat::testing_traverse

namespace yat::testing_traverse {

/// The watertight test of one pair, written out plainly in float: the kernels must agree to the
/// bit.
inline bool float_hit(const TriangleRow<Value>& tri, const Ray<Value>& ray, float& t, float& u,
                      float& v) {
  const float d[3] = {ray.dir_x, ray.dir_y, ray.dir_z}, o[3] = {ray.org_x, ray.org_y, ray.org_z};
  const float m[3] = {std::abs(d[0]), std::abs(d[1]), std::abs(d[2])};
  const int kz = m[0] >= m[1] && m[0] >= m[2] ? 0 : m[1] >= m[2] ? 1 : 2;
  const int kx = (kz + 1) % 3, ky = (kz + 2) % 3;
  const float sz = 1.f / d[kz], sx = d[kx] * sz, sy = d[ky] * sz;
  float x[3], y[3], z[3];
  const float* const p = &tri.p0_x;
  for (int i = 0; i < 3; ++i) {
    z[i] = p[3 * i + kz] - o[kz];
    x[i] = (p[3 * i + kx] - o[kx]) - sx * z[i];
    y[i] = (p[3 * i + ky] - o[ky]) - sy * z[i];
  }
  const float e0 = x[2] * y[1] - y[2] * x[1];
  const float e1 = x[0] * y[2] - y[0] * x[2];
  const float e2 = x[1] * y[0] - y[1] * x[0];
  if (!((e0 >= 0 && e1 >= 0 && e2 >= 0) || (e0 <= 0 && e1 <= 0 && e2 <= 0))) return false;
  const float det = (e0 + e1) + e2;
  if (!(det != 0)) return false;
  const auto one_sign = [](const float(&c)[3]) {
    return std::signbit(c[0]) == std::signbit(c[1]) && std::signbit(c[1]) == std::signbit(c[2]);
  };
  if (one_sign(x) || one_sign(y)) return false;
  const float inverse = 1.f / det;
  u = e1 * inverse;
  v = e2 * inverse;
  const float along = (e0 * inverse * z[0] + u * z[1]) + v * z[2];
  t = along * sz;
  // Too near to be sure: the plane itself must lie ahead.
  const auto reach = [](const float(&c)[3]) {
    return std::max(std::abs(c[0]), std::max(std::abs(c[1]), std::abs(c[2])));
  };
  const float across = std::max(reach(x), reach(y)), deep = reach(z);
  const float error = (80 * 0x1p-24f * across) * std::max(across, deep) * deep;
  if (!(std::abs(along * det) <= error)) return true;
  float r[3][3];  // Axis, vertex.
  for (int i = 0; i < 3; ++i) {
    r[0][i] = p[3 * i + kx] - o[kx];
    r[1][i] = p[3 * i + ky] - o[ky];
    r[2][i] = p[3 * i + kz] - o[kz];
  }
  const auto normal = [&r](int a, int b) {
    float value = 0, size = FLT_MAX;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const float first = (r[a][j] - r[a][i]) * (r[b][k] - r[b][j]),
                  second = (r[b][j] - r[b][i]) * (r[a][k] - r[a][j]);
      const float largest = std::max(std::abs(first), std::abs(second));
      if (!(largest < size)) continue;
      value = first - second;
      size = largest;
    }
    return value;
  };
  const float n[3] = {normal(1, 2), normal(2, 0), normal(0, 1)};
  const float distance = (n[0] * r[0][0] + n[1] * r[1][0]) + n[2] * r[2][0];
  const float slope = (n[0] * sx + n[1] * sy) + n[2];
  return distance == 0 || !(std::signbit(distance) ^ std::signbit(slope) ^ std::signbit(sz));
}

/// Every triangle, in float; (t, lower row) wins. For rays from within kFarExtents.
inline Hit<Value> brute_force(const Mesh& mesh, const Ray<Value>& ray) {
  Hit<Value> best{ray.t_max, 0, 0, kNone};
  for (uint32_t prim = 0; prim < mesh.list.size(); ++prim) {
    float t, u, v;
    if (!float_hit(mesh.list[prim], ray, t, u, v) || !(t > 0)) continue;
    if (t < best.t || (t == best.t && prim < best.prim)) best = {t, u, v, prim};
  }
  return best;
}

/// Every triangle, in double. Empty if `hit` can be true, else what is wrong with it.
inline std::string check_hit(const Mesh& mesh, const Ray<Value>& ray, const Hit<Value>& hit) {
  if (hit.prim != kNone) {
    if (hit.prim >= mesh.list.size()) return "no such primitive";
    if (!(hit.t > 0 && hit.t <= ray.t_max)) return "t out of range";
    if (!(hit.u >= -1e-6f && hit.v >= -1e-6f && hit.u + hit.v <= 1 + 1e-6f)) return "bad weights";
    const Exact e = exact_hit(mesh, hit.prim, ray);
    if (e.inside < -e.border) return "outside the triangle by " + std::to_string(-e.inside);
    if (std::abs(e.t - double(hit.t)) > e.t_error)
      return "t " + std::to_string(hit.t) + ", exactly " + std::to_string(e.t);
  } else if (hit.t != ray.t_max) {
    return "a miss with t != t_max";
  }
  for (uint32_t prim = 0; prim < mesh.list.size(); ++prim) {
    const Exact e = exact_hit(mesh, prim, ray);
    if (e.inside > e.border && e.t - e.t_error > 0 && e.t + e.t_error < double(hit.t))
      return "passed triangle " + std::to_string(prim);
  }
  return {};
}

}  // namespace yat::testing_traverse

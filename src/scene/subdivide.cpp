#include "scene/subdivide.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <numbers>
#include <unordered_map>

namespace yat {

namespace {

using Corners = std::array<uint32_t, 3>;

/// Positions and texture coordinates have indices of their own: seams of uv are not edges.
struct Net {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec2> uvs;
  std::vector<Corners> faces, uv_faces;  ///< uv_faces is empty where there are none
};

constexpr uint32_t kNobody = 0xffffffffu;

struct Edge {
  uint32_t a, b;         ///< a < b
  uint32_t opposite[2];  ///< the third corners of its triangles
  uint32_t faces = 0;
  bool turned = false;  ///< two faces run along it in one direction
  bool boundary() const { return faces != 2 || turned; }
};

/// Numbers pairs of indices in the order in which they come.
class PairNumbers {
 public:
  explicit PairNumbers(size_t expected) { number_.reserve(expected); }
  /// The pair's number, and whether it is new.
  std::pair<uint32_t, bool> of(uint32_t a, uint32_t b) {
    const uint64_t key = uint64_t(std::min(a, b)) << 32 | std::max(a, b);
    const auto [at, is_new] = number_.try_emplace(key, uint32_t(number_.size()));
    return {at->second, is_new};
  }

 private:
  std::unordered_map<uint64_t, uint32_t> number_;
};

/// The edges of a net, and each face's three: edge k runs from corner k to the next.
struct Edges {
  std::vector<Edge> list;
  std::vector<Corners> of_face;

  explicit Edges(const std::vector<Corners>& faces) {
    PairNumbers numbers(faces.size() * 3 / 2);
    std::vector<uint8_t> upwards;  // whether the first face runs from a to b
    for (const Corners& face : faces) {
      Corners own;
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t from = face[k], to = face[(k + 1) % 3], third = face[(k + 2) % 3];
        const auto [edge, is_new] = numbers.of(from, to);
        if (is_new) {
          list.push_back({std::min(from, to), std::max(from, to), {third, kNobody}});
          upwards.push_back(from < to);
        }
        Edge& e = list[edge];
        if (e.faces == 1) {
          e.opposite[1] = third;
          e.turned = upwards[edge] == uint8_t(from < to);
        }
        ++e.faces;
        own[k] = edge;
      }
      of_face.push_back(own);
    }
  }
};

/// Sums over the neighbours of each vertex.
struct Rings {
  std::vector<glm::dvec3> sum, boundary_sum;
  std::vector<uint32_t> count, boundary_count;

  Rings(const Net& net, const Edges& edges)
      : sum(net.positions.size(), glm::dvec3(0.)),
        boundary_sum(sum),
        count(sum.size()),
        boundary_count(sum.size()) {
    for (const Edge& e : edges.list) {
      const auto add = [&](uint32_t to, uint32_t from) {
        sum[to] += net.positions[from];
        ++count[to];
        if (!e.boundary()) return;
        boundary_sum[to] += net.positions[from];
        ++boundary_count[to];
      };
      add(e.a, e.b);
      add(e.b, e.a);
    }
  }

  /// own * v + the rest shared evenly by the neighbours that count: all of them inside, the two
  /// along the boundary there. Corners stay.
  glm::dvec3 blend(const Net& net, uint32_t v, double inside, double along, bool sharp) const {
    const glm::dvec3& p = net.positions[v];
    if (count[v] == 0) return p;
    if (boundary_count[v] == 0) return inside * p + (1 - inside) / count[v] * sum[v];
    if (boundary_count[v] != 2 || sharp) return p;
    return along * p + (1 - along) / 2 * boundary_sum[v];
  }
};

/// Weight of one neighbour in the new place of a vertex with n of them (Loop 1987).
double loop_beta(uint32_t n) {
  const double c = 3. / 8 + std::cos(2 * std::numbers::pi / n) / 4;
  return (5. / 8 - c * c) / n;
}

Net refine(const Net& in, bool sharp) {
  const Edges edges(in.faces);
  const Rings rings(in, edges);
  Net out;
  const auto old = uint32_t(in.positions.size());
  out.positions.reserve(old + edges.list.size());
  for (uint32_t v = 0; v < old; ++v) {
    const uint32_t n = rings.count[v];
    out.positions.push_back(rings.blend(in, v, n ? 1 - n * loop_beta(n) : 1, 3. / 4, sharp));
  }
  for (const Edge& e : edges.list) {
    const glm::dvec3 ends = in.positions[e.a] + in.positions[e.b];
    out.positions.push_back(
        e.boundary()
            ? .5 * ends
            : 3. / 8 * ends + 1. / 8 * (in.positions[e.opposite[0]] + in.positions[e.opposite[1]]));
  }
  const auto split = [](const Corners& c, const Corners& middle, std::vector<Corners>& to) {
    to.push_back({c[0], middle[0], middle[2]});
    to.push_back({middle[0], c[1], middle[1]});
    to.push_back({middle[2], middle[1], c[2]});
    to.push_back({middle[0], middle[1], middle[2]});
  };
  out.faces.reserve(4 * in.faces.size());
  for (size_t f = 0; f < in.faces.size(); ++f) {
    const Corners& e = edges.of_face[f];
    split(in.faces[f], {old + e[0], old + e[1], old + e[2]}, out.faces);
  }
  if (in.uv_faces.empty()) return out;
  out.uvs = in.uvs;
  out.uv_faces.reserve(4 * in.uv_faces.size());
  const auto old_uvs = uint32_t(in.uvs.size());
  PairNumbers numbers(in.uv_faces.size() * 3 / 2);
  for (const Corners& face : in.uv_faces) {
    Corners middle;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = face[k], b = face[(k + 1) % 3];
      const auto [number, is_new] = numbers.of(a, b);
      if (is_new) out.uvs.push_back(.5 * (in.uvs[a] + in.uvs[b]));
      middle[k] = old_uvs + number;
    }
    split(face, middle, out.uv_faces);
  }
  return out;
}

/// The vertices around one, in order, from one boundary to the other where there are two.
class OrderedRings {
 public:
  explicit OrderedRings(const Net& net) : first_(net.positions.size() + 1) {
    for (const Corners& face : net.faces)
      for (const uint32_t v : face) ++first_[v + 1];
    for (size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
    steps_.resize(net.faces.size() * 3);
    std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
    for (const Corners& face : net.faces)
      for (size_t k = 0; k < 3; ++k)
        steps_[next[face[k]]++] = {face[(k + 1) % 3], face[(k + 2) % 3]};
  }
  /// Fills `ring`; false where the faces do not make one fan. `open`: it has two ends.
  bool around(uint32_t v, std::vector<uint32_t>& ring, bool& open) const {
    const size_t begin = first_[v], end = first_[v + 1], n = end - begin;
    ring.clear();
    if (n == 0) return false;
    const auto step_from = [&](uint32_t from) {
      for (size_t i = begin; i < end; ++i)
        if (steps_[i].from == from) return i;
      return end;
    };
    // Where nothing leads to is one end.
    uint32_t start = steps_[begin].from;
    open = false;
    for (size_t i = begin; i < end; ++i) {
      bool led_to = false;
      for (size_t j = begin; j < end; ++j) led_to = led_to || steps_[j].to == steps_[i].from;
      if (led_to) continue;
      if (open) return false;
      open = true;
      start = steps_[i].from;
    }
    ring.push_back(start);
    for (size_t taken = 0; taken < n; ++taken) {
      const size_t step = step_from(ring.back());
      if (step == end) return false;
      ring.push_back(steps_[step].to);
    }
    if (!open) {
      if (ring.back() != start) return false;
      ring.pop_back();
    }
    return true;
  }

 private:
  struct Step {
    uint32_t from, to;
  };
  std::vector<size_t> first_;
  std::vector<Step> steps_;
};

/// Normal of the limit surface at v, not unit; zero where it has none.
glm::dvec3 limit_normal(const Net& s, uint32_t v, const std::vector<uint32_t>& ring, bool open) {
  const auto n = uint32_t(ring.size());
  const auto p = [&](uint32_t i) { return s.positions[ring[i]]; };
  glm::dvec3 along(0.), across(0.);
  if (!open) {
    for (uint32_t i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * i / n;
      along += std::cos(angle) * p(i);
      across += std::sin(angle) * p(i);
    }
    return glm::cross(along, across);
  }
  along = p(0) - p(n - 1);
  if (n == 2) {
    across = p(0) + p(1) - 2. * s.positions[v];
  } else if (n == 3) {
    across = p(1) - s.positions[v];
  } else {
    const double theta = std::numbers::pi / (n - 1);
    across = -std::sin(theta) * (p(0) + p(n - 1));
    for (uint32_t i = 1; i + 1 < n; ++i)
      across += (2 - 2 * std::cos(theta)) * std::sin(i * theta) * p(i);
  }
  return glm::cross(along, across);
}

std::vector<glm::dvec3> normals_of(const Net& s) {
  std::vector<glm::dvec3> normals(s.positions.size(), glm::dvec3(0.));
  // Where no ring can be followed, the mean of the faces.
  for (const Corners& f : s.faces) {
    const glm::dvec3 n =
        glm::cross(s.positions[f[1]] - s.positions[f[0]], s.positions[f[2]] - s.positions[f[0]]);
    for (const uint32_t v : f) normals[v] += n;
  }
  const OrderedRings rings(s);
  std::vector<uint32_t> ring;
  for (uint32_t v = 0; v < normals.size(); ++v) {
    bool open = false;
    glm::dvec3 n(0.);
    if (rings.around(v, ring, open)) n = limit_normal(s, v, ring, open);
    if (!(glm::length(n) > 0)) n = normals[v];
    const double length = glm::length(n);
    normals[v] = length > 0 && std::isfinite(length) ? n / length : glm::dvec3(0.);
  }
  return normals;
}

/// Weight of the vertex itself in its limit position.
double limit_weight(uint32_t n) {
  const double own = 3 / (8 * loop_beta(n));
  return own / (own + n);
}

Net net_of(const Mesh& mesh) {
  Net s;
  struct Hash {
    size_t operator()(const std::array<float, 3>& p) const {
      uint64_t h = 0;
      for (float x : p) {
        uint32_t bits;
        std::memcpy(&bits, &x, 4);
        h = (h ^ bits) * 0x9e3779b97f4a7c15u;
        h ^= h >> 29;
      }
      return size_t(h);
    }
  };
  std::unordered_map<std::array<float, 3>, uint32_t, Hash> known;
  std::vector<uint32_t> place(mesh.vertices());
  for (uint32_t v = 0; v < mesh.vertices(); ++v) {
    // Adding 0 makes -0 and 0 one place.
    const std::array<float, 3> p = {mesh.positions[3 * v] + 0.f, mesh.positions[3 * v + 1] + 0.f,
                                    mesh.positions[3 * v + 2] + 0.f};
    const auto [at, is_new] = known.try_emplace(p, uint32_t(s.positions.size()));
    if (is_new) s.positions.push_back({double(p[0]), double(p[1]), double(p[2])});
    place[v] = at->second;
    if (!mesh.uvs.empty()) s.uvs.push_back({double(mesh.uvs[2 * v]), double(mesh.uvs[2 * v + 1])});
  }
  for (size_t t = 0; t < mesh.indices.size(); t += 3) {
    const Corners corners = {mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]};
    const Corners face = {place[corners[0]], place[corners[1]], place[corners[2]]};
    // Without area there is nothing to subdivide.
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
    s.faces.push_back(face);
    if (!mesh.uvs.empty()) s.uv_faces.push_back(corners);
  }
  return s;
}

/// Back to one index per vertex.
void to_mesh(const Net& s, const std::vector<glm::dvec3>& normals, Mesh& mesh) {
  Mesh out;
  out.normals_from_file = false;
  const auto add_vertex = [&](uint32_t p) {
    for (size_t k = 0; k < 3; ++k) out.owned_positions.push_back(float(s.positions[p][int(k)]));
    if (!normals.empty())
      for (size_t k = 0; k < 3; ++k) out.owned_normals.push_back(float(normals[p][int(k)]));
  };
  if (s.uv_faces.empty()) {
    for (uint32_t v = 0; v < s.positions.size(); ++v) add_vertex(v);
    for (const Corners& f : s.faces) out.indices.insert(out.indices.end(), f.begin(), f.end());
  } else {
    std::unordered_map<uint64_t, uint32_t> known;
    known.reserve(s.uvs.size());
    for (size_t f = 0; f < s.faces.size(); ++f)
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t p = s.faces[f][k], uv = s.uv_faces[f][k];
        const auto [at, is_new] = known.try_emplace(uint64_t(p) << 32 | uv, uint32_t(known.size()));
        if (is_new) {
          add_vertex(p);
          out.owned_uvs.push_back(float(s.uvs[uv].x));
          out.owned_uvs.push_back(float(s.uvs[uv].y));
        }
        out.indices.push_back(at->second);
      }
  }
  out.positions = out.owned_positions;
  out.normals = out.owned_normals;
  out.uvs = out.owned_uvs;
  mesh = std::move(out);
}

}  // namespace

void subdivide(Mesh& mesh, const SubdivisionOptions& options) {
  Net net = net_of(mesh);
  for (int level = 0; level < options.levels; ++level) net = refine(net, options.sharp_boundary);
  std::vector<glm::dvec3> normals;
  if (options.smooth_normals) normals = normals_of(net);
  const Rings rings(net, Edges(net.faces));
  std::vector<glm::dvec3> limit(net.positions.size());
  for (uint32_t v = 0; v < limit.size(); ++v)
    limit[v] = rings.blend(net, v, rings.count[v] ? limit_weight(rings.count[v]) : 1, 2. / 3,
                           options.sharp_boundary);
  net.positions = std::move(limit);
  to_mesh(net, normals, mesh);
}

}  // namespace yat

#include "scene/rectangle_lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>
#include <utility>

namespace yat {

namespace {

std::array<glm::dvec3, 3> corners_of(const TriangleRow<Value>& t) {
  return {glm::dvec3(t.p0_x, t.p0_y, t.p0_z), glm::dvec3(t.p1_x, t.p1_y, t.p1_z),
          glm::dvec3(t.p2_x, t.p2_y, t.p2_z)};
}

/// A triangle with a right angle: its corner there, and the ends of the side across in their order.
struct RightTriangle {
  glm::dvec3 corner, from, to;
};

std::optional<RightTriangle> right_triangle(const TriangleRow<Value>& t) {
  const std::array<glm::dvec3, 3> p = corners_of(t);
  for (size_t k = 0; k < 3; ++k) {
    const RightTriangle r{p[k], p[(k + 1) % 3], p[(k + 2) % 3]};
    if (is_rectangle(r.from - r.corner, r.to - r.corner)) return r;
  }
  return std::nullopt;
}

}  // namespace

bool is_rectangle(const glm::dvec3& b, const glm::dvec3& c) {
  return std::abs(glm::dot(b, c)) <= kRectangleTolerance * glm::length(b) * glm::length(c);
}

std::optional<RectangleSides> rectangle_of(const TriangleRow<Value>& one,
                                           const TriangleRow<Value>& other) {
  const std::optional<RightTriangle> a = right_triangle(one), b = right_triangle(other);
  if (!a || !b || a->from != b->to || a->to != b->from) return std::nullopt;
  const RectangleSides sides{a->corner, a->from - a->corner, a->to - a->corner};
  const double shorter = std::min(glm::length(sides.b), glm::length(sides.c));
  const glm::dvec3 opposite = sides.corner + sides.b + sides.c;
  if (!(glm::length(b->corner - opposite) <= kRectangleTolerance * shorter)) return std::nullopt;
  return sides;
}

std::vector<uint32_t> find_rectangles(std::span<const TriangleRow<Value>> triangles,
                                      const std::function<bool(const RectangleSides&)>& fits) {
  // Triangles by their diagonals, whichever way round these go.
  struct Entry {
    std::array<double, 6> ends;
    uint32_t triangle;
    bool operator<(const Entry& o) const {
      return std::tie(ends, triangle) < std::tie(o.ends, o.triangle);
    }
  };
  std::vector<Entry> entries;
  for (uint32_t t = 0; t < triangles.size(); ++t)
    if (const std::optional<RightTriangle> r = right_triangle(triangles[t])) {
      std::array<double, 3> from{r->from.x, r->from.y, r->from.z}, to{r->to.x, r->to.y, r->to.z};
      if (to < from) std::swap(from, to);
      entries.push_back({{from[0], from[1], from[2], to[0], to[1], to[2]}, t});
    }
  std::sort(entries.begin(), entries.end());

  std::vector<uint32_t> partner(triangles.size(), kNone);
  for (size_t i = 0; i < entries.size(); ++i) {
    const uint32_t one = entries[i].triangle;
    if (partner[one] != kNone) continue;
    for (size_t k = i + 1; k < entries.size() && entries[k].ends == entries[i].ends; ++k) {
      const uint32_t other = entries[k].triangle;
      if (partner[other] != kNone) continue;
      const std::optional<RectangleSides> sides = rectangle_of(triangles[one], triangles[other]);
      if (!sides || !fits(*sides)) continue;
      partner[one] = other;
      partner[other] = one;
      break;
    }
  }
  return partner;
}

LightRow<Value> rectangle_light(const RectangleSides& sides, const glm::dvec3& radiance) {
  RectangleSides s = sides;
  // From the next corner on, the sides change places.
  if (glm::length(s.b) > glm::length(s.c)) s = {s.corner + s.b, s.c, -s.b};
  LightRow<Value> light{};
  light.kind = uint32_t(LightKind::kRectangle);
  light.a_x = float(s.corner.x), light.a_y = float(s.corner.y), light.a_z = float(s.corner.z);
  light.b_x = float(s.b.x), light.b_y = float(s.b.y), light.b_z = float(s.b.z);
  light.c_x = float(s.c.x), light.c_y = float(s.c.y), light.c_z = float(s.c.z);
  light.extra = float(glm::length(glm::cross(s.b, s.c)));
  light.radiance_r = float(radiance.x);
  light.radiance_g = float(radiance.y);
  light.radiance_b = float(radiance.z);
  return light;
}

}  // namespace yat

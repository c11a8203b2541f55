#pragma once
// Pairs of triangles that make a rectangle shine as one light: half as many lights to choose from,
// and places on them are spread more evenly (kernels/lights/rectangle.h). Not where the light tree
// chooses, which does better with halves.

#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "scene/compiled.h"

namespace yat {

/// b x c points to the outside.
struct RectangleSides {
  glm::dvec3 corner, b, c;
};

/// Whether sides meet at a right angle, to kRectangleTolerance.
bool is_rectangle(const glm::dvec3& b, const glm::dvec3& c);

/// The rectangle of two triangles on either side of its diagonal; empty if they make none, or face
/// to different sides.
std::optional<RectangleSides> rectangle_of(const TriangleRow<Value>& one,
                                           const TriangleRow<Value>& other);

/// For each triangle the number of the one with which it makes a rectangle that `fits`, or kNone.
/// Each is in one rectangle at most; which, follows from the triangles alone.
std::vector<uint32_t> find_rectangles(
    std::span<const TriangleRow<Value>> triangles,
    const std::function<bool(const RectangleSides&)>& fits = [](const auto&) { return true; });

/// The light that a rectangle is; its area is 0 where a float cannot hold it.
LightRow<Value> rectangle_light(const RectangleSides& sides, const glm::dvec3& radiance);

/// Largest cosine between sides of a rectangle, and largest distance of a corner from where the
/// other three put it, by the shorter side: what is less changes densities by less than their own
/// rounding.
inline constexpr double kRectangleTolerance = 0x1p-16;

}  // namespace yat

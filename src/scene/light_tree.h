#pragma once
// Builds the tree over the lights that have a place (scene/light_nodes.h).

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "scene/compiled.h"

namespace yat {

/// Where a light is and where it shines.
struct LightBound {
  glm::dvec3 center;  ///< of a sphere that holds it, scene space
  double radius;      ///< >= 0 [m]
  glm::dvec3 axis;    ///< unit: it shines within a right angle of this, ...
  bool everywhere;    ///< ... or in all directions
  double intensity;   ///< towards where it is brightest [cd]: luminance times area seen from there
};

/// luminance: > 0, of the light's radiance. shapes: those that light rows name. Empty for a light
/// without a place.
std::optional<LightBound> light_bound(const LightRow<Value>& light, double luminance,
                                      const RowTable<ShapeRow>& shapes);

struct LightTree {
  RowTable<LightNode> nodes;
  AlignedArray<uint32_t> trail;  ///< per light, as LightTreeView::trail
  uint32_t depth = 0;            ///< levels of nodes, at most 32
};

/// From two lights on; light i has row i. scale: from scene to tree space. Splits are those of
/// least orientation cost (Conty Estevez and Kulla 2018) among 16 bins per axis.
LightTree build_light_tree(std::span<const LightBound> lights, double scale, ThreadPool& pool);

}  // namespace yat

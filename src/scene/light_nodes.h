#pragma once
// The light tree as kernels read it (part of scene/compiled.h): a binary tree over the lights that
// have a place, by which each surface chooses those that can be bright there.
//
// Tree space: scene space times `scale`, so that its numbers are about 1 in scenes of any size.
// What a child may send to a point at distance d of its sphere's centre, seen in direction w from
// there:
//
//   intensity / max(d, radius)^2 * clamp(dot(axis, w) + chord + s, kLeastCosine, 1)
//   s = min(radius / d, 1)
//
// The bracket is above the cosine of any of its lights: normals differ from `axis` by at most
// `chord`, directions to the sphere's points by about s. Source: after Conty Estevez and Kulla,
// "Importance Sampling of Many Lights with Adaptive Tree Splitting", 2018; departs: the bound on
// cosines is linear instead of by angles, and no light is ever worth nothing.

#include <cstdint>

#include "soa/columns.h"
#include "soa/fields.h"

namespace yat {

/// Both children of a node: one cache line.
template <template <class> class Of>
struct LightNode {
  Of<float> l_x, l_y, l_z, l_radius;  ///< sphere about the left child's lights, tree space
  Of<float> l_intensity;              ///< sum over its lights; those of the whole tree add to 1
  Of<uint32_t> l_axis;   ///< three signed numbers of 10 bits, x lowest: 511 times a unit vector
  Of<float> l_chord;     ///< >= 0; 2 where lights shine in all directions
  Of<uint32_t> l_child;  ///< bit 31 set: light row in the low 31 bits; clear: node row
  Of<float> r_x, r_y, r_z, r_radius;
  Of<float> r_intensity;
  Of<uint32_t> r_axis;
  Of<float> r_chord;
  Of<uint32_t> r_child;
  YAT_FIELDS(l_x, l_y, l_z, l_radius, l_intensity, l_axis, l_chord, l_child, r_x, r_y, r_z,
             r_radius, r_intensity, r_axis, r_chord, r_child)
};
static_assert(all_fields_listed<LightNode>);

/// Bounds on cosines are not below this: what rounding takes for dark must stay reachable.
inline constexpr float kLeastCosine = 1.f / 32;
/// Where lights with and without a place are chosen between, neither is chosen less often.
inline constexpr float kLeastShare = 1.f / 16;
/// Coordinates of receivers in tree space are clamped to this: infinite planes reach far.
inline constexpr float kTreeReach = 1e12f;
/// Distances in tree space are not below this: a light may lie on a receiver.
inline constexpr float kTreeNear = 1e-6f;

/// Lights without a place (kDistant, points without fall-off, environments) are the last rows of
/// the light table. Among them, LightView::choice decides.
struct LightTreeView {
  Rows<LightNode> nodes;            ///< row 0 is the root; count = 0: no tree, power alone decides
  const uint32_t* trail = nullptr;  ///< per light row: bit k is the child (1: right) at level k
  float scale = 1;
  float far = 0;           ///< what lights without a place send, as the tree's; 0: there are none
  uint32_t first_far = 0;  ///< the first of them
};

}  // namespace yat

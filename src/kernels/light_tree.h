#pragma once
// Choice of lights by the tree over them (scene/light_nodes.h): from the root, each lane goes to
// one of two children with the share of what they may send to its surface, with one number that is
// stretched again at every level.
//
// A surface knows on which side it can be lit, but a path that finds a light by chance knows only
// where it came from. So two chances go along: `chance`, with which a light is chosen, by which its
// contribution is divided; and `nominal`, the same without regard to the side, by which both
// techniques of multiple importance sampling are weighted. Any weights that add up to one are
// right; these are nearly the best ones.

#include "kernels/light.h"

namespace yat::YAT_ISA {

template <class A>
using LightNodeW = LightNode<Lanes<A>::template Of>;

/// Who is lit.
template <class A>
struct LitPoint {
  Vec3<A> at;             ///< tree space
  Vec3<A> up;             ///< unit: lights on the other side do nothing
  Float<A> least_cosine;  ///< of what is above: 1 where `up` does not matter

  static YAT_INLINE Vec3<A> to_tree(const LightTreeView& tree, const Vec3<A>& receiver) {
    const Float<A> scale(tree.scale), reach(kTreeReach);
    const auto clamp = [&](const Float<A>& x) {
      return xsimd::max(xsimd::min(scale * x, reach), -reach);
    };
    return {clamp(receiver.x), clamp(receiver.y), clamp(receiver.z)};
  }
  static YAT_INLINE LitPoint any_side(const LightTreeView& tree, const Vec3<A>& receiver) {
    const Float<A> zero(0.f), one(1.f);
    return {to_tree(tree, receiver), {zero, zero, one}, one};
  }
};

/// What a child may send.
template <class A>
struct ChildLight {
  Float<A> any_side;  ///< to a surface of any orientation
  Float<A> lit;       ///< to the surface
};

/// A number of 10 bits from bit 22 on, -512 to 511.
template <class A>
YAT_INLINE Float<A> signed_ten_bits(const UInt<A>& word) {
  return xsimd::to_float(xsimd::bitwise_cast<int32_t>(word) >> 22);
}

template <class A>
YAT_INLINE ChildLight<A> child_light(const Vec3<A>& center, const Float<A>& radius,
                                     const Float<A>& intensity, const UInt<A>& axis_word,
                                     const Float<A>& chord, const LitPoint<A>& lit) {
  const Float<A> one(1.f), least(kLeastCosine);
  const Vec3<A> way = center - lit.at;
  const Float<A> distance = xsimd::max(length(way), Float<A>(kTreeNear));
  const Float<A> inverse = one / distance, slack = xsimd::min(radius * inverse, one);
  const Vec3<A> axis{signed_ten_bits<A>(axis_word << 22), signed_ten_bits<A>(axis_word << 12),
                     signed_ten_bits<A>(axis_word << 2)};
  const Float<A> leaving = chord + slack - Float<A>(1.f / 511) * inverse * dot(axis, way);
  const Float<A> arriving = slack + inverse * dot(lit.up, way);
  const Float<A> near = xsimd::max(distance, radius);
  ChildLight<A> out;
  out.any_side = intensity * xsimd::max(xsimd::min(leaving, one), least) / (near * near);
  out.lit = out.any_side * xsimd::max(xsimd::min(arriving, one), lit.least_cosine);
  return out;
}
template <class A>
YAT_INLINE ChildLight<A> left_light(const LightNodeW<A>& node, const LitPoint<A>& lit) {
  return child_light<A>({node.l_x, node.l_y, node.l_z}, node.l_radius, node.l_intensity,
                        node.l_axis, node.l_chord, lit);
}
template <class A>
YAT_INLINE ChildLight<A> right_light(const LightNodeW<A>& node, const LitPoint<A>& lit) {
  return child_light<A>({node.r_x, node.r_y, node.r_z}, node.r_radius, node.r_intensity,
                        node.r_axis, node.r_chord, lit);
}

/// A child's part of both; half where neither sends anything.
template <class A>
YAT_INLINE Float<A> share_of(const Float<A>& child, const Float<A>& left, const Float<A>& right) {
  const Float<A> both = left + right;
  return select<A>(both > Float<A>(0.f), child / both, Float<A>(.5f));
}

/// How often a light without a place is chosen.
template <class A>
YAT_INLINE Float<A> share_of_far(const LightTreeView& tree, const LitPoint<A>& lit) {
  const LightNodeW<A> root = broadcast<A>(tree.nodes, 0);
  const Float<A> near = left_light<A>(root, lit).any_side + right_light<A>(root, lit).any_side;
  const Float<A> far(tree.far), least(kLeastShare);
  return xsimd::max(xsimd::min(far / (far + near), Float<A>(1.f) - least), least);
}

/// What is left of a number below `share`, or else above it, as a number in [0, 1) again.
template <class A>
YAT_INLINE Float<A> stretch_number(const Float<A>& u, const Float<A>& share, const Mask<A>& below) {
  const Float<A> one(1.f), below_one(1.f - kRounding);
  return xsimd::min(select<A>(below, u / share, (u - share) / (one - share)), below_one);
}

template <class A>
struct TreeChoice {
  UInt<A> row;       ///< valid in all lanes
  Float<A> chance;   ///< with which the row was chosen, but for the choice among far lights
  Float<A> nominal;  ///< the same whatever side is lit: chance_in_tree()
  Float<A> left;     ///< what is left of the number: of use where the light is far
  Mask<A> far;       ///< the row is still to be chosen among those from first_far on
};

/// u in [0, 1) in active lanes.
template <class A>
YAT_INLINE TreeChoice<A> choose_in_tree(const LightTreeView& tree, const LitPoint<A>& lit,
                                        const Mask<A>& active, Float<A> u) {
  const Float<A> one(1.f);
  TreeChoice<A> out;
  out.chance = out.nominal = one;
  out.far = active & !active;
  if (tree.far > 0) {
    const Float<A> share = share_of_far<A>(tree, lit);
    out.far = active & (u < share);
    u = stretch_number<A>(u, share, out.far);
    out.chance = out.nominal = select<A>(out.far, share, one - share);
  }
  Mask<A> open = active & !out.far;
  UInt<A> at(0u);
  while (any<A>(open)) {
    const LightNodeW<A> node = gather<A>(tree.nodes, only<A>(open, at));
    const ChildLight<A> left = left_light<A>(node, lit), right = right_light<A>(node, lit);
    const Float<A> share = share_of<A>(left.lit, left.lit, right.lit);
    const Mask<A> goes_left = u < share;
    // Not one minus the other: a small share would lose its digits.
    const Float<A> chance =
        share_of<A>(select<A>(goes_left, left.lit, right.lit), left.lit, right.lit);
    const Float<A> nominal = share_of<A>(select<A>(goes_left, left.any_side, right.any_side),
                                         left.any_side, right.any_side);
    out.chance = select<A>(open, out.chance * chance, out.chance);
    out.nominal = select<A>(open, out.nominal * nominal, out.nominal);
    u = select<A>(open, stretch_number<A>(u, share, goes_left), u);
    at = select<A>(open, select<A>(goes_left, node.l_child, node.r_child), at);
    open = open & !negative<A>(at);
  }
  out.row = at & UInt<A>(0x7fffffffu);
  out.left = u;
  return out;
}

/// TreeChoice::nominal of active lanes' rows, but for the choice among far lights.
template <class A>
YAT_INLINE Float<A> chance_in_tree(const LightTreeView& tree, const Vec3<A>& receiver,
                                   const UInt<A>& row, const Mask<A>& active) {
  const Float<A> one(1.f);
  const LitPoint<A> lit = LitPoint<A>::any_side(tree, receiver);
  const Mask<A> far = active & mask_of<A>(row >= UInt<A>(tree.first_far));
  Float<A> chance = one;
  if (tree.far > 0) {
    const Float<A> share = share_of_far<A>(tree, lit);
    chance = select<A>(far, share, one - share);
  }
  Mask<A> open = active & !far;
  UInt<A> at(0u), trail = gather<A>(tree.trail, only<A>(open, row));
  while (any<A>(open)) {
    const LightNodeW<A> node = gather<A>(tree.nodes, only<A>(open, at));
    const Float<A> left = left_light<A>(node, lit).any_side,
                   right = right_light<A>(node, lit).any_side;
    const Mask<A> goes_left = mask_of<A>((trail & UInt<A>(1u)) == UInt<A>(0u));
    const Float<A> share = share_of<A>(select<A>(goes_left, left, right), left, right);
    chance = select<A>(open, chance * share, chance);
    at = select<A>(open, select<A>(goes_left, node.l_child, node.r_child), at);
    trail = trail >> 1;
    open = open & !negative<A>(at);
  }
  return chance;
}

}  // namespace yat::YAT_ISA

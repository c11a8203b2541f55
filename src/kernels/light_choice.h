#pragma once
// Which light is sampled, and the chance of each: the one place that both sides of multiple
// importance sampling ask.

#include "kernels/light_tree.h"

namespace yat::YAT_ISA {

/// A row of an alias table, and what is left of the number that chose it, in [0, 1) again.
template <class A>
struct AliasChoice {
  UInt<A> row;
  Float<A> left;
};

/// Alias method (Walker 1977, Vose 1991): one number chooses the interval and, by where in it the
/// number lies, the interval's own row or the other one.
template <class A>
YAT_INLINE AliasChoice<A> choose_light(const Rows<LightChoice>& choice, const Float<A>& u) {
  const Float<A> place = u * Float<A>(float(choice.count));
  const Int<A> interval = xsimd::to_int(place);
  const UInt<A> row =
      xsimd::min(xsimd::bitwise_cast<uint32_t>(interval), UInt<A>(choice.count - 1));
  const LightChoice<Lanes<A>::template Of> entry = gather<A>(choice, row);
  const Float<A> rest = place - xsimd::to_float(interval);
  const Mask<A> own = rest < entry.threshold;
  return {select<A>(own, row, entry.other), stretch_number<A>(rest, entry.threshold, own)};
}

/// A light chosen for a surface. Both chances are to be multiplied by LightRow::probability.
template <class A>
struct ChosenLight {
  UInt<A> row;
  Float<A> chance;   ///< with which it was chosen
  Float<A> nominal;  ///< what multiple importance sampling goes by: chance_of_light()
};

/// By the tree; `active` lanes have u in [0, 1).
template <class A>
YAT_INLINE ChosenLight<A> choose_light_by_tree(const LightView& lights, const LitPoint<A>& lit,
                                               const Mask<A>& active, const Float<A>& u) {
  const TreeChoice<A> choice = choose_in_tree<A>(lights.tree, lit, active, u);
  ChosenLight<A> out{choice.row, choice.chance, choice.nominal};
  if (any<A>(choice.far)) {
    const UInt<A> far = UInt<A>(lights.tree.first_far) +
                        choose_light<A>(lights.choice, only<A>(choice.far, choice.left)).row;
    out.row = select<A>(choice.far, far, out.row);
  }
  return out;
}

/// The part of the chance that does not depend on the place: all of it without a tree.
template <class A>
YAT_INLINE Float<A> chance_of_light(const LightRowW<A>& row) {
  return row.probability;
}

/// ChosenLight::nominal of a light that a path found, from the vertex that it came from.
template <class A, bool kByTree>
YAT_INLINE Float<A> chance_of_light(const LightView& lights, const UInt<A>& light,
                                    const LightRowW<A>& row, const Vec3<A>& receiver,
                                    const Mask<A>& active) {
  if constexpr (kByTree)
    return row.probability * chance_in_tree<A>(lights.tree, receiver, light, active);
  else
    return row.probability;
}

}  // namespace yat::YAT_ISA

#pragma once
// Materials made of two others: rows of a chunk go to one child each, at random by its share.
//
//   Surface, Randoms ─> [split: share, the children's parameter rows] ─> choose_child
//     ─> take_rows, per child: dense Surface, PathState ─> the child's own stages
//
// One number in [0, 1) decides: what it leaves decides inside the child. The estimate stays right:
// light sampling and the next direction both belong to the child that was chosen, and their MIS
// weights add up to one within it. Where the children of a mixture give back unlike amounts of
// light, the brighter one is chosen more often than its share says, and what comes to either is
// multiplied by share over chance. The children of a coating are not shares of one whole: what
// comes to them is divided by its chance, and what is below the coat is weakened by it (coat.h).

#include "kernels/material.h"
#include "kernels/shade.h"

namespace yat::YAT_ISA {

/// How a surface is seen; `turned`: its outside is the other side.
template <class A>
YAT_INLINE BsdfView<A> view_of(const Surface<ConstColumn>& surfaces, uint32_t i, bool turned) {
  const Float<A> side(turned ? -1.f : 1.f);
  const Vec3<A> ng{load<A>(surfaces.ng_x, i), load<A>(surfaces.ng_y, i), load<A>(surfaces.ng_z, i)};
  const Vec3<A> ns{load<A>(surfaces.ns_x, i), load<A>(surfaces.ns_y, i), load<A>(surfaces.ns_z, i)};
  const Vec3<A> wo{load<A>(surfaces.wo_x, i), load<A>(surfaces.wo_y, i), load<A>(surfaces.wo_z, i)};
  return ShadingFrame<A>::of(side * ng, side * ns, wo).view;
}

/// See KernelTable::split.
template <class A, template <class> class Material, template <template <class> class> class Record>
void split(const ParameterView& table, const Surface<ConstColumn>& surfaces, bool turned,
           float* share, uint32_t* first, uint32_t* second, uint32_t n) noexcept {
  for (uint32_t i = 0; i < n; i += kLanes<A>) {
    const auto parameters = load_parameters<A, Record>(
        table, only<A>(tail_mask<A>(i, n), load<A>(surfaces.parameter, i)), i);
    store<A>(Material<A>::share(parameters, view_of<A>(surfaces, i, turned)), share, i);
    store<A>(parameters.first, first, i);
    store<A>(parameters.second, second, i);
  }
}

/// See KernelTable::chances.
template <class A, template <class> class Material, template <template <class> class> class Record>
void chances(const ParameterView& table, const Surface<ConstColumn>& surfaces, const float* share,
             float* chance, uint32_t n) noexcept {
  for (uint32_t i = 0; i < n; i += kLanes<A>) {
    const auto parameters = load_parameters<A, Record>(
        table, only<A>(tail_mask<A>(i, n), load<A>(surfaces.parameter, i)), i);
    store<A>(Material<A>::chance(parameters, load<A>(share, i)), chance, i);
  }
}

/// See KernelTable::coats.
template <class A, template <class> class Material, template <template <class> class> class Record>
void coats(const ParameterView& table, const Surface<ConstColumn>& surfaces,
           const Coat<Column>& out, uint32_t n) noexcept {
  for (uint32_t i = 0; i < n; i += kLanes<A>) {
    const auto parameters = load_parameters<A, Record>(
        table, only<A>(tail_mask<A>(i, n), load<A>(surfaces.parameter, i)), i);
    store<A>(Material<A>::coat(parameters, view_of<A>(surfaces, i, false).outside), out, i);
  }
}

/// See KernelTable::take_coats.
template <class A>
void take_coats(const Coat<ConstColumn>& from, const uint32_t* order, const Coat<Column>& out,
                uint32_t n) noexcept {
  for (uint32_t row = 0; row < n; row += kLanes<A>) {
    const Coat<Lanes<A>::template Of> c =
        gather<A>(from, near_rows<A>(order, row, n - row < kLanes<A> ? n - row : kLanes<A>));
    store<A>(c, out, row);
  }
}

/// See KernelTable::weigh_child.
template <class A>
void weigh_child(const float* share, const float* chance, const uint32_t* order, uint32_t child,
                 const PathState<Column>& paths, uint32_t n) noexcept {
  const Float<A> one(1.f);
  // Of the child, by that of the second.
  const auto of_child = [&](const Float<A>& second) { return child ? second : one - second; };
  for (uint32_t row = 0; row < n; row += kLanes<A>) {
    const NearRows<A> from = near_rows<A>(order, row, n - row < kLanes<A> ? n - row : kLanes<A>);
    const Float<A> there = share ? of_child(gather<A>(share, from)) : one;
    const Float<A> weight = there / of_child(gather<A>(chance, from));
    store<A>(weight * load<A>(paths.throughput_r, row), paths.throughput_r, row);
    store<A>(weight * load<A>(paths.throughput_g, row), paths.throughput_g, row);
    store<A>(weight * load<A>(paths.throughput_b, row), paths.throughput_b, row);
  }
}

/// See KernelTable::choose_child.
template <class A>
void choose_child(const float* chance, const float* u, uint32_t* child, float* left,
                  uint32_t n) noexcept {
  const Float<A> one(1.f), below_one(1.f - kRounding);
  for (uint32_t i = 0; i < n; i += kLanes<A>) {
    const Float<A> second = load<A>(chance, i), first = one - second, number = load<A>(u, i);
    const Mask<A> takes_second = number >= first;
    const Float<A> rest = select<A>(takes_second, (number - first) / second, number / first);
    store<A>(select<A>(takes_second, UInt<A>(1u), UInt<A>(0u)), child, i);
    // Below one: with a chance of 0 the second child is never taken.
    store<A>(xsimd::min(rest, below_one), left, i);
  }
}

/// See KernelTable::take_rows.
template <class A>
void take_rows(const Surface<ConstColumn>& surfaces, const PathState<ConstColumn>& paths,
               const float* u, const uint32_t* order, bool turned,
               const Surface<Column>& surfaces_out, const PathState<Column>& paths_out,
               float* u_out, uint32_t n) noexcept {
  const Float<A> side(turned ? -1.f : 1.f);
  for (uint32_t row = 0; row < n; row += kLanes<A>) {
    const NearRows<A> from = near_rows<A>(order, row, n - row < kLanes<A> ? n - row : kLanes<A>);
    Surface<Lanes<A>::template Of> s = gather<A>(surfaces, from);
    s.ng_x = side * s.ng_x;
    s.ng_y = side * s.ng_y;
    s.ng_z = side * s.ng_z;
    s.ns_x = side * s.ns_x;
    s.ns_y = side * s.ns_y;
    s.ns_z = side * s.ns_z;
    store<A>(s, surfaces_out, row);
    const PathState<Lanes<A>::template Of> path = gather<A>(paths, from);
    store<A>(path, paths_out, row);
    store<A>(gather<A>(u, from), u_out, row);
  }
}

}  // namespace yat::YAT_ISA

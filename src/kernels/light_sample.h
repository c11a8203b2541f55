#pragma once
// One light and a point on it for every surface.

#include <type_traits>

#include "kernels/light_choice.h"
#include "kernels/lights/constant.h"
#include "kernels/lights/distant.h"
#include "kernels/lights/image.h"
#include "kernels/lights/point.h"
#include "kernels/lights/point_map.h"
#include "kernels/lights/projection.h"
#include "kernels/lights/rectangle.h"
#include "kernels/lights/shape.h"
#include "kernels/lights/sky.h"
#include "kernels/lights/sphere.h"
#include "kernels/lights/spot.h"
#include "kernels/lights/sun.h"
#include "kernels/lights/triangle.h"

namespace yat::YAT_ISA {

/// Distant shadow rays end this many scene sizes away: infinite planes stop them up to there.
inline constexpr float kFarSizes = 65536.f;

template <class A, LightKind kKind>
struct LightOfKind;
template <class A>
struct LightOfKind<A, LightKind::kTriangle> : TriangleLight<A> {};
template <class A>
struct LightOfKind<A, LightKind::kSphere> : SphereLight<A> {};
template <class A>
struct LightOfKind<A, LightKind::kPoint> : PointLight<A> {};
template <class A>
struct LightOfKind<A, LightKind::kDistant> : DistantLight<A> {};
template <class A>
struct LightOfKind<A, LightKind::kRectangle> : RectangleLight<A> {};
template <class A>
struct LightOfKind<A, LightKind::kSpot> : SpotLight<A> {};
template <class A>
struct LightOfKind<A, LightKind::kPointMap> : PointMapLight<A> {};
template <class A>
struct LightOfKind<A, LightKind::kProjection> : ProjectionLight<A> {};
template <class A>
struct LightOfKind<A, LightKind::kConstant> : ConstantLight<A> {};
template <class A>
struct LightOfKind<A, LightKind::kImage> : ImageLight<A> {};
template <class A>
struct LightOfKind<A, LightKind::kSun> : SunLight<A> {};
template <class A>
struct LightOfKind<A, LightKind::kSky> : SkyLight<A> {};

/// The choice and the numbers of a row, for the kinds.
template <class A>
struct LightQuery {
  const LightView& lights;
  const ShapesView& shapes;
  const LightRowW<A>& row;
  Vec3<A> receiver;
  Float<A> far, u, v;
};

/// The pick of kind kKind, merged into `pick` where rows are of that kind.
template <class A, LightKind kKind>
YAT_INLINE void pick_kind(const LightQuery<A>& query, LightPick<A>& pick) {
  const Mask<A> of_kind = mask_of<A>(query.row.kind == UInt<A>(uint32_t(kKind)));
  if (!any<A>(of_kind)) return;
  const LightPick<A> p =
      LightOfKind<A, kKind>::sample(query.row, query.receiver, query.far, query.u, query.v);
  pick.wi = select(of_kind, p.wi, pick.wi);
  pick.to = select(of_kind, p.to, pick.to);
  pick.measure = select<A>(of_kind, p.measure, pick.measure);
  pick.pdf = select<A>(of_kind, p.pdf, pick.pdf);
}
template <class A, LightKind kKind>
YAT_INLINE void pick_shaded_kind(const LightQuery<A>& query, ShadedPick<A>& pick) {
  if (!(query.lights.kinds >> uint32_t(kKind) & 1u)) return;
  const Mask<A> of_kind = mask_of<A>(query.row.kind == UInt<A>(uint32_t(kKind)));
  if (!any<A>(of_kind)) return;
  const ShadedPick<A> p = LightOfKind<A, kKind>::sample(
      query.lights, query.row, of_kind, query.receiver, query.far, query.u, query.v);
  pick.wi = select(of_kind, p.wi, pick.wi);
  pick.to = select(of_kind, p.to, pick.to);
  pick.measure = select<A>(of_kind, p.measure, pick.measure);
  pick.pdf = select<A>(of_kind, p.pdf, pick.pdf);
  pick.shade.r = select<A>(of_kind, p.shade.r, pick.shade.r);
  pick.shade.g = select<A>(of_kind, p.shade.g, pick.shade.g);
  pick.shade.b = select<A>(of_kind, p.shade.b, pick.shade.b);
}

/// The pick of analytic shapes, merged likewise.
template <class A>
YAT_INLINE void pick_shapes(const LightQuery<A>& query, LightPick<A>& pick) {
  if (!(query.lights.kinds >> uint32_t(LightKind::kShape) & 1u)) return;
  const Mask<A> of_kind = mask_of<A>(query.row.kind == UInt<A>(uint32_t(LightKind::kShape)));
  if (!any<A>(of_kind)) return;
  const LightPick<A> p =
      ShapeLight<A>::sample(query.shapes, query.row, of_kind, query.receiver, query.u, query.v);
  pick.wi = select(of_kind, p.wi, pick.wi);
  pick.to = select(of_kind, p.to, pick.to);
  pick.measure = select<A>(of_kind, p.measure, pick.measure);
  pick.pdf = select<A>(of_kind, p.pdf, pick.pdf);
}

/// The pick of any of the first kPlainLightKinds kinds.
template <class A>
YAT_INLINE void pick_plain_kinds(const LightQuery<A>& query, LightPick<A>& pick) {
  pick_kind<A, LightKind::kTriangle>(query, pick);
  pick_kind<A, LightKind::kSphere>(query, pick);
  pick_kind<A, LightKind::kPoint>(query, pick);
  pick_kind<A, LightKind::kDistant>(query, pick);
  pick_kind<A, LightKind::kRectangle>(query, pick);
}

/// Rows of surfaces as the light tree sees them; all_around: lights of either side count alike.
template <class A>
YAT_INLINE LitPoint<A> lit_point(const LightTreeView& tree, const Surface<ConstColumn>& surfaces,
                                 uint32_t i, const Vec3<A>& receiver, bool all_around) {
  const Vec3<A> ng{load<A>(surfaces.ng_x, i), load<A>(surfaces.ng_y, i), load<A>(surfaces.ng_z, i)};
  const Vec3<A> wo{load<A>(surfaces.wo_x, i), load<A>(surfaces.wo_y, i), load<A>(surfaces.wo_z, i)};
  return {LitPoint<A>::to_tree(tree, receiver), select(dot(ng, wo) > Float<A>(0.f), ng, -ng),
          Float<A>(all_around ? 1.f : kLeastCosine)};
}

/// kKernel: a kind of light, kPlainLights or kAnyLights. all_around matters to the tree alone.
/// Without numbers for the choice (and without a tree), those of the place choose (Plan).
/// kKeepRows: the row of each light goes to `light`, which is not looked at otherwise.
template <class A, uint32_t kKernel, bool kByTree, bool kKeepRows = false>
YAT_INLINE void sample_chosen_lights(const SceneView& scene, const Surface<ConstColumn>& surfaces,
                                     const Randoms<ConstColumn>& randoms, bool all_around,
                                     const LightSample<Column>& samples, uint32_t n,
                                     [[maybe_unused]] uint32_t* light = nullptr) noexcept {
  const LightView& lights = scene.lights;
  const bool one_light = !kByTree && lights.rows.count == 1;
  const bool own_number = randoms.light_choice != nullptr;
  const Float<A> zero(0.f), one(1.f);
  LightRowW<A> row;
  constexpr bool kRectangles = kKernel == uint32_t(LightKind::kRectangle);
  [[maybe_unused]] std::conditional_t<kRectangles, typename RectangleLight<A>::Placed, uint32_t>
      placed;
  if (one_light) {
    row = broadcast<A>(lights.rows, 0);
    if constexpr (kRectangles) placed = RectangleLight<A>::place(row);
  }
  for (uint32_t i = 0; i < n; i += kLanes<A>) {
    const Mask<A> active = tail_mask<A>(i, n);
    const Vec3<A> receiver{load<A>(surfaces.pos_x, i), load<A>(surfaces.pos_y, i),
                           load<A>(surfaces.pos_z, i)};
    Float<A> u = load<A>(randoms.light_u, i), v = load<A>(randoms.light_v, i);
    // Padding may hold anything: as an index, only a number that was drawn is safe.
    ChosenLight<A> chosen;
    if constexpr (kByTree) {
      const Float<A> choice = only<A>(active, load<A>(randoms.light_choice, i));
      chosen = choose_light_by_tree<A>(
          lights, lit_point<A>(lights.tree, surfaces, i, receiver, all_around), active, choice);
      row = gather<A>(lights.rows, chosen.row);
    } else if (!one_light) {
      const Float<A> choice = only<A>(active, own_number ? load<A>(randoms.light_choice, i) : u);
      const AliasChoice<A> by_power = choose_light<A>(lights.choice, choice);
      chosen.row = by_power.row;
      row = gather<A>(lights.rows, chosen.row);
      if (!own_number) u = by_power.left;
    } else if constexpr (kKeepRows) {
      chosen.row = UInt<A>(0u);
    }
    if constexpr (kKeepRows) store<A>(chosen.row, light, i);
    const Float<A> far =
        Float<A>(kFarSizes) * xsimd::max(Float<A>(scene.radius), largest_magnitude(receiver));
    if constexpr (kKernel == kAnyLights) {
      // Tables are searched with these.
      u = only<A>(active, u);
      v = only<A>(active, v);
    }
    const LightQuery<A> query{lights, scene.geometry.shapes, row, receiver, far, u, v};
    ShadedPick<A> pick;
    if constexpr (kKernel >= kPlainLights) {
      pick.wi = {zero, zero, one};
      pick.to = receiver;
      pick.measure = pick.pdf = zero;
      pick_plain_kinds<A>(query, pick);
    } else if constexpr (kRectangles) {
      if (!one_light) placed = RectangleLight<A>::place(row);
      static_cast<LightPick<A>&>(pick) = RectangleLight<A>::sample(placed, receiver, u, v);
    } else {
      static_cast<LightPick<A>&>(pick) =
          LightOfKind<A, LightKind(kKernel)>::sample(row, receiver, far, u, v);
    }
    if constexpr (kKernel == kAnyLights) {
      pick_shaded_kind<A, LightKind::kSpot>(query, pick);
      pick_shaded_kind<A, LightKind::kPointMap>(query, pick);
      pick_shaded_kind<A, LightKind::kProjection>(query, pick);
      pick_shapes<A>(query, pick);
      pick_shaded_kind<A, LightKind::kConstant>(query, pick);
      pick_shaded_kind<A, LightKind::kImage>(query, pick);
      pick_shaded_kind<A, LightKind::kSun>(query, pick);
      pick_shaded_kind<A, LightKind::kSky>(query, pick);
    }
    Float<A> chance = chance_of_light<A>(row), nominal = chance;
    if constexpr (kByTree) {
      chance = chance * chosen.chance;
      nominal = nominal * chosen.nominal;
    }
    const Float<A> weight = pick.measure / chance;
    LightSample<Lanes<A>::template Of> out;
    out.wi_x = pick.wi.x;
    out.wi_y = pick.wi.y;
    out.wi_z = pick.wi.z;
    out.to_x = pick.to.x;
    out.to_y = pick.to.y;
    out.to_z = pick.to.z;
    out.weight_r = weight * row.radiance_r;
    out.weight_g = weight * row.radiance_g;
    out.weight_b = weight * row.radiance_b;
    if constexpr (kKernel == kAnyLights) {
      out.weight_r = out.weight_r * pick.shade.r;
      out.weight_g = out.weight_g * pick.shade.g;
      out.weight_b = out.weight_b * pick.shade.b;
    }
    out.pdf = pick.pdf * nominal;
    store<A>(out, samples, i);
  }
}

/// See KernelTable::sample_lights.
template <class A, uint32_t kKernel>
void sample_lights(const SceneView& scene, const Surface<ConstColumn>& surfaces,
                   const Randoms<ConstColumn>& randoms, const LightSample<Column>& samples,
                   uint32_t n) noexcept {
  sample_chosen_lights<A, kKernel, false>(scene, surfaces, randoms, true, samples, n);
}

/// See KernelTable::sample_tree_lights.
template <class A, uint32_t kKernel>
void sample_tree_lights(const SceneView& scene, const Surface<ConstColumn>& surfaces,
                        const Randoms<ConstColumn>& randoms, bool all_around,
                        const LightSample<Column>& samples, uint32_t n) noexcept {
  sample_chosen_lights<A, kKernel, true>(scene, surfaces, randoms, all_around, samples, n);
}

}  // namespace yat::YAT_ISA

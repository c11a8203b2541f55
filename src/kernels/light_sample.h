#pragma once
// One light and a point on it for every surface.

#include "kernels/lights/distant.h"
#include "kernels/lights/point.h"
#include "kernels/lights/sphere.h"
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

/// Alias method (Walker 1977, Vose 1991): one number chooses the interval and, by where in it the
/// number lies, the interval's own row or the other one.
template <class A>
YAT_INLINE UInt<A> choose_light(const LightView& lights, const Float<A>& u) {
  const Float<A> place = u * Float<A>(float(lights.rows.count));
  const Int<A> interval = xsimd::to_int(place);
  const UInt<A> row =
      xsimd::min(xsimd::bitwise_cast<uint32_t>(interval), UInt<A>(lights.rows.count - 1));
  const LightChoice<Lanes<A>::template Of> choice = gather<A>(lights.choice, row);
  return select<A>(place - xsimd::to_float(interval) < choice.threshold, row, choice.other);
}

/// The pick of kind kKind, merged into `pick` where `of_kind` holds.
template <class A, LightKind kKind>
YAT_INLINE void pick_kind(const LightRowW<A>& row, const Vec3<A>& receiver, const Float<A>& far,
                          const Float<A>& u, const Float<A>& v, LightPick<A>& pick) {
  const Mask<A> of_kind = mask_of<A>(row.kind == UInt<A>(uint32_t(kKind)));
  if (!any<A>(of_kind)) return;
  const LightPick<A> p = LightOfKind<A, kKind>::sample(row, receiver, far, u, v);
  pick.wi = select(of_kind, p.wi, pick.wi);
  pick.to = select(of_kind, p.to, pick.to);
  pick.measure = select<A>(of_kind, p.measure, pick.measure);
  pick.pdf = select<A>(of_kind, p.pdf, pick.pdf);
}

/// See KernelTable::sample_lights. kKind = kCount: any mixture.
template <class A, LightKind kKind>
void sample_lights(const SceneView& scene, const Surface<ConstColumn>& surfaces,
                   const Randoms<ConstColumn>& randoms, const LightSample<Column>& samples,
                   uint32_t n) noexcept {
  const LightView& lights = scene.lights;
  const bool one_light = lights.rows.count == 1;
  LightRowW<A> row;
  if (one_light) row = broadcast<A>(lights.rows, 0);
  for (uint32_t i = 0; i < n; i += kLanes<A>) {
    const Mask<A> active = tail_mask<A>(i, n);
    // Padding may hold anything: as an index, only a number that was drawn is safe.
    if (!one_light) {
      const Float<A> choice = only<A>(active, load<A>(randoms.light_choice, i));
      row = gather<A>(lights.rows, choose_light<A>(lights, choice));
    }
    const Vec3<A> receiver{load<A>(surfaces.pos_x, i), load<A>(surfaces.pos_y, i),
                           load<A>(surfaces.pos_z, i)};
    const Float<A> u = load<A>(randoms.light_u, i), v = load<A>(randoms.light_v, i);
    const Float<A> far =
        Float<A>(kFarSizes) * xsimd::max(Float<A>(scene.radius), largest_magnitude(receiver));
    LightPick<A> pick;
    if constexpr (kKind == LightKind::kCount) {
      const Float<A> zero(0.f);
      pick = {{zero, zero, Float<A>(1.f)}, receiver, zero, zero};
      pick_kind<A, LightKind::kTriangle>(row, receiver, far, u, v, pick);
      pick_kind<A, LightKind::kSphere>(row, receiver, far, u, v, pick);
      pick_kind<A, LightKind::kPoint>(row, receiver, far, u, v, pick);
      pick_kind<A, LightKind::kDistant>(row, receiver, far, u, v, pick);
    } else {
      pick = LightOfKind<A, kKind>::sample(row, receiver, far, u, v);
    }
    const Float<A> weight = pick.measure / row.probability;
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
    out.pdf = pick.pdf * row.probability;
    store<A>(out, samples, i);
  }
}

}  // namespace yat::YAT_ISA

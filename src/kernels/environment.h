#pragma once
// The environment as rays see it that leave the scene, weighted against light sampling.

#include "kernels/accumulate.h"
#include "kernels/drop.h"
#include "kernels/light_choice.h"
#include "kernels/lights/constant.h"
#include "kernels/lights/image.h"
#include "kernels/lights/sky.h"
#include "kernels/lights/sun.h"

namespace yat::YAT_ISA {

/// What the environment `row`, the same in all lanes, shows in direction w. asked: surfaces sample
/// it; else no density is needed.
template <class A>
YAT_INLINE SeenEnvironment<A> see_environment(const LightView& lights, LightKind kind,
                                              const LightRowW<A>& row, const Mask<A>& active,
                                              const Vec3<A>& w, bool asked) {
  switch (kind) {
    case LightKind::kImage:
      return ImageLight<A>::see(lights, row, active, w, asked);
    case LightKind::kSun:
      return SunLight<A>::see(lights, row, active, w, asked);
    case LightKind::kSky:
      return SkyLight<A>::see(lights, row, active, w, asked);
    default:
      return ConstantLight<A>::see(lights, row, active, w, asked);
  }
}

/// Words of LightRow::probability and kind in a row.
inline constexpr uint32_t kLightProbabilityWord = 13, kLightKindWord = 14;

/// See KernelTable::add_environment, add_tree_environment. Environments are added up in the order
/// of their rows.
template <class A, bool kByTree = false>
void add_environment(const SceneView& scene, const uint32_t* order, const Ray<ConstColumn>& rays,
                     const Hit<ConstColumn>& hits, const PathState<ConstColumn>& paths,
                     const TransportOptions& options, const SampleSum<Column>& sums, DropLog& log,
                     uint32_t n) noexcept {
  const LightView& lights = scene.lights;
  const Float<A> zero(0.f), one(1.f);
  for (uint32_t i = 0; i < n; i += kLanes<A>) {
    const NearRows<A> at = near_rows<A>(order, i, n - i < kLanes<A> ? n - i : kLanes<A>);
    const UInt<A> prim = gather<A>(hits.prim, at);
    Mask<A> missed = tail_mask<A>(i, n) & mask_of<A>(prim == UInt<A>(kNone));
    if (options.hide_environment) {
      const UInt<A> vertex = gather<A>(paths.depth, at) & UInt<A>(0xffffu);
      missed = missed & mask_of<A>(vertex != UInt<A>(0u));
    }
    if (!any<A>(missed)) continue;
    const PathState<Lanes<A>::template Of> path = gather<A>(paths, at);
    const Vec3<A> w{gather<A>(rays.dir_x, at), gather<A>(rays.dir_y, at),
                    gather<A>(rays.dir_z, at)};
    alignas(64) uint32_t pixel[kLanes<A>], sample[kLanes<A>];
    path.pixel.store_aligned(pixel);
    path.sample.store_aligned(sample);
    drop_lanes<A>(missed, !is_finite_positive<A>(path.pdf), DropCause::kPdf, pixel, sample, log);

    Float<A> chosen = one;
    if constexpr (kByTree) {
      const Vec3<A> origin{gather<A>(rays.org_x, at), gather<A>(rays.org_y, at),
                           gather<A>(rays.org_z, at)};
      // The first far light stands for all of them.
      chosen = chance_in_tree<A>(lights.tree, origin - path.passed * w,
                                 UInt<A>(lights.tree.first_far), missed);
    }
    Float<A> r(0.f), g(0.f), b(0.f);
    for (uint32_t light = lights.first_environment; light < lights.rows.count; ++light) {
      const LightRowW<A> row = broadcast<A>(lights.rows, light);
      const uint32_t* const words = lights.rows.words + size_t(light) * row_words<LightRow>;
      const SeenEnvironment<A> seen =
          see_environment<A>(lights, LightKind(words[kLightKindWord]), row, missed, w,
                             words[kLightProbabilityWord] != 0);
      const Float<A> weight =
          select<A>(path.pdf == zero, one,
                    power_heuristic<A>(path.pdf, seen.pdf * (chosen * chance_of_light<A>(row))));
      r = r + weight * row.radiance_r * seen.shade.r;
      g = g + weight * row.radiance_g * seen.shade.g;
      b = b + weight * row.radiance_b * seen.shade.b;
    }
    drop_lanes<A>(missed,
                  !(is_finite_positive<A>(r) & is_finite_positive<A>(g) & is_finite_positive<A>(b)),
                  DropCause::kLight, pixel, sample, log);
    r = r * path.throughput_r;
    g = g * path.throughput_g;
    b = b * path.throughput_b;
    drop_lanes<A>(missed, !(is_finite<A>(r) & is_finite<A>(g) & is_finite<A>(b)), DropCause::kOther,
                  pixel, sample, log);
    add_to_samples<A>(r, g, b, path.slot, missed, sums);
  }
}

}  // namespace yat::YAT_ISA

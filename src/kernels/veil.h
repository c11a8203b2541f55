#pragma once
// Veils: surfaces that let a part of the light pass. Shadow rays that nothing solid stops are
// walked through them one by one, as paths of their own:
//
//   ShadowRay ─> Ray, PathState ─> intersect (the tree of veils alone) ─> sort ─> surface
//     ─> [share_weight, veil: what passes] ─> pass_veils ─> Ray, PathState ... ─> end_veils
//
// In these PathState rows, throughput is what the light still brings, `passed` the way so far, and
// `pdf` the whole way to the light [m].

#include "kernels/accumulate.h"
#include "kernels/split.h"

namespace yat::YAT_ISA {

/// See KernelTable::start_veils.
template <class A>
uint32_t start_veils(const ShadowRay<ConstColumn>& shadow, const uint32_t* occluded,
                     const Ray<Column>& rays, const PathState<Column>& paths, uint32_t n) noexcept {
  uint32_t count = 0;
  for (uint32_t row = 0; row < n; row += kLanes<A>) {
    const Mask<A> free = mask_of<A>(load<A>(occluded, row) == UInt<A>(0u)) & tail_mask<A>(row, n);
    if (!any<A>(free)) continue;
    const ShadowRay<Lanes<A>::template Of> from = load<A>(shadow, row);
    const Vec3<A> way{from.dir_x, from.dir_y, from.dir_z};
    // Scaled first: a way may be as long as floats go.
    const Float<A> scale = largest_magnitude(way);
    const Vec3<A> scaled = (Float<A>(1.f) / scale) * way;
    const Float<A> stretch = length(scaled);
    const Vec3<A> dir = (Float<A>(1.f) / stretch) * scaled;
    Ray<Lanes<A>::template Of> ray;
    ray.org_x = from.org_x;
    ray.org_y = from.org_y;
    ray.org_z = from.org_z;
    ray.dir_x = dir.x;
    ray.dir_y = dir.y;
    ray.dir_z = dir.z;
    ray.t_max = scale * stretch;
    PathState<Lanes<A>::template Of> path;
    path.throughput_r = from.add_r;
    path.throughput_g = from.add_g;
    path.throughput_b = from.add_b;
    path.pdf = ray.t_max;
    path.passed = Float<A>(0.f);
    path.slot = from.slot;
    path.pixel = path.sample = path.depth = UInt<A>(0u);
    store_packed<A>(ray, free, rays, count);
    store_packed<A>(path, free, paths, count);
    count += count_true<A>(free);
  }
  return count;
}

/// See KernelTable::share_weight.
template <class A>
void share_weight(const float* weight, const float* share, float* first, float* second,
                  uint32_t n) noexcept {
  for (uint32_t i = 0; i < n; i += kLanes<A>) {
    const Float<A> w = load<A>(weight, i), s = load<A>(share, i);
    store<A>(w * (Float<A>(1.f) - s), first, i);
    store<A>(w * s, second, i);
  }
}

/// See KernelTable::veil.
template <class A, template <class> class Material, template <template <class> class> class Record>
void veil(const ParameterView& table, const Surface<ConstColumn>& surfaces, bool turned,
          const float* weight, float* r, float* g, float* b, uint32_t n) noexcept {
  for (uint32_t i = 0; i < n; i += kLanes<A>) {
    const auto parameters = load_parameters<A, Record>(
        table, only<A>(tail_mask<A>(i, n), load<A>(surfaces.parameter, i)), i);
    const Spectrum<A> passed =
        load<A>(weight, i) *
        Material<A>::transmittance(parameters, view_of<A>(surfaces, i, turned));
    store<A>(load<A>(r, i) + passed.r, r, i);
    store<A>(load<A>(g, i) + passed.g, g, i);
    store<A>(load<A>(b, i) + passed.b, b, i);
  }
}

/// See KernelTable::pass_veils.
template <class A>
uint32_t pass_veils(const Surface<ConstColumn>& surfaces, const PathState<ConstColumn>& paths,
                    const float* r, const float* g, const float* b, const Ray<Column>& rays_out,
                    const PathState<Column>& paths_out, uint32_t count, uint32_t n) noexcept {
  const Float<A> zero(0.f);
  for (uint32_t i = 0; i < n; i += kLanes<A>) {
    PathState<Lanes<A>::template Of> path = load<A>(paths, i);
    path.throughput_r = path.throughput_r * load<A>(r, i);
    path.throughput_g = path.throughput_g * load<A>(g, i);
    path.throughput_b = path.throughput_b * load<A>(b, i);
    const Mask<A> alive =
        tail_mask<A>(i, n) &
        is_not_black<A>(Spectrum<A>{path.throughput_r, path.throughput_g, path.throughput_b});
    const Vec3<A> pos{load<A>(surfaces.pos_x, i), load<A>(surfaces.pos_y, i),
                      load<A>(surfaces.pos_z, i)};
    const Vec3<A> ng{load<A>(surfaces.ng_x, i), load<A>(surfaces.ng_y, i),
                     load<A>(surfaces.ng_z, i)};
    const Vec3<A> dir{-load<A>(surfaces.wo_x, i), -load<A>(surfaces.wo_y, i),
                      -load<A>(surfaces.wo_z, i)};
    const Vec3<A> org = spawn_point<A>(pos, load<A>(surfaces.offset, i), ng, dot(ng, dir) > zero);
    // The way along the ray to where it starts again counts: the light's own surface, kept off by
    // as little, must not come within reach.
    path.passed = load<A>(surfaces.distance, i) + dot(org - pos, dir);
    Ray<Lanes<A>::template Of> ray;
    ray.org_x = org.x;
    ray.org_y = org.y;
    ray.org_z = org.z;
    ray.dir_x = dir.x;
    ray.dir_y = dir.y;
    ray.dir_z = dir.z;
    // At the light already: one more search finds nothing, and what is left arrives.
    ray.t_max = xsimd::max(path.pdf * Float<A>(1.f - 8 * kRounding) - path.passed, zero);
    store_packed<A>(ray, alive, rays_out, count);
    store_packed<A>(path, alive, paths_out, count);
    count += count_true<A>(alive);
  }
  return count;
}

/// See KernelTable::end_veils.
template <class A>
void end_veils(const uint32_t* bin, const PathState<ConstColumn>& paths,
               const SampleSum<Column>& sums, uint32_t n) noexcept {
  for (uint32_t row = 0; row < n; row += kLanes<A>) {
    const Mask<A> through = mask_of<A>(load<A>(bin, row) == UInt<A>(0u)) & tail_mask<A>(row, n);
    if (!any<A>(through)) continue;
    add_to_samples<A>(load<A>(paths.throughput_r, row), load<A>(paths.throughput_g, row),
                      load<A>(paths.throughput_b, row), load<A>(paths.slot, row), through, sums);
  }
}

}  // namespace yat::YAT_ISA

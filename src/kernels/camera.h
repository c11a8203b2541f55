#pragma once
// Camera rays: place in the pixel filter, direction, lens, near and far plane.

#include "kernels/sampling.h"
#include "kernels/table.h"
#include "kernels/vec.h"

namespace yat::YAT_ISA {

template <class A>
struct FilterSample {
  Float<A> x, y;    ///< offset from the pixel centre [pixels]
  Float<A> weight;  ///< FilterView::sign of the cell
};

/// Inverts a piecewise linear cumulative distribution of kFilterBins cells at table + row.
/// Returns the place in [0, kFilterBins] and the cell.
template <class A>
struct CellSample {
  Float<A> place;
  UInt<A> cell;
};
template <class A>
YAT_INLINE CellSample<A> invert_cumulative(const float* table, const UInt<A>& row,
                                           const Float<A>& u) {
  // The last cell whose start is not above u. A cell without mass ends where it starts, so that it
  // is passed over.
  UInt<A> cell(0u);
  for (uint32_t step = kFilterBins / 2; step; step /= 2) {
    const Float<A> start = gather<A>(table, row + cell + UInt<A>(step));
    cell = select<A>(start <= u, cell + UInt<A>(step), cell);
  }
  const Float<A> start = gather<A>(table, row + cell),
                 end = gather<A>(table, row + cell + UInt<A>(1u));
  const Float<A> mass = end - start, zero(0.f);
  Float<A> inside = xsimd::select(mass > zero, (u - start) / mass, zero);
  inside = xsimd::min(xsimd::max(inside, zero), Float<A>(1.f));
  return {xsimd::to_float(xsimd::bitwise_cast<int32_t>(cell)) + inside, cell};
}

/// Inverse of a cumulative distribution given by its kFilterQuantiles + 1 quantiles, linear in
/// between.
template <class A>
YAT_INLINE Float<A> quantile(const float* table, const Float<A>& u) {
  const Float<A> place = u * Float<A>(float(kFilterQuantiles));
  const Int<A> k = xsimd::to_int(place);
  const UInt<A> row = xsimd::min(xsimd::bitwise_cast<uint32_t>(k), UInt<A>(kFilterQuantiles - 1));
  const Float<A> low = gather<A>(table, row), high = gather<A>(table, row + UInt<A>(1u));
  return low + (place - xsimd::to_float(k)) * (high - low);
}

template <class A, FilterKind kKind>
YAT_INLINE FilterSample<A> sample_filter(const FilterView& filter, const Float<A>& u,
                                         const Float<A>& v) {
  const Float<A> one(1.f), two(2.f);
  if constexpr (kKind == FilterKind::kBox)
    return {(two * u - one) * Float<A>(filter.radius_x),
            (two * v - one) * Float<A>(filter.radius_y), one};
  if constexpr (kKind == FilterKind::kProduct)
    return {quantile<A>(filter.quantile_x, u) * Float<A>(filter.radius_x),
            quantile<A>(filter.quantile_y, v) * Float<A>(filter.radius_y), one};
  if constexpr (kKind == FilterKind::kTable) {
    const CellSample<A> y = invert_cumulative<A>(filter.marginal, UInt<A>(0u), v);
    const CellSample<A> x =
        invert_cumulative<A>(filter.conditional, y.cell * UInt<A>(kFilterBins + 1), u);
    const Float<A> scale(2.f / kFilterBins);
    return {(x.place * scale - one) * Float<A>(filter.radius_x),
            (y.place * scale - one) * Float<A>(filter.radius_y),
            gather<A>(filter.sign, y.cell * UInt<A>(kFilterBins) + x.cell)};
  }
}

/// Source: lxs 3.2 (perspective, thin lens). The lens shift is divided by the focal distance
/// rather than the direction multiplied by it: a focal distance of 1e30 stays finite.
template <class A, bool kThinLens, FilterKind kFilter>
YAT_INLINE void generate_rows(const SceneView& scene, const CameraSample<ConstColumn>& samples,
                              const float* film_u, const float* film_v, const float* lens_u,
                              const float* lens_v, const Ray<Column>& rays,
                              const PathState<Column>& paths, uint32_t n) noexcept {
  const CameraView& camera = scene.camera;
  const Float<A> one(1.f), zero(0.f), half(.5f);
  const auto broadcast3 = [](const float* p) {
    return Vec3<A>{Float<A>(p[0]), Float<A>(p[1]), Float<A>(p[2])};
  };
  for (uint32_t row = 0; row < n; row += kLanes<A>) {
    // Padding may hold anything: as an index, only a number that was drawn is safe.
    const Mask<A> active = tail_mask<A>(row, n);
    const auto film_number = [&active](const float* column, uint32_t first) {
      return only<A>(active, load<A>(column, first));
    };
    const CameraSample<Lanes<A>::template Of> sample = load<A>(samples, row);
    const FilterSample<A> offset =
        sample_filter<A, kFilter>(scene.filter, film_number(film_u, row), film_number(film_v, row));
    const auto to_float = [](const UInt<A>& v) {
      return xsimd::to_float(xsimd::bitwise_cast<int32_t>(v));
    };
    const Float<A> x = to_float(sample.pixel & UInt<A>(0xffffu)) + half + offset.x;
    const Float<A> y = to_float(sample.pixel >> 16) + half + offset.y;
    // Unit along the view axis.
    Vec3<A> to = broadcast3(camera.corner) + x * broadcast3(camera.dx) + y * broadcast3(camera.dy);
    Vec3<A> from = broadcast3(camera.origin);
    if constexpr (kThinLens) {
      const Point2<A> lens = square_to_disc<A>(load<A>(lens_u, row), load<A>(lens_v, row));
      const Vec3<A> shift = lens.x * broadcast3(camera.lens_x) + lens.y * broadcast3(camera.lens_y);
      from = from + shift;
      to = to - Float<A>(1.f / camera.focal_distance) * shift;
    }
    const Float<A> stretch = length(to);
    const Vec3<A> dir = (one / stretch) * to;
    from = from + Float<A>(camera.near_depth) * to;
    Ray<Lanes<A>::template Of> ray;
    ray.org_x = from.x;
    ray.org_y = from.y;
    ray.org_z = from.z;
    ray.dir_x = dir.x;
    ray.dir_y = dir.y;
    ray.dir_z = dir.z;
    ray.t_max =
        xsimd::min(Float<A>(camera.far_depth - camera.near_depth) * stretch, Float<A>(kRayFar));
    store<A>(ray, rays, row);
    PathState<Lanes<A>::template Of> path;
    path.throughput_r = path.throughput_g = path.throughput_b = offset.weight;
    path.pdf = path.passed = zero;
    path.slot = sample.slot;
    path.pixel = sample.pixel;
    path.sample = sample.sample;
    path.depth = UInt<A>(0u);
    store<A>(path, paths, row);
  }
}

/// See KernelTable::generate_camera_rays. The filter's kind is asked before the loop.
template <class A, bool kThinLens>
void generate_camera_rays(const SceneView& scene, const CameraSample<ConstColumn>& samples,
                          const float* film_u, const float* film_v, const float* lens_u,
                          const float* lens_v, const Ray<Column>& rays,
                          const PathState<Column>& paths, uint32_t n) noexcept {
  const auto run = [&]<FilterKind kFilter>(std::integral_constant<FilterKind, kFilter>) {
    generate_rows<A, kThinLens, kFilter>(scene, samples, film_u, film_v, lens_u, lens_v, rays,
                                         paths, n);
  };
  switch (scene.filter.kind) {
    case FilterKind::kBox:
      return run(std::integral_constant<FilterKind, FilterKind::kBox>{});
    case FilterKind::kProduct:
      return run(std::integral_constant<FilterKind, FilterKind::kProduct>{});
    case FilterKind::kTable:
      return run(std::integral_constant<FilterKind, FilterKind::kTable>{});
  }
}

}  // namespace yat::YAT_ISA

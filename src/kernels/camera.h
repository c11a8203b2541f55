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

/// A point of the unit disc's regular polygon with `blades` corners, the first on +x; uniform.
template <class A>
YAT_INLINE Point2<A> square_to_polygon(uint32_t blades, const Float<A>& u, const Float<A>& v) {
  // A sector by u, and what is left of u and v for a point of its triangle.
  const Float<A> place = u * Float<A>(float(blades));
  const Float<A> sector =
      xsimd::min(xsimd::to_float(xsimd::to_int(place)), Float<A>(float(blades - 1)));
  const Point2<A> b = square_to_triangle<A>(xsimd::min(place - sector, Float<A>(1.f)), v);
  const Float<A> turn(1.f / float(blades));
  const SinCos<A> first = sin_cos_turns<A>(sector * turn);
  const Float<A> next_sector = sector + Float<A>(1.f);
  const SinCos<A> next = sin_cos_turns<A>(
      xsimd::select(next_sector >= Float<A>(float(blades)), Float<A>(0.f), next_sector * turn));
  return {b.x * first.cos + b.y * next.cos, b.x * first.sin + b.y * next.sin};
}

/// A ray before its length is known. `seen` is 0 where the camera sees nothing.
template <class A>
struct CameraRay {
  Vec3<A> from, dir;  ///< dir unit
  Float<A> t_max, seen;
};

template <class A>
YAT_INLINE Vec3<A> broadcast3(const float* p) {
  return {Float<A>(p[0]), Float<A>(p[1]), Float<A>(p[2])};
}

/// Source: lxs 3.2 (perspective, thin lens). The lens shift is divided by the focal distance
/// rather than the direction multiplied by it: a focal distance of 1e30 stays finite.
template <class A, CameraKind kKind>
YAT_INLINE CameraRay<A> perspective_ray(const CameraView& camera, const Float<A>& x,
                                        const Float<A>& y, const Float<A>& u, const Float<A>& v) {
  // Unit along the view axis.
  Vec3<A> to =
      broadcast3<A>(camera.corner) + x * broadcast3<A>(camera.dx) + y * broadcast3<A>(camera.dy);
  Vec3<A> from = broadcast3<A>(camera.origin);
  if constexpr (has_lens(kKind)) {
    Point2<A> lens;
    if constexpr (kKind == CameraKind::kPolygonLens)
      lens = square_to_polygon<A>(camera.blades, u, v);
    else
      lens = square_to_disc<A>(u, v);
    const Vec3<A> shift =
        lens.x * broadcast3<A>(camera.lens_x) + lens.y * broadcast3<A>(camera.lens_y);
    from = from + shift;
    to = to - Float<A>(1.f / camera.focal_distance) * shift;
  }
  const Float<A> one(1.f), stretch = length(to);
  return {from + Float<A>(camera.near_depth) * to, (one / stretch) * to,
          Float<A>(camera.far_depth - camera.near_depth) * stretch, one};
}

/// Source: lxs 3.3.
template <class A>
YAT_INLINE CameraRay<A> orthographic_ray(const CameraView& camera, const Float<A>& x,
                                         const Float<A>& y) {
  const Vec3<A> from =
      broadcast3<A>(camera.corner) + x * broadcast3<A>(camera.dx) + y * broadcast3<A>(camera.dy);
  const Vec3<A> dir = broadcast3<A>(camera.forward);
  return {from + Float<A>(camera.near_depth) * dir, dir,
          Float<A>(camera.far_depth - camera.near_depth), Float<A>(1.f)};
}

template <class A>
YAT_INLINE CameraRay<A> environment_ray(const CameraView& camera, const Float<A>& x,
                                        const Float<A>& y) {
  const Float<A> zero(0.f), half(.5f);
  // The filter reaches over the edges: around in x, and no farther than the poles in y.
  const Float<A> across = x * Float<A>(camera.step_x);
  const SinCos<A> phi = sin_cos_turns<A>(across - xsimd::floor(across));
  const Float<A> down = xsimd::min(xsimd::max(y * Float<A>(camera.step_y), zero), Float<A>(1.f));
  const SinCos<A> theta = sin_cos_turns<A>(half * down);
  const Vec3<A> to = -(theta.sin * phi.sin) * broadcast3<A>(camera.dx) +
                     theta.cos * broadcast3<A>(camera.dy) -
                     theta.sin * phi.cos * broadcast3<A>(camera.forward);
  return {broadcast3<A>(camera.origin), normalize(to), Float<A>(kRayFar), Float<A>(1.f)};
}

/// Source: lxs 12.3.
template <class A>
YAT_INLINE CameraRay<A> fisheye_ray(const CameraView& camera, const Float<A>& x,
                                    const Float<A>& y) {
  const Float<A> zero(0.f), one(1.f);
  const Float<A> rx = x * Float<A>(camera.step_x) - one, ry = one - y * Float<A>(camera.step_y);
  const Float<A> r = xsimd::sqrt(rx * rx + ry * ry);
  const Mask<A> inside = r <= one;
  // Whole turns change nothing: any half angle will do.
  const Float<A> turns = xsimd::min(r, one) * Float<A>(camera.half_angle);
  const SinCos<A> psi = sin_cos_turns<A>(turns - xsimd::floor(turns));
  const Float<A> across = xsimd::select(r > zero, psi.sin / r, zero);
  const Vec3<A> to = across * rx * broadcast3<A>(camera.dx) +
                     across * ry * broadcast3<A>(camera.dy) +
                     psi.cos * broadcast3<A>(camera.forward);
  return {broadcast3<A>(camera.origin), normalize(to), only<A>(inside, Float<A>(kRayFar)),
          only<A>(inside, one)};
}

template <class A, CameraKind kKind, FilterKind kFilter>
YAT_INLINE void generate_rows(const SceneView& scene, const CameraSample<ConstColumn>& samples,
                              const float* film_u, const float* film_v, const float* lens_u,
                              const float* lens_v, const Ray<Column>& rays,
                              const PathState<Column>& paths, uint32_t n) noexcept {
  const CameraView& camera = scene.camera;
  const Float<A> zero(0.f), half(.5f);
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
    CameraRay<A> seen;
    if constexpr (kKind == CameraKind::kOrthographic)
      seen = orthographic_ray<A>(camera, x, y);
    else if constexpr (kKind == CameraKind::kEnvironment)
      seen = environment_ray<A>(camera, x, y);
    else if constexpr (kKind == CameraKind::kFisheye)
      seen = fisheye_ray<A>(camera, x, y);
    else if constexpr (has_lens(kKind))
      seen = perspective_ray<A, kKind>(camera, x, y, load<A>(lens_u, row), load<A>(lens_v, row));
    else
      seen = perspective_ray<A, kKind>(camera, x, y, zero, zero);
    Ray<Lanes<A>::template Of> ray;
    ray.org_x = seen.from.x;
    ray.org_y = seen.from.y;
    ray.org_z = seen.from.z;
    ray.dir_x = seen.dir.x;
    ray.dir_y = seen.dir.y;
    ray.dir_z = seen.dir.z;
    ray.t_max = xsimd::min(seen.t_max, Float<A>(kRayFar));
    store<A>(ray, rays, row);
    PathState<Lanes<A>::template Of> path;
    path.throughput_r = path.throughput_g = path.throughput_b = offset.weight;
    // Where nothing is seen the ray has no length, and what it misses has no weight.
    if constexpr (kKind == CameraKind::kFisheye)
      path.throughput_r = path.throughput_g = path.throughput_b = offset.weight * seen.seen;
    path.pdf = path.passed = zero;
    path.slot = sample.slot;
    path.pixel = sample.pixel;
    path.sample = sample.sample;
    path.depth = UInt<A>(0u);
    store<A>(path, paths, row);
  }
}

/// See KernelTable::generate_camera_rays. The filter's kind is asked before the loop.
template <class A, CameraKind kKind>
void generate_camera_rays(const SceneView& scene, const CameraSample<ConstColumn>& samples,
                          const float* film_u, const float* film_v, const float* lens_u,
                          const float* lens_v, const Ray<Column>& rays,
                          const PathState<Column>& paths, uint32_t n) noexcept {
  const auto run = [&]<FilterKind kFilter>(std::integral_constant<FilterKind, kFilter>) {
    generate_rows<A, kKind, kFilter>(scene, samples, film_u, film_v, lens_u, lens_v, rays, paths,
                                     n);
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

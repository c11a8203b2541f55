#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/rng_scalar.h"
#include "wavefront/reference_parts.h"

namespace yat::reference {

namespace {

constexpr double kPi = std::numbers::pi;

/// A number in one of the kFilterBins cells of a cumulative table, in [0, kFilterBins].
struct CellPlace {
  double place;
  uint32_t cell;
};
CellPlace invert(const float* cumulative, double u) {
  uint32_t cell = 0;
  while (cell + 1 < kFilterBins && double(cumulative[cell + 1]) <= u) ++cell;
  const double start = double(cumulative[cell]), end = double(cumulative[cell + 1]);
  const double inside = end > start ? std::clamp((u - start) / (end - start), 0.0, 1.0) : 0;
  return {cell + inside, cell};
}

/// Inverse of a cumulative distribution given by its quantiles, linear in between.
double quantile(const float* table, double u) {
  const double place = u * kFilterQuantiles;
  const auto k = std::min(uint32_t(place), kFilterQuantiles - 1);
  return double(table[k]) + (place - k) * (double(table[k + 1]) - double(table[k]));
}

Vec vec(const float* p) {
  return {p[0], p[1], p[2]};
}

/// A point of a regular polygon inscribed in the unit circle: a triangle between its middle and two
/// corners, and Heitz's map (2019) for a point of that.
glm::dvec2 polygon(uint32_t blades, double u, double v) {
  const double place = u * blades, sector = std::min(std::floor(place), double(blades) - 1);
  const double a = std::min(place - sector, 1.0);
  const double b1 = v > a ? a / 2 : a - v / 2, b2 = v > a ? v - a / 2 : v / 2;
  const double first = 2 * kPi * sector / blades, next = 2 * kPi * (sector + 1) / blades;
  return {b1 * std::cos(first) + b2 * std::cos(next), b1 * std::sin(first) + b2 * std::sin(next)};
}

RaySegment perspective(const CameraView& camera, double px, double py, const glm::dvec2& lens) {
  Vec to = vec(camera.corner) + px * vec(camera.dx) + py * vec(camera.dy);
  Vec from = vec(camera.origin);
  if (lens.x != 0 || lens.y != 0) {
    // The point in focus stays where it is.
    const Vec focus = from + double(camera.focal_distance) * to;
    from += lens.x * vec(camera.lens_x) + lens.y * vec(camera.lens_y);
    to = (focus - from) / double(camera.focal_distance);
  }
  // `to` is 1 along the view axis: near and far are depths.
  const double stretch = glm::length(to);
  return {from + double(camera.near_depth) * to, to / stretch,
          (double(camera.far_depth) - double(camera.near_depth)) * stretch};
}

}  // namespace

RaySegment camera_segment(const CameraView& camera, CameraKind kind, double px, double py, double u,
                          double v) {
  const Vec forward = vec(camera.forward);
  switch (kind) {
    case CameraKind::kThinLens:
      return perspective(camera, px, py, disc(u, v));
    case CameraKind::kPolygonLens:
      return perspective(camera, px, py, polygon(camera.blades, u, v));
    case CameraKind::kOrthographic: {
      const Vec from = vec(camera.corner) + px * vec(camera.dx) + py * vec(camera.dy);
      return {from + double(camera.near_depth) * forward, forward,
              double(camera.far_depth) - double(camera.near_depth)};
    }
    case CameraKind::kEnvironment: {
      const double phi = 2 * kPi * px * double(camera.step_x);
      const double theta = kPi * std::clamp(py * double(camera.step_y), 0.0, 1.0);
      const Vec to = -std::sin(theta) * std::sin(phi) * vec(camera.dx) +
                     std::cos(theta) * vec(camera.dy) - std::sin(theta) * std::cos(phi) * forward;
      return {vec(camera.origin), glm::normalize(to), double(kRayFar)};
    }
    case CameraKind::kFisheye: {
      const double x = px * double(camera.step_x) - 1, y = 1 - py * double(camera.step_y);
      const double r = std::hypot(x, y), alpha = std::atan2(y, x);
      const double psi = std::min(r, 1.0) * double(camera.half_angle) * 2 * kPi;
      const Vec to = std::sin(psi) * std::cos(alpha) * vec(camera.dx) +
                     std::sin(psi) * std::sin(alpha) * vec(camera.dy) + std::cos(psi) * forward;
      return {vec(camera.origin), glm::normalize(to), r <= 1 ? double(kRayFar) : 0};
    }
    case CameraKind::kPinhole:
    case CameraKind::kCount:
      break;
  }
  return perspective(camera, px, py, glm::dvec2(0));
}

CameraStart camera_ray(const Scene& scene, const Plan& plan, uint32_t x, uint32_t y,
                       uint32_t sample) {
  const uint32_t pixel = y << 16 | x;
  const DrawKey key = plan.draw_key();
  const SceneView view = scene.view();
  const FilterView& filter = view.filter;
  const auto [u, v] = random_pair(plan.sampler, key, Dimension::kFilm, pixel, sample, 0);
  CameraStart start{};
  double dx = 2 * double(u) - 1, dy = 2 * double(v) - 1;
  start.weight = 1;
  if (filter.kind == FilterKind::kProduct) {
    dx = quantile(filter.quantile_x, double(u));
    dy = quantile(filter.quantile_y, double(v));
  } else if (filter.kind == FilterKind::kTable) {
    const CellPlace row = invert(filter.marginal, double(v));
    const CellPlace column = invert(filter.conditional + row.cell * (kFilterBins + 1), double(u));
    dx = column.place * 2 / kFilterBins - 1;
    dy = row.place * 2 / kFilterBins - 1;
    start.weight = double(filter.sign[row.cell * kFilterBins + column.cell]);
  }
  const double px = x + .5 + dx * double(filter.radius_x);
  const double py = y + .5 + dy * double(filter.radius_y);
  std::pair<float, float> lens{.5f, .5f};
  if (has_lens(plan.camera))
    lens = random_pair(plan.sampler, key, Dimension::kLens, pixel, sample, 0);
  start.ray =
      camera_segment(view.camera, plan.camera, px, py, double(lens.first), double(lens.second));
  if (start.ray.t_max == 0) start.weight = 0;  // beyond the fisheye's circle
  return start;
}

}  // namespace yat::reference

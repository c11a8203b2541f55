#include "wavefront/reference.h"

#include <algorithm>
#include <cmath>

#include "kernels/rng_scalar.h"
#include "wavefront/reference_parts.h"

namespace yat {

namespace reference {
namespace {

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

struct CameraStart {
  RaySegment ray;
  double weight;  ///< sign of the pixel filter
};

/// lxs 3.2, with the camera as an affine map (CameraView).
CameraStart camera_ray(const Scene& scene, const Plan& plan, uint32_t x, uint32_t y,
                       uint32_t sample) {
  const uint32_t pixel = y << 16 | x, seed = plan.transport.seed;
  const SceneView view = scene.view();
  const FilterView& filter = view.filter;
  const auto [u, v] = random_pair(plan.sampler, seed, Dimension::kFilm, pixel, sample, 0);
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
  const auto vec = [](const float* p) { return Vec(p[0], p[1], p[2]); };
  const CameraView& camera = view.camera;
  const double px = x + .5 + dx * double(filter.radius_x);
  const double py = y + .5 + dy * double(filter.radius_y);
  Vec to = vec(camera.corner) + px * vec(camera.dx) + py * vec(camera.dy);
  Vec from = vec(camera.origin);
  if (plan.thin_lens) {
    const auto [lu, lv] = random_pair(plan.sampler, seed, Dimension::kLens, pixel, sample, 0);
    const glm::dvec2 lens = disc(double(lu), double(lv));
    const Vec shift = lens.x * vec(camera.lens_x) + lens.y * vec(camera.lens_y);
    // The point in focus stays where it is.
    const Vec focus = from + double(camera.focal_distance) * to;
    from += shift;
    to = (focus - from) / double(camera.focal_distance);
  }
  // `to` is 1 along the view axis: near and far are depths.
  const double stretch = glm::length(to);
  start.ray.origin = from + double(camera.near_depth) * to;
  start.ray.direction = to / stretch;
  start.ray.t_max = (double(camera.far_depth) - double(camera.near_depth)) * stretch;
  return start;
}

double power_heuristic(double own, double other) {
  return own * own / (own * own + other * other);
}

bool black(const Vec& c) {
  return c.x == 0 && c.y == 0 && c.z == 0;
}

}  // namespace
}  // namespace reference

glm::dvec3 reference_sample(const Scene& scene, const Plan& plan, uint32_t x, uint32_t y,
                            uint32_t sample) {
  using namespace reference;
  const TransportOptions& options = plan.transport;
  const uint32_t pixel = y << 16 | x;
  uint32_t vertex = 0;
  const auto random = [&](Dimension dimension) {
    return random_pair(plan.sampler, options.seed, dimension, pixel, sample, vertex);
  };

  const CameraStart start = camera_ray(scene, plan, x, y, sample);
  RaySegment ray = start.ray;
  Vec throughput(start.weight), radiance(0.0);
  double scattered_pdf = 0;  // of the direction under way
  uint32_t crossed = 0;      // surfaces that the path went through
  Vec scattered_at(0.0);     // last scattering vertex
  double passed = 0;         // from there to the ray's origin
  for (;;) {
    const std::optional<Point> hit = nearest(scene, ray);
    if (!hit) {
      if (options.hide_environment && vertex == 0) break;
      for (uint32_t i = scene.first_environment; i < scene.lights.size(); ++i) {
        const SeenEnvironment seen = see_environment(scene, i, ray.direction);
        const double weight = scattered_pdf > 0 ? power_heuristic(scattered_pdf, seen.pdf) : 1;
        radiance += throughput * seen.radiance * weight;
      }
      break;
    }
    const Vec wo = -ray.direction;
    const bool met_outside = glm::dot(hit->ng, wo) > 0;
    const float child = random_pair(plan.sampler, options.seed, Dimension::kChild, pixel, sample,
                                    crossed << 16 | vertex)
                            .first;
    const ChosenMaterial chosen = choose_material(scene, *hit, met_outside, child);
    const MaterialKind material = chosen.kind;

    if (const double cos = glm::dot(hit->ng, wo); hit->light != kNone && cos > 0) {
      double weight = 1;
      if (scattered_pdf > 0)
        weight = power_heuristic(scattered_pdf, light_pdf(scene, scattered_at, *hit, cos));
      radiance += throughput * light_radiance(scene, hit->light) * weight;
    }
    if (material_traits(material).see_through) {
      ray.origin = hit->position +
                   (glm::dot(hit->ng, ray.direction) > 0 ? 1.0 : -1.0) * hit->offset * hit->ng;
      ray.t_max = double(kRayFar);
      passed += hit->t;
      ++crossed;
      continue;
    }
    if (vertex >= options.max_depth) break;

    // Everything on the viewer's side.
    const bool outside = met_outside != chosen.turned;
    const Vec ng = met_outside ? hit->ng : -hit->ng, turned = met_outside ? hit->ns : -hit->ns;
    const Vec up = glm::dot(turned, wo) > 0 ? turned : ng;
    const Axes axes = scene.bins[hit->bin].tangents ? Axes(up, tangent_of(*hit)) : Axes(up);
    const Bsdf bsdf(scene, material, chosen.row, {axes.to_local(wo), outside, hit->t + passed});
    const auto leave = [&](const Vec& wi) {
      return hit->position + (glm::dot(ng, wi) > 0 ? 1.0 : -1.0) * hit->offset * ng;
    };

    if (plan.lights && !material_traits(material).delta) {
      const auto [u, v] = random(Dimension::kLight);
      const LightPoint light = sample_light(scene, hit->position, random(Dimension::kChoice).first,
                                            double(u), double(v));
      const Vec wi = axes.to_local(light.wi);
      if (!black(light.arriving) && glm::dot(ng, light.wi) * wi.z > 0) {
        const double weight = light.pdf > 0 ? power_heuristic(light.pdf, bsdf.pdf(wi)) : 1;
        const Vec add = throughput * bsdf.evaluate(wi) * std::fabs(wi.z) * light.arriving * weight;
        if (!black(add) && !occluded(scene, leave(light.wi), light.to))
          radiance += add * through_veils(scene, leave(light.wi), light.to);
      }
    }

    const auto [u, v] = random(Dimension::kBsdf);
    const Bounce bounce =
        bsdf.sample(double(random(Dimension::kChoice).second), double(u), double(v));
    const Vec wi = axes.to_scene(bounce.wi);
    if (!(glm::dot(ng, wi) * bounce.wi.z > 0)) break;
    throughput *= bounce.weight;
    if (black(throughput)) break;
    if (vertex >= options.roulette_depth) {
      const double chance = std::min(
          1.0,
          std::max({std::fabs(throughput.x), std::fabs(throughput.y), std::fabs(throughput.z)}));
      if (double(random(Dimension::kRoulette).first) >= chance) break;
      throughput /= chance;
    }
    scattered_pdf = bounce.pdf;
    scattered_at = hit->position;
    passed = 0;
    ray = {leave(wi), glm::normalize(wi), double(kRayFar)};
    ++vertex;
    if (!material_traits(material).delta)
      vertex = std::max(vertex, options.least_depth_after_scatter);
  }
  return to_rgb(radiance, scene.colour.film);
}

}  // namespace yat

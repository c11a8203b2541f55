#include "wavefront/reference.h"

#include <algorithm>
#include <cmath>

#include "kernels/rng_scalar.h"
#include "wavefront/reference_parts.h"

namespace yat {

namespace reference {
namespace {

double power_heuristic(double own, double other) {
  return own * own / (own * own + other * other);
}

/// Weight of a light that a path met, which chose its direction with density `scattered`.
double weight_of_met(LightSampling ways, double scattered, double sampled) {
  if (scattered == 0 || ways == LightSampling::kBsdf) return 1;
  return ways == LightSampling::kLights ? 0 : power_heuristic(scattered, sampled);
}

/// Weight of a light sample.
double weight_of_sample(LightSampling ways, double sampled, double scattered) {
  if (sampled == 0 || ways == LightSampling::kLights) return 1;
  return ways == LightSampling::kBsdf ? 0 : power_heuristic(sampled, scattered);
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
    return random_pair(plan.sampler, plan.draw_key(), dimension, pixel, sample, vertex);
  };

  const CameraStart start = camera_ray(scene, plan, x, y, sample);
  RaySegment ray = start.ray;
  Vec throughput(start.weight), radiance(0.0);
  double scattered_pdf = 0;      // of the direction under way
  uint32_t crossed = 0;          // surfaces that the path went through
  Vec scattered_at(ray.origin);  // last scattering vertex
  double passed = 0;             // from there to the ray's origin
  for (;;) {
    std::optional<Point> hit = nearest(scene, ray);
    if (!hit) {
      if (options.hide_environment && vertex == 0) break;
      for (uint32_t i = scene.first_environment; i < scene.lights.size(); ++i) {
        const SeenEnvironment seen = see_environment(scene, i, scattered_at, ray.direction);
        radiance += throughput * seen.radiance *
                    weight_of_met(plan.light_sampling, scattered_pdf, seen.pdf);
      }
      break;
    }
    const Vec wo = -ray.direction;
    const bool met_outside = glm::dot(hit->ng, wo) > 0;
    const float child = random_pair(plan.sampler, plan.draw_key(), Dimension::kChild, pixel, sample,
                                    crossed << 16 | vertex)
                            .first;
    const double width = footprint(scene, glm::length(hit->position - scattered_at), scattered_pdf,
                                   std::fabs(glm::dot(hit->ng, wo)));
    const ChosenMaterial chosen = choose_material(scene, *hit, wo, width, child);
    const MaterialKind material = chosen.kind;

    if (const double cos = glm::dot(hit->ng, wo); hit->light != kNone && cos > 0) {
      const double sampled = scattered_pdf > 0 ? light_pdf(scene, scattered_at, *hit, cos) : 0;
      radiance += throughput * light_radiance(scene, hit->light) *
                  emission_factor(scene, hit->light, *hit, wo, width) *
                  weight_of_met(plan.light_sampling, scattered_pdf, sampled);
    }
    throughput *= chosen.weight;
    if (material_traits(material).see_through) {
      ray.origin = hit->position +
                   (glm::dot(hit->ng, ray.direction) > 0 ? 1.0 : -1.0) * hit->offset * hit->ng;
      ray.t_max = double(kRayFar);
      passed += hit->t;
      ++crossed;
      continue;
    }
    const bool veil = material_traits(material).veil;
    if (vertex >= options.max_depth && !veil) break;

    if (scene.bins[hit->bin].program != chosen.program || chosen.row != hit->parameter)
      bend_normal(scene, scene.bins[hit->bin].program, hit->parameter, *hit, width);
    bend_normal(scene, chosen.program, chosen.row, *hit, width);
    // Everything on the viewer's side.
    const bool outside = met_outside != chosen.turned;
    const Vec ng = met_outside ? hit->ng : -hit->ng, turned = met_outside ? hit->ns : -hit->ns;
    const Vec up = glm::dot(turned, wo) > 0 ? turned : ng;
    const Axes axes = scene.bins[hit->bin].tangents ? Axes(up, tangent_of(*hit)) : Axes(up);
    const Bsdf bsdf(material,
                    material_parameters(scene, material, chosen.program, chosen.row, *hit, width),
                    {axes.to_local(wo), outside, hit->t + passed});
    const auto coat = [&](const Vec& wi) {
      return chosen.coat ? chosen.coat->passes(axes.to_local(wo), wi) : Vec(1.0);
    };
    const auto leave = [&](const Vec& wi) {
      return hit->position + (glm::dot(ng, wi) > 0 ? 1.0 : -1.0) * hit->offset * ng;
    };

    // What a light sample brings; `number` is that of its group.
    const auto connect = [&](const LightPoint& light, uint32_t number) {
      const Vec wi = axes.to_local(light.wi);
      if (black(light.arriving) || !(glm::dot(ng, light.wi) * wi.z > 0)) return;
      const double weight = weight_of_sample(plan.light_sampling, light.pdf, bsdf.pdf(wi));
      Vec add =
          throughput * bsdf.evaluate(wi) * coat(wi) * std::fabs(wi.z) * light.arriving * weight;
      if (black(add)) return;
      const double most = std::max({std::fabs(add.x), std::fabs(add.y), std::fabs(add.z)});
      if (const auto bound = double(options.shadow_bound); most < bound) {
        const double chance = std::max(most / bound, double(kLeastShadowChance));
        const float played =
            random_pair(SamplerKind::kIndependent, plan.draw_key(),
                        of_light(Dimension::kShadow, number), pixel, sample, crossed << 16 | vertex)
                .first;
        if (double(played) >= chance) return;
        add /= chance;
      }
      if (!occluded(scene, leave(light.wi), light.to))
        radiance += add * through_veils(scene, leave(light.wi), light.to);
    };
    if (plan.lights && !material_traits(material).delta) {
      const Receiver receiver{hit->position, ng, material_traits(material).all_around};
      for (uint32_t i = 0; i < plan.light_groups.size(); ++i) {
        const RowRange& rows = plan.light_groups[i].rows;
        const auto [u, v] = random(of_light(Dimension::kLight, i));
        if (rows.end - rows.first == 1) {
          connect(sample_light(scene, receiver, {rows.first, 1, 1}, double(u), double(v)), i);
          continue;
        }
        std::optional<float> choice;
        if (!plan.light_by_place) choice = random(Dimension::kChoice).first;
        connect(sample_light(scene, receiver, choice, u, v), i);
      }
    }

    const auto [u, v] = random(Dimension::kBsdf);
    const float lobe = veil ? random_pair(plan.sampler, plan.draw_key(), Dimension::kChild, pixel,
                                          sample, crossed << 16 | vertex)
                                  .second
                            : random(Dimension::kChoice).second;
    const Bounce bounce = bsdf.sample(double(lobe), double(u), double(v));
    const Vec wi = axes.to_scene(bounce.wi);
    if (!(glm::dot(ng, wi) * bounce.wi.z > 0)) break;
    throughput *= bounce.weight * coat(bounce.wi);
    if (black(throughput)) break;
    if (veil && bounce.wi.z < 0) {
      ray = {leave(ray.direction), ray.direction, double(kRayFar)};
      passed += hit->t;
      ++crossed;
      continue;
    }
    if (vertex >= options.max_depth) break;
    if (vertex >= options.roulette_depth) {
      const double chance = std::min(
          1.0, double(kRouletteChance) * std::max({std::fabs(throughput.x), std::fabs(throughput.y),
                                                   std::fabs(throughput.z)}));
      if (double(random(Dimension::kRoulette).first) >= chance) break;
      throughput /= chance;
    }
    scattered_pdf = bounce.pdf;
    scattered_at = hit->position;
    passed = material == MaterialKind::kAbsorbingGlass
                 ? hit->offset / std::max(std::fabs(glm::dot(ng, wi)), 1.4e-3)
                 : 0;
    ray = {leave(wi), glm::normalize(wi), double(kRayFar)};
    ++vertex;
    if (!material_traits(material).delta)
      vertex = std::max(vertex, options.least_depth_after_scatter);
  }
  return to_rgb(radiance, scene.colour.film);
}

}  // namespace yat

// Materials of the oracle that are made of others, and veils.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/exponential.hpp>
#include <vector>

#include "wavefront/reference_materials.h"

namespace yat::reference {

namespace {

struct Children {
  float share;   ///< of the second; of a coating both are there in full
  float chance;  ///< with which the second is chosen
  uint32_t row[2];
  std::optional<CoatOver> coat = {};  ///< over the second
};

template <template <template <class> class> class Record>
Record<Value> record_of(const std::vector<uint32_t>& words) {
  Record<Value> out{};
  for_each_field([&](auto index, auto& field) { std::memcpy(&field, &words[index], 4); }, out);
  return out;
}

Children children(const Scene& scene, const MaterialForm& form, uint32_t row, const Point& point,
                  double width, bool outside, double cos) {
  const std::vector<uint32_t> words =
      material_parameters(scene, form.kind, form.program, row, point, width);
  if (form.kind == MaterialKind::kMix) {
    const auto p = record_of<MixParameters>(words);
    const float share = std::clamp(p.amount, 0.f, 1.f), bright = share * p.ratio;
    const float chance = scene.splits[form.split].unequal ? bright / (1 - share + bright) : share;
    return {share, chance, {p.first, p.second}};
  }
  if (form.kind == MaterialKind::kCoating) {
    const auto p = record_of<CoatingParameters>(words);
    const double root = (double(p.index) - 1) / (double(p.index) + 1);
    const CoatOver coat{Vec(p.ks_r, p.ks_g, p.ks_b) * (p.index > 0 ? root * root : 1),
                        Vec(p.ka_r, p.ka_g, p.ka_b) * double(p.depth), outside};
    const Vec s = coat.r0 + (1. - coat.r0) * std::pow(1 - cos, 5);
    const double lobe = largest(s),
                 base =
                     double(p.base) * largest(glm::exp(-coat.absorbs * (1 + 1 / cos)) * (1. - s));
    const double share = !outside || lobe == 0 ? 1
                         : base == 0           ? 0
                                               : std::clamp(base / (lobe + base), .125, .875);
    return {1, float(share), {p.first, p.second}, coat};
  }
  const auto p = record_of<DoubleSideParameters>(words);
  const float share = outside ? 0.f : 1.f;
  return {share, share, {p.first, p.second}};
}

/// Expected share of light that passes a material in the direction -wo.
Vec passing(const Scene& scene, const MaterialForm& form, uint32_t row, const Point& point,
            const Vec& wo, bool outside) {
  if (form.kind == MaterialKind::kNull) return Vec(1.0);
  if (form.kind == MaterialKind::kArchitecturalGlass) {
    const double cos = std::fabs(glm::dot(point.ns, wo));
    return transmittance(record_of<ArchitecturalGlassParameters>(
                             material_parameters(scene, form.kind, form.program, row, point, 0)),
                         cos, outside);
  }
  // What is coated is solid.
  if (!material_traits(form.kind).splits || form.kind == MaterialKind::kCoating) return Vec(0.0);
  const MaterialSplit& split = scene.splits[form.split];
  const Children of = children(scene, form, row, point, 0, outside, 1);
  return (1 - double(of.share)) *
             passing(scene, split.child[0], of.row[0], point, wo, outside != split.turned[0]) +
         double(of.share) *
             passing(scene, split.child[1], of.row[1], point, wo, outside != split.turned[1]);
}

}  // namespace

Vec CoatOver::passes(const Vec& wo, const Vec& wi) const {
  const Vec up(wi.x, wi.y, std::fabs(wi.z));
  if (wo.z <= 0 || up.z <= 0) return Vec(0.0);
  const bool reflected = wi.z > 0;
  if (reflected && !outside) return Vec(1.0);
  const Vec s = r0 + (1. - r0) * std::pow(1 - glm::dot(wo, glm::normalize(wo + up)), 5);
  const double way = (outside ? 1 / wo.z : 0) + (reflected == outside ? 1 / up.z : 0);
  return glm::exp(-absorbs * way) * (reflected ? 1. - s : glm::sqrt(1. - s));
}

ChosenMaterial choose_material(const Scene& scene, const Point& point, const Vec& wo, double width,
                               float u) {
  const bool outside = glm::dot(point.ng, wo) > 0;
  const double by_ns = (outside ? 1 : -1) * glm::dot(point.ns, wo);
  const double cos = by_ns > 0 ? by_ns : std::fabs(glm::dot(point.ng, wo));
  const Bin& bin = scene.bins[point.bin];
  MaterialForm form{bin.material, bin.split, bin.program};
  ChosenMaterial chosen{form.kind, form.program, point.parameter, false};
  // In single precision, as in the kernels: another child would be another path.
  while (material_traits(form.kind).splits) {
    const MaterialSplit& split = scene.splits[form.split];
    const Children of =
        children(scene, form, chosen.row, point, width, outside != chosen.turned, cos);
    const float first = 1 - of.chance;
    const int c = u >= first;
    const float chance = c ? of.chance : first;
    u = std::fmin((c ? u - first : u) / chance, 1 - 0x1p-24f);
    const bool coats = form.kind == MaterialKind::kCoating;
    chosen.weight *= double(coats ? 1 : c ? of.share : 1 - of.share) / double(chance);
    if (coats && c) chosen.coat = of.coat;
    form = split.child[c];
    chosen.kind = form.kind;
    chosen.program = form.program;
    chosen.row = of.row[c];
    chosen.turned = chosen.turned != split.turned[c];
  }
  return chosen;
}

Vec through_veils(const Scene& scene, const Vec& from, const Vec& to) {
  Vec passed(1.0);
  RaySegment ray{from, glm::normalize(to - from), glm::length(to - from)};
  while (largest(passed) > 0) {
    const std::optional<Point> hit = nearest(scene, ray);
    if (!hit || hit->t >= ray.t_max) break;
    const bool outside = glm::dot(hit->ng, ray.direction) < 0;
    const Bin& bin = scene.bins[hit->bin];
    passed *= passing(scene, {bin.material, bin.split, bin.program}, hit->parameter, *hit,
                      -ray.direction, outside);
    ray.origin = hit->position + (outside ? -1.0 : 1.0) * hit->offset * hit->ng;
    ray.t_max = glm::dot(to - ray.origin, ray.direction);
  }
  return passed;
}

}  // namespace yat::reference

// Materials of the oracle that are made of others, and veils.

#include <algorithm>
#include <cmath>

#include "wavefront/reference_materials.h"

namespace yat::reference {

namespace {

struct Children {
  float share;  ///< of the second
  uint32_t row[2];
};

Children children(const Scene& scene, MaterialKind kind, uint32_t row, bool outside) {
  if (kind == MaterialKind::kMix) {
    const auto p = parameters<MixParameters>(scene, kind, row);
    return {std::clamp(p.amount, 0.f, 1.f), {p.first, p.second}};
  }
  const auto p = parameters<DoubleSideParameters>(scene, kind, row);
  return {outside ? 0.f : 1.f, {p.first, p.second}};
}

/// Expected share of light that passes a material.
double passing(const Scene& scene, const MaterialForm& form, uint32_t row, bool outside) {
  if (form.kind == MaterialKind::kNull) return 1;
  if (!material_traits(form.kind).splits) return 0;
  const MaterialSplit& split = scene.splits[form.split];
  const Children of = children(scene, form.kind, row, outside);
  return (1 - double(of.share)) *
             passing(scene, split.child[0], of.row[0], outside != split.turned[0]) +
         double(of.share) * passing(scene, split.child[1], of.row[1], outside != split.turned[1]);
}

}  // namespace

ChosenMaterial choose_material(const Scene& scene, const Point& point, bool outside, float u) {
  const Bin& bin = scene.bins[point.bin];
  MaterialForm form{bin.material, bin.split};
  ChosenMaterial chosen{form.kind, point.parameter, false};
  // In single precision, as in the kernels: another child would be another path.
  while (material_traits(form.kind).splits) {
    const MaterialSplit& split = scene.splits[form.split];
    const Children of = children(scene, form.kind, chosen.row, outside != chosen.turned);
    const float first = 1 - of.share;
    const int c = u >= first;
    u = std::fmin(c ? (u - first) / of.share : u / first, 1 - 0x1p-24f);
    form = split.child[c];
    chosen = {form.kind, of.row[c], chosen.turned != split.turned[c]};
  }
  return chosen;
}

Vec through_veils(const Scene& scene, const Vec& from, const Vec& to) {
  double passed = 1;
  RaySegment ray{from, glm::normalize(to - from), glm::length(to - from)};
  while (passed > 0) {
    const std::optional<Point> hit = nearest(scene, ray);
    if (!hit || hit->t >= ray.t_max) break;
    const bool outside = glm::dot(hit->ng, ray.direction) < 0;
    const Bin& bin = scene.bins[hit->bin];
    passed *= passing(scene, {bin.material, bin.split}, hit->parameter, outside);
    ray.origin = hit->position + (outside ? -1.0 : 1.0) * hit->offset * hit->ng;
    ray.t_max = glm::dot(to - ray.origin, ray.direction);
  }
  return Vec(passed);
}

}  // namespace yat::reference

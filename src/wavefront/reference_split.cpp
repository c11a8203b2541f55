// Materials of the oracle that are made of others, and veils.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "wavefront/reference_materials.h"

namespace yat::reference {

namespace {

struct Children {
  float share;  ///< of the second
  uint32_t row[2];
};

template <template <template <class> class> class Record>
Record<Value> record_of(const std::vector<uint32_t>& words) {
  Record<Value> out{};
  for_each_field([&](auto index, auto& field) { std::memcpy(&field, &words[index], 4); }, out);
  return out;
}

Children children(const Scene& scene, const MaterialForm& form, uint32_t row, const Point& point,
                  double width, bool outside) {
  const std::vector<uint32_t> words =
      material_parameters(scene, form.kind, form.program, row, point, width);
  if (form.kind == MaterialKind::kMix) {
    const auto p = record_of<MixParameters>(words);
    return {std::clamp(p.amount, 0.f, 1.f), {p.first, p.second}};
  }
  const auto p = record_of<DoubleSideParameters>(words);
  return {outside ? 0.f : 1.f, {p.first, p.second}};
}

/// Expected share of light that passes a material.
double passing(const Scene& scene, const MaterialForm& form, uint32_t row, const Point& point,
               bool outside) {
  if (form.kind == MaterialKind::kNull) return 1;
  if (!material_traits(form.kind).splits) return 0;
  const MaterialSplit& split = scene.splits[form.split];
  const Children of = children(scene, form, row, point, 0, outside);
  return (1 - double(of.share)) *
             passing(scene, split.child[0], of.row[0], point, outside != split.turned[0]) +
         double(of.share) *
             passing(scene, split.child[1], of.row[1], point, outside != split.turned[1]);
}

}  // namespace

ChosenMaterial choose_material(const Scene& scene, const Point& point, double width, bool outside,
                               float u) {
  const Bin& bin = scene.bins[point.bin];
  MaterialForm form{bin.material, bin.split, bin.program};
  ChosenMaterial chosen{form.kind, form.program, point.parameter, false};
  // In single precision, as in the kernels: another child would be another path.
  while (material_traits(form.kind).splits) {
    const MaterialSplit& split = scene.splits[form.split];
    const Children of = children(scene, form, chosen.row, point, width, outside != chosen.turned);
    const float first = 1 - of.share;
    const int c = u >= first;
    u = std::fmin(c ? (u - first) / of.share : u / first, 1 - 0x1p-24f);
    form = split.child[c];
    chosen = {form.kind, form.program, of.row[c], chosen.turned != split.turned[c]};
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
    passed *= passing(scene, {bin.material, bin.split, bin.program}, hit->parameter, *hit, outside);
    ray.origin = hit->position + (outside ? -1.0 : 1.0) * hit->offset * hit->ng;
    ray.t_max = glm::dot(to - ray.origin, ray.direction);
  }
  return Vec(passed);
}

}  // namespace yat::reference

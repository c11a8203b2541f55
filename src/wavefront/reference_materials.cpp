// What all materials of the oracle share, and those that scatter into single directions.

#include "wavefront/reference_materials.h"

#include <cmath>
#include <stdexcept>
#include <vector>

namespace yat::reference {

namespace {

/// Calls visit with the record that these words are.
template <class Visit>
auto with_parameters(MaterialKind kind, const std::vector<uint32_t>& words, Visit&& visit) {
  const auto read = [&]<template <template <class> class> class Record>(Record<Value> out) {
    for_each_field([&](auto index, auto& field) { std::memcpy(&field, &words[index], 4); }, out);
    return visit(out);
  };
  switch (kind) {
#define YAT_MATERIAL(file, Type) \
  case MaterialKind::k##Type:    \
    return read(Type##Parameters<Value>{});
    YAT_MATERIALS(YAT_MATERIAL)
#undef YAT_MATERIAL
    case MaterialKind::kCount:
      break;
  }
  throw std::logic_error("reference: no such material kind");
}

}  // namespace

double largest(const Vec& c) {
  return std::fmax(c.x, std::fmax(c.y, c.z));
}

Vec mirrored(const Vec& wo) {
  return {-wo.x, -wo.y, wo.z};
}

Vec Bsdf::evaluate(const Vec& wi) const {
  return with_parameters(kind_, parameters_, [&](const auto& p) {
    if constexpr (requires { reference::evaluate(p, view_, wi); })
      return reference::evaluate(p, view_, wi);
    else
      return Vec(0.0);
  });
}

double Bsdf::pdf(const Vec& wi) const {
  return with_parameters(kind_, parameters_, [&](const auto& p) {
    if constexpr (requires { reference::pdf(p, view_, wi); })
      return reference::pdf(p, view_, wi);
    else
      return 0.0;
  });
}

Bounce Bsdf::sample(double lobe, double u, double v) const {
  return with_parameters(kind_, parameters_, [&](const auto& p) {
    if constexpr (requires { reference::sample(p, view_, lobe, u, v); })
      return reference::sample(p, view_, lobe, u, v);
    else
      return Bounce{};  // made of others: choose_material() has gone on to one of them
  });
}

Bounce sample(const MirrorParameters<Value>& p, const LocalView& view, double, double, double) {
  return {mirrored(view.wo), {p.kr_r, p.kr_g, p.kr_b}, 0};
}

Bounce sample(const NullParameters<Value>&, const LocalView& view, double, double, double) {
  return {-view.wo, Vec(1.0), 0};
}

/// Snell's law and Fresnel's equations in their amplitudes.
Bounce sample(const GlassParameters<Value>& p, const LocalView& view, double lobe, double, double) {
  const Vec& wo = view.wo;
  const double n_here = view.outside ? 1 : double(p.index),
               n_there = view.outside ? double(p.index) : 1;
  const double sin_here = std::sqrt(wo.x * wo.x + wo.y * wo.y);
  const double sin_there = n_here / n_there * sin_here;
  double reflectance = 1, cos_there = 0;
  if (sin_there < 1 && wo.z > 0) {
    cos_there = std::sqrt(1 - sin_there * sin_there);
    const double rs = (n_here * wo.z - n_there * cos_there) / (n_here * wo.z + n_there * cos_there);
    const double rp = (n_there * wo.z - n_here * cos_there) / (n_there * wo.z + n_here * cos_there);
    reflectance = (rs * rs + rp * rp) / 2;
  }
  const Vec reflected = reflectance * Vec(p.kr_r, p.kr_g, p.kr_b);
  const Vec refracted = (1 - reflectance) * Vec(p.kt_r, p.kt_g, p.kt_b);
  const double total = largest(reflected) + largest(refracted);
  if (total == 0) return {mirrored(wo), Vec(0.0), 0};
  const double chance = largest(reflected) / total;
  if (lobe < chance) return {mirrored(wo), reflected / chance, 0};
  const double ratio = n_here / n_there;
  return {
      {-ratio * wo.x, -ratio * wo.y, -cos_there}, refracted * (ratio * ratio / (1 - chance)), 0};
}

}  // namespace yat::reference

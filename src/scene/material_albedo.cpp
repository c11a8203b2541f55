// What materials give back of the light that they get, about: children of mixtures and coats are
// chosen by it. Nothing depends on it but noise.

#include <algorithm>
#include <cstring>
#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include "kernels/materials/all.h"
#include "scene/compile_fresnel.h"

namespace yat {

namespace {

template <template <template <class> class> class Record>
Record<Value> record_of(const uint32_t* row) {
  Record<Value> record{};
  for_each_field([&](auto index, auto& field) { std::memcpy(&field, row + index, 4); }, record);
  return record;
}

/// A coat over something diffuse: its fields have the same names everywhere.
template <template <template <class> class> class Record>
glm::vec3 coated(const uint32_t* row) {
  const Record<Value> p = record_of<Record>(row);
  glm::vec3 base(p.kd_r, p.kd_g, p.kd_b);
  if constexpr (requires { p.kt_r; }) base += glm::vec3(p.kt_r, p.kt_g, p.kt_b);
  return coated_albedo({p.ks_r, p.ks_g, p.ks_b}, p.index,
                       base * glm::exp(-2 * p.depth * glm::vec3(p.ka_r, p.ka_g, p.ka_b)));
}

template <template <template <class> class> class Record>
glm::vec3 diffuse(const uint32_t* row) {
  const Record<Value> p = record_of<Record>(row);
  return {p.kd_r, p.kd_g, p.kd_b};
}

/// What is reflected and, of glass, what goes through: the brighter of both.
template <template <template <class> class> class Record>
glm::vec3 tinted(const uint32_t* row) {
  const Record<Value> p = record_of<Record>(row);
  glm::vec3 tint(p.kr_r, p.kr_g, p.kr_b);
  if constexpr (requires { p.kt_r; }) tint = glm::max(tint, glm::vec3(p.kt_r, p.kt_g, p.kt_b));
  return tint;
}

template <template <template <class> class> class Record>
glm::vec3 metal(const uint32_t* row) {
  const Record<Value> p = record_of<Record>(row);
  return glm::vec3(reflectance_head_on(double(p.n_r), double(p.k_r)),
                   reflectance_head_on(double(p.n_g), double(p.k_g)),
                   reflectance_head_on(double(p.n_b), double(p.k_b)));
}

}  // namespace

glm::vec3 coated_albedo(const glm::vec3& ks, float index, const glm::vec3& base) {
  const float root = (index - 1) / (index + 1);
  const glm::vec3 coat = index > 0 ? root * root * ks : ks;
  return coat + (1.f - coat) * base;
}

glm::vec3 about_albedo(MaterialKind kind, const uint32_t* row) {
  switch (kind) {
    case MaterialKind::kMatte:
      return diffuse<MatteParameters>(row);
    case MaterialKind::kOrenNayar:
      return diffuse<OrenNayarParameters>(row);
    case MaterialKind::kScatter:
      return diffuse<ScatterParameters>(row);
    case MaterialKind::kMatteTranslucent: {
      const auto p = record_of<MatteTranslucentParameters>(row);
      const glm::vec3 kr(p.kr_r, p.kr_g, p.kr_b), kt(p.kt_r, p.kt_g, p.kt_b);
      return kr + (1.f - p.conserve * kr) * kt;
    }
    case MaterialKind::kGlossy:
      return coated<GlossyParameters>(row);
    case MaterialKind::kGlossySingle:
      return coated<GlossySingleParameters>(row);
    case MaterialKind::kGlossyLossy:
      return coated<GlossyLossyParameters>(row);
    case MaterialKind::kGlossyTranslucent:
      return coated<GlossyTranslucentParameters>(row);
    case MaterialKind::kCarPaint: {
      const auto p = record_of<CarPaintParameters>(row);
      return glm::vec3(p.kd_r, p.kd_g, p.kd_b) + p.r1 * glm::vec3(p.ks1_r, p.ks1_g, p.ks1_b) +
             p.r2 * glm::vec3(p.ks2_r, p.ks2_g, p.ks2_b) +
             p.r3 * glm::vec3(p.ks3_r, p.ks3_g, p.ks3_b);
    }
    case MaterialKind::kMetal:
      return metal<MetalParameters>(row);
    case MaterialKind::kMetalIndex:
      return metal<MetalIndexParameters>(row);
    case MaterialKind::kMetalColour:
      return tinted<MetalColourParameters>(row);
    case MaterialKind::kCookTorrance:
      return tinted<CookTorranceParameters>(row);
    case MaterialKind::kCookTorranceSingle:
      return tinted<CookTorranceSingleParameters>(row);
    case MaterialKind::kShinyMetal: {
      const auto p = record_of<ShinyMetalParameters>(row);
      return glm::vec3(p.kr_r, p.kr_g, p.kr_b) + glm::vec3(p.ks_r, p.ks_g, p.ks_b);
    }
    case MaterialKind::kMirror:
      return tinted<MirrorParameters>(row);
    case MaterialKind::kMirrorFilm:
      return tinted<MirrorFilmParameters>(row);
    case MaterialKind::kGlass:
      return tinted<GlassParameters>(row);
    case MaterialKind::kGlassFilm:
      return tinted<GlassFilmParameters>(row);
    case MaterialKind::kAbsorbingGlass:
      return tinted<AbsorbingGlassParameters>(row);
    case MaterialKind::kRoughGlass:
      return tinted<RoughGlassParameters>(row);
    // What passes unturned shows other surfaces, which give back a part again.
    case MaterialKind::kArchitecturalGlass:
      return .5f * tinted<ArchitecturalGlassParameters>(row);
    case MaterialKind::kNull:
      return glm::vec3(.5f);
    // Velvet's definition does not keep to its Kd; what is made of others is asked of these.
    case MaterialKind::kVelvet:
    case MaterialKind::kMix:
    case MaterialKind::kDoubleSide:
    case MaterialKind::kCoating:
    case MaterialKind::kCount:
      break;
  }
  return glm::vec3(1.f);
}

float brightness(const MaterialRef& material) {
  const glm::vec3& c = material.albedo;
  return std::clamp(std::max({c.x, c.y, c.z}), .125f, 1.f);
}

}  // namespace yat

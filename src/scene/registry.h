#pragma once
// One list each of what yat knows. Everything that must happen "for every material" (parsing,
// parameter tables, sorting bins, shade kernels, tests, bench rows) is generated from these lists.
//
// A material is a header src/kernels/materials/NAME.h and one line here, in the list of its family:
// a family's kernels are one translation unit, src/kernels/shade_FAMILY.cpp (composite: split.cpp).
// The header declares, for an entry YAT_MATERIAL(oren_nayar, OrenNayar):
//   template <template <class> class Of> struct OrenNayarParameters { ... YAT_FIELDS(...) };
//   inline constexpr MaterialTraits kOrenNayarTraits{...};
// and, only where YAT_ISA is defined, in namespace yat::YAT_ISA,
//   template <class A> struct OrenNayar { evaluate, sample, pdf }     (kernels/material.h).
// A parameter of it that may be a texture is one line of a list that the traits name:
//   inline constexpr TexturedField kOrenNayarTextured[] = {
//       textured_colour<OrenNayarParameters>("Kd", "kd_r"), ...};
//   inline constexpr MaterialTraits kOrenNayarTraits{..., .textured = kOrenNayarTextured};
//
// A texture kind, one step of a program that makes such parameters, is likewise a header
// src/kernels/textures/NAME.h and one line in YAT_TEXTURES (kernels/texture.h says what it has).

#include <cstdint>
#include <string_view>

#include "soa/fields.h"

// clang-format off
#define YAT_DIFFUSE_MATERIALS(YAT_MATERIAL) \
  YAT_MATERIAL(matte,             Matte)            \
  YAT_MATERIAL(oren_nayar,        OrenNayar)        \
  YAT_MATERIAL(matte_translucent, MatteTranslucent) \
  YAT_MATERIAL(velvet,            Velvet)           \
  YAT_MATERIAL(scatter,           Scatter)
#define YAT_COATED_MATERIALS(YAT_MATERIAL) \
  YAT_MATERIAL(glossy,            Glossy)           \
  YAT_MATERIAL(glossy_single,     GlossySingle)     \
  YAT_MATERIAL(glossy_lossy,      GlossyLossy)
#define YAT_LAYERED_MATERIALS(YAT_MATERIAL) \
  YAT_MATERIAL(glossy_translucent, GlossyTranslucent) \
  YAT_MATERIAL(car_paint,         CarPaint)
#define YAT_METAL_MATERIALS(YAT_MATERIAL) \
  YAT_MATERIAL(metal,             Metal)            \
  YAT_MATERIAL(metal_index,       MetalIndex)       \
  YAT_MATERIAL(metal_colour,      MetalColour)      \
  YAT_MATERIAL(shiny_metal,       ShinyMetal)       \
  YAT_MATERIAL(cook_torrance,     CookTorrance)     \
  YAT_MATERIAL(cook_torrance_single, CookTorranceSingle)
#define YAT_GLASS_MATERIALS(YAT_MATERIAL) \
  YAT_MATERIAL(rough_glass,       RoughGlass)       \
  YAT_MATERIAL(mirror,            Mirror)           \
  YAT_MATERIAL(mirror_film,       MirrorFilm)       \
  YAT_MATERIAL(glass,             Glass)            \
  YAT_MATERIAL(glass_film,        GlassFilm)        \
  YAT_MATERIAL(absorbing_glass,   AbsorbingGlass)   \
  YAT_MATERIAL(architectural_glass, ArchitecturalGlass)
#define YAT_COMPOSITE_MATERIALS(YAT_MATERIAL) \
  YAT_MATERIAL(mix,               Mix)              \
  YAT_MATERIAL(double_side,       DoubleSide)       \
  YAT_MATERIAL(coating,           Coating)          \
  YAT_MATERIAL(null,              Null)

#define YAT_MATERIALS(YAT_MATERIAL) \
  YAT_DIFFUSE_MATERIALS(YAT_MATERIAL) \
  YAT_COATED_MATERIALS(YAT_MATERIAL) \
  YAT_LAYERED_MATERIALS(YAT_MATERIAL) \
  YAT_METAL_MATERIALS(YAT_MATERIAL) \
  YAT_GLASS_MATERIALS(YAT_MATERIAL) \
  YAT_COMPOSITE_MATERIALS(YAT_MATERIAL)

#define YAT_TEXTURES(YAT_TEXTURE) \
  YAT_TEXTURE(constant,      Constant) \
  YAT_TEXTURE(map_surface,   MapSurface) \
  YAT_TEXTURE(map_round,     MapRound) \
  YAT_TEXTURE(map_planar,    MapPlanar) \
  YAT_TEXTURE(map_solid,     MapSolid) \
  YAT_TEXTURE(image,         Image) \
  YAT_TEXTURE(arithmetic,    Arithmetic) \
  YAT_TEXTURE(ramp,          Ramp) \
  YAT_TEXTURE(clamp,         Clamp) \
  YAT_TEXTURE(weigh,         Weigh) \
  YAT_TEXTURE(bands,         Bands) \
  YAT_TEXTURE(checkerboard,  Checkerboard) \
  YAT_TEXTURE(bilerp,        Bilerp) \
  YAT_TEXTURE(brick,         Brick) \
  YAT_TEXTURE(dots,          Dots) \
  YAT_TEXTURE(uv_colour,     UvColour) \
  YAT_TEXTURE(uv_mask,       UvMask) \
  YAT_TEXTURE(harlequin,     Harlequin) \
  YAT_TEXTURE(noise,         Noise) \
  YAT_TEXTURE(marble,        Marble) \
  YAT_TEXTURE(blender,       Blender)
// clang-format on

namespace yat {

enum class MaterialKind : uint32_t {
#define YAT_MATERIAL(file, Type) k##Type,
  YAT_MATERIALS(YAT_MATERIAL)
#undef YAT_MATERIAL
      kCount
};
inline constexpr uint32_t kMaterialKinds = uint32_t(MaterialKind::kCount);

enum class StepKind : uint32_t {
#define YAT_TEXTURE(file, Type) k##Type,
  YAT_TEXTURES(YAT_TEXTURE)
#undef YAT_TEXTURE
      kCount
};
inline constexpr uint32_t kStepKinds = uint32_t(StepKind::kCount);

/// A parameter of a material that may be a texture, and the fields of the record that it gives.
struct TexturedField {
  std::string_view parameter;  ///< its name in the scene file
  uint32_t field = 0;          ///< of the record
  uint32_t channels = 1;       ///< 3: a reflectance in bands, in three fields; 1: a number
  float least = 0, most = 1;   ///< clamped to these, in the unit of the scene file
  float unit = 1;              ///< field = unit * clamped value
};

/// "Kd" in fields kd_r, kd_g, kd_b.
template <template <template <class> class> class Record>
consteval TexturedField textured_colour(std::string_view parameter, std::string_view first_field) {
  return {parameter, field_number<Record>(first_field), 3, 0, 1, 1};
}
template <template <template <class> class> class Record>
consteval TexturedField textured_number(std::string_view parameter, std::string_view field,
                                        float least, float most, float unit = 1) {
  return {parameter, field_number<Record>(field), 1, least, most, unit};
}

/// A view of a constexpr array.
struct TexturedFields {
  const TexturedField* first = nullptr;
  uint32_t count = 0;
  constexpr TexturedFields() = default;
  template <uint32_t N>
  constexpr TexturedFields(const TexturedField (&fields)[N]) : first(fields), count(N) {}
  constexpr const TexturedField* begin() const { return first; }
  constexpr const TexturedField* end() const { return first + count; }
};

/// What the plan must know of a material kind.
struct MaterialTraits {
  std::string_view name;  ///< as shown by `yat info` and in traces
  bool delta;             ///< scatters only into single directions: no light sampling, no MIS
  bool see_through;       ///< lets shadow rays and paths pass unchanged (null)
  bool needs_lobe;        ///< chooses between lobes: draws Randoms::lobe
  bool needs_direction;   ///< draws Randoms::bsdf_u, bsdf_v
  /// Hands each of its rows on to one of two materials: it has share() instead of the three
  /// functions of a BSDF (kernels/split.h).
  bool splits = false;
  /// Lets a part of the light pass unturned: it has transmittance(parameters, view), by which
  /// shadow rays are weakened, and samples with wi.z < 0 go straight on, as through see-through
  /// surfaces. Its lobe is decided by Dimension::kChild, anew at every crossing.
  bool veil = false;
  /// Takes light from the other side too, or takes it without a cosine: choosing lights goes by
  /// their distance alone.
  bool all_around = false;
  TexturedFields textured = {};  ///< what textures may give
};

/// Throws std::logic_error for kCount.
MaterialTraits material_traits(MaterialKind kind);

/// Fields and words per row of a record.
struct RecordSize {
  uint32_t fields, row_words;
};
RecordSize parameters_size(MaterialKind kind);
RecordSize parameters_size(StepKind kind);

}  // namespace yat

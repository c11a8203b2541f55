#pragma once
// One list each of what yat knows. Everything that must happen "for every material" (parsing,
// parameter tables, sorting bins, shade kernels, tests, bench rows) is generated from these lists.
//
// A material is a header src/kernels/materials/NAME.h and one line here. The header declares, for
// an entry YAT_MATERIAL(oren_nayar, OrenNayar):
//   template <template <class> class Of> struct OrenNayarParameters { ... YAT_FIELDS(...) };
//   inline constexpr MaterialTraits kOrenNayarTraits{...};
// and, only where YAT_ISA is defined, in namespace yat::YAT_ISA,
//   template <class A> struct OrenNayar { evaluate, sample, pdf }     (kernels/material.h).

#include <cstdint>
#include <string_view>

// clang-format off
#define YAT_MATERIALS(YAT_MATERIAL) \
  YAT_MATERIAL(matte,             Matte)            \
  YAT_MATERIAL(oren_nayar,        OrenNayar)        \
  YAT_MATERIAL(matte_translucent, MatteTranslucent) \
  YAT_MATERIAL(velvet,            Velvet)           \
  YAT_MATERIAL(scatter,           Scatter)          \
  YAT_MATERIAL(metal,             Metal)            \
  YAT_MATERIAL(metal_index,       MetalIndex)       \
  YAT_MATERIAL(metal_colour,      MetalColour)      \
  YAT_MATERIAL(shiny_metal,       ShinyMetal)       \
  YAT_MATERIAL(cook_torrance,     CookTorrance)     \
  YAT_MATERIAL(cook_torrance_single, CookTorranceSingle) \
  YAT_MATERIAL(rough_glass,       RoughGlass)       \
  YAT_MATERIAL(mirror,            Mirror)           \
  YAT_MATERIAL(mirror_film,       MirrorFilm)       \
  YAT_MATERIAL(glass,             Glass)            \
  YAT_MATERIAL(glass_film,        GlassFilm)        \
  YAT_MATERIAL(absorbing_glass,   AbsorbingGlass)   \
  YAT_MATERIAL(architectural_glass, ArchitecturalGlass) \
  YAT_MATERIAL(mix,               Mix)              \
  YAT_MATERIAL(double_side,       DoubleSide)       \
  YAT_MATERIAL(null,              Null)
// clang-format on

namespace yat {

enum class MaterialKind : uint32_t {
#define YAT_MATERIAL(file, Type) k##Type,
  YAT_MATERIALS(YAT_MATERIAL)
#undef YAT_MATERIAL
      kCount
};
inline constexpr uint32_t kMaterialKinds = uint32_t(MaterialKind::kCount);

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
  /// shadow rays are weakened, and its paths go on as through see-through surfaces.
  bool veil = false;
};

/// Throws std::logic_error for kCount.
MaterialTraits material_traits(MaterialKind kind);

}  // namespace yat

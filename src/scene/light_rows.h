#pragma once
// Lights as kernels read them (part of scene/compiled.h).

#include <cstdint>

#include "kernels/colour_bands.h"
#include "scene/light_map_rows.h"
#include "scene/light_nodes.h"
#include "soa/columns.h"
#include "soa/fields.h"

namespace yat {

/// Kinds of lights. Those from kFirstEnvironment on lie infinitely far away and are found by rays
/// that leave the scene; spots, maps and projections are points that no ray finds.
enum class LightKind : uint32_t {
  kTriangle,
  kSphere,
  kPoint,
  kDistant,
  kRectangle,
  kSpot,
  kPointMap,
  kProjection,
  kShape,
  kConstant,
  kImage,
  kSun,
  kSky,
  kCount
};
inline constexpr uint32_t kFirstEnvironment = uint32_t(LightKind::kConstant);
inline constexpr const char* kLightKindNames[] = {"triangle",
                                                  "sphere",
                                                  "point",
                                                  "distant",
                                                  "rectangle",
                                                  "spot",
                                                  "mapped point",
                                                  "projection",
                                                  "shape",
                                                  "constant environment",
                                                  "image environment",
                                                  "sun",
                                                  "sky"};
static_assert(sizeof(kLightKindNames) / sizeof(*kLightKindNames) == uint32_t(LightKind::kCount));

/// One light: one emissive triangle, two that make a rectangle, a sphere, a point, a direction, an
/// environment. Fields by kind:
///   triangle    a = p0, b = p1 - p0, c = p2 - p0 (b x c points where it shines),
///               extra = area [m2]; in an instance, further = what the rounding of its transform
///               adds to the distance that a ray keeps off it [m]
///   sphere      a = centre, extra = radius, b_x = 1 if it shines inwards
///   point       a = position; a surface at distance d that faces it gets the irradiance
///               radiance / (b_x d^2 + b_y): b = (1, 0) and radiance = intensity [W/sr],
///               or b = (0, 1), no fall-off
///   distant     a = unit direction towards the light; radiance holds the irradiance on a surface
///               that faces it (theta 0), or radiance of a disc with cos(theta) in extra < 1
///   rectangle   a = p0, b = p1 - p0, c = p3 - p0, |b| <= |c|, at right angles (b x c points where
///               it shines), extra = area [m2], further as of triangles
///   spot        a = position, b = unit axis, extra = cosine of the cone,
///               c_x = 1 / (cosine where the falloff begins - extra), finite;
///               radiance holds the intensity on the axis
///   mapped point  a = position, extra = the map's mean, c_x = map row (as bits);
///               radiance holds the mean intensity
///   projection  a = position, c_x = map row (as bits), b_x, b_y = half of the window at
///               distance 1, b_z = flux of a white picture of intensity scale 1,
///               extra = 1 / LuxRender's area
///   shape       a_x = its row of ShapesView::rows, as bits; extra = area [m2]
///   constant    radiance alone
///   image       c_x = map row (as bits), c_y = unevenness, extra = mean luminance with radiance
///   sun         a = unit direction towards its middle, extra = 1 - cos(its angular radius)
///   sky         c_x = map row, b_x = sky row (as bits), c_y, extra = as of an image
template <template <class> class Of>
struct LightRow {
  Of<float> a_x, a_y, a_z, b_x, b_y, b_z, c_x, c_y, c_z;
  Of<float> extra;
  Of<float> radiance_r, radiance_g, radiance_b;  ///< bands
  /// With which sample_lights chooses this row by power; where there is a light tree, only among
  /// those without a place, and 1 for the others; 1 where surfaces ask all lights.
  Of<float> probability;
  Of<uint32_t> kind;  ///< LightKind
  Of<float> further;  ///< >= 0
  YAT_FIELDS(a_x, a_y, a_z, b_x, b_y, b_z, c_x, c_y, c_z, extra, radiance_r, radiance_g, radiance_b,
             probability, kind, further)
};
static_assert(all_fields_listed<LightRow>);

/// Alias table entry (Walker 1977, Vose 1991): of n equal intervals, interval i gives row i below
/// `threshold`, row `other` above.
template <template <class> class Of>
struct LightChoice {
  Of<float> threshold;
  Of<uint32_t> other;
  YAT_FIELDS(threshold, other)
};
static_assert(all_fields_listed<LightChoice>);

/// How the emission of a light with a surface varies: its row's radiance is multiplied by what a
/// texture program (Scene::emission_programs) says at a point, and by a map of the direction.
/// A map's own space is the triangle's: z its normal, x along dp/du; its texels are divided by the
/// cosine to z (kernels/varying_emission.h).
template <template <class> class Of>
struct EmissionRow {
  Of<uint32_t> program;              ///< row of Scene::emission_programs, or kNone
  Of<uint32_t> parameter;            ///< row of the program's constants
  Of<uint32_t> map;                  ///< row of LightView::maps, or kNone
  Of<uint32_t> prim;                 ///< as in Hit
  Of<float> u0, v0, u1, v1, u2, v2;  ///< triangles: texture coordinates of a, a + b, a + c
  YAT_FIELDS(program, parameter, map, prim, u0, v0, u1, v1, u2, v2)
};
static_assert(all_fields_listed<EmissionRow>);

/// Places of fields in an EmissionRow, for whom one field is enough.
inline constexpr uint32_t kEmissionProgramWord = 0, kEmissionParameterWord = 1;

struct LightView {
  Rows<LightRow> rows;  ///< those of environments last
  /// One per light, or none: no light's emission varies.
  Rows<EmissionRow> emission;
  /// Of all lights; where there is a tree, of those without a place only, numbered from 0.
  Rows<LightChoice> choice;
  LightTreeView tree;
  uint32_t kinds = 0;              ///< bit k set: LightKind k is present
  uint32_t first_environment = 0;  ///< row of the first light that rays leaving the scene find
  // What lights with a map need; empty without.
  Rows<LightMapRow> maps;
  Rows<SkyRow> skies;
  const float* texels = nullptr;  ///< kTexelWords each, rows of a map from the top
  const float* cells = nullptr;
  BandBasis basis{};  ///< of lights: bands of colours that kernels compute
};

}  // namespace yat

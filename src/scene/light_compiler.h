#pragma once
// LightSource statements -> light rows (lxs 6). One file per family: points, environments, sun and
// sky.

#include <optional>
#include <string>
#include <vector>

#include "scene/compile_parts.h"
#include "scene/light_maps.h"

namespace yat {

/// What the families need of a statement, and the tables that they add to.
struct LightContext {
  Parameters& p;
  const LightEntry& entry;
  const Description& description;
  const ColourModel& colour;
  glm::dvec3 center;  ///< world position of the scene-space origin
  LightTables& tables;
  std::vector<LightRow<Value>>& rows;

  SourceLoc loc() const { return entry.plugin.loc; }
  glm::dmat3 linear() const { return glm::dmat3(entry.to_world); }
  /// Adds the row, unless it is black (warned about).
  void add(const LightRow<Value>& row);
};

/// A colour of a light: L, and L times gain, with negative and non-finite channels as 0.
struct LightColor {
  glm::dvec3 bands;  ///< of L times gain
  double y;          ///< luminance of L, without gain
};
LightColor light_color(Parameters& p, const Description& description, const ColourModel& colour);
/// The same for an L of `rgb`.
LightColor light_color(Parameters& p, const glm::dvec3& rgb, const ColourModel& colour);
/// The same times lumens / (solid_angle Y(L)) where "power" and "efficacy" are given.
glm::dvec3 light_intensity(LightContext& light, double solid_angle);

LightRow<Value> light_row(LightKind kind, const glm::dvec3& radiance);
/// A row number in a float field.
float row_bits(size_t row);
uint32_t row_of_bits(float bits);

/// A matrix applied to a point, its last row taken as 0 0 0 w (lxs section 11).
glm::dvec3 transform_point(const Matrix& m, const glm::dvec3& p);

void compile_point(LightContext& light);
void compile_spot(LightContext& light);
void compile_projection(LightContext& light);
void compile_distant(LightContext& light);
void compile_infinite(LightContext& light);

/// Which parts of "sun", "sky" and what is made of both.
void compile_sun(LightContext& light);
void compile_sky(LightContext& light);

/// "mapname" of a light; empty, and an error, if it cannot be read. `basis` is that of
/// reflectances: LuxRender's pictures are factors of the light's own spectrum (docs/decisions.md).
/// The gamma acts on the bands of the stored colours, as that of textures does
/// (kernels/textures/bands.h).
std::optional<LightPicture> read_light_picture(Parameters& p, const std::string& name, double gamma,
                                               const BandBasis& basis,
                                               const Description& description);
/// "iesname" of a light as a lat-long picture of its intensities; empty, and reported, if it cannot
/// be read.
std::optional<LightPicture> read_ies(Parameters& p, const std::string& name, bool flip_z,
                                     const Description& description);
/// What "iesname", "mapname" and "flipz" of a light say of directions; empty if they say nothing,
/// or nothing that can be read.
std::optional<LightPicture> read_distribution(Parameters& p, const BandBasis& basis,
                                              const Description& description);

}  // namespace yat

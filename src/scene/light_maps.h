#pragma once
// The tables of lights that have a map: their making when a scene is compiled, and what they say,
// in double precision and one direction at a time.

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "scene/colour_model.h"
#include "scene/compiled.h"

namespace yat {

/// Columns of the scene under construction.
struct LightTables {
  std::vector<LightMapRow<Value>> maps;
  std::vector<SkyRow<Value>> skies;
  std::vector<float> texels;  ///< kTexelWords each
  std::vector<float> cells;
};

/// A picture in bands, a factor of what a light sends into directions; rows from the top.
struct LightPicture {
  uint32_t width = 0, height = 0;
  std::vector<glm::vec3> texels;
};

/// A map whose directions are those of `light_to_world` (any scale); without texels and cells.
/// Empty if the matrix cannot be inverted.
std::optional<LightMapRow<Value>> make_light_map(const glm::dmat3& light_to_world);

/// Appends the picture's texels.
void add_texels(const LightPicture& picture, MapLayout layout, LightTables& tables,
                LightMapRow<Value>& map);

/// Bands of the map's picture in a direction of light space (unit), bilinear as kernels look it up.
glm::dvec3 map_colour(const LightMapRow<Value>& map, const float* texels, const glm::dvec3& l);
/// Bands of the bilinear picture at texel coordinates, the first texel's centre at (0, 0), clamped
/// at the sides; `around`: the left and the right side are neighbours.
glm::dvec3 texel_colour(const LightMapRow<Value>& map, const float* texels, double x, double y,
                        bool around);
/// Bands of a sky in a direction of light space (unit).
glm::dvec3 sky_colour(const SkyRow<Value>& sky, const BandBasis& basis, const glm::dvec3& l);

/// The direction of a place of the lat-long square, light space.
glm::dvec3 latlong_direction(double s, double t);

/// Mean luminances over the cells of the lat-long square, rows of t from the zenith.
struct CellMeans {
  uint32_t columns = 0, rows = 0;
  std::vector<double> mean;
  /// Over all directions.
  double average() const;
  /// Mean square over squared mean, over all directions: 1 if all are alike, 2 if half are dark,
  /// the share of the sphere's whole over that of a lone bright spot. 1 if all are dark.
  double unevenness() const;
};
/// Of radiance (bands) times the map's picture.
CellMeans picture_cells(const LightMapRow<Value>& map, const LightTables& tables,
                        const glm::dvec3& radiance, const BandMatrix& film);
/// Of a sky.
CellMeans sky_cells(const SkyRow<Value>& sky, const BandBasis& basis, const BandMatrix& film);

/// Appends the cumulative values by which directions are drawn: the cells by their mean times their
/// solid angle, and one direction in kEvenShare from the whole sphere, so that every cell is
/// reached with random numbers of 24 bits and nothing that shines counts many times over.
void add_cells(const CellMeans& cells, LightTables& tables, LightMapRow<Value>& map);
inline constexpr double kEvenShare = 50;

}  // namespace yat

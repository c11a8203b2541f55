#pragma once
// The camera and the pixel filter as kernels read them (part of scene/compiled.h).

#include <cstdint>

namespace yat {

enum class CameraKind : uint32_t {
  kPinhole,
  kThinLens,
  kPolygonLens,
  kOrthographic,
  kEnvironment,
  kFisheye,
  kCount
};
constexpr bool has_lens(CameraKind kind) {
  return kind == CameraKind::kThinLens || kind == CameraKind::kPolygonLens;
}

/// Raster positions (x, y) are in pixels from the top left of the full image.
///   pinhole and lenses   the direction is normalize(corner + x dx + y dy); forward component of
///                        corner is 1, of dx and dy 0
///   orthographic         rays start at corner + x dx + y dy and go along forward
///   environment          with theta = pi y step_y from +dy and phi = 2 pi x step_x: direction
///                        normalize(-sin theta sin phi dx + cos theta dy - sin theta cos phi
///                        forward)
///   fisheye              with (r cos a, r sin a) = (x step_x - 1, 1 - y step_y): at psi = r
///                        half_angle from the axis, in direction a: normalize(sin psi cos a dx +
///                        sin psi sin a dy + cos psi forward); nothing is seen where r > 1
struct CameraView {
  float origin[3];                ///< scene space [m]
  float corner[3], dx[3], dy[3];  ///< scene space
  float forward[3];               ///< view axis; unit, but for environment and fisheye
  float lens_x[3], lens_y[3];     ///< lens axes times radius [m]; 0 for a pinhole
  float focal_distance;           ///< depth of the plane of focus [m]
  float near_depth, far_depth;    ///< hither and yon, along the view axis [m]
  float step_x, step_y;           ///< environment, fisheye: see there
  float half_angle;               ///< fisheye [turns]
  uint32_t blades;                ///< polygon lens: its corners, >= 3
};

enum class FilterKind : uint32_t {
  kBox,      ///< uniform over the radius: no table
  kProduct,  ///< f(x) g(y), nowhere negative: inverted cumulative distributions
  kTable,    ///< any: cumulative distributions over cells, with signs
};

/// Pixel filter as tables for importance sampling, see kernels/camera.h. Offsets in pixels from the
/// pixel centre.
struct FilterView {
  FilterKind kind = FilterKind::kBox;
  float radius_x = 0.5f, radius_y = 0.5f;
  // kProduct: kFilterQuantiles + 1 offsets in units of the radius, from -1 to 1, between which
  // equal shares of the filter lie.
  const float* quantile_x = nullptr;
  const float* quantile_y = nullptr;
  // kTable.
  const float* marginal = nullptr;  ///< kFilterBins + 1 cumulative values over y, 0..1
  const float* conditional =
      nullptr;                  ///< kFilterBins rows of kFilterBins + 1 cumulative values over x
  const float* sign = nullptr;  ///< kFilterBins^2: weight of a sample in the cell (1 where >= 0)
};
inline constexpr uint32_t kFilterBins = 64;
inline constexpr uint32_t kFilterQuantiles = 512;

}  // namespace yat

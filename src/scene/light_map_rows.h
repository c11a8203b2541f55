#pragma once
// What lights shine by: pictures, profiles and the formula of the sky (part of scene/compiled.h).

#include <cstdint>

#include "soa/fields.h"

namespace yat {

/// How a picture is laid over directions of light space (lxs 6.4); phi from +x towards +y.
enum class MapLayout : uint32_t {
  kLatLong,  ///< s = phi / 2 pi, t = theta / pi from +z: row 0 is the zenith
  kAngular,  ///< a disc about -x
  kCross,    ///< the six sides of a cube in 3 x 4 cells
};

/// A map of a light: its place in the scene, its texels, and the cells that directions are drawn
/// by. Cells divide the lat-long square of light space, whatever the picture's layout. Their lists
/// start at LightView::cells + cells: that of the rows, then that of the columns of each row. A
/// list of n cells has n + 1 cumulative values from 0 to 1, then cell_guides(n) + 1 guides: number
/// k is the last cell that starts at or below k / cell_guides(n).
template <template <class> class Of>
struct LightMapRow {
  Of<float> m_xx, m_xy, m_xz, m_yx, m_yy, m_yz, m_zx, m_zy, m_zz;  ///< scene -> light, |det| = 1
  Of<uint32_t> layout;                                             ///< MapLayout
  Of<uint32_t> texels, width, height;  ///< first texel in LightView::texels, and how many
  Of<uint32_t> cells, columns, rows;   ///< columns = 0: no directions are drawn by this map
  YAT_FIELDS(m_xx, m_xy, m_xz, m_yx, m_yy, m_yz, m_zx, m_zy, m_zz, layout, texels, width, height,
             cells, columns, rows)
};
static_assert(all_fields_listed<LightMapRow>);

/// One guide to four cells. Count: a number or a register of them.
template <class Count>
YAT_INLINE Count cell_guides(const Count& cells) {
  return (cells + Count(3u)) >> 2;
}
/// Words of a list of cells.
template <class Count>
YAT_INLINE Count cell_list_words(const Count& cells) {
  return cells + cell_guides(cells) + Count(2u);
}

/// Words of a texel in LightView::texels: three bands and one that is not used.
inline constexpr uint32_t kTexelWords = 4;

/// A clear sky as a formula (Preetham, Shirley, Smits 1999; lxs 6.5): luminance and chromaticities
/// are q = scale_q (1 + a e^(b / cos theta)) (1 + c e^(d gamma) + e cos^2 gamma), never below 0.
template <template <class> class Of>
struct SkyRow {
  Of<float> a_l, b_l, c_l, d_l, e_l, a_x, b_x, c_x, d_x, e_x, a_y, b_y, c_y, d_y, e_y;
  Of<float> scale_l, scale_x, scale_y;
  Of<float> sun_x, sun_y, sun_z;  ///< unit, light space
  YAT_FIELDS(a_l, b_l, c_l, d_l, e_l, a_x, b_x, c_x, d_x, e_x, a_y, b_y, c_y, d_y, e_y, scale_l,
             scale_x, scale_y, sun_x, sun_y, sun_z)
};
static_assert(all_fields_listed<SkyRow>);
/// Angles to the zenith end there [radians below a right angle]: all that is below has the colour
/// of the horizon.
inline constexpr float kSkyHorizon = .001f;
/// Its exponents are not above this, which only odd constants would have them be.
inline constexpr float kSkyExponent = 40;

}  // namespace yat

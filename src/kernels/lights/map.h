#pragma once
// Maps of lights: from the scene to a map's own space and back, what a picture holds in a
// direction, and directions drawn by the map's cells.

#include "kernels/light.h"

namespace yat::YAT_ISA {

template <class A>
using LightMapW = LightMapRow<Lanes<A>::template Of>;

/// The rows' maps; lanes outside of_kind get any map.
template <class A>
YAT_INLINE LightMapW<A> load_map(const LightView& lights, const LightRowW<A>& row,
                                 const Mask<A>& of_kind) {
  if (lights.maps.count == 1) return broadcast<A>(lights.maps, 0);
  return gather<A>(lights.maps, only<A>(of_kind, as_uint<A>(row.c_x)));
}

/// A direction of light space, and how much longer than the scene's unit direction its image was.
template <class A>
struct MappedDirection {
  Vec3<A> unit;
  Float<A> stretch;
};
template <class A>
YAT_INLINE MappedDirection<A> to_map(const LightMapW<A>& map, const Vec3<A>& w) {
  const Vec3<A> image{map.m_xx * w.x + map.m_xy * w.y + map.m_xz * w.z,
                      map.m_yx * w.x + map.m_yy * w.y + map.m_yz * w.z,
                      map.m_zx * w.x + map.m_zy * w.y + map.m_zz * w.z};
  const Float<A> stretch = length(image);
  return {(Float<A>(1.f) / stretch) * image, stretch};
}
/// The inverse by cofactors: the determinant is 1 or -1. stretch: of the scene's direction.
template <class A>
YAT_INLINE MappedDirection<A> to_scene(const LightMapW<A>& map, const Vec3<A>& l) {
  const Vec3<A> x{map.m_xx, map.m_xy, map.m_xz}, y{map.m_yx, map.m_yy, map.m_yz},
      z{map.m_zx, map.m_zy, map.m_zz};
  const Vec3<A> yz = cross(y, z);
  const Float<A> sign = xsimd::copysign(Float<A>(1.f), dot(x, yz));
  const Vec3<A> image = sign * (l.x * yz + l.y * cross(z, x) + l.z * cross(x, y));
  const Float<A> stretch = length(image);
  return {(Float<A>(1.f) / stretch) * image, stretch};
}

/// Place of a direction of light space on the lat-long square.
template <class A>
YAT_INLINE Point2<A> latlong_place(const Vec3<A>& l) {
  const Float<A> across = xsimd::sqrt(l.x * l.x + l.y * l.y);
  return {angle_in_turns<A>(l.x, l.y), Float<A>(2.f) * angle_in_turns<A>(l.z, across)};
}

// ---- Texels ----------------------------------------------------------------------------------

/// Where to look into a picture: texel coordinates, the centre of the first texel at (0, 0), and
/// what they may not leave.
template <class A>
struct TexelPlace {
  Float<A> x, y;
  Mask<A> around;  ///< x goes on at the other side; else it is clamped, as y always is
};

template <class A>
YAT_INLINE Float<A> to_number(const UInt<A>& count) {
  return xsimd::to_float(xsimd::bitwise_cast<int32_t>(count));
}

/// lxs 6.4. The cross is looked up within the cell of the direction, whose neighbours in the
/// picture need not be neighbours on the sphere.
template <class A>
YAT_INLINE TexelPlace<A> picture_place(const LightMapW<A>& map, const Vec3<A>& l) {
  const Float<A> zero(0.f), half(.5f), one(1.f);
  const Float<A> width = to_number<A>(map.width), height = to_number<A>(map.height);
  const auto is = [&map](MapLayout layout) {
    return mask_of<A>(map.layout == UInt<A>(uint32_t(layout)));
  };
  TexelPlace<A> place;
  place.around = is(MapLayout::kLatLong);
  const Point2<A> square = latlong_place<A>(l);
  place.x = square.x * width - half;
  place.y = square.y * height - half;
  const Mask<A> angular = is(MapLayout::kAngular), crossed = is(MapLayout::kCross);
  if (any<A>(angular)) {
    const Float<A> across = xsimd::sqrt(l.y * l.y + l.z * l.z);
    const Float<A> r = angle_in_turns<A>(-l.x, across);
    const Float<A> scale = xsimd::select(across > zero, r / across, zero);
    place.x = xsimd::select(angular, (half - l.y * scale) * width - half, place.x);
    place.y = xsimd::select(angular, (half - l.z * scale) * height - half, place.y);
  }
  if (any<A>(crossed)) {
    const Float<A> ax = xsimd::abs(l.x), ay = xsimd::abs(l.y), az = xsimd::abs(l.z);
    const Mask<A> by_x = (ax >= ay) & (ax >= az), by_y = (!by_x) & (ay >= az);
    const Mask<A> positive = xsimd::select(by_x, l.x, xsimd::select(by_y, l.y, l.z)) > zero;
    const Float<A> m = xsimd::max(ax, xsimd::max(ay, az));
    // Cells by (column, row): +z (1,0), +y (0,1), -x (1,1), -y (2,1), -z (1,2), +x (1,3).
    const Float<A> sc = xsimd::select(by_y, xsimd::select(positive, -l.x, l.x), -l.y);
    const Float<A> tc = xsimd::select(by_x | by_y, xsimd::select(by_x & positive, l.z, -l.z),
                                      xsimd::select(positive, -l.x, l.x));
    const Float<A> column = xsimd::select(by_y, xsimd::select(positive, zero, Float<A>(2.f)), one);
    const Float<A> row =
        xsimd::select(by_x, xsimd::select(positive, Float<A>(3.f), one),
                      xsimd::select(by_y, one, xsimd::select(positive, zero, Float<A>(2.f))));
    const Float<A> cell_w = width * Float<A>(1.f / 3), cell_h = height * Float<A>(.25f);
    const auto inside = [&](const Float<A>& c, const Float<A>& size) {
      const Float<A> texel = (c / m + one) * half * size - half;
      return xsimd::min(xsimd::max(texel, zero), xsimd::max(size - one, zero));
    };
    place.x = xsimd::select(crossed, column * cell_w + inside(sc, cell_w), place.x);
    place.y = xsimd::select(crossed, row * cell_h + inside(tc, cell_h), place.y);
  }
  return place;
}

/// Bands of texels; any index must be valid.
template <class A>
YAT_INLINE ColourTriple<Float<A>> load_texel(const float* texels, const UInt<A>& index) {
#if defined(YAT_HAVE_QUADS)
  Float<A> word[3];
  detail::load_rows<A, kTexelWords, 3>(reinterpret_cast<const uint32_t*>(texels), index, word);
  return {word[0], word[1], word[2]};
#else
  const UInt<A> first = index * UInt<A>(kTexelWords);
  return {gather<A>(texels, first), gather<A>(texels, first + UInt<A>(1u)),
          gather<A>(texels, first + UInt<A>(2u))};
#endif
}

/// Bilinear. A place that is not a number gives some texel of the map.
template <class A>
YAT_INLINE ColourTriple<Float<A>> look_up(const LightView& lights, const LightMapW<A>& map,
                                          const TexelPlace<A>& place) {
  const Float<A> one(1.f);
  const UInt<A> last_x = map.width - UInt<A>(1u), last_y = map.height - UInt<A>(1u);
  // Places begin at -1/2: one more makes truncation the floor.
  const Int<A> x = xsimd::to_int(place.x + one), y = xsimd::to_int(place.y + one);
  const Float<A> fx = place.x + one - xsimd::to_float(x), fy = place.y + one - xsimd::to_float(y);
  const auto column = [&](const Int<A>& c) {
    const UInt<A> number = xsimd::bitwise_cast<uint32_t>(c);
    const Mask<A> before = negative<A>(number), after = mask_of<A>(number > last_x);
    const UInt<A> low = select<A>(place.around, last_x, UInt<A>(0u));
    const UInt<A> high = select<A>(place.around, UInt<A>(0u), last_x);
    return select<A>(before, low, select<A>(after, high, number));
  };
  const auto row = [&](const Int<A>& r) {
    const UInt<A> number = xsimd::bitwise_cast<uint32_t>(r);
    const UInt<A> clamped = select<A>(negative<A>(number), UInt<A>(0u), number);
    return map.texels + xsimd::min(clamped, last_y) * map.width;
  };
  const UInt<A> x0 = column(x - Int<A>(1)), x1 = column(x), y0 = row(y - Int<A>(1)), y1 = row(y);
  const auto a = load_texel<A>(lights.texels, y0 + x0), b = load_texel<A>(lights.texels, y0 + x1);
  const auto c = load_texel<A>(lights.texels, y1 + x0), d = load_texel<A>(lights.texels, y1 + x1);
  const auto blend = [&](const Float<A>& a_, const Float<A>& b_, const Float<A>& c_,
                         const Float<A>& d_) {
    const Float<A> top = a_ + fx * (b_ - a_), bottom = c_ + fx * (d_ - c_);
    return top + fy * (bottom - top);
  };
  return {blend(a.r, b.r, c.r, d.r), blend(a.g, b.g, c.g, d.g), blend(a.b, b.b, c.b, d.b)};
}

// ---- Cells -----------------------------------------------------------------------------------

/// A place on the lat-long square, and the density there (1 for an even distribution).
template <class A>
struct CellPlace {
  Float<A> s, t, density;
};

/// Inverts the cumulative values of a list of cells, linear within each: the place in [0, count]
/// and the mass of its cell.
template <class A>
struct Inverted {
  UInt<A> cell;
  Float<A> place, mass;
};
/// table   LightView::cells; the list of `count` cells starts at `first` (LightMapRow says how).
/// active  lanes that hold a list; the others get its first cell, whatever it is.
/// u       in [0, 1).
///
/// Source  Chen, Asau, "On Generating Random Variates from an Empirical Distribution", 1974, for
///         the guides; between two of them, halving.
template <class A>
YAT_INLINE Inverted<A> invert_cells(const float* table, const UInt<A>& first, const UInt<A>& count,
                                    const Mask<A>& active, const Float<A>& u) {
  const Float<A> zero(0.f), one(1.f);
  const UInt<A> step(1u);
  const UInt<A> guides = cell_guides(count);
  const UInt<A> bucket = xsimd::min(
      xsimd::bitwise_cast<uint32_t>(xsimd::to_int(u * to_number<A>(guides))), guides - step);
  const UInt<A> guide = only<A>(active, first + count + step + bucket);
  const auto guided = [&](const UInt<A>& at) {
    const Float<A> cell = only<A>(active, gather<A>(table, at));
    return xsimd::bitwise_cast<uint32_t>(xsimd::to_int(cell));
  };
  // The last cell whose start is not above u. A cell without mass ends where it starts, so that it
  // is passed over.
  UInt<A> low = guided(guide), high = guided(guide + step);
  for (Mask<A> open = mask_of<A>(low < high); any<A>(open); open = mask_of<A>(low < high)) {
    const UInt<A> middle = (low + high + step) >> 1;
    const Float<A> start = gather<A>(table, only<A>(active, first + middle));
    const Mask<A> before = start <= u;
    low = select<A>(open & before, middle, low);
    high = select<A>(open & !before, middle - step, high);
  }
  const UInt<A> at = only<A>(active, first + low);
  const Float<A> start = gather<A>(table, at), mass = gather<A>(table, at + step) - start;
  Float<A> inside = xsimd::select(mass > zero, (u - start) / mass, zero);
  inside = xsimd::min(xsimd::max(inside, zero), one);
  return {low, to_number<A>(low) + inside, mass};
}

template <class A>
YAT_INLINE UInt<A> first_of_row(const LightMapW<A>& map, const UInt<A>& row) {
  return map.cells + cell_list_words(map.rows) + row * cell_list_words(map.columns);
}

/// A place by the map's cells; v chooses the row.
template <class A>
YAT_INLINE CellPlace<A> sample_cells(const LightView& lights, const LightMapW<A>& map,
                                     const Mask<A>& of_kind, const Float<A>& u, const Float<A>& v) {
  const Float<A> columns = to_number<A>(map.columns), rows = to_number<A>(map.rows);
  const Inverted<A> t = invert_cells<A>(lights.cells, map.cells, map.rows, of_kind, v);
  const Inverted<A> s =
      invert_cells<A>(lights.cells, first_of_row<A>(map, t.cell), map.columns, of_kind, u);
  return {s.place / columns, t.place / rows, (s.mass * columns) * (t.mass * rows)};
}

/// The density of sample_cells at a place of [0, 1]^2.
template <class A>
YAT_INLINE Float<A> cells_density(const LightView& lights, const LightMapW<A>& map,
                                  const Point2<A>& place) {
  const UInt<A> one(1u);
  const Float<A> columns = to_number<A>(map.columns), rows = to_number<A>(map.rows);
  // What is not a number becomes a large index, and is clamped.
  const auto cell = [&](const Float<A>& x, const Float<A>& n, const UInt<A>& count) {
    return xsimd::min(xsimd::bitwise_cast<uint32_t>(xsimd::to_int(x * n)), count - one);
  };
  const UInt<A> column = cell(place.x, columns, map.columns), row = cell(place.y, rows, map.rows);
  const auto mass = [&](const UInt<A>& at) {
    return gather<A>(lights.cells, at + one) - gather<A>(lights.cells, at);
  };
  return (mass(first_of_row<A>(map, row) + column) * columns) * (mass(map.cells + row) * rows);
}

/// Solid angle per area of the lat-long square, of the map's space: 2 pi^2 sin(theta).
inline constexpr float kLatLongMeasure = 2 * kPi * kPi;

/// A direction drawn by the cells: into a pick without its shade, and in light space.
template <class A>
struct CellPick {
  LightPick<A> pick;
  Vec3<A> local;
};
template <class A>
YAT_INLINE CellPick<A> pick_by_cells(const LightView& lights, const LightMapW<A>& map,
                                     const Mask<A>& of_kind, const Vec3<A>& receiver,
                                     const Float<A>& far, const Float<A>& u, const Float<A>& v) {
  const Float<A> zero(0.f), one(1.f);
  const CellPlace<A> place = sample_cells<A>(lights, map, of_kind, u, v);
  const SinCos<A> theta = sin_cos_turns<A>(Float<A>(.5f) * place.t);
  const SinCos<A> phi = sin_cos_turns<A>(place.s);
  CellPick<A> out;
  out.local = {theta.sin * phi.cos, theta.sin * phi.sin, theta.cos};
  const MappedDirection<A> scene = to_scene<A>(map, out.local);
  // A linear map of determinant 1 turns solid angles by the cube of how it stretches directions.
  const Float<A> angle = Float<A>(kLatLongMeasure) * theta.sin /
                         (scene.stretch * scene.stretch * scene.stretch * place.density);
  const Mask<A> good = angle > zero;
  out.pick.wi = scene.unit;
  out.pick.to = receiver + far * scene.unit;
  out.pick.measure = only<A>(good, angle);
  out.pick.pdf = only<A>(good, one / angle);
  return out;
}

/// The density of pick_by_cells for a direction that to_map() found.
template <class A>
YAT_INLINE Float<A> pdf_by_cells(const LightView& lights, const LightMapW<A>& map,
                                 const MappedDirection<A>& found) {
  const Float<A> sin = xsimd::sqrt(found.unit.x * found.unit.x + found.unit.y * found.unit.y);
  const Float<A> density = cells_density<A>(lights, map, latlong_place<A>(found.unit));
  // to_map's stretch is the inverse of to_scene's.
  return density /
         (Float<A>(kLatLongMeasure) * sin * found.stretch * found.stretch * found.stretch);
}

}  // namespace yat::YAT_ISA

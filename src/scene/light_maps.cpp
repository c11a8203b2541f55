#include "scene/light_maps.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "scene/compile_parts.h"

namespace yat {

namespace {

constexpr double kPi = std::numbers::pi;

double y_of(const glm::dvec3& bands, const BandMatrix& film) {
  return luminance(to_rgb(bands, film));
}

/// Angle of (x, y) in turns, [0, 1).
double turns(double x, double y) {
  const double t = std::atan2(y, x) / (2 * kPi);
  return t < 0 ? t + 1 : t;
}

double across(double a, double b) {
  return std::sqrt(a * a + b * b);
}

}  // namespace

std::optional<LightMapRow<Value>> make_light_map(const glm::dmat3& light_to_world) {
  const glm::dmat3 inverse = glm::inverse(light_to_world);
  const glm::dmat3 m = inverse / std::cbrt(std::fabs(glm::determinant(inverse)));
  LightMapRow<Value> map{};
  // Lanes of other lights look up any map: every one has a first texel.
  map.width = map.height = 1;
  float* const out[3][3] = {{&map.m_xx, &map.m_xy, &map.m_xz},
                            {&map.m_yx, &map.m_yy, &map.m_yz},
                            {&map.m_zx, &map.m_zy, &map.m_zz}};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      if (!std::isfinite(m[column][row])) return std::nullopt;
      *out[row][column] = float(m[column][row]);
    }
  return map;
}

void add_texels(const LightPicture& picture, MapLayout layout, LightTables& tables,
                LightMapRow<Value>& map) {
  map.layout = uint32_t(layout);
  map.texels = uint32_t(tables.texels.size() / kTexelWords);
  map.width = picture.width;
  map.height = picture.height;
  tables.texels.reserve(tables.texels.size() + picture.texels.size() * kTexelWords);
  for (const glm::vec3& bands : picture.texels)
    for (const float band : {bands.x, bands.y, bands.z, 0.f}) tables.texels.push_back(band);
}

glm::dvec3 texel_colour(const LightMapRow<Value>& map, const float* texels, double x, double y,
                        bool around) {
  const auto width = int64_t(map.width), height = int64_t(map.height);
  const double left = std::floor(x), top = std::floor(y), fx = x - left, fy = y - top;
  const auto texel = [&](double column, double row) {
    auto i = int64_t(column);
    i = around ? (i % width + width) % width : std::clamp<int64_t>(i, 0, width - 1);
    const int64_t j = std::clamp<int64_t>(int64_t(row), 0, height - 1);
    const float* t = texels + (size_t(map.texels) + size_t(j * width + i)) * kTexelWords;
    return glm::dvec3(t[0], t[1], t[2]);
  };
  return (1 - fy) * ((1 - fx) * texel(left, top) + fx * texel(left + 1, top)) +
         fy * ((1 - fx) * texel(left, top + 1) + fx * texel(left + 1, top + 1));
}

glm::dvec3 map_colour(const LightMapRow<Value>& map, const float* texels, const glm::dvec3& l) {
  const double width = map.width, height = map.height;
  switch (MapLayout(map.layout)) {
    case MapLayout::kLatLong:
      break;
    case MapLayout::kAngular: {
      const double side = across(l.y, l.z);
      const double scale = side > 0 ? turns(-l.x, side) / side : 0;
      return texel_colour(map, texels, (.5 - l.y * scale) * width - .5,
                          (.5 - l.z * scale) * height - .5, false);
    }
    case MapLayout::kCross: {
      const glm::dvec3 a = glm::abs(l);
      const double m = std::max({a.x, a.y, a.z});
      double column = 1, row = 1, sc = -l.y, tc = 0;
      if (a.x >= a.y && a.x >= a.z) {
        row = l.x > 0 ? 3 : 1;
        tc = l.x > 0 ? l.z : -l.z;
      } else if (a.y >= a.z) {
        column = l.y > 0 ? 0 : 2;
        sc = l.y > 0 ? -l.x : l.x;
        tc = -l.z;
      } else {
        row = l.z > 0 ? 0 : 2;
        tc = l.z > 0 ? -l.x : l.x;
      }
      // Not beyond the middle of the cell's own outermost texels.
      const auto inside = [](double c, double size) {
        return std::clamp((c + 1) / 2 * size - .5, 0., std::max(size - 1, 0.));
      };
      return texel_colour(map, texels, column * width / 3 + inside(sc / m, width / 3),
                          row * height / 4 + inside(tc / m, height / 4), false);
    }
  }
  const double theta = std::atan2(across(l.x, l.y), l.z);
  return texel_colour(map, texels, turns(l.x, l.y) * width - .5, theta / kPi * height - .5, true);
}

glm::dvec3 sky_colour(const SkyRow<Value>& sky, const BandBasis& basis, const glm::dvec3& l) {
  const glm::dvec3 sun(sky.sun_x, sky.sun_y, sky.sun_z);
  const double cos_theta = std::max(l.z, double(kSkyHorizon)), cos_gamma = glm::dot(l, sun);
  const double gamma = std::atan2(glm::length(glm::cross(l, sun)), cos_gamma);
  const auto exponential = [](double x) { return std::exp(std::min(x, double(kSkyExponent))); };
  const auto perez = [&](float scale, float a, float b, float c, float d, float e) {
    return double(scale) * (1 + double(a) * exponential(double(b) / cos_theta)) *
           (1 + double(c) * exponential(double(d) * gamma) + double(e) * cos_gamma * cos_gamma);
  };
  const double luminance =
      std::max(0., perez(sky.scale_l, sky.a_l, sky.b_l, sky.c_l, sky.d_l, sky.e_l));
  const double x = perez(sky.scale_x, sky.a_x, sky.b_x, sky.c_x, sky.d_x, sky.e_x);
  const double y = perez(sky.scale_y, sky.a_y, sky.b_y, sky.c_y, sky.d_y, sky.e_y);
  const glm::dvec3 xyz(x / y * luminance, luminance, (1 - x - y) / y * luminance);
  return to_bands(glm::max(xyz_to_rec709(xyz), glm::dvec3(0.)), basis);
}

glm::dvec3 latlong_direction(double s, double t) {
  const double theta = kPi * t, phi = 2 * kPi * s;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// ---- Cells -----------------------------------------------------------------------------------

namespace {

constexpr uint32_t kMostColumns = 1024, kMostRows = 512;

/// Solid angle of a cell of a row.
double cell_angle(const CellMeans& cells, uint32_t row) {
  const double from = std::cos(kPi * row / cells.rows), to = std::cos(kPi * (row + 1) / cells.rows);
  return (from - to) * 2 * kPi / cells.columns;
}

/// Mean of value(s, t) over each cell, from across x down places in it, weighted by solid angle.
template <class Function>
CellMeans tabulate(uint32_t columns, uint32_t rows, uint32_t across, uint32_t down,
                   const Function& value) {
  CellMeans cells{columns, rows, std::vector<double>(size_t(columns) * rows)};
  for (uint32_t row = 0; row < rows; ++row)
    for (uint32_t column = 0; column < columns; ++column) {
      double sum = 0, weights = 0;
      for (uint32_t j = 0; j < down; ++j) {
        const double t = (row + (j + .5) / down) / rows, weight = std::sin(kPi * t);
        weights += weight * across;
        for (uint32_t i = 0; i < across; ++i)
          sum += weight * value((column + (i + .5) / across) / columns, t);
      }
      cells.mean[size_t(row) * columns + column] = sum / weights;
    }
  return cells;
}

}  // namespace

double CellMeans::average() const {
  double sum = 0;
  for (uint32_t row = 0; row < rows; ++row)
    for (uint32_t column = 0; column < columns; ++column)
      sum += mean[size_t(row) * columns + column] * cell_angle(*this, row);
  return sum / (4 * kPi);
}

double CellMeans::unevenness() const {
  const double whole = average();
  if (!(whole > 0)) return 1;
  double sum = 0;
  for (uint32_t row = 0; row < rows; ++row)
    for (uint32_t column = 0; column < columns; ++column) {
      const double times = mean[size_t(row) * columns + column] / whole;
      sum += times * times * cell_angle(*this, row);
    }
  return sum / (4 * kPi);
}

CellMeans picture_cells(const LightMapRow<Value>& map, const LightTables& tables,
                        const glm::dvec3& radiance, const BandMatrix& film) {
  const float* texels = tables.texels.data();
  if (MapLayout(map.layout) != MapLayout::kLatLong)
    return tabulate(kMostColumns / 2, kMostRows / 2, 3, 3, [&](double s, double t) {
      return y_of(radiance * map_colour(map, texels, latlong_direction(s, t)), film);
    });
  const uint32_t columns = std::clamp(map.width, 16u, kMostColumns);
  const uint32_t rows = std::clamp(map.height, 8u, kMostRows);
  // Where a texel is no larger than a cell, one place a texel; else two see its slope.
  const auto places = [](uint32_t texels_there, uint32_t count) {
    return texels_there <= count ? 2 : (texels_there + count - 1) / count;
  };
  return tabulate(
      columns, rows, places(map.width, columns), places(map.height, rows), [&](double s, double t) {
        return y_of(
            radiance * texel_colour(map, texels, s * map.width - .5, t * map.height - .5, true),
            film);
      });
}

CellMeans sky_cells(const SkyRow<Value>& sky, const BandBasis& basis, const BandMatrix& film) {
  return tabulate(256, 128, 2, 2, [&](double s, double t) {
    return y_of(sky_colour(sky, basis, latlong_direction(s, t)), film);
  });
}

void add_cells(const CellMeans& cells, LightTables& tables, LightMapRow<Value>& map) {
  map.cells = uint32_t(tables.cells.size());
  map.columns = cells.columns;
  map.rows = cells.rows;
  const double even = cells.average() / (kEvenShare - 1);
  std::vector<double> row_mass(cells.rows);
  // A list of `count` cells: cumulative values from 0 to exactly 1, then guides.
  const auto add = [&tables](const double* mass, uint32_t count) {
    double total = 0, sum = 0;
    for (uint32_t i = 0; i < count; ++i) total += mass[i];
    const size_t first = tables.cells.size();
    tables.cells.push_back(0);
    for (uint32_t i = 0; i < count; ++i) {
      sum += mass[i];
      tables.cells.push_back(i + 1 < count ? std::min(1.f, float(sum / total)) : 1.f);
    }
    const uint32_t guides = cell_guides(count);
    for (uint32_t k = 0, cell = 0; k <= guides; ++k) {
      const float start = float(k) / float(guides);
      while (cell + 1 < count && tables.cells[first + cell + 1] <= start) ++cell;
      tables.cells.push_back(float(cell));
    }
  };
  std::vector<double> mass(cells.mean.size());
  for (uint32_t row = 0; row < cells.rows; ++row)
    for (uint32_t column = 0; column < cells.columns; ++column) {
      const size_t i = size_t(row) * cells.columns + column;
      mass[i] = (cells.mean[i] + even) * cell_angle(cells, row);
      row_mass[row] += mass[i];
    }
  add(row_mass.data(), cells.rows);
  for (uint32_t row = 0; row < cells.rows; ++row)
    add(mass.data() + size_t(row) * cells.columns, cells.columns);
}

}  // namespace yat

#include "film/colour.h"

#include <cmath>

#include "base/error.h"

namespace yat {

ColourMatrix rgb_to_xyz(const float (&red)[2], const float (&green)[2], const float (&blue)[2],
                        const float (&white)[2]) {
  const auto xyz = [](const float(&xy)[2]) {
    const double x = double(xy[0]), y = double(xy[1]);
    return Colour{x / y, 1.0, (1 - x - y) / y};
  };
  const Colour r = xyz(red), g = xyz(green), b = xyz(blue);
  ColourMatrix m;
  for (int i = 0; i < 3; ++i) m[i] = {r[i], g[i], b[i]};
  const Colour scale = inverse(m) * xyz(white);
  for (auto& row : m)
    for (int j = 0; j < 3; ++j) row[j] *= scale[j];
  return m;
}

ColourMatrix rec709_to_xyz() {
  return rgb_to_xyz({.64f, .33f}, {.30f, .60f}, {.15f, .06f}, {.3127f, .3290f});
}

ColourMatrix film_to_xyz(const FilmSettings& settings) {
  return rgb_to_xyz(settings.red, settings.green, settings.blue, settings.white);
}

ColourMatrix inverse(const ColourMatrix& m) {
  const auto minor = [&m](int i, int j) {
    const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return m[a][c] * m[b][d] - m[a][d] * m[b][c];
  };
  const double determinant = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
  // Compared with the size of the terms it is the difference of: what is left of a determinant that
  // should be 0 is rounding.
  double size = 1;
  for (const auto& row : m) size *= std::abs(row[0]) + std::abs(row[1]) + std::abs(row[2]);
  if (!(std::abs(determinant) > 1e-9 * size))
    throw UsageError(
        "film colour space: its primaries lie on one line, so no colour has a place in it");
  ColourMatrix out;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out[j][i] = minor(i, j) / determinant;
  return out;
}

ColourMatrix operator*(const ColourMatrix& a, const ColourMatrix& b) {
  ColourMatrix out{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) out[i][j] += a[i][k] * b[k][j];
  return out;
}

Colour operator*(const ColourMatrix& m, const Colour& v) {
  Colour out{};
  for (int i = 0; i < 3; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return out;
}

}  // namespace yat

#pragma once
// Colour spaces given by primaries and white, as 3 x 3 matrices to and from CIE XYZ. No chromatic
// adaptation anywhere (lxs 9).

#include <array>

#include "film/settings.h"

namespace yat {

using Colour = std::array<double, 3>;
/// Row-major.
using ColourMatrix = std::array<std::array<double, 3>, 3>;

/// RGB -> XYZ of the space with these xy chromaticities: RGB (1,1,1) is the white at Y = 1.
ColourMatrix rgb_to_xyz(const float (&red)[2], const float (&green)[2], const float (&blue)[2],
                        const float (&white)[2]);
/// Linear Rec.709 (white D65) -> XYZ.
ColourMatrix rec709_to_xyz();
/// The film's colour space -> XYZ. Throws UsageError when its primaries lie on one line.
ColourMatrix film_to_xyz(const FilmSettings& settings);

/// Throws UsageError when there is no inverse.
ColourMatrix inverse(const ColourMatrix& m);
ColourMatrix operator*(const ColourMatrix& a, const ColourMatrix& b);
Colour operator*(const ColourMatrix& m, const Colour& v);

}  // namespace yat

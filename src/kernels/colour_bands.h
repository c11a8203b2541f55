#pragma once
// Colours in three transport bands, written once for a number type: double or float in scalar code,
// a register of floats in kernels. Which bands they are is data (scene/colour_model.h).

#include "soa/fields.h"

namespace yat {

template <class Number>
struct ColourTriple {
  Number r, g, b;
};

/// What the six pure colours are in the red, green and blue band. White is (1, 1, 1).
struct BandBasis {
  float cyan[3], magenta[3], yellow[3], red[3], green[3], blue[3];
};

/// Linear Rec.709 -> bands: the colour as the most white that is in it, then the most of one of
/// cyan, magenta and yellow, then what is left of red, green or blue.
///
/// r, g, b  >= 0. Grey comes out as it is, to the bit; c times a colour as c times its bands.
/// basis    entries in 0..1 keep channels of 0..1 in 0..1: energy is conserved.
/// smaller  the lesser of two numbers.
///
/// Source  Smits, "An RGB-to-Spectrum Conversion for Reflectances", JGT 4(4), 1999.
///         Departs: his cases are written as minima, of which all but two are 0.
template <class Number, class Smaller>
YAT_INLINE ColourTriple<Number> bands_of(const ColourTriple<Number>& rgb, const BandBasis& basis,
                                         Smaller smaller) {
  const Number white = smaller(rgb.r, smaller(rgb.g, rgb.b));
  const Number r = rgb.r - white, g = rgb.g - white, b = rgb.b - white;
  const Number cyan = smaller(g, b), magenta = smaller(r, b), yellow = smaller(r, g);
  const Number red = r - magenta - yellow, green = g - cyan - yellow, blue = b - cyan - magenta;
  const auto band = [&](int k) {
    return white + cyan * Number(basis.cyan[k]) + magenta * Number(basis.magenta[k]) +
           yellow * Number(basis.yellow[k]) + red * Number(basis.red[k]) +
           green * Number(basis.green[k]) + blue * Number(basis.blue[k]);
  };
  return {band(0), band(1), band(2)};
}

/// Bands -> linear Rec.709: r = r_r r + r_g g + r_b b and so on. Rows sum to 1, and only what is
/// off the diagonal is kept.
struct BandMatrix {
  float r_g, r_b, g_r, g_b, b_r, b_g;
};

/// Equal bands come out as they are, to the bit.
template <class Number>
YAT_INLINE ColourTriple<Number> rgb_of(const ColourTriple<Number>& bands, const BandMatrix& m) {
  const Number r_to_g = bands.g - bands.r, g_to_b = bands.b - bands.g, b_to_r = bands.r - bands.b;
  return {bands.r + Number(m.r_g) * r_to_g - Number(m.r_b) * b_to_r,
          bands.g + Number(m.g_b) * g_to_b - Number(m.g_r) * r_to_g,
          bands.b + Number(m.b_r) * b_to_r - Number(m.b_g) * g_to_b};
}

}  // namespace yat

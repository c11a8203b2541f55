#pragma once
// How the colours of a scene multiply. Transport knows three bands and multiplies them one by one;
// what a colour of the scene is in these bands, and what the bands are on the film, is decided
// here, when the scene is compiled.

#include <cstdint>
#include <glm/vec3.hpp>

#include "kernels/colour_bands.h"

namespace yat {

enum class ColourMode : uint32_t {
  /// Bands that multiply as LuxRender's spectra do.
  kBands,
  /// The channels of linear Rec.709 are the bands.
  kRgb,
};

struct ColourModel {
  BandBasis reflectance;  ///< of surfaces: entries in 0..1
  BandBasis light;        ///< of what shines, relative to a white light: entries >= 0
  BandMatrix film;        ///< bands -> linear Rec.709
};

/// kBands. LuxRender makes a spectrum of every colour and multiplies spectra; a path of four
/// bounces between orange walls then brings back 8 % less luminance than the product of RGB
/// triples, and a white light on a pure red surface 1.6 % more red. Three numbers a colour are
/// enough to follow that, if they are not the channels of the screen but bands that overlap as the
/// spectra do, and if the film is told what these look like (Ward, Eydelberg-Vileshin, "Picture
/// Perfect RGB Rendering Using Spectral Prefiltering and Sharp Color Primaries", 2002).
///
/// The numbers are a least squares fit. Fitted to: the linear Rec.709 of spectral products, light
/// times 0 to 6 reflectances, over random colours of all saturations, with the spectra of a colour
/// by Smits' method (1999), from bases of 32 samples over 380..720 nm for reflectances (white E)
/// and for lights (white D65), as LuxRender and pbrt (Pharr, Humphreys) publish them, and the CIE
/// 1931 observer. Free: both bases and the matrix; held: white (1, 1, 1) is 1, 1, 1.
/// docs/decisions.md, "Three bands that multiply like spectra", has what is left of the error.
const ColourModel& colour_model(ColourMode mode);

/// A colour of the scene (linear Rec.709, >= 0) in the bands of `basis`.
glm::dvec3 to_bands(const glm::dvec3& rgb, const BandBasis& basis);
/// Bands as linear Rec.709. Saturated products may have a small negative channel: they lie outside
/// its gamut.
glm::dvec3 to_rgb(const glm::dvec3& bands, const BandMatrix& film);

}  // namespace yat

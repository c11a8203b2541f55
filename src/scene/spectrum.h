#pragma once
// Spectra of the scene as colours: what a curve over wavelengths is in linear Rec.709.

#include <functional>
#include <glm/vec3.hpp>

namespace yat {

/// A value for a wavelength in nm, asked for 380..720.
using SpectralCurve = std::function<double(double)>;

/// A reflectance: the colour of a surface under D65, so that 1 throughout is white. Channels may be
/// negative where the colour is outside Rec.709.
glm::dvec3 rgb_of_reflectance(const SpectralCurve& curve);

/// What shines [W m^-2 sr^-1 nm^-1]: linear Rec.709 with luminance in cd/m2, as LuxRender counts
/// its lights.
///
/// Source  CIE 1931 curves by Wyman, Sloan, Shirley, "Simple Analytic Approximations to the CIE XYZ
///         Color Matching Functions", JCGT 2(2), 2013 (several lobes), good to about 1 % of the
///         peak.
glm::dvec3 rgb_of_light(const SpectralCurve& curve);

/// Planck's curve scaled so that its largest value within 380..720 nm is 1. temperature > 0 [K].
SpectralCurve blackbody_curve(double temperature);

}  // namespace yat

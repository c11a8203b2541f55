#pragma once
// Albedos of rough, flat mirrors by quadrature, from formulas written down here anew.

namespace yat::accuracy {

/// Light that a lobe with F = 1 reflects of a uniform hemisphere, seen at cosine c in (0, 1]:
///   E(c) = integral of D(h) G (o.h) / c over facets h that reflect o upwards.

/// GGX of roughness alpha with the height-correlated masking and shadowing of Smith (Heitz 2014).
double ggx_albedo(double alpha, double c);
/// LuxRender's isotropic lobe: GGX's D with Schlick's G(c) = c / (c (1 - alpha^2) + alpha^2).
double luxrender_albedo(double alpha, double c);
/// Cook and Torrance's: Beckmann's D of slope m, G of V-cavities.
double cook_torrance_albedo(double m, double c);

}  // namespace yat::accuracy

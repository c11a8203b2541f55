#pragma once
// Closed forms of light that arrives from uniform, diffuse emitters. Radiance 1, no occlusion.

#include <glm/vec3.hpp>
#include <vector>

namespace yat::accuracy {

/// Irradiance at p on a surface with normal n (unit) from a polygon, by Lambert's formula: half
/// the sum over the edges of the angle they subtend times their plane's normal . n. What is behind
/// the surface is cut off. `corners` run counter-clockwise as seen from p, else the sign is turned:
/// the magnitude is returned.
double polygon_irradiance(const glm::dvec3& p, const glm::dvec3& n,
                          const std::vector<glm::dvec3>& corners);

/// The rectangle corner + [0, 1] u + [0, 1] v.
double rectangle_irradiance(const glm::dvec3& p, const glm::dvec3& n, const glm::dvec3& corner,
                            const glm::dvec3& u, const glm::dvec3& v);

/// From one to the other of two parallel, opposite rectangles a x b at distance c (Howell's
/// catalogue, C-11).
double opposite_form_factor(double a, double b, double c);

}  // namespace yat::accuracy

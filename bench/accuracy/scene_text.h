#pragma once
// Scene text from geometry. Lengths in scene units; all colours are grey.

#include <glm/vec3.hpp>
#include <string>

namespace yat::accuracy {

using Vec = glm::dvec3;

/// Sees the surface at p from its side n (unit), .1 away, through a cone .1 degrees wide, in 4 x 4
/// pixels: the picture is what p shows along n, to 1e-6 of whatever changes over a unit length.
/// Begins the world.
std::string point_view(const Vec& p, const Vec& n);
inline constexpr double kSpotWidth = 1.745e-4;  ///< of what it sees: 2 x .1 tan(.05 degrees)

/// The same seen along `direction` (unit), from the surface to the camera.
std::string slanted_view(const Vec& p, const Vec& direction);

/// Sees the whole rectangle corner + [0, 1] u + [0, 1] v, u and v perpendicular, from `distance`
/// before it on the side of u x v, every area alike.
std::string face_view(const Vec& corner, const Vec& u, const Vec& v, double distance);

std::string matte(double kd);
/// What follows shines with radiance L to its outside.
std::string area_light(double radiance);
std::string attribute(const std::string& statements);
/// corner + [0, 1] u + [0, 1] v; its outside is that of u x v.
std::string quad(const Vec& corner, const Vec& u, const Vec& v);
std::string triangle(const Vec& a, const Vec& b, const Vec& c);
std::string translated(const Vec& by, const std::string& statements);
/// The six sides of a box from `least` to `most`, with their outside inside.
std::string room(const Vec& least, const Vec& most);
/// A pane of clear glass (fresnel.h) between the rectangle and the same one `thickness` before it,
/// on the side of u x v.
std::string clear_pane(const Vec& corner, const Vec& u, const Vec& v, double index,
                       double absorption, double thickness);
/// A white receiver of a millimetre, facing n, .1 mm before p: what it takes from others is below
/// 1e-6. And where its middle is.
std::string speck(const Vec& p, const Vec& n);
Vec speck_place(const Vec& p, const Vec& n);
std::string constant_sky(double radiance);
std::string number(double x);

}  // namespace yat::accuracy

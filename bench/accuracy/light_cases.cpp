// Irradiance from one light on a white, diffuse receiver, and radiance in the open.

#include <glm/geometric.hpp>

#include "accuracy/case.h"
#include "accuracy/form_factors.h"
#include "accuracy/quadrature.h"
#include "accuracy/scene_text.h"

namespace yat::accuracy {

namespace {

const Vec kUp(0, 0, 1);
/// The receiver: white, in z = 0, seen at the origin.
std::string receiver() {
  return matte(1) + quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
}
/// A lamp that reflects nothing.
std::string lamp(const std::string& shape, double radiance = 1) {
  return attribute(matte(0) + area_light(radiance) + shape);
}
/// Irradiance at the origin: pi times the radiance of a white receiver.
Case irradiance(const std::string& name, const std::string& what, const std::string& light,
                double expected, std::optional<double> published = {}) {
  return {"lights." + name,
          what,
          {{point_view({0, 0, 0}, kUp) + receiver() + light + "WorldEnd\n", 1, kPi}},
          known(expected),
          published};
}

/// Everything around shines with 1: so does whatever loses nothing.
Case furnace(const std::string& name, const std::string& what, const std::string& object,
             uint32_t depth) {
  const std::string view =
      "LookAt 0 -4 1.5  0 0 0  0 0 1\nCamera \"perspective\" \"float fov\" [20]\nPixelFilter "
      "\"box\" \"float xwidth\" [.5] \"float ywidth\" [.5]\nFilm \"fleximage\" \"integer "
      "xresolution\" [16] \"integer yresolution\" [16]\nWorldBegin\n";
  return {"furnace." + name,
          what,
          {{view + object + constant_sky(1) + "WorldEnd\n", depth}},
          known(1),
          1};
}

}  // namespace

void add_light_cases(std::vector<Case>& cases) {
  // Seen from below: u x v points down.
  const auto square = [](const Vec& corner) { return lamp(quad(corner, {0, 1, 0}, {1, 0, 0})); };
  const auto from_square = [](const Vec& corner) {
    return rectangle_irradiance({0, 0, 0}, kUp, corner, {1, 0, 0}, {0, 1, 0});
  };
  cases.push_back(irradiance("square.centre", "square 1 x 1 at height 1, below its centre",
                             square({-.5, -.5, 1}), from_square({-.5, -.5, 1}), .752274688));
  cases.push_back(irradiance("square.corner", "the same, below a corner", square({0, 0, 1}),
                             from_square({0, 0, 1}), .435209876));
  const Vec a(1, 0, 2), b(0, 1, 2), c(-1, -1, 3);
  cases.push_back(irradiance("triangle", "triangle (1,0,2) (0,1,2) (-1,-1,3)",
                             lamp(triangle(a, c, b)), polygon_irradiance({0, 0, 0}, kUp, {a, b, c}),
                             .258953915));
  // E = pi (r / d)^2
  cases.push_back(irradiance("sphere", "sphere of radius 1, centre 3 overhead",
                             lamp(translated({0, 0, 3}, "Shape \"sphere\" \"float radius\" [1]\n")),
                             kPi / 9, .349065850));
  // E = pi r^2 / (r^2 + h^2)
  cases.push_back(irradiance(
      "disk", "disk of radius 1 at height 2",
      lamp(translated({0, 0, 2}, "ReverseOrientation\nShape \"disk\" \"float radius\" [1]\n")),
      kPi / 5, .628318531));
  // E = I / h^2
  cases.push_back(irradiance("point", "point light of intensity 4 at height 2",
                             "LightSource \"point\" \"point from\" [0 0 2] \"color L\" [4 4 4]\n",
                             1, 1));
  // E = E0 cos(60 degrees)
  cases.push_back(irradiance("distant",
                             "parallel light of irradiance 1, 60 degrees from the normal",
                             "LightSource \"distant\" \"point from\" [0 " + number(std::sqrt(3.)) +
                                 " 1] \"point to\" [0 0 0] \"color L\" [1 1 1]\n",
                             .5, .5));
  cases.push_back(irradiance("sky", "uniform sky of radiance 1", constant_sky(1), kPi, kPi));

  cases.push_back(furnace("convex", "a white ball in light from all around",
                          matte(1) + "Shape \"sphere\" \"float radius\" [.6]\n", 1000));
  cases.push_back(furnace(
      "concave", "a white bowl",
      matte(1) + "Rotate -60 1 0 0\nShape \"sphere\" \"float radius\" [.6] \"float zmax\" [.1]\n",
      1000));
  cases.push_back(furnace("mirror", "a perfect mirror with a hole",
                          "Material \"mirror\" \"color Kr\" [1 1 1]\nShape \"torus\" \"float "
                          "majorradius\" [.5] \"float minorradius\" [.2]\n",
                          1000));
  cases.push_back(furnace("glass", "a clear glass ball",
                          "Material \"glass\" \"color Kr\" [1 1 1] \"color Kt\" [1 1 1] \"float "
                          "index\" [1.5]\nShape \"sphere\" \"float radius\" [.6]\n",
                          1000));
  cases.push_back(furnace("translucent", "a ball of a sheet that reflects and transmits half",
                          "Material \"mattetranslucent\" \"color Kr\" [.5 .5 .5] \"color Kt\" "
                          "[.5 .5 .5]\nShape \"sphere\" \"float radius\" [.6]\n",
                          1000));
}

}  // namespace yat::accuracy

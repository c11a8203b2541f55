// Closed rooms and spheres: light that comes back, and what surfaces send each other.

#include <fmt/format.h>

#include "accuracy/case.h"
#include "accuracy/form_factors.h"
#include "accuracy/quadrature.h"
#include "accuracy/scene_text.h"

namespace yat::accuracy {

namespace {

std::string sphere(double radius, const std::string& more = "") {
  return fmt::format("Shape \"sphere\" \"float radius\" [{}]{}\n", radius, more);
}
/// A wide picture from p, with all that it shows.
std::string inside_view(const Vec& p, const Vec& to) {
  return fmt::format(
      "LookAt {} {} {}  {} {} {}  0 0 1\nCamera \"perspective\" \"float fov\" [80]\nPixelFilter "
      "\"box\" \"float xwidth\" [.5] \"float ywidth\" [.5]\nFilm \"fleximage\" \"integer "
      "xresolution\" [8] \"integer yresolution\" [8]\nWorldBegin\n",
      p.x, p.y, p.z, to.x, to.y, to.z);
}

void add_closed_rooms(std::vector<Case>& cases) {
  // L = Le (1 + rho + ... + rho^n), Le = rho = .5
  const std::string scene = inside_view({-.2, -.7, .1}, {.3, 1, .2}) +
                            attribute(matte(.5) + area_light(.5) + room(Vec(-1), Vec(1))) +
                            "WorldEnd\n";
  double sum = 0, bounced = .5;
  for (uint32_t depth = 0; depth <= 5; ++depth, bounced *= .5) {
    sum += bounced;
    cases.push_back({fmt::format("rooms.closed.{}", depth),
                     fmt::format("closed room, albedo .5, emission .5, after {} bounces", depth),
                     {{scene, depth}},
                     known(sum),
                     sum});
  }
  cases.push_back(
      {"rooms.closed.all", "the same after all bounces", {{scene, 10000}}, known(1), 1});
}

void add_spheres(std::vector<Case>& cases) {
  cases.push_back({"rooms.sphere.point",
                   "unit sphere, albedo .5, point light of intensity pi at its centre",
                   {{inside_view({.5, -.3, .2}, {0, 1, -.4}) + matte(.5) + sphere(1) +
                         fmt::format("LightSource \"point\" \"color L\" [1 1 1] \"float gain\" "
                                     "[{}]\nWorldEnd\n",
                                     kPi),
                     10000}},
                   known(1),
                   1});

  // L1 = 1 + .3 L2, L2 = .6 (F21 L1 + (1 - F21) L2), F21 = 1/4
  const std::string pair = attribute(matte(.3) + area_light(1) + sphere(.5)) +
                           attribute(matte(.6) + sphere(1)) + "WorldEnd\n";
  const double outer = .15 / (1 - .045 - .45), inner = 1 + .3 * outer;
  cases.push_back({"rooms.concentric.inner",
                   "concentric spheres r = .5 (shines with 1, albedo .3) and 1 (.6): inner",
                   {{point_view({.3, 0, .4}, {.6, 0, .8}) + pair, 10000}},
                   known(inner),
                   1.089108911});
  cases.push_back({"rooms.concentric.outer",
                   "the same: outer",
                   {{point_view({.6, 0, .8}, {-.6, 0, -.8}) + pair, 10000}},
                   known(outer),
                   .297029703});

  // A cap of the sphere shines on the rest: F = A / (4 pi R^2) from wherever, A = 2 pi R h.
  const double height = .3, factor = 2 * kPi * height / (4 * kPi);
  const std::string cap = attribute("ReverseOrientation\n" + matte(0) + area_light(1) +
                                    sphere(1, fmt::format(" \"float zmin\" [{}]", 1 - height))) +
                          matte(1) + sphere(1, fmt::format(" \"float zmax\" [{}]", 1 - height)) +
                          "WorldEnd\n";
  const std::pair<const char*, Vec> points[] = {
      {"opposite", {0, 0, -1}}, {"beside", {.8, 0, .6}}, {"across", {0, -1, 0}}};
  for (const auto& [name, p] : points)
    cases.push_back({fmt::format("rooms.integrating_sphere.{}", name),
                     "a cap of height .3 of a unit sphere, seen from the sphere",
                     {{point_view(p, -p) + cap, 1}},
                     known(factor),
                     factor});
}

void add_cube_faces(std::vector<Case>& cases) {
  const double opposite = opposite_form_factor(1, 1, 1);
  const Vec x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const std::string lid = attribute(matte(0) + area_light(1) + quad(z, y, x));
  cases.push_back(
      {"rooms.cube.opposite",
       "unit cube: form factor of opposite faces",
       {{face_view({0, 0, 0}, x, y, .01) + lid + matte(1) + quad({0, 0, 0}, x, y) + "WorldEnd\n",
         1}},
       known(opposite),
       .199824896});
  cases.push_back(
      {"rooms.cube.adjacent",
       "the same of adjacent faces",
       {{face_view({0, 0, 0}, y, z, .01) + lid + matte(1) + quad({0, 0, 0}, y, z) + "WorldEnd\n",
         1}},
       known((1 - opposite) / 4),
       .200043776});
}

}  // namespace

void add_room_cases(std::vector<Case>& cases) {
  add_closed_rooms(cases);
  add_spheres(cases);
  add_cube_faces(cases);
}

}  // namespace yat::accuracy

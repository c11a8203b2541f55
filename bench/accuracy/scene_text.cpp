#include "accuracy/scene_text.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace yat::accuracy {

namespace {

std::string text(const Vec& p) {
  return fmt::format("{} {} {}", p.x, p.y, p.z);
}

std::string film(uint32_t width, uint32_t height) {
  return fmt::format(
      "PixelFilter \"box\" \"float xwidth\" [.5] \"float ywidth\" [.5]\nFilm \"fleximage\" "
      "\"integer xresolution\" [{}] \"integer yresolution\" [{}]\nWorldBegin\n",
      width, height);
}

std::string look(const Vec& from, const Vec& to) {
  const Vec d = glm::normalize(to - from);
  const Vec up = std::fabs(d.z) < .9 ? Vec(0, 0, 1) : Vec(0, 1, 0);
  return "LookAt " + text(from) + "  " + text(to) + "  " + text(up) + "\n";
}

}  // namespace

std::string number(double x) {
  return fmt::format("{}", x);
}

std::string slanted_view(const Vec& p, const Vec& direction) {
  return look(p + .1 * direction, p) + "Camera \"perspective\" \"float fov\" [.1]\n" + film(4, 4);
}
std::string point_view(const Vec& p, const Vec& n) {
  return slanted_view(p, n);
}

std::string face_view(const Vec& corner, const Vec& u, const Vec& v, double distance) {
  const Vec middle = corner + .5 * (u + v), n = glm::normalize(glm::cross(u, v));
  const double x = .5 * glm::length(u), y = .5 * glm::length(v);
  const auto height = uint32_t(std::lround(12 * y / x));
  return "LookAt " + text(middle + distance * n) + "  " + text(middle) + "  " + text(v) +
         fmt::format(
             "\nCamera \"orthographic\" \"float screenwindow\" [{} {} {} {}] \"float "
             "hither\" [1e-5]\n",
             -x, x, -y, y) +
         film(12, height);
}

std::string matte(double kd) {
  return fmt::format("Material \"matte\" \"color Kd\" [{0} {0} {0}]\n", kd);
}
std::string area_light(double radiance) {
  return fmt::format(
      "AreaLightSource \"area\" \"color L\" [1 1 1] \"float gain\" [{}] \"float power\" [0] "
      "\"float efficacy\" [0]\n",
      radiance);
}
std::string attribute(const std::string& statements) {
  return "AttributeBegin\n" + statements + "AttributeEnd\n";
}
std::string translated(const Vec& by, const std::string& statements) {
  return attribute("Translate " + text(by) + "\n" + statements);
}

std::string quad(const Vec& corner, const Vec& u, const Vec& v) {
  return "Shape \"mesh\" \"integer triindices\" [0 1 2 0 2 3] \"point P\" [" + text(corner) + " " +
         text(corner + u) + " " + text(corner + u + v) + " " + text(corner + v) + "]\n";
}
std::string triangle(const Vec& a, const Vec& b, const Vec& c) {
  return "Shape \"mesh\" \"integer triindices\" [0 1 2] \"point P\" [" + text(a) + " " + text(b) +
         " " + text(c) + "]\n";
}

std::string room(const Vec& least, const Vec& most) {
  const Vec x(most.x - least.x, 0, 0), y(0, most.y - least.y, 0), z(0, 0, most.z - least.z);
  return quad(least, x, y) + quad(least, y, z) + quad(least, z, x) + quad(most, -y, -x) +
         quad(most, -z, -y) + quad(most, -x, -z);
}

std::string clear_pane(const Vec& corner, const Vec& u, const Vec& v, double index,
                       double absorption, double thickness) {
  const Vec before = corner + thickness * glm::normalize(glm::cross(u, v));
  return attribute(
      fmt::format("MakeNamedVolume \"pane\" \"clear\" \"float fresnel\" [{0}] \"color "
                  "absorption\" [{1} {1} {1}]\nInterior \"pane\"\nMaterial \"glass2\"\n",
                  index, absorption) +
      quad(before, u, v) + quad(corner, v, u));
}

Vec speck_place(const Vec& p, const Vec& n) {
  return p + 1e-4 * n;
}
std::string speck(const Vec& p, const Vec& n) {
  const Vec u =
      1e-3 * glm::normalize(glm::cross(n, std::fabs(n.z) < .5 ? Vec(0, 0, 1) : Vec(0, 1, 0)));
  const Vec v = glm::cross(n, u);
  return matte(1) + quad(speck_place(p, n) - .5 * (u + v), u, v);
}

std::string constant_sky(double radiance) {
  return fmt::format("LightSource \"infinite\" \"color L\" [1 1 1] \"float gain\" [{}]\n",
                     radiance);
}

}  // namespace yat::accuracy

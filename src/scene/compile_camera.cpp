// Camera -> CameraView (lxs 3).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <utility>

#include "scene/compile_parts.h"

namespace yat {

namespace {

struct Window {
  double x0, x1, y0, y1;
};

/// The screen rectangle: as given, else -1..1 across the shorter side.
Window screen_window(Parameters& camera, const FilmSettings& film) {
  const double image_aspect = double(film.width) / double(film.height);
  const auto aspect = double(camera.number("frameaspectratio", float(image_aspect)));
  std::vector<float> storage;
  const auto given = camera.floats("screenwindow", ParameterType::kFloat, storage);
  if (!given.empty() && given.size() != 4)
    camera.diagnostics().warning(
        camera.loc("screenwindow"),
        fmt::format("\"screenwindow\" has {} numbers where 4 are wanted (x0 x1 y0 y1): the default "
                    "is used",
                    given.size()));
  if (given.size() == 4) {
    const Window w{double(given[0]), double(given[1]), double(given[2]), double(given[3])};
    if (w.x0 == w.x1 || w.y0 == w.y1 || !std::isfinite(w.x0 + w.x1 + w.y0 + w.y1))
      camera.diagnostics().fail(camera.loc("screenwindow"), "\"screenwindow\" is empty");
    const double stretch = std::abs((w.x1 - w.x0) / (w.y1 - w.y0)) / image_aspect;
    if (std::abs(stretch - 1) > .01)
      camera.diagnostics().warning(
          camera.loc("screenwindow"),
          fmt::format(
              "the \"screenwindow\" has another aspect ratio than the {} x {} picture, which "
              "is therefore stretched vertically {:.3g} times",
              film.width, film.height, stretch));
    return w;
  }
  if (!(aspect > 0) || !std::isfinite(aspect))
    camera.diagnostics().fail(
        camera.loc("frameaspectratio"),
        fmt::format("\"frameaspectratio\" is {}, but must be above 0", aspect));
  return aspect > 1 ? Window{-aspect, aspect, -1, 1} : Window{-1, 1, -1 / aspect, 1 / aspect};
}

/// YART's: square pixels, as large as a screen across the shorter side of the window makes them.
Window yart_window(Parameters& camera, const FilmSettings& film) {
  std::vector<float> storage;
  const auto given = camera.floats("screenwindow", ParameterType::kFloat, storage);
  double across = 2;
  if (given.size() == 4)
    across = std::min(std::abs(double(given[1]) - double(given[0])),
                      std::abs(double(given[3]) - double(given[2])));
  if (!(across > 0) || !std::isfinite(across))
    camera.diagnostics().fail(camera.loc("screenwindow"), "\"screenwindow\" is empty");
  const double pixel = across / std::min(film.width, film.height);
  const double x = .5 * pixel * film.width, y = .5 * pixel * film.height;
  return {-x, x, -y, y};
}

void store(float (&to)[3], const glm::dvec3& v) {
  for (int i = 0; i < 3; ++i) to[i] = float(v[i]);
}

bool invertible(const Matrix& m) {
  const double d = glm::determinant(m);
  return std::isfinite(d) && d != 0;
}

}  // namespace

glm::dvec3 camera_position(const Description& description) {
  if (!invertible(description.world_to_camera)) return glm::dvec3(0.);
  return glm::dvec3(glm::inverse(description.world_to_camera)[3]);
}

namespace {

/// Everything that the kinds of cameras have in common while they are read.
struct CameraReader {
  const Description& description;
  const FilmSettings& film;
  const glm::dvec3& center;
  Diagnostics& diagnostics;
  Parameters camera;
  Matrix to_world{1.0};
  glm::dmat3 linear{1.0};  ///< camera axes in the world
  CameraSetup setup{};

  bool by_yart() const { return description.dialect == Dialect::kYart; }
  Window window() { return by_yart() ? yart_window(camera, film) : screen_window(camera, film); }
  float angle(float most);
  void depths(double units_per_m);
  void perspective();
  void lens(double units_per_m);
  void orthographic();
  void environment();
  void fisheye();
};

/// "fov": above 0 and below `most` degrees. YART clamps a perspective camera's to 0..179.
float CameraReader::angle(float most) {
  const float fov = camera.number("fov", 90);
  if (by_yart() && most == 180 && fov > 179) {
    diagnostics.warning(camera.loc("fov"), fmt::format("\"fov\" is {} degrees: 179 is used", fov));
    return 179;
  }
  if (!(fov > 0 && fov < most))
    diagnostics.fail(camera.loc("fov"),
                     fmt::format("\"fov\" is {} degrees, but must be above 0 and "
                                 "below {}",
                                 fov, most));
  return fov;
}

/// hither and yon, which YART does not know. units_per_m: camera z per metre.
void CameraReader::depths(double units_per_m) {
  double hither = 1e-3, yon = 1e30;
  if (by_yart()) {
    camera.accept({"hither", "yon"});
    hither = 0;
  } else {
    hither = double(camera.number("hither", 1e-3f));
    yon = double(camera.number("yon", 1e30f));
  }
  if (!(hither >= 0 && hither < yon))
    diagnostics.fail(camera.loc("hither"),
                     fmt::format("\"hither\" {} and \"yon\" {} leave nothing to "
                                 "see",
                                 hither, yon));
  setup.view.near_depth = float(hither / units_per_m);
  setup.view.far_depth = float(std::min(yon / units_per_m, 1e30));
}

void CameraReader::perspective() {
  CameraView& view = setup.view;
  const double tangent = std::tan(double(angle(180)) * std::numbers::pi / 360);
  const Window w = window();
  // Raster (x, y) is the camera-space point (sx t, sy t, 1), sx from x0 at the left, sy from y1 at
  // the top. Its depth in the world is measured along the gradient of camera z, which also holds
  // when the camera's transform scales or shears.
  const Matrix& to_camera = description.world_to_camera;
  const glm::dvec3 z_row(to_camera[0][2], to_camera[1][2], to_camera[2][2]);
  const double z_per_m = glm::length(z_row);
  store(view.forward, z_row / z_per_m);
  store(view.corner, z_per_m * (linear * glm::dvec3(w.x0 * tangent, w.y1 * tangent, 1)));
  store(view.dx, z_per_m * (linear * glm::dvec3((w.x1 - w.x0) * tangent / film.width, 0, 0)));
  store(view.dy, z_per_m * (linear * glm::dvec3(0, (w.y0 - w.y1) * tangent / film.height, 0)));
  depths(z_per_m);
  lens(z_per_m);
}

void CameraReader::lens(double z_per_m) {
  CameraView& view = setup.view;
  double radius = double(camera.number("lensradius", 0)),
         focus = double(camera.number("focaldistance", 1e30f));
  if (!(radius >= 0)) {
    diagnostics.warning(camera.loc("lensradius"), "\"lensradius\" is negative: a pinhole is used");
    radius = 0;
  }
  const bool automatic = camera.flag("autofocus", false) && !by_yart();
  if (radius > 0 && !automatic && !(focus > 0)) {
    diagnostics.warning(camera.loc("focaldistance"),
                        "\"focaldistance\" is not above 0: a pinhole is used");
    radius = 0;
  }
  const int32_t blades = camera.integer("blades", 0);
  if (radius > 0) setup.kind = blades >= 3 ? CameraKind::kPolygonLens : CameraKind::kThinLens;
  setup.autofocus = radius > 0 && automatic;
  view.blades = uint32_t(std::max(blades, 0));
  store(view.lens_x, radius * linear[0]);
  store(view.lens_y, radius * linear[1]);
  if (!(focus > 0)) focus = 1e30;
  view.focal_distance = float(std::min(focus / z_per_m, 1e30));  // finite, and so are its products
  const std::string distribution = camera.text("distribution", "uniform");
  if (setup.kind == CameraKind::kPolygonLens && distribution != "uniform")
    diagnostics.warning(camera.loc("distribution"),
                        fmt::format("lens \"distribution\" \"{}\" is not supported: the lens is "
                                    "sampled uniformly",
                                    distribution));
  camera.accept({"power"});
}

void CameraReader::orthographic() {
  CameraView& view = setup.view;
  setup.kind = CameraKind::kOrthographic;
  const Window w = window();
  const double length = glm::length(linear[2]);
  store(view.forward, linear[2] / length);
  store(view.corner, glm::dvec3(to_world[3]) - center + linear * glm::dvec3(w.x0, w.y1, 0));
  store(view.dx, linear * glm::dvec3((w.x1 - w.x0) / film.width, 0, 0));
  store(view.dy, linear * glm::dvec3(0, (w.y0 - w.y1) / film.height, 0));
  depths(1 / length);
  camera.accept(
      {"fov", "lensradius", "focaldistance", "autofocus", "blades", "distribution", "power"});
}

void CameraReader::environment() {
  CameraView& view = setup.view;
  setup.kind = CameraKind::kEnvironment;
  store(view.dx, linear[0]);
  store(view.dy, linear[1]);
  store(view.forward, linear[2]);
  view.step_x = 1 / float(film.width);
  view.step_y = 1 / float(film.height);
  camera.accept({"fov", "screenwindow", "frameaspectratio", "hither", "yon", "lensradius",
                 "focaldistance", "autofocus", "blades", "distribution", "power"});
}

void CameraReader::fisheye() {
  CameraView& view = setup.view;
  setup.kind = CameraKind::kFisheye;
  store(view.dx, linear[0]);
  store(view.dy, linear[1]);
  store(view.forward, linear[2]);
  view.step_x = 2 / float(film.width);
  view.step_y = 2 / float(film.height);
  view.half_angle = angle(36000) / 360;  // half of what is seen; YART sets no limit
  camera.accept({"screenwindow", "frameaspectratio", "hither", "yon", "lensradius", "focaldistance",
                 "autofocus", "blades", "distribution", "power"});
}

}  // namespace

CameraSetup compile_camera(const Description& description, const FilmSettings& film,
                           const glm::dvec3& center, Diagnostics& diagnostics) {
  if (!description.camera)
    diagnostics.fail({},
                     "the scene has no Camera: add LookAt and Camera \"perspective\" before "
                     "WorldBegin");
  const Plugin& plugin = *description.camera;
  static constexpr std::pair<std::string_view, void (CameraReader::*)()> kKinds[] = {
      {"perspective", &CameraReader::perspective},
      {"orthographic", &CameraReader::orthographic},
      {"environment", &CameraReader::environment},
      {"fisheye", &CameraReader::fisheye}};
  void (CameraReader::*read)() = nullptr;
  std::vector<std::string_view> names;
  for (const auto& [name, reader] : kKinds) {
    names.push_back(name);
    if (name == plugin.type) read = reader;
  }
  if (!read)
    diagnostics.fail(plugin.loc,
                     fmt::format("camera \"{}\" is not supported{}: use \"perspective\"",
                                 plugin.type, did_you_mean(plugin.type, names)));
  if (!invertible(description.world_to_camera))
    diagnostics.fail(plugin.loc,
                     "the camera's transform cannot be inverted: check the LookAt, "
                     "Scale and Transform before it");
  CameraReader reader{description, film, center, diagnostics,
                      Parameters(plugin, "camera \"" + plugin.type + "\"", diagnostics)};
  reader.to_world = glm::inverse(description.world_to_camera);
  reader.linear = glm::dmat3(reader.to_world);
  store(reader.setup.view.origin, glm::dvec3(reader.to_world[3]) - center);
  (reader.*read)();
  reader.camera.accept({"autofocus", "shutteropen", "shutterclose", "shutterdistribution"});
  reader.camera.report_unused();
  return reader.setup;
}

}  // namespace yat

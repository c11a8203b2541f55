// Camera -> CameraView (lxs 3).

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

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

CameraSetup compile_camera(const Description& description, const FilmSettings& film,
                           const glm::dvec3& center, Diagnostics& diagnostics) {
  if (!description.camera)
    diagnostics.fail({},
                     "the scene has no Camera: add LookAt and Camera \"perspective\" before "
                     "WorldBegin");
  const Plugin& plugin = *description.camera;
  if (plugin.type != "perspective")
    diagnostics.fail(plugin.loc,
                     fmt::format("camera \"{}\" is not supported{}: use \"perspective\"",
                                 plugin.type, did_you_mean(plugin.type, {"perspective"})));
  if (!invertible(description.world_to_camera))
    diagnostics.fail(plugin.loc,
                     "the camera's transform cannot be inverted: check the LookAt, "
                     "Scale and Transform before it");
  Parameters camera(plugin, "camera \"perspective\"", diagnostics);
  const float fov = camera.number("fov", 90);
  if (!(fov > 0 && fov < 180))
    diagnostics.fail(camera.loc("fov"),
                     fmt::format("\"fov\" is {} degrees, but must be above 0 and "
                                 "below 180",
                                 fov));
  const Window window = screen_window(camera, film);
  const double tangent = std::tan(double(fov) * std::numbers::pi / 360);

  // Raster (x, y) is the camera-space point (sx t, sy t, 1), sx from x0 at the left, sy from y1 at
  // the top. Its depth in the world is measured along the gradient of camera z, which also holds
  // when the camera's transform scales or shears.
  const Matrix to_world = glm::inverse(description.world_to_camera);
  const glm::dmat3 linear(to_world);
  const glm::dvec3 z_row(description.world_to_camera[0][2], description.world_to_camera[1][2],
                         description.world_to_camera[2][2]);
  const double z_per_m = glm::length(z_row);
  CameraSetup setup;
  CameraView& view = setup.view;
  store(view.origin, glm::dvec3(to_world[3]) - center);
  store(view.forward, z_row / z_per_m);
  store(view.corner, z_per_m * (linear * glm::dvec3(window.x0 * tangent, window.y1 * tangent, 1)));
  store(view.dx,
        z_per_m * (linear * glm::dvec3((window.x1 - window.x0) * tangent / film.width, 0, 0)));
  store(view.dy,
        z_per_m * (linear * glm::dvec3(0, (window.y0 - window.y1) * tangent / film.height, 0)));

  const auto hither = double(camera.number("hither", 1e-3f)),
             yon = double(camera.number("yon", 1e30f));
  if (!(hither >= 0 && hither < yon))
    diagnostics.fail(camera.loc("hither"),
                     fmt::format("\"hither\" {} and \"yon\" {} leave nothing to "
                                 "see",
                                 hither, yon));
  view.near_depth = float(hither / z_per_m);
  view.far_depth = float(std::min(yon / z_per_m, 1e30));

  double lens = double(camera.number("lensradius", 0)),
         focus = double(camera.number("focaldistance", 1e30f));
  if (!(lens >= 0)) {
    diagnostics.warning(camera.loc("lensradius"), "\"lensradius\" is negative: a pinhole is used");
    lens = 0;
  }
  if (lens > 0 && !(focus > 0)) {
    diagnostics.warning(camera.loc("focaldistance"),
                        "\"focaldistance\" is not above 0: a pinhole is used");
    lens = 0;
  }
  setup.thin_lens = lens > 0;
  store(view.lens_x, lens * linear[0]);
  store(view.lens_y, lens * linear[1]);
  view.focal_distance = float(std::min(focus / z_per_m, 1e30));  // finite, and so are its products
  if (setup.thin_lens && camera.flag("autofocus", false))
    diagnostics.warning(camera.loc("autofocus"),
                        "\"autofocus\" is not yet supported: \"focaldistance\" is used");
  if (setup.thin_lens && camera.integer("blades", 0) >= 3)
    diagnostics.warning(camera.loc("blades"), "\"blades\" is not yet supported: the lens is round");
  camera.accept({"autofocus", "blades", "shutteropen", "shutterclose", "shutterdistribution",
                 "distribution", "power"});
  camera.report_unused();
  return setup;
}

}  // namespace yat

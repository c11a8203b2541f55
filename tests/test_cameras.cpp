// Cameras: raster position -> ray, against the formulas of the scene format, by every kernel.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "per_isa.h"
#include "render_scenes.h"
#include "wavefront/focus.h"
#include "wavefront/reference.h"
#include "wavefront/reference_parts.h"

namespace yat {
namespace {

constexpr double kPi = std::numbers::pi;

/// A camera at (1, 2, 3) that looks along +y with +z up, over a plane.
std::string text_of(const std::string& camera, uint32_t width, uint32_t height,
                    const std::string& world = "") {
  return "LookAt 1 2 3 1 5 3 0 0 1\nCamera " + camera + "\nPixelFilter \"box\"\n" +
         "Film \"fleximage\" \"integer xresolution\" [" + std::to_string(width) +
         "] \"integer yresolution\" [" + std::to_string(height) +
         "]\nWorldBegin\nShape \"plane\"\nLightSource \"point\" \"point from\" [1 2 6]\n" + world +
         "WorldEnd\n";
}

class Cameras : public PerIsa {
 protected:
  struct Seen {
    glm::dvec3 from, dir;  ///< world
    double t_max, weight;
    double px, py;  ///< raster position
  };
  /// Rays through random places of a picture.
  std::vector<Seen> rays(const Scene& scene, uint32_t n) {
    const SceneView view = scene.view();
    Table<CameraSample> samples(n);
    AlignedArray<float> fu(n), fv(n), lu(n), lv(n);
    std::vector<Seen> seen(n);
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t x = i * 7919u % scene.film.width, y = i * 104729u % scene.film.height;
      samples.set(i, {y << 16 | x, i, i});
      fu[i] = float(i * 37 % 101) / 101;
      fv[i] = float(i * 53 % 89) / 89;
      lu[i] = float(i * 29 % 97) / 97;
      lv[i] = float(i * 61 % 83) / 83;
      // The box filter covers the pixel.
      seen[i].px = x + double(fu[i]);
      seen[i].py = y + double(fv[i]);
    }
    Table<Ray> rays(n);
    Table<PathState> paths(n);
    kernels().generate_camera_rays[uint32_t(scene.camera_kind)](view, samples.view(), fu.data(),
                                                                fv.data(), lu.data(), lv.data(),
                                                                rays.columns(), paths.columns(), n);
    for (uint32_t i = 0; i < n; ++i) {
      const Ray<Value> r = rays.row(i);
      seen[i].from = glm::dvec3(r.org_x, r.org_y, r.org_z) + scene.center;
      seen[i].dir = {r.dir_x, r.dir_y, r.dir_z};
      seen[i].t_max = double(r.t_max);
      seen[i].weight = double(paths.row(i).throughput_g);
      const reference::RaySegment same = reference::camera_segment(
          scene.camera, scene.camera_kind, seen[i].px, seen[i].py, double(lu[i]), double(lv[i]));
      EXPECT_LT(glm::length(same.direction - seen[i].dir), 2e-6);
      EXPECT_LT(glm::length(same.origin + scene.center - seen[i].from), 1e-5);
    }
    return seen;
  }
};
YAT_INSTANTIATE_PER_ISA(Cameras);

TEST_P(Cameras, OrthographicRaysAreParallelAndStartOnTheWindow) {
  const Scene scene = compile_text(
      text_of("\"orthographic\" \"float screenwindow\" [-2 4 -1 2] \"float hither\" [.5] "
              "\"float yon\" [9]",
              60, 30),
      kernels());
  EXPECT_EQ(scene.camera_kind, CameraKind::kOrthographic);
  for (const Seen& ray : rays(scene, 200)) {
    EXPECT_EQ(ray.dir, glm::dvec3(0, 1, 0));
    EXPECT_NEAR(ray.from.x, 1 - 2 + 6 * ray.px / 60, 1e-5);
    EXPECT_NEAR(ray.from.z, 3 + 2 - 3 * ray.py / 30, 1e-5);
    EXPECT_NEAR(ray.from.y, 2.5, 1e-6);
    EXPECT_NEAR(ray.t_max, 8.5, 1e-5);
  }
}

TEST_P(Cameras, EnvironmentIsTheWholeSphere) {
  const Scene scene = compile_text(text_of("\"environment\"", 64, 32), kernels());
  for (const Seen& ray : rays(scene, 300)) {
    const double theta = kPi * ray.py / 32, phi = 2 * kPi * ray.px / 64;
    // Camera x is the world's x, camera y the world's z, camera z the world's y.
    EXPECT_NEAR(ray.dir.x, -std::sin(theta) * std::sin(phi), 2e-6);
    EXPECT_NEAR(ray.dir.z, std::cos(theta), 2e-6);
    EXPECT_NEAR(ray.dir.y, -std::sin(theta) * std::cos(phi), 2e-6);
    EXPECT_NEAR(ray.from.x, 1, 1e-6);
    EXPECT_EQ(ray.t_max, double(kRayFar));
  }
}

TEST_P(Cameras, FisheyeAnglesGrowWithTheRadius) {
  for (const double fov : {35., 90., 150.}) {
    const Scene scene = compile_text(
        text_of("\"fisheye\" \"float fov\" [" + std::to_string(fov) + "]", 50, 40), kernels());
    uint32_t dark = 0;
    for (const Seen& ray : rays(scene, 500)) {
      const double rx = 2 * ray.px / 50 - 1, ry = 1 - 2 * ray.py / 40, r = std::hypot(rx, ry);
      if (r > 1 + 1e-6) {
        EXPECT_EQ(ray.weight, 0);
        EXPECT_EQ(ray.t_max, 0);
        ++dark;
        continue;
      }
      if (r > 1 - 1e-6) continue;
      EXPECT_EQ(ray.weight, 1);
      const double psi = r * fov * kPi / 180;
      EXPECT_NEAR(ray.dir.y, std::cos(psi), 3e-6);
      EXPECT_NEAR(ray.dir.x, std::sin(psi) * rx / r, 3e-6);
      EXPECT_NEAR(ray.dir.z, std::sin(psi) * ry / r, 3e-6);
    }
    EXPECT_GT(dark, 50u);
  }
}

TEST_P(Cameras, LensesWithBladesArePolygons) {
  for (const int blades : {3, 6}) {
    const Scene scene = compile_text(
        text_of("\"perspective\" \"float lensradius\" [.5] \"float focaldistance\" [4] "
                "\"float hither\" [0] \"integer blades\" [" +
                    std::to_string(blades) + "]",
                40, 40),
        kernels());
    EXPECT_EQ(scene.camera_kind, CameraKind::kPolygonLens);
    double sum_x = 0, sum_y = 0, squares = 0;
    const auto seen = rays(scene, 4000);
    for (const Seen& ray : seen) {
      const double x = ray.from.x - 1, y = ray.from.z - 3;
      // Within every edge: its distance from the middle is r cos(pi / n).
      for (int k = 0; k < blades; ++k) {
        const double a = 2 * kPi * (k + .5) / blades;
        EXPECT_LE(x * std::cos(a) + y * std::sin(a), .5 * std::cos(kPi / blades) + 1e-6);
      }
      // All rays of a pixel position meet in the plane of focus.
      const glm::dvec3 focus = ray.from + ray.dir * (4 / ray.dir.y);
      EXPECT_NEAR(focus.x, 1 + 4 * (2 * ray.px / 40 - 1), 1e-4);
      EXPECT_NEAR(focus.z, 3 + 4 * (1 - 2 * ray.py / 40), 1e-4);
      sum_x += x;
      sum_y += y;
      squares += x * x + y * y;
    }
    // Uniform over the polygon: mean 0, mean square r^2 (2 + cos(2 pi / n)) / 6.
    EXPECT_NEAR(sum_x / double(seen.size()), 0, .015);
    EXPECT_NEAR(sum_y / double(seen.size()), 0, .015);
    EXPECT_NEAR(squares / double(seen.size()), .25 * (2 + std::cos(2 * kPi / blades)) / 6, .004);
  }
}

TEST_P(Cameras, AutofocusTakesTheDepthOfTheMiddle) {
  const std::string lens =
      "\"perspective\" \"float lensradius\" [.1] \"bool autofocus\" [\"true\"] "
      "\"float focaldistance\" [7] \"float fov\" [20] \"float screenwindow\" [.2 1.2 .5 1.5]";
  // The middle of this window is off the axis: depth is not distance.
  Scene scene = compile_text(
      text_of(lens, 20, 20, quad_text("-90 11 -90", "90 11 -90", "90 11 90", "-90 11 90")),
      kernels());
  focus_camera(scene);
  EXPECT_NEAR(scene.camera.focal_distance, 9, 1e-5);
  Scene empty = compile_text(text_of(lens, 20, 20), kernels());
  focus_camera(empty);
  EXPECT_EQ(empty.camera.focal_distance, 7);
}

// Whole pictures by each camera: the same paths as the oracle's.
TEST_P(Cameras, PathsAreTheOracles) {
  for (const char* camera :
       {"\"orthographic\" \"float screenwindow\" [-3 3 -2.25 2.25]", "\"environment\"",
        "\"fisheye\" \"float fov\" [70]",
        "\"perspective\" \"float lensradius\" [.2] \"float focaldistance\" [4] \"integer blades\" "
        "[5]"}) {
    const std::string world = sphere_text("1 6 2", 1) + sphere_text("2 5 3.5", .7);
    const Scene scene = compile_text(text_of(camera, 16, 12, world), kernels());
    PlanOptions options;
    options.max_depth = 2;
    for (const SamplerKind sampler :
         {SamplerKind::kCorrelatedMultiJittered, SamplerKind::kNRooks, SamplerKind::kSobol}) {
      options.sampler = sampler;
      options.sample_set = 6;
      const Plan plan = make_plan(scene, kernels(), options);
      const Film film = render_film(scene, plan, 0, 6);
      uint32_t off = 0, lit = 0;
      for (uint32_t y = 0; y < 12; ++y)
        for (uint32_t x = 0; x < 16; ++x) {
          glm::dvec3 sum(0.);
          for (uint32_t s = 0; s < 6; ++s) sum += reference_sample(scene, plan, x, y, s);
          const double got = from_fixed(film.at(x, y).g);
          lit += sum.y > 0;
          // A path that rounding sends past an edge is another path: a few may.
          off += std::abs(got - sum.y) > 1e-3 * (sum.y + .01);
        }
      EXPECT_LE(off, 3u) << camera;
      EXPECT_GT(lit, 20u) << camera;
    }
  }
}

}  // namespace
}  // namespace yat

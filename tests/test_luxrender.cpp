// Pictures against LuxRender's own: the mean of each large uniform region within 1 %.
//
// The references are linear pictures in LuxRender's film colour space (SMPTE-C); they are converted
// to linear Rec.709 first. Luminance is compared in every region. Where colours lie outside of the
// film's gamut, LuxRender has moved them towards white at their luminance, so that their channels
// say nothing; in the other regions each channel is compared as well.
//
// Both pictures are noisy: a region passes when it is within 1 % plus two standard errors of the
// mean difference (both taken from the pixels of the region).

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

#include "kernels/dispatch.h"
#include "scene/compile.h"
#include "scene/parse.h"
#include "shared_scenes.h"
#include "wavefront/render.h"

namespace yat {
namespace {

/// Relative difference allowed, beside the noise.
constexpr double kWithin = .01;

enum class Gamut { kInside, kOutside };

struct Region {
  const char* name;
  uint32_t x0, x1, y0, y1;  // in a picture 960 pixels wide
  Gamut gamut = Gamut::kInside;
  double within = kWithin;
};

struct Picture {
  uint32_t width = 0, height = 0;
  std::vector<float> rgb;
};

Picture read_reference(const std::string& path) {
  auto in = OIIO::ImageInput::open(path);
  Picture picture;
  if (!in) return picture;
  const OIIO::ImageSpec spec = in->spec();
  picture.width = uint32_t(spec.width);
  picture.height = uint32_t(spec.height);
  std::vector<float> all(size_t(spec.width) * size_t(spec.height) * size_t(spec.nchannels));
  in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, all.data());
  const auto channel = [&](const char* name) {
    for (int c = 0; c < spec.nchannels; ++c)
      if (spec.channelnames[size_t(c)] == name) return size_t(c);
    return size_t(0);
  };
  const size_t c[3] = {channel("R"), channel("G"), channel("B")};
  // Film RGB -> XYZ -> Rec.709: inverse of the matrix in lxs 9, step 3.
  const glm::dmat3 to_film(1.04796, -.01971, .00164, -.05449, 1.04063, .00445, -.00981, -.01680,
                           1.00152);
  const glm::dmat3 to_709 = glm::inverse(to_film);
  picture.rgb.resize(size_t(spec.width) * size_t(spec.height) * 3);
  for (size_t i = 0; i < size_t(spec.width) * size_t(spec.height); ++i) {
    const float* pixel = &all[i * size_t(spec.nchannels)];
    const glm::dvec3 film{double(pixel[c[0]]), double(pixel[c[1]]), double(pixel[c[2]])};
    const glm::dvec3 rgb = to_709 * film;
    for (int k = 0; k < 3; ++k) picture.rgb[i * 3 + size_t(k)] = float(rgb[k]);
  }
  return picture;
}

Picture render_scene(const std::string& path, uint32_t width, uint32_t height, uint32_t max_depth,
                     uint32_t spp) {
  Diagnostics diagnostics([](Severity, std::string_view) {});
  const Description description = read_scene(path, diagnostics);
  const KernelTable& kernels = select_kernels();
  ThreadPool pool(2);
  CompileOptions options;
  options.block_width = kernels.lanes;
  options.width = width;
  options.height = height;
  const Scene scene = compile_scene(description, options, pool, diagnostics);
  PlanOptions plan_options;
  plan_options.max_depth = max_depth;
  const Plan plan = make_plan(scene, kernels, plan_options);
  Film film(width, height);
  RenderOptions render_options;
  render_options.end_sample = spp;
  render(scene, plan, render_options, pool, film);
  return {width, height, film.resolve()};
}

struct Mean {
  double value = 0, variance_of_mean = 0;
};

/// Mean of the region, channels weighted. The noise comes from the differences of pixels four
/// apart, which a gradient hardly touches; LuxRender's filter makes nearer ones agree, and its 16
/// pixels of support about four samples of noise of each mean one (hence `correlated`).
Mean mean_of(const Picture& picture, const Region& region, const glm::dvec3& weights,
             double correlated) {
  const double scale = picture.width / 960.0;
  const auto x0 = uint32_t(region.x0 * scale), x1 = uint32_t(region.x1 * scale);
  const auto y0 = uint32_t(region.y0 * scale), y1 = uint32_t(region.y1 * scale);
  const auto at = [&](uint32_t x, uint32_t y) {
    const float* p = &picture.rgb[(size_t(y) * picture.width + x) * 3];
    return weights.x * double(p[0]) + weights.y * double(p[1]) + weights.z * double(p[2]);
  };
  double sum = 0, squares = 0, pairs = 0;
  for (uint32_t y = y0; y < y1; ++y)
    for (uint32_t x = x0; x < x1; ++x) {
      sum += at(x, y);
      if (x + 4 >= x1) continue;
      const double difference = at(x, y) - at(x + 4, y);
      squares += difference * difference / 2;
      pairs += 1;
    }
  const double n = double(x1 - x0) * double(y1 - y0);
  return {sum / n, correlated * squares / pairs / n};
}

/// Luminance first: the one that is compared in every region.
const std::pair<const char*, glm::dvec3> kQuantities[] = {{"luminance", {.2126, .7152, .0722}},
                                                          {"red", {1, 0, 0}},
                                                          {"green", {0, 1, 0}},
                                                          {"blue", {0, 0, 1}}};

void compare(const char* scene, const char* reference, uint32_t spp,
             const std::vector<Region>& regions) {
  YAT_NEED_SHARED(scene_path, scene);
  YAT_NEED_SHARED(reference_path, std::string("luxrender-reference-images/") + reference);
  const Picture theirs = read_reference(reference_path);
  ASSERT_GT(theirs.width, 0u);
  const Picture ours = render_scene(scene_path, theirs.width, theirs.height, 10, spp);
  for (const Region& region : regions) {
    std::printf("%-14s", region.name);
    for (const auto& [quantity, weights] : kQuantities) {
      const Mean a = mean_of(ours, region, weights, 1), b = mean_of(theirs, region, weights, 4);
      ASSERT_GT(b.value, 0) << region.name;
      const double allowance = 2 * std::sqrt(a.variance_of_mean + b.variance_of_mean) / b.value;
      std::printf("  %s %+.2f +- %.2f %%", quantity, 100 * (a.value / b.value - 1),
                  100 * allowance);
      EXPECT_LT(allowance, .025) << region.name << ": " << quantity << " is too noisy to tell";
      EXPECT_NEAR(a.value / b.value, 1.0, region.within + allowance)
          << region.name << " of " << scene << ", " << quantity << ": " << a.value << " against "
          << b.value;
      if (region.gamut == Gamut::kOutside) break;
    }
    std::printf("\n");
  }
}

// Where much light comes by caustics and several bounces, LuxRender's pictures differ by 1 % among
// themselves, and three bands are not spectra: 1.5 % there.
TEST(LuxRender, CornellBox) {
  compare("CornellBox/cornell-box.lxs", "cornell-path10-256spp.exr", 256,
          {{"back_wall", 330, 640, 110, 210},
           {"back_right", 500, 645, 230, 345},
           {"left_wall", 210, 285, 150, 400, Gamut::kOutside},
           {"right_wall", 665, 735, 150, 450, Gamut::kOutside},
           {"ceiling_left", 300, 415, 10, 88},
           {"floor_left", 260, 340, 495, 535, Gamut::kInside, .015},
           {"box_front", 470, 600, 380, 505},
           {"lamp", 430, 515, 51, 63},
           {"box_in_mirror", 405, 455, 355, 455, Gamut::kInside, .015}});
}

TEST(LuxRender, Dragon) {
  compare("Dragon/dragon-202k.lxs", "dragon-202k-path10-32spp.exr", 32,
          {{"floor_front", 50, 900, 420, 530},
           {"floor_left", 20, 250, 330, 400},
           {"floor_right", 680, 930, 330, 400}});
}

TEST(LuxRender, PillarPoint) {
  compare("Pillar/pillar-point.lxs", "pillar-point-path10-64spp.exr", 32,
          {{"floor_lit", 440, 580, 240, 310},
           {"floor_front", 400, 900, 420, 530},
           {"pillar_front", 185, 265, 200, 340, Gamut::kOutside},
           {"floor_right", 700, 930, 200, 350}});
}

TEST(LuxRender, PillarSphereSmall) {
  compare("Pillar/pillar-sphere-small.lxs", "pillar-sphere-small-path10-64spp.exr", 32,
          {{"floor_lit", 440, 580, 240, 310},
           {"floor_front", 400, 900, 420, 530},
           {"pillar_front", 185, 265, 200, 340, Gamut::kOutside}});
}

TEST(LuxRender, PillarSphereLarge) {
  compare("Pillar/pillar-sphere-large.lxs", "pillar-sphere-large-path10.exr", 64,
          {{"floor_lit", 440, 580, 240, 310},
           {"floor_front", 400, 900, 420, 530},
           {"pillar_front", 185, 265, 200, 340, Gamut::kOutside}});
}

TEST(LuxRender, PillarSquareSmall) {
  compare("Pillar/pillar-square-small.lxs", "pillar-square-small-path10-64spp.exr", 32,
          {{"floor_lit", 350, 450, 260, 330},
           {"floor_front", 250, 700, 440, 530},
           {"pillar_front", 185, 265, 200, 340, Gamut::kOutside},
           {"lamp", 490, 540, 70, 130}});
}

TEST(LuxRender, PillarSquareLarge) {
  for (const char* scene : {"Pillar/pillar-square-large.lxs", "Pillar/pillar-reinhard.lxs"})
    compare(scene, "pillar-square-large-path10.exr", 64,
            {{"floor_lit", 380, 500, 270, 320},
             {"floor_front", 250, 700, 440, 530},
             {"pillar_front", 185, 265, 200, 340, Gamut::kOutside},
             {"lamp", 460, 580, 60, 160}});
}

}  // namespace
}  // namespace yat

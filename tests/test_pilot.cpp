// The pilot: how bright a picture will be, told by a few paths, and what must not change it.

#include "wavefront/pilot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kernels/rng_scalar.h"
#include "per_isa.h"
#include "render_scenes.h"

namespace yat {
namespace {

class Pilot : public PerIsa {
 protected:
  Plan plan_for(const Scene& scene, uint32_t seed = 0, double share = kNoShadowRoulette) {
    PlanOptions options;
    options.max_depth = 30;
    options.seed = seed;
    options.shadow_roulette = share;
    return make_plan(scene, kernels(), options);
  }
  float level(const Scene& scene, uint32_t seed = 0) {
    return picture_level(scene, plan_for(scene, seed));
  }
  Scene compile(const std::string& text, ColourMode colour = ColourMode::kRgb) {
    return compile_text(text + "WorldEnd\n", kernels(), colour);
  }
};
YAT_INSTANTIATE_PER_ISA(Pilot);

/// A room whose walls all shine.
std::string shining_room(const std::string& radiance, const std::string& kd, uint32_t width,
                         uint32_t height) {
  return view_text("0 -.5 0", "0 0 0", 60, width, height) + light_text(radiance) + matte_text(kd) +
         room_text(1);
}

TEST_P(Pilot, IsTheLargestBand) {
  // Nothing is scattered: every path brings the same, and 1.75 is a number of few bits.
  EXPECT_EQ(level(compile(shining_room(".5 1.75 .25", "0 0 0", 200, 100))), 1.75f);
  const Scene scene = compile(shining_room(".5 1.75 .25", "0 0 0", 200, 100), ColourMode::kBands);
  const glm::dvec3 bands = to_bands({.5, 1.75, .25}, scene.colour.light);
  const double largest = std::max({bands.x, bands.y, bands.z});
  EXPECT_NEAR(level(scene), largest, largest / 64);
}

TEST_P(Pilot, FindsTheLevelOfAFurnace) {
  // 1 + .6 + .36 + ... = 2.5, of which the first part is there always and the rest on average.
  for (const uint32_t seed : {0u, 1u, 2u})
    EXPECT_NEAR(level(compile(shining_room("1 1 1", ".6 .6 .6", 200, 100)), seed), 2.5, .1);
}

TEST_P(Pilot, DoesNotLookAtTheSky) {
  const std::string sky = "LightSource \"infinite\" \"color L\" [3 3 3]\n";
  // The lower half of the picture shows a floor under an even sky.
  const std::string text = view_text("0 -3 1", "0 0 1", 60, 160, 120) + sky +
                           matte_text(".5 .5 .5") +
                           quad_text("-1e4 -1e4 0", "1e4 -1e4 0", "1e4 1e4 0", "-1e4 1e4 0");
  for (const uint32_t seed : {0u, 1u, 2u}) EXPECT_NEAR(level(compile(text), seed), .75, .06);
  EXPECT_EQ(level(compile(view_text("0 -3 1", "0 0 1", 60, 160, 120) + sky)), 0.f);
}

TEST_P(Pilot, ABrightLampInViewCountsLittle) {
  const std::string dark = shining_room("1 1 1", "0 0 0", 160, 120);
  // Seen from the middle of the room, a square of a fifth of the wall's width.
  const std::string lamp =
      light_text("1e6 1e6 1e6") + quad_text("-.2 .9 -.2", ".2 .9 -.2", ".2 .9 .2", "-.2 .9 .2");
  EXPECT_EQ(level(compile(dark)), 1.f);
  const Scene lit = compile(dark + lamp);
  EXPECT_GT(level(lit), 1.f);
  EXPECT_LT(level(lit), 1.5f);
  double mean = 0;
  for (const float v : render_film(lit, plan_for(lit), 0, 1).resolve()) mean += double(v);
  EXPECT_GT(mean / (160 * 120 * 3), 1e3) << "the lamp is not in view";
}

TEST_P(Pilot, ABlackPictureHasNoLevel) {
  const std::string black = view_text("0 -.5 0", "0 0 0", 60, 64, 64) + matte_text("0 0 0") +
                            room_text(1) + "LightSource \"point\" \"color L\" [1 1 1]\n";
  const Scene scene = compile(black);
  EXPECT_EQ(level(scene), 0.f);
  Plan plan = plan_for(scene, 0, .3);
  set_shadow_bound(scene, plan);
  EXPECT_EQ(plan.transport.shadow_bound, 0.f);
  // More than the film takes of a sample: there will be no picture either.
  EXPECT_EQ(level(compile(shining_room("1e20 1e20 1e20", "0 0 0", 64, 64))), 0.f);
}

TEST_P(Pilot, SmallFramesHaveALevel) {
  for (const auto& [width, height] :
       {std::pair(1u, 1u), {3u, 5u}, {8u, 8u}, {65u, 7u}, {2u, 1000u}})
    EXPECT_EQ(level(compile(shining_room("1.5 1.5 1.5", "0 0 0", width, height))), 1.5f)
        << width << " x " << height;
}

TEST_P(Pilot, IsOfThePictureAndTheSeedAlone) {
  const Scene scene = compile_text(everything_text(150, 110), kernels());
  const float whole = level(scene);
  EXPECT_GT(whole, 0.f);
  Scene part = compile_text(everything_text(150, 110), kernels());
  part.film.crop_x0 = 91, part.film.crop_x1 = 92, part.film.crop_y0 = 4, part.film.crop_y1 = 5;
  EXPECT_EQ(level(part), whole);
  PlanOptions options;
  options.max_depth = 30;
  options.sampler = SamplerKind::kRegular;
  options.sample_set = 9;
  Plan other = make_plan(scene, kernels(), options);
  other.transport.shadow_bound = 1e3f;
  EXPECT_EQ(picture_level(scene, other), whole);
  float least = whole, most = whole;
  for (uint32_t seed = 1; seed < 5; ++seed) {
    least = std::min(least, level(scene, seed));
    most = std::max(most, level(scene, seed));
  }
  EXPECT_LT(least, most);
  EXPECT_LT(most, 1.25f * least);
}

const KernelTable* healthy = nullptr;
uint32_t generated = 0, as_in_the_picture = 0;
constexpr uint32_t kSeed = 3;

void counting_camera(const SceneView& scene, const CameraSample<ConstColumn>& samples,
                     const float* film_u, const float* film_v, const float* lens_u,
                     const float* lens_v, const Ray<Column>& rays, const PathState<Column>& paths,
                     uint32_t n) noexcept {
  generated += n;
  for (uint32_t i = 0; i < n; ++i)
    as_in_the_picture +=
        film_u[i] == random_pair(SamplerKind::kIndependent, kSeed, Dimension::kFilm,
                                 samples.pixel[i], samples.sample[i], 0)
                         .first;
  healthy->generate_camera_rays[0](scene, samples, film_u, film_v, lens_u, lens_v, rays, paths, n);
}

TEST_P(Pilot, RunsOnlyWhereShadowRaysPlayRoulette) {
  healthy = &kernels();
  KernelTable counting = kernels();
  counting.generate_camera_rays[0] = &counting_camera;
  PlanOptions options;
  options.seed = kSeed;
  const auto bound = [&](const Scene& scene) {
    Plan plan = make_plan(scene, counting, options);
    generated = as_in_the_picture = 0;
    set_shadow_bound(scene, plan);
    return plan.transport.shadow_bound;
  };
  const Scene lit = compile(shining_room("1 1 1", "0 0 0", 200, 100));
  options.shadow_roulette = .25;
  EXPECT_EQ(bound(lit), .25f);
  EXPECT_EQ(generated, kPilotWindows * kPilotWindowEdge * kPilotWindowEdge);
  EXPECT_LE(as_in_the_picture, 1u) << "the picture's own numbers";
  options.shadow_roulette = kNoShadowRoulette;
  EXPECT_EQ(bound(lit), 0.f);
  EXPECT_EQ(generated, 0u);
  options.shadow_roulette = .25;
  options.max_depth = 0;  // no vertex asks for light
  EXPECT_EQ(bound(lit), 0.f);
  EXPECT_EQ(generated, 0u);
  options.max_depth = 8;
  options.light_sampling = LightSampling::kBsdf;
  EXPECT_EQ(bound(lit), 0.f);
  EXPECT_EQ(generated, 0u);
}

}  // namespace
}  // namespace yat

// Whole renders of scenes with known answers, and what a render says of itself.
//
// A mean is compared with its exact value in units of its standard error, which comes from renders
// with different seeds. Seeds are fixed; with 32 of them a right renderer is within 3 standard
// errors with probability 99.5 %.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "per_isa.h"
#include "render_scenes.h"

namespace yat {
namespace {

constexpr uint32_t kSeeds = 32;

class Renders : public PerIsa {
 protected:
  /// The picture's mean of the red channel over kSeeds renders.
  Estimate mean_radiance(const std::string& text, uint32_t samples, uint32_t max_depth,
                         Integrator integrator = Integrator::kPath) {
    const Scene scene = compile_text(text, kernels());
    PlanOptions options;
    options.max_depth = max_depth;
    options.integrator = integrator;
    std::vector<double> means;
    for (options.seed = 0; options.seed < kSeeds; ++options.seed) {
      const Film film = render_film(scene, make_plan(scene, kernels(), options), 0, samples);
      double sum = 0;
      for (const float value : film.resolve()) sum += double(value);
      means.push_back(sum / (3.0 * film.width() * film.height()));
    }
    return estimate(means);
  }
  static void expect_value(const Estimate& e, double exact) {
    // Rounding counts where there is no noise at all.
    EXPECT_LE(std::fabs(e.mean - exact), 3 * e.error + 2e-6 * exact)
        << e.mean << " +- " << e.error << ", should be " << exact;
    EXPECT_LT(e.error, .02 * exact) << "too noisy to say anything";
  }
};
YAT_INSTANTIATE_PER_ISA(Renders);

TEST_P(Renders, FurnaceAtEveryDepth) {
  // A closed room that emits .5 and reflects .5 everywhere: .5 (1 + .5 + ...) by depth.
  const std::string text = view_text("0.1 -.6 .2", "0 0 0", 70, 8, 8) + light_text(".5 .5 .5") +
                           matte_text(".5 .5 .5") + room_text(1) + "WorldEnd\n";
  double exact = 0;
  for (uint32_t depth = 0; depth <= 5; ++depth) {
    exact += std::pow(.5, depth + 1);
    SCOPED_TRACE(depth);
    expect_value(mean_radiance(text, 16, depth), exact);
  }
  expect_value(mean_radiance(text, 16, 40), 1);
}

// The same in a sphere: its points light themselves, and rounding puts half of them outside of it.
TEST_P(Renders, SphereFurnaceAtEveryDepth) {
  for (const char* radius : {"1", "10"}) {
    const std::string text = view_text("0.1 -.6 .2", "0 0 0", 70, 8, 8) + "ReverseOrientation\n" +
                             light_text(".5 .5 .5") + matte_text(".5 .5 .5") +
                             "Shape \"sphere\" \"float radius\" [" + radius + "]\nWorldEnd\n";
    double exact = 0;
    for (uint32_t depth = 0; depth <= 3; ++depth) {
      exact += std::pow(.5, depth + 1);
      SCOPED_TRACE(depth);
      expect_value(mean_radiance(text, 64, depth), exact);
    }
    expect_value(mean_radiance(text, 64, 40), 1);
  }
}

TEST_P(Renders, LitPlaneByLambertsFormula) {
  // A unit square light one above a floor, seen at the point below its centre: E = .752274688.
  const std::string text =
      view_text("2 -2 .6", "0 0 0", .02, 2, 2) + matte_text(".5 .5 .5") +
      quad_text("-5 -5 0", "5 -5 0", "5 5 0", "-5 5 0") + "AttributeBegin\n" + light_text("1 1 1") +
      quad_text("-.5 -.5 1", "-.5 .5 1", ".5 .5 1", ".5 -.5 1") + "AttributeEnd\nWorldEnd\n";
  const double exact = .5 / std::numbers::pi * 0.752274688;
  expect_value(mean_radiance(text, 64, 1), exact);
  expect_value(mean_radiance(text, 64, 1, Integrator::kDirect), exact);
}

TEST_P(Renders, ColoursMultiplyInBands) {
  // Seen by way of a blue mirror, a warm lamp on a red floor: the same paths as without colours,
  // with every band of lamp, mirror and floor multiplied, and on the film as linear Rec.709.
  const auto text = [](const std::string& lamp, const std::string& mirror,
                       const std::string& floor) {
    return view_text("0 -1 1", "0 1 .5", 12, 4, 4) + "Material \"mirror\" \"color Kr\" [" + mirror +
           "]\n" + quad_text("-9 1 -9", "9 1 -9", "9 1 9", "-9 1 9") + matte_text(floor) +
           quad_text("-50 -50 0", "50 -50 0", "50 50 0", "-50 50 0") +
           "LightSource \"point\" \"point from\" [0 -3 2] \"color L\" [" + lamp + "]\nWorldEnd\n";
  };
  const glm::dvec3 lamp(8, 6, 4), mirror(.25, .5, 1), floor(.75, .125, .0625);
  for (const ColourMode mode : {ColourMode::kBands, ColourMode::kRgb}) {
    const auto picture = [&](const std::string& description) {
      const Scene scene = compile_text(description, kernels(), mode);
      PlanOptions options;
      options.max_depth = 2;
      options.roulette_depth = kNoRoulette;  // which colours would change
      return render_film(scene, make_plan(scene, kernels(), options), 0, 16).resolve();
    };
    const std::vector<float> grey = picture(text("1 1 1", "1 1 1", "1 1 1"));
    const std::vector<float> coloured = picture(text("8 6 4", ".25 .5 1", ".75 .125 .0625"));
    const ColourModel& model = colour_model(mode);
    const glm::dvec3 rgb =
        to_rgb(to_bands(lamp, model.light) * to_bands(mirror, model.reflectance) *
                   to_bands(floor, model.reflectance),
               model.film);
    if (mode == ColourMode::kRgb) {
      EXPECT_EQ(rgb, lamp * mirror * floor);
    }
    for (size_t i = 0; i < grey.size(); ++i) {
      EXPECT_GT(grey[i], 0);
      EXPECT_NEAR(double(coloured[i]), rgb[int(i % 3)] * double(grey[i]), 2e-6 * double(grey[i]));
    }
  }
}

TEST_P(Renders, GreyHasTheSameBitsInBothColourModes) {
  const std::string text = view_text("0.1 -.6 .2", "0 .2 0", 70, 8, 8) + matte_text(".7 .7 .7") +
                           room_text(1) + "Material \"mirror\" \"color Kr\" [.6 .6 .6]\n" +
                           sphere_text(".3 .3 -.4", .3) + "AttributeBegin\n" + light_text("5 5 5") +
                           sphere_text("-.3 .2 .6", .2) + "AttributeEnd\nWorldEnd\n";
  PlanOptions options;
  options.max_depth = 20;
  const auto film = [&](ColourMode mode) {
    const Scene scene = compile_text(text, kernels(), mode);
    return render_film(scene, make_plan(scene, kernels(), options), 0, 16);
  };
  EXPECT_TRUE(same_bits(film(ColourMode::kBands), film(ColourMode::kRgb)));
}

// A lamp shines from its front alone: its back is a surface of the material that came last before
// it, here lit by a point 2 above it, (Kd / pi) (1 / 4). Which side the back is, the order of the
// corners says, or ReverseOrientation.
TEST_P(Renders, TheBackOfALampShowsTheLastMaterial) {
  const std::string up = quad_text("-1 -1 0", "1 -1 0", "1 1 0", "-1 1 0"),
                    down = quad_text("-1 -1 0", "-1 1 0", "1 1 0", "1 -1 0");
  const auto seen = [&](const std::string& lamp) {
    const std::string text =
        view_text("2 -2 1", "0 0 0", .02, 2, 2) + matte_text(".1 .1 .1") +
        sphere_text("9 9 9", .1) + "AttributeBegin\n" + light_text("1 2 4") +
        matte_text(".8 .4 .2") + lamp +
        "AttributeEnd\nLightSource \"point\" \"point from\" [0 0 2]\nWorldEnd\n";
    const Scene scene = compile_text(text, kernels(), ColourMode::kRgb);
    PlanOptions options;
    options.max_depth = 1;
    std::vector<double> means[3];
    for (options.seed = 0; options.seed < kSeeds; ++options.seed) {
      const std::vector<float> rgb =
          render_film(scene, make_plan(scene, kernels(), options), 0, 64).resolve();
      glm::dvec3 sum(0.0);
      for (size_t i = 0; i < rgb.size(); ++i) sum[int(i % 3)] += double(rgb[i]) * 3;
      for (int k = 0; k < 3; ++k) means[k].push_back(sum[k] / double(rgb.size()));
    }
    return std::array{estimate(means[0]), estimate(means[1]), estimate(means[2])};
  };
  const glm::dvec3 kd(.8, .4, .2), radiance(1, 2, 4);
  for (const std::string& lamp : {down, "ReverseOrientation\n" + up}) {
    const std::array<Estimate, 3> back = seen(lamp);
    for (int k = 0; k < 3; ++k) expect_value(back[size_t(k)], kd[k] / (4 * std::numbers::pi));
  }
  // From the front both are seen.
  const std::array<Estimate, 3> front = seen(up);
  for (int k = 0; k < 3; ++k)
    expect_value(front[size_t(k)], radiance[k] + kd[k] / (4 * std::numbers::pi));
}

TEST_P(Renders, SphereLightOverAnInfinitePlane) {
  // Radius 1, centre 3 overhead: E = pi / 9.
  const std::string text = view_text("4 -4 1", "0 0 0", .02, 2, 2) + matte_text(".5 .5 .5") +
                           "Shape \"plane\"\nAttributeBegin\n" + light_text("1 1 1") +
                           sphere_text("0 0 3", 1) + "AttributeEnd\nWorldEnd\n";
  expect_value(mean_radiance(text, 64, 1), .5 / 9);
}

TEST_P(Renders, ConcentricSpheres) {
  // Inner .5 (emits 1, reflects .3), outer 1 (reflects .6). Every bounce, both estimators, two
  // materials, occlusion; uniform by symmetry.
  const std::string world = "AttributeBegin\n" + light_text("1 1 1") + matte_text(".3 .3 .3") +
                            sphere_text("0 0 0", .5) + "AttributeEnd\n" + matte_text(".6 .6 .6") +
                            sphere_text("0 0 0", 1) + "WorldEnd\n";
  expect_value(mean_radiance(view_text("0 -.75 0", "0 0 0", 20, 4, 4) + world, 64, 60),
               1.089108911);
  expect_value(mean_radiance(view_text("0 -.75 0", "0 -2 0", 60, 4, 4) + world, 64, 60),
               0.297029703);
}

TEST_P(Renders, PointLightInTheMiddleOfASphere) {
  const std::string text = view_text("0 -.3 .2", "0 0 .1", 60, 4, 4) + matte_text(".5 .5 .5") +
                           sphere_text("0 0 0", 1) +
                           "LightSource \"point\" \"color L\" [3.14159265 3.14159265 3.14159265]\n"
                           "WorldEnd\n";
  expect_value(mean_radiance(text, 64, 60), 1);
}

TEST_P(Renders, TheSeenLightIsExact) {
  // Light sees light: every path ends in radiance 1 exactly, whatever the estimator.
  const std::string text = view_text("0 -.5 0", "0 0 0", 60, 4, 4) + light_text("1 1 1") +
                           matte_text("0 0 0") + room_text(1) + "WorldEnd\n";
  const Scene scene = compile_text(text, kernels());
  PlanOptions options;
  const Film film = render_film(scene, make_plan(scene, kernels(), options), 0, 4);
  for (const float value : film.resolve()) EXPECT_EQ(value, 1.f);
}

TEST_P(Renders, DirectLightIsDepthOneOfAPath) {
  // Without delta materials the direct integrator is the path integrator of depth 1, to the bit.
  const Scene scene = compile_text(view_text("0.1 -.6 .2", "0 0 0", 70, 16, 16) +
                                       matte_text(".5 .6 .7") + room_text(1) + light_text("5 5 5") +
                                       sphere_text("0 0 .5", .2) + "WorldEnd\n",
                                   kernels());
  PlanOptions direct, path;
  direct.integrator = Integrator::kDirect;
  direct.max_depth = 5;
  path.max_depth = 1;
  EXPECT_TRUE(same_bits(render_film(scene, make_plan(scene, kernels(), direct), 0, 8),
                        render_film(scene, make_plan(scene, kernels(), path), 0, 8)));
}

TEST_P(Renders, CountsAddUp) {
  const Scene scene = compile_text(everything_text(64, 64), kernels());
  const Plan plan = make_plan(scene, kernels(), {});
  RenderOptions options;
  options.end_sample = 8;
  options.batch_rows = 4096;
  options.trace = true;
  uint64_t last = 0, calls = 0;
  options.progress = [&](uint64_t done, const RenderStats& so_far) {
    EXPECT_GE(done, last);
    EXPECT_EQ(done, so_far.paths);
    last = done;
    ++calls;
  };
  ThreadPool pool(2);
  Film film(64, 64);
  const RenderResult result = render(scene, plan, options, pool, film);
  const RenderStats& stats = result.stats;
  const auto stage = [&](Stage s) { return stats.stages[uint32_t(s)]; };
  EXPECT_GT(calls, 2u);
  EXPECT_EQ(last, 64u * 64 * 8);
  EXPECT_EQ(stats.paths, 64u * 64 * 8);
  EXPECT_EQ(stats.camera_rays, 64u * 64 * 8);
  EXPECT_EQ(stage(Stage::kGenerate).rows, stats.camera_rays);
  EXPECT_EQ(stage(Stage::kIntersect).rows, stats.camera_rays + stats.bounce_rays);
  EXPECT_EQ(stage(Stage::kIntersectShadow).rows, stats.shadow_rays);
  EXPECT_EQ(stage(Stage::kShade).rows, stage(Stage::kSurface).rows);
  EXPECT_GT(result.scratch_bytes, 0u);
  EXPECT_FALSE(result.stopped);
  for (const Stage s : {Stage::kGenerate, Stage::kIntersect, Stage::kShade}) {
    EXPECT_GT(stage(s).nanoseconds, 0u) << stage_name(s);
    EXPECT_GT(stage(s).lanes_active, 0u);
    EXPECT_LE(stage(s).lanes_active, stage(s).lanes_total);
  }
  ASSERT_FALSE(result.trace.empty());
  for (const TraceSpan& span : result.trace) ASSERT_LE(span.begin_ns, span.end_ns);
}

TEST_P(Renders, LanesAreBusyWhileShading) {
  const Scene scene =
      compile_text(view_text("0.1 -.6 .2", "0 0 0", 70, 128, 128) + matte_text(".5 .6 .7") +
                       room_text(1) + "AttributeBegin\n" + light_text("5 5 5") +
                       quad_text("-.3 -.3 .95", "-.3 .3 .95", ".3 .3 .95", ".3 -.3 .95") +
                       "AttributeEnd\nWorldEnd\n",
                   kernels());
  RenderResult result;
  render_film(scene, make_plan(scene, kernels(), {}), 0, 16, 1, 0, 0, &result);
  const StageCount& shade = result.stats.stages[uint32_t(Stage::kShade)];
  EXPECT_GT(double(shade.lanes_active) / double(shade.lanes_total), .95);
}

}  // namespace
}  // namespace yat

// What a scene does not hold does not run, and the plan says so.

#include "wavefront/plan.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "render_scenes.h"
#include "wavefront/stages.h"

namespace yat {
namespace {

std::string pinhole_room(const std::string& inside) {
  return view_text("0 -.9 0", "0 0 0", 60, 8, 8) + matte_text(".5 .5 .5") + room_text(1) + inside +
         "WorldEnd\n";
}

TEST(Plan, SkipsWhatTheSceneDoesNotHold) {
  const KernelTable& kernels = select_kernels();
  const Scene scene =
      compile_text(pinhole_room("LightSource \"point\" \"color L\" [1 1 1]\n"), kernels);
  const Plan plan = make_plan(scene, kernels, {});
  EXPECT_TRUE(plan.triangles);
  EXPECT_FALSE(plan.spheres || plan.planes || has_lens(plan.camera) || plan.shadow_mask);
  EXPECT_EQ(plan.light_groups[0].kernel, uint32_t(LightKind::kPoint));
  EXPECT_EQ(plan.first_lasting_bin, 2u);
  ASSERT_EQ(plan.bins.size(), 2u);
  EXPECT_TRUE(plan.bins[1].sample_lights && plan.bins[1].draw_direction);
  EXPECT_FALSE(plan.bins[1].emission || plan.bins[1].draw_choice || plan.bins[1].draw_lobe);

  const std::string text = describe_plan(plan, scene);
  for (const char* expected :
       {"intersect_tiles (camera), intersect_closest: 12 triangles", "sample_lights (point)",
        "shade matte", "intersect_planes: no plane in the scene",
        "intersect_spheres: no sphere in the scene", "add_emission: no surface emits light",
        "draw lens: the camera has no lens", "shade glass: no surface of this material",
        "draw choice: one light is asked"})
    EXPECT_NE(text.find(expected), std::string::npos) << expected << "\n" << text;
}

TEST(Plan, FewLightsShareTheNumberOfTheirPlace) {
  const KernelTable& kernels = select_kernels();
  const auto plan_of = [&](const char* second) {
    const Scene scene = compile_text(
        pinhole_room(std::string("LightSource \"point\" \"color L\" [1 1 1]\n") + second), kernels);
    const Plan plan = make_plan(scene, kernels, {});
    EXPECT_EQ(plan.bins[1].draw_choice, scene.lights.size() > 1 && !plan.light_by_place);
    if (plan.light_by_place) {
      EXPECT_NE(
          describe_plan(plan, scene).find("draw choice: the number of the place chooses the light"),
          std::string::npos);
    }
    return plan.light_by_place;
  };
  EXPECT_FALSE(plan_of("")) << "there is nothing to choose";
  EXPECT_TRUE(plan_of("LightSource \"point\" \"color L\" [.1 .1 .1]\n"));
  EXPECT_FALSE(plan_of("LightSource \"point\" \"color L\" [.001 .001 .001]\n"))
      << "what a rare light leaves of a number is too coarse";
}

// Matte surfaces find an even sky without shadow rays; where light samples are all there is, it
// must be among them.
TEST(Plan, AsksNoEvenSkyOverMatteSurfaces) {
  const KernelTable& kernels = select_kernels();
  const Scene scene =
      compile_text(pinhole_room("LightSource \"infinite\" \"color L\" [1 1 1]\n"), kernels);
  const Plan plan = make_plan(scene, kernels, {});
  EXPECT_TRUE(plan.environment);
  EXPECT_FALSE(plan.lights || plan.bins[1].sample_lights);
  EXPECT_TRUE(plan.light_groups.empty());
  EXPECT_NE(describe_plan(plan, scene).find("paths find the even sky by chance"),
            std::string::npos);
  PlanOptions options;
  options.light_sampling = LightSampling::kLights;
  EXPECT_THROW(make_plan(scene, kernels, options), std::logic_error);
}

TEST(Plan, RunsWhatTheSceneHolds) {
  const KernelTable& kernels = select_kernels();
  const Scene scene = compile_text(everything_text(8, 8), kernels);
  const Plan plan = make_plan(scene, kernels, {});
  EXPECT_TRUE(plan.triangles && plan.spheres && plan.planes && has_lens(plan.camera) &&
              plan.shadow_mask && plan.lights);
  EXPECT_EQ(plan.light_groups[0].kernel, kPlainLights);
  uint32_t delta = 0, lobes = 0;
  for (uint32_t b = 1; b < plan.bins.size(); ++b) {
    const BinPlan& bin = plan.bins[b];
    const MaterialTraits traits = material_traits(bin.bin.material);
    EXPECT_EQ(bin.sample_lights, !traits.delta);
    EXPECT_EQ(bin.draw_roulette, !traits.see_through);
    delta += traits.delta;
    lobes += bin.draw_lobe;
    EXPECT_EQ(b >= plan.first_lasting_bin, bin.emission || traits.see_through);
  }
  EXPECT_EQ(delta, 3u);
  EXPECT_EQ(lobes, 1u);
}

TEST(Plan, WithoutVerticesNoLightIsSampled) {
  const KernelTable& kernels = select_kernels();
  const Scene scene = compile_text(everything_text(8, 8), kernels);
  PlanOptions options;
  options.max_depth = 0;
  const Plan plan = make_plan(scene, kernels, options);
  EXPECT_FALSE(plan.lights);
  for (const BinPlan& bin : plan.bins) EXPECT_FALSE(bin.sample_lights || bin.draw_roulette);
  EXPECT_NE(describe_plan(plan, scene).find("paths end at their first vertex"), std::string::npos);
}

TEST(Plan, LightFoundByChanceAsksNone) {
  const KernelTable& kernels = select_kernels();
  PlanOptions options;
  options.light_sampling = LightSampling::kBsdf;
  const Scene lamp = compile_text(pinhole_room("AttributeBegin\n" + light_text("1 1 1") +
                                               sphere_text("0 0 .5", .2) + "AttributeEnd\n"),
                                  kernels);
  const Plan plan = make_plan(lamp, kernels, options);
  EXPECT_FALSE(plan.lights);
  for (const BinPlan& bin : plan.bins) EXPECT_FALSE(bin.sample_lights);
  EXPECT_NE(describe_plan(plan, lamp).find("light is found by chance"), std::string::npos);
  // A point is found by no ray.
  const Scene point =
      compile_text(pinhole_room("LightSource \"point\" \"color L\" [1 1 1]\n"), kernels);
  EXPECT_TRUE(make_plan(point, kernels, options).lights);
}

TEST(Plan, RouletteMayBeOff) {
  const KernelTable& kernels = select_kernels();
  const Scene scene = compile_text(pinhole_room("LightSource \"point\"\n"), kernels);
  PlanOptions options;
  options.max_depth = 30;
  EXPECT_TRUE(make_plan(scene, kernels, options).bins[1].draw_roulette);
  options.roulette_depth = 30;
  EXPECT_FALSE(make_plan(scene, kernels, options).bins[1].draw_roulette);
  options.roulette_depth = kNoRoulette;
  const Plan plan = make_plan(scene, kernels, options);
  EXPECT_FALSE(plan.bins[1].draw_roulette);
  EXPECT_NE(describe_plan(plan, scene).find("--roulette off"), std::string::npos);
}

TEST(Plan, TellsWhetherShadowRaysPlayRoulette) {
  const KernelTable& kernels = select_kernels();
  const Scene scene = compile_text(pinhole_room("LightSource \"point\"\n"), kernels);
  const auto told = [&](const PlanOptions& options, std::string_view what) {
    return describe_plan(make_plan(scene, kernels, options), scene).find(what) != std::string::npos;
  };
  PlanOptions options;
  options.shadow_roulette = .25;
  EXPECT_TRUE(told(options, "shadow rays below 0.25 of the level play roulette"));
  options.max_depth = 0;
  EXPECT_TRUE(told(options, "pilot: no light is sampled"));
  options.max_depth = 8;
  options.shadow_roulette = kNoShadowRoulette;
  EXPECT_TRUE(told(options, "pilot: all shadow rays are traced (--shadow-roulette off)"));
}

TEST(Plan, ATableWithoutANeededKernelIsRefused) {
  KernelTable kernels = select_kernels();
  const Scene scene = compile_text(everything_text(8, 8), kernels);
  kernels.shadow_spheres = nullptr;
  EXPECT_THROW(make_plan(scene, kernels, {}), std::logic_error);
}

// Whatever a stage reads and writes has a size.
TEST(Stages, RowsOfAllThatIsNamedHaveASize) {
  for (const StageInfo& stage : kStageList) {
    for (std::string_view names : {stage.reads, stage.writes})
      while (!names.empty()) {
        const size_t end = names.find(", ");
        EXPECT_GT(bytes_named(names.substr(0, end)), 0u) << names;
        names = end == std::string_view::npos ? std::string_view() : names.substr(end + 2);
      }
    EXPECT_EQ(stage_row_bytes(stage.stage) == 0, stage.stage == Stage::kSchedule);
  }
  EXPECT_EQ(bytes_named("nothing"), 0u);
  // A ray (7 words) in, a hit (4) out; a film pixel is a line of the cache.
  EXPECT_EQ(stage_row_bytes(Stage::kIntersect), 4 * (7 + 4u));
  EXPECT_EQ(stage_row_bytes(Stage::kAccumulate), 4 * (10 + 4 + 4u) + 64u);
}

}  // namespace
}  // namespace yat

// Pictures of scenes of many lights: by the light tree, by power, and by the oracle.

#include "many_lights.h"
#include "oracle.h"
#include "per_isa.h"

namespace yat {
namespace {

class LightRenders : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(LightRenders);

TEST_P(LightRenders, OnlyManyLightsHaveATree) {
  const auto plan_of = [&](uint32_t lamps, LightChoosing choosing) {
    return make_plan(compile_lamps(lamp_room_text(8, 8, lamps), kernels(), choosing), kernels(),
                     {});
  };
  EXPECT_FALSE(plan_of(kTreeLights - 1, LightChoosing::kAuto).light_tree);
  EXPECT_TRUE(plan_of(kTreeLights, LightChoosing::kAuto).light_tree);
  EXPECT_FALSE(plan_of(kTreeLights, LightChoosing::kPower).light_tree);
  EXPECT_TRUE(plan_of(2, LightChoosing::kTree).light_tree);
}

TEST_P(LightRenders, PathsAgreeOneByOneWithTheOracle) {
  for (const std::string& more : {std::string(), other_lights_text()}) {
    const Scene scene =
        compile_lamps(lamp_room_text(24, 18, 100, more), kernels(), LightChoosing::kTree);
    PlanOptions options;
    options.max_depth = 5;
    options.seed = 3;
    const double share = agreement(scene, make_plan(scene, kernels(), options), 4, 2e-2);
    RecordProperty("share", std::to_string(share));
    // Rough glass spreads rounding; chances of lights close by have that of their distance.
    EXPECT_GT(share, .9);
  }
}

// ---- Every light at every surface --------------------------------------------------------------

TEST_P(LightRenders, EveryLightIsSampledWhereAllAreAsked) {
  const auto scene_of = [&](uint32_t lamps, const std::string& more) {
    return compile_lamps(lamp_room_text(8, 8, lamps, more), kernels(), LightChoosing::kAll);
  };
  const Scene scene = scene_of(1, other_lights_text());
  const Plan plan = make_plan(scene, kernels(), {});
  ASSERT_EQ(scene.lights.size(), 8u);
  ASSERT_EQ(plan.light_groups.size(), 8u);
  EXPECT_FALSE(plan.light_by_place || plan.light_tree);
  for (uint32_t i = 0; i < 8; ++i) {
    const LightGroup& group = plan.light_groups[i];
    const LightRow<Value> row = scene.lights.row(i);
    EXPECT_EQ(group.rows.first, i);
    EXPECT_EQ(group.rows.end, i + 1);
    EXPECT_EQ(row.probability, 1);
    EXPECT_FALSE(group.tree);
    EXPECT_EQ(group.kernel, row.kind < kPlainLightKinds ? row.kind : uint32_t(kAnyLights));
  }
  for (const BinPlan& bin : plan.bins) EXPECT_FALSE(bin.draw_choice);
  const std::string text = describe_plan(plan, scene);
  EXPECT_NE(text.find("draw choice: every light is asked"), std::string::npos) << text;
  EXPECT_EQ(make_plan(scene_of(1, ""), kernels(), {}).light_groups.size(), 1u);
  // Without light samples there are none.
  PlanOptions options;
  options.max_depth = 0;
  EXPECT_TRUE(make_plan(scene, kernels(), options).light_groups.empty());
}

TEST_P(LightRenders, MoreLightsThanASurfaceMayAskAreSaid) {
  std::vector<std::string> warnings;
  Diagnostics diagnostics([&](Severity severity, std::string_view line) {
    if (severity == Severity::kWarning) warnings.emplace_back(line);
  });
  CompileOptions options;
  options.block_width = kernels().lanes;
  options.light_choice = LightChoosing::kAll;
  ThreadPool pool(1);
  const Scene scene = compile_scene(
      parse_scene(lamp_room_text(8, 8, kMostAskedLights + 1), "lamps.lxs", ".", diagnostics),
      options, pool, diagnostics);
  EXPECT_FALSE(scene.every_light);
  EXPECT_GT(scene.light_tree.nodes.size(), 0u);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("--light-choice all"), std::string::npos) << warnings[0];
}

TEST_P(LightRenders, PathsThatAskEveryLightAgreeWithTheOracle) {
  const Scene scene =
      compile_lamps(lamp_room_text(24, 18, 1, other_lights_text()), kernels(), LightChoosing::kAll);
  ASSERT_TRUE(scene.every_light);
  for (const float bound : {0.f, .05f}) {
    PlanOptions options;
    options.max_depth = 5;
    options.seed = 3;
    Plan plan = make_plan(scene, kernels(), options);
    plan.transport.shadow_bound = bound;
    EXPECT_GT(agreement(scene, plan, 4, 2e-2), .9) << bound;
  }
}

TEST_P(LightRenders, AskingEveryLightKeepsTheBitsOfAnyBatchAndThreads) {
  const Scene scene =
      compile_lamps(lamp_room_text(33, 21, 1, other_lights_text()), kernels(), LightChoosing::kAll);
  Plan plan = make_plan(scene, kernels(), {});
  plan.transport.shadow_bound = .05f;
  const Film expected = render_film(scene, plan, 0, 5);
  for (const uint32_t batch_rows : {16u, 100u, 8192u})
    EXPECT_TRUE(same_bits(expected, render_film(scene, plan, 0, 5, 3, batch_rows, 5)));
}

/// Sums of blocks of pixels over every sample: [block and channel][sample].
std::vector<std::vector<double>> block_sums(const Scene& scene, const Plan& plan, uint32_t samples,
                                            uint32_t block) {
  const uint32_t width = scene.film.crop_width(), height = scene.film.crop_height();
  const uint32_t across = (width + block - 1) / block, down = (height + block - 1) / block;
  std::vector<std::vector<double>> sums(size_t(across) * down * 3, std::vector<double>(samples));
  for (uint32_t sample = 0; sample < samples; ++sample) {
    const std::vector<float> rgb = render_film(scene, plan, sample, sample + 1).resolve();
    for (uint32_t y = 0; y < height; ++y)
      for (uint32_t x = 0; x < width; ++x)
        for (uint32_t k = 0; k < 3; ++k)
          sums[3 * (y / block * across + x / block) + k][sample] +=
              double(rgb[3 * (size_t(y) * width + x) + k]);
  }
  return sums;
}

// 108 tests: at |z| < 4.5 a right renderer passes them all with probability 99.9 %.
TEST_P(LightRenders, TreeAndPowerGiveTheSamePicture) {
  const std::string text = lamp_room_text(24, 24, 400, other_lights_text());
  const Scene tree = compile_lamps(text, kernels(), LightChoosing::kTree);
  const Scene power = compile_lamps(text, kernels(), LightChoosing::kPower);
  PlanOptions options;
  options.max_depth = 5;
  options.sampler = SamplerKind::kIndependent;
  options.seed = 1;
  const auto a = block_sums(tree, make_plan(tree, kernels(), options), 256, 4);
  options.seed = 2;
  const auto b = block_sums(power, make_plan(power, kernels(), options), 256, 4);
  for (size_t i = 0; i < a.size(); ++i) {
    const Estimate x = estimate(a[i]), y = estimate(b[i]);
    const double z = (x.mean - y.mean) / std::hypot(x.error, y.error);
    EXPECT_LT(std::fabs(z), 4.5) << "block " << i / 3 << " channel " << i % 3 << ": " << x.mean
                                 << " by tree, " << y.mean << " by power";
  }
}

// A floor under lamps that hang low and shine downwards; the camera sees none of them.
TEST_P(LightRenders, LampsCloseByMakeLessNoiseByTree) {
  std::string text = view_text("0 0 4", "0 .01 0", 30, 16, 16) + matte_text(".7 .6 .5") +
                     quad_text("-1 -1 0", "1 -1 0", "1 1 0", "-1 1 0");
  text += "AttributeBegin\n" + light_text("9 9 9") + "Material \"null\"\n";
  std::mt19937 engine(2);
  for (int i = 0; i < 100; ++i) {
    const double x = double(engine() >> 8) * 0x1p-23 - 1, y = double(engine() >> 8) * 0x1p-23 - 1;
    text += "AttributeBegin\nTranslate " + std::to_string(x) + " " + std::to_string(y) +
            " .15\nShape \"mesh\" \"integer triindices\" [0 1 2] \"point P\" "
            "[0 0 0 0 .05 0 .05 0 0]\nAttributeEnd\n";
  }
  text += "AttributeEnd\nWorldEnd\n";
  PlanOptions options;
  options.max_depth = 1;
  options.sampler = SamplerKind::kIndependent;
  const auto variance = [&](LightChoosing choosing) {
    const Scene scene = compile_lamps(text, kernels(), choosing);
    double sum = 0;
    for (const auto& values : block_sums(scene, make_plan(scene, kernels(), options), 64, 16))
      sum += std::pow(estimate(values).error, 2);
    return sum;
  };
  const double ratio = variance(LightChoosing::kTree) / variance(LightChoosing::kPower);
  RecordProperty("ratio", std::to_string(ratio));
  EXPECT_LT(ratio, .4);
}

TEST_P(LightRenders, SameBitsForAnyThreadsBatchAndTile) {
  const Scene scene = compile_lamps(lamp_room_text(37, 23, 200, other_lights_text()), kernels(),
                                    LightChoosing::kTree);
  const Plan plan = make_plan(scene, kernels(), {});
  const Film expected = render_film(scene, plan, 0, 4);
  for (const uint32_t threads : {1u, 3u})
    for (const uint32_t batch_rows : {16u, 1000u, 8192u})
      EXPECT_TRUE(same_bits(expected, render_film(scene, plan, 0, 4, threads, batch_rows, 7)))
          << threads << " threads, " << batch_rows << " rows";
}

}  // namespace
}  // namespace yat

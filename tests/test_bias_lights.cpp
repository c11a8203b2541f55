// No bias: ways to find light, and ways to choose lights.

#include "bias_proof.h"
#include "bias_scenes.h"

namespace yat {
namespace {

Side side_of(LightSampling ways, uint32_t depth, uint32_t samples) {
  Side side;
  side.options.max_depth = depth;
  side.options.light_sampling = ways;
  side.samples = samples;
  return side;
}

/// Light samples alone and light met by chance alone against both, weighted. by_chance: samples of
/// a pixel in each run of that way.
void prove_light_sampling(const std::string& text, uint32_t depth, uint32_t both, uint32_t lights,
                          uint32_t by_chance) {
  const KernelTable& kernels = select_kernels();
  const Scene scene = compile_text(text, kernels);
  const Runs mis = render_runs(scene, kernels, side_of(LightSampling::kBoth, depth, both), 0);
  expect_same("lights",
              render_runs(scene, kernels, side_of(LightSampling::kLights, depth, lights), 1), mis);
  expect_same("bsdf",
              render_runs(scene, kernels, side_of(LightSampling::kBsdf, depth, by_chance), 2), mis);
}

TEST(BiasOfLightSampling, Box) {
  prove_light_sampling(box_text(), 6, 16, 16, 32);
}
TEST(BiasOfLightSampling, Plates) {
  prove_light_sampling(plates_text(), 4, 16, 16, 64);
}
TEST(BiasOfLightSampling, Open) {
  prove_light_sampling(open_text(), 5, 16, 16, 32);
}
TEST(BiasOfLightSampling, Lamps) {
  prove_light_sampling(lamps_room_text(), 5, 16, 16, 96);
}
TEST(BiasOfLightSampling, Screens) {
  prove_light_sampling(screens_text(), 4, 32, 32, 128);
}
TEST(BiasOfLightSampling, Veils) {
  prove_light_sampling(veils_text(), 6, 16, 16, 64);
}

/// By power, by the tree, and all together if they are not too many, against each light alike.
void prove_light_choice(const std::string& text, uint32_t depth, uint32_t samples,
                        uint32_t uniform_samples, bool all = true) {
  const KernelTable& kernels = select_kernels();
  const auto runs = [&](LightChoosing choosing, uint32_t number, uint32_t count) {
    const Scene scene = compile_lamps(text, kernels, choosing);
    EXPECT_EQ(scene.light_tree.nodes.size() > 0, choosing == LightChoosing::kTree);
    return render_runs(scene, kernels, side_of(LightSampling::kBoth, depth, count), number);
  };
  const Runs uniform = runs(LightChoosing::kUniform, 0, uniform_samples);
  expect_same("power", runs(LightChoosing::kPower, 1, samples), uniform);
  expect_same("tree", runs(LightChoosing::kTree, 2, samples), uniform);
  if (all) expect_same("all", runs(LightChoosing::kAll, 3, samples), uniform);
}

TEST(BiasOfLightChoice, Plates) {
  prove_light_choice(plates_text(), 4, 16, 16);
}
TEST(BiasOfLightChoice, Lamps) {
  prove_light_choice(lamps_room_text(), 5, 16, 32, false);
}
TEST(BiasOfLightChoice, LightsOfAllKinds) {
  prove_light_choice(lamps_room_text(other_lights_text()), 5, 16, 32, false);
}
TEST(BiasOfLightChoice, Screens) {
  prove_light_choice(screens_text(), 4, 32, 64);
}
TEST(BiasOfLightChoice, Veils) {
  prove_light_choice(veils_text(), 6, 16, 32);
}

// Even skies that rays find by chance, as auto leaves them, against each light asked alike.
void prove_even_skies(const std::string& text, uint32_t depth, uint32_t samples,
                      uint32_t uniform_samples) {
  const KernelTable& kernels = select_kernels();
  const auto runs = [&](LightChoosing choosing, uint32_t number, uint32_t count) {
    const Scene scene = compile_lamps(text, kernels, choosing);
    EXPECT_EQ(scene.asked_lights < scene.lights.size(), choosing == LightChoosing::kAuto);
    return render_runs(scene, kernels, side_of(LightSampling::kBoth, depth, count), number);
  };
  const Runs uniform = runs(LightChoosing::kUniform, 0, uniform_samples);
  expect_same("left", runs(LightChoosing::kAuto, 1, samples), uniform);
}

TEST(BiasOfEvenSkies, BesideLamps) {
  prove_even_skies(lamps_room_text("LightSource \"infinite\" \"color L\" [.2 .25 .3]\n"), 5, 16,
                   32);
}
TEST(BiasOfEvenSkies, BesideASun) {
  prove_even_skies(
      view_text("0 -2.4 1.2", "0 0 -.3", 40, kProofSide, kProofSide) + matte_text(".7 .6 .5") +
          quad_text("-2 -2 -.5", "2 -2 -.5", "2 2 -.5", "-2 2 -.5") +
          "Material \"glossy\" \"color Kd\" [.4 .2 .1] \"color Ks\" [.3 .3 .3] \"float "
          "uroughness\" [.3] \"float vroughness\" [.3]\n" +
          sphere_text("-.6 0 -.1", .4) + "Material \"velvet\"\n" + sphere_text(".5 .2 -.1", .4) +
          "LightSource \"sunsky\" \"vector sundir\" [.5 -.3 .6] \"float relsize\" [20]\nWorldEnd\n",
      5, 16, 32);
}
TEST(BiasOfEvenSkies, Alone) {
  prove_even_skies(
      view_text("0 -2.4 1.2", "0 0 -.3", 40, kProofSide, kProofSide) + matte_text(".7 .6 .5") +
          quad_text("-2 -2 -.5", "2 -2 -.5", "2 2 -.5", "-2 2 -.5") + sphere_text("-.6 0 -.1", .4) +
          "Material \"mirror\"\n" + sphere_text(".5 .2 -.1", .4) +
          "LightSource \"infinite\" \"color L\" [.9 .8 .7]\nWorldEnd\n",
      5, 16, 32);
}

// ---- Roulette of shadow rays -------------------------------------------------------------------

/// Bounds of a third and of three times the picture's mean against none.
void prove_shadow_roulette(const std::string& text, uint32_t depth, uint32_t samples,
                           LightChoosing choosing = LightChoosing::kAuto) {
  const KernelTable& kernels = select_kernels();
  const Scene scene = compile_lamps(text, kernels, choosing);
  const auto runs = [&](float bound, uint32_t number) {
    Side side = side_of(LightSampling::kBoth, depth, samples);
    side.change = [bound](Plan& plan) { plan.transport.shadow_bound = bound; };
    return render_runs(scene, kernels, side, number);
  };
  const Runs off = runs(0, 0);
  double sum = 0;
  for (const float value : off.pictures.front()) sum += double(value);
  const double mean = sum / double(off.pictures.front().size());
  expect_same("third", runs(float(mean / 3), 1), off);
  expect_same("three_times", runs(float(mean * 3), 2), off);
}

TEST(BiasOfShadowRoulette, Box) {
  prove_shadow_roulette(box_text(), 6, 16);
}
TEST(BiasOfShadowRoulette, Plates) {
  prove_shadow_roulette(plates_text(), 4, 32, LightChoosing::kAll);
}
TEST(BiasOfShadowRoulette, Open) {
  prove_shadow_roulette(open_text(), 5, 16);
}
TEST(BiasOfShadowRoulette, Veils) {
  prove_shadow_roulette(veils_text(), 6, 16, LightChoosing::kAll);
}

}  // namespace
}  // namespace yat

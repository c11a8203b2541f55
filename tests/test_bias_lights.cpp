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

/// By power and by the tree against each light alike.
void prove_light_choice(const std::string& text, uint32_t depth, uint32_t samples,
                        uint32_t uniform_samples) {
  const KernelTable& kernels = select_kernels();
  const auto runs = [&](LightChoosing choosing, uint32_t number, uint32_t count) {
    const Scene scene = compile_lamps(text, kernels, choosing);
    EXPECT_EQ(scene.light_tree.nodes.size() > 0, choosing == LightChoosing::kTree);
    return render_runs(scene, kernels, side_of(LightSampling::kBoth, depth, count), number);
  };
  const Runs uniform = runs(LightChoosing::kUniform, 0, uniform_samples);
  expect_same("power", runs(LightChoosing::kPower, 1, samples), uniform);
  expect_same("tree", runs(LightChoosing::kTree, 2, samples), uniform);
}

TEST(BiasOfLightChoice, Plates) {
  prove_light_choice(plates_text(), 4, 16, 16);
}
TEST(BiasOfLightChoice, Lamps) {
  prove_light_choice(lamps_room_text(), 5, 16, 32);
}
TEST(BiasOfLightChoice, LightsOfAllKinds) {
  prove_light_choice(lamps_room_text(other_lights_text()), 5, 16, 32);
}
TEST(BiasOfLightChoice, Screens) {
  prove_light_choice(screens_text(), 4, 32, 64);
}
TEST(BiasOfLightChoice, Veils) {
  prove_light_choice(veils_text(), 6, 16, 32);
}

}  // namespace
}  // namespace yat

// No bias: samplers, Russian roulette, parts of the light, known pictures.

#include <initializer_list>

#include "bias_proof.h"
#include "bias_scenes.h"

namespace yat {
namespace {

Side side_of(uint32_t depth, SamplerKind sampler = SamplerKind::kSobol, uint32_t samples = 16) {
  Side side;
  side.options.max_depth = depth;
  side.options.sampler = sampler;
  side.samples = samples;
  return side;
}

// ---- Samplers ----------------------------------------------------------------------------------

/// All but `regular`: its samples are the middles of strata, whatever the seed; what lies beside
/// them is never seen, which is what makes it regular.
constexpr SamplerKind kSpread[] = {SamplerKind::kSobol,
                                   SamplerKind::kJittered,
                                   SamplerKind::kNRooks,
                                   SamplerKind::kMultiJittered,
                                   SamplerKind::kCorrelatedMultiJittered,
                                   SamplerKind::kZSobol};

void prove_samplers(const std::string& text, uint32_t depth) {
  const KernelTable& kernels = select_kernels();
  const Scene scene = compile_text(text, kernels);
  const Runs independent =
      render_runs(scene, kernels, side_of(depth, SamplerKind::kIndependent), 0);
  uint32_t number = 0;
  for (const SamplerKind sampler : kSpread)
    expect_same(std::string(sampler_kind_name(sampler)),
                render_runs(scene, kernels, side_of(depth, sampler), ++number), independent);
}

TEST(BiasOfSamplers, Box) {
  prove_samplers(box_text(), 5);
}
TEST(BiasOfSamplers, Plates) {
  prove_samplers(plates_text(), 3);
}
TEST(BiasOfSamplers, Open) {
  prove_samplers(open_text(), 4);
}

// Part of a set (a render that a time limit ends, a range of samples): strata are left out, but
// each with the same chance. And sets whose grid has fewer cells than they were asked to hold.
TEST(BiasOfSamplers, PartsOfSets) {
  const KernelTable& kernels = select_kernels();
  const Scene scene = compile_text(plates_text(), kernels);
  const Runs independent =
      render_runs(scene, kernels, side_of(3, SamplerKind::kIndependent, 32), 0);
  uint32_t number = 0;
  for (const SamplerKind sampler : kSpread) {
    Side side = side_of(3, sampler, 21);
    side.sample_set = 40;
    expect_same(std::string(sampler_kind_name(sampler)),
                render_runs(scene, kernels, side, ++number), independent);
  }
}

// ---- Roulette ----------------------------------------------------------------------------------

void prove_roulette(const std::string& text, uint32_t samples) {
  const KernelTable& kernels = select_kernels();
  const Scene scene = compile_text(text, kernels);
  const auto runs = [&](uint32_t from, uint32_t number) {
    Side side = side_of(16, SamplerKind::kSobol, samples);
    side.options.roulette_depth = from;
    return render_runs(scene, kernels, side, number);
  };
  const Runs off = runs(kNoRoulette, 0);
  expect_same("usual", runs(TransportOptions{}.roulette_depth, 1), off);
  expect_same("from_the_first_vertex", runs(0, 2), off);
}

TEST(BiasOfRoulette, Box) {
  prove_roulette(box_text(), 16);
}
TEST(BiasOfRoulette, Open) {
  prove_roulette(open_text(), 16);
}
TEST(BiasOfRoulette, Veils) {
  prove_roulette(veils_text(), 16);
}

// ---- Parts of the light ------------------------------------------------------------------------

/// Direct plus indirect light, of other seeds, is all of it; direct light alone is that of paths
/// that end at the next vertex.
void prove_parts(const std::string& text, uint32_t depth) {
  const KernelTable& kernels = select_kernels();
  const Scene scene = compile_text(text, kernels);
  const Side side = side_of(depth);
  Runs sum{kProofSide, kProofSide, {}}, direct = sum;
  for (uint32_t r = 0; r < kRuns; ++r) {
    const Plan plan = plan_of(scene, kernels, side, proof_seed(1) + r);
    Film film(kProofSide, kProofSide);
    FeatureFilm features(kProofSide, kProofSide,
                         feature_bit(Feature::kDirect) | feature_bit(Feature::kIndirect));
    RenderOptions options;
    options.end_sample = side.samples;
    options.features = &features;
    ThreadPool pool(1);
    render(scene, plan, options, pool, film);
    direct.pictures.push_back(features.resolve(Feature::kDirect, film));
    sum.pictures.push_back(direct.pictures.back());
    const std::vector<float> rest = features.resolve(Feature::kIndirect, film);
    for (size_t i = 0; i < rest.size(); ++i) sum.pictures.back()[i] += rest[i];
  }
  expect_same("sum", sum, render_runs(scene, kernels, side, 0));
  expect_same("direct", direct, render_runs(scene, kernels, side_of(1), 2));
}

TEST(BiasOfParts, Box) {
  prove_parts(box_text(), 6);
}
TEST(BiasOfParts, Plates) {
  prove_parts(plates_text(), 4);
}
TEST(BiasOfParts, Veils) {
  prove_parts(veils_text(), 6);
}

// ---- What a proof finds ------------------------------------------------------------------------

// Paths that end a vertex early: about 1.5 % of the light of a closed room.
TEST(BiasProofs, FindAMissingBounce) {
  const KernelTable& kernels = select_kernels();
  const Scene scene = compile_text(box_text(), kernels);
  const PictureTest test = compare_runs(render_runs(scene, kernels, side_of(7), 0),
                                        render_runs(scene, kernels, side_of(8), 1));
  EXPECT_LT(test.difference, 0);
  EXPECT_GT(test.difference, -.03);
  EXPECT_FALSE(test.passes(kProofLevel)) << test.text();
}

// ---- Known pictures ----------------------------------------------------------------------------

/// Walls that shine with .5 and reflect half of what comes, all around: 1 in every pixel.
void prove_furnace(const std::string& walls, std::initializer_list<LightSampling> all) {
  const KernelTable& kernels = select_kernels();
  const Scene scene = compile_text(
      view_text("0.1 -.6 .2", "0 0 0", 70, kProofSide, kProofSide) + walls + "WorldEnd\n", kernels);
  const Runs known = known_picture(kProofSide, kProofSide, 1);
  for (const LightSampling ways : all) {
    Side side = side_of(30);
    side.options.light_sampling = ways;
    expect_same("ways" + std::to_string(int(ways)),
                render_runs(scene, kernels, side, uint32_t(ways)), known);
  }
}

// Without light samples alone: in a corner what walls send each other has no finite variance then.
TEST(BiasOfKnownPictures, Room) {
  prove_furnace(light_text(".5 .5 .5") + matte_text(".5 .5 .5") + room_text(1),
                {LightSampling::kBoth, LightSampling::kBsdf});
}
TEST(BiasOfKnownPictures, Ball) {
  prove_furnace("ReverseOrientation\n" + light_text(".5 .5 .5") + matte_text(".5 .5 .5") +
                    "Shape \"sphere\" \"float radius\" [1]\n",
                {LightSampling::kBoth, LightSampling::kLights, LightSampling::kBsdf});
}

}  // namespace
}  // namespace yat

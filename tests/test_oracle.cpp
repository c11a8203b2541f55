// Kernels and schedule against the scalar reference: path by path with the same random numbers,
// and picture by picture with different ones.

#include <gtest/gtest.h>

#include <filesystem>

#include "environment_scenes.h"
#include "many_lights.h"
#include "oracle.h"
#include "per_isa.h"
#include "shared_scenes.h"

namespace yat {
namespace {

class Oracle : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(Oracle);

TEST_P(Oracle, PathsAgreeOneByOne) {
  const Scene scene = compile_text(everything_text(32, 24), kernels());
  for (const SamplerKind sampler : {SamplerKind::kSobol, SamplerKind::kIndependent}) {
    PlanOptions options;
    options.sampler = sampler;
    options.max_depth = 8;
    options.seed = 11;
    const double share = agreement(scene, make_plan(scene, kernels(), options), 4, 1e-2);
    RecordProperty("share", std::to_string(share));
    // Long paths over glass and curved mirrors spread rounding errors; some pass an edge on the
    // other side.
    EXPECT_GT(share, .96);
  }
}

TEST_P(Oracle, OpenAirPathsAgreeOneByOne) {
  const Scene scene = compile_text(open_air_text(32, 24), kernels());
  PlanOptions options;
  options.max_depth = 6;
  options.seed = 3;
  const double share = agreement(scene, make_plan(scene, kernels(), options), 4, 1e-2);
  RecordProperty("share", std::to_string(share));
  // Densities jump at the edges of cells; curved mirrors spread rounding errors.
  EXPECT_GT(share, .96);
}

TEST_P(Oracle, OpenAirPicturesAgree) {
  const Scene scene = compile_text(open_air_text(24, 16), kernels());
  expect_same_picture(scene, kernels(), 6, 64, 8);
}

// Light found in one way only, in a scene with light of all sorts around it and lamps that are met.
TEST_P(Oracle, PathsOfEachWayToFindLightAgreeOneByOne) {
  for (const std::string& text : {everything_text(32, 24), open_air_text(32, 24)}) {
    for (const LightSampling ways : {LightSampling::kLights, LightSampling::kBsdf}) {
      // Light samples alone find what is asked alone.
      const Scene scene = compile_lamps(
          text, kernels(),
          ways == LightSampling::kLights ? LightChoosing::kPower : LightChoosing::kAuto);
      PlanOptions options;
      options.max_depth = 6;
      options.seed = 5;
      options.light_sampling = ways;
      options.roulette_depth = ways == LightSampling::kLights ? kNoRoulette : 1;
      EXPECT_GT(agreement(scene, make_plan(scene, kernels(), options), 4, 1e-2), .96);
    }
  }
}

// Corners whose differences are not exact: the oracle's shadow rays once ended behind such lamps.
TEST_P(Oracle, PathsToObliqueLampsAgreeOneByOne) {
  std::string text = view_text("0 -2.6 .4", "0 .2 -.7", 40, 32, 24) + matte_text(".6 .6 .6") +
                     quad_text("-1 -1 -1", "1 -1 -1", "1 1 -1", "-1 1 -1");
  text += "AttributeBegin\nTranslate 0 -.3 1.2\nScale .8 .8 .8\n" + lamps_text(12, .45, 1) +
          "AttributeEnd\n";
  const Scene scene = compile_text(text + "WorldEnd\n", kernels());
  PlanOptions options;
  options.max_depth = 3;
  EXPECT_GT(agreement(scene, make_plan(scene, kernels(), options), 8, 1e-3), .99);
}

TEST_P(Oracle, DirectPathsAgreeOneByOne) {
  const Scene scene = compile_text(everything_text(32, 24), kernels());
  PlanOptions options;
  options.integrator = Integrator::kDirect;
  options.max_depth = 4;
  EXPECT_GT(agreement(scene, make_plan(scene, kernels(), options), 4, 1e-3), .98);
}

TEST_P(Oracle, PicturesAgree) {
  const Scene scene = compile_text(everything_text(32, 24), kernels());
  expect_same_picture(scene, kernels(), 8, 64, 8);
}

TEST_P(Oracle, CornellBox) {
  YAT_NEED_SHARED(file, "CornellBox/cornell-box.lxs");
  Diagnostics diagnostics([](Severity, std::string_view) {});
  const Scene scene =
      compile_description(read_scene(file, diagnostics), kernels(), diagnostics, 32, 18);
  PlanOptions options;
  options.max_depth = 10;
  EXPECT_GT(agreement(scene, make_plan(scene, kernels(), options), 16, 1e-4), .99);
  expect_same_picture(scene, kernels(), 10, 64, 8);
}

}  // namespace
}  // namespace yat

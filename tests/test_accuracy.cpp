// The formulas behind the known answers against figures in print, and bench_accuracy itself on a
// few cases.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "accuracy/cie_sky.h"
#include "accuracy/form_factors.h"
#include "accuracy/fresnel.h"
#include "accuracy/lobes.h"
#include "accuracy/report.h"
#include "run_program.h"

namespace yat::accuracy {
namespace {

using Vec = glm::dvec3;
using Json = nlohmann::json;

TEST(Accuracy, QuadratureIsExactForPolynomialsAndSmoothFunctions) {
  EXPECT_NEAR(integrate(0, 2, 1, [](double x) { return std::pow(x, 31); }) / std::pow(2, 27), 1,
              1e-13);
  EXPECT_NEAR(integrate(0, kPi, 4, [](double x) { return std::sin(x); }), 2, 1e-14);
  // A kink between intervals does no harm.
  EXPECT_NEAR(integrate_between({-1, 0, 2}, 1, [](double x) { return std::fabs(x); }), 2.5, 1e-14);
}

TEST(Accuracy, PolygonsHaveLambertsIrradiance) {
  const Vec o(0), up(0, 0, 1);
  EXPECT_NEAR(rectangle_irradiance(o, up, {-.5, -.5, 1}, {1, 0, 0}, {0, 1, 0}), .752274688, 1e-9);
  EXPECT_NEAR(rectangle_irradiance(o, up, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}), .435209876, 1e-9);
  EXPECT_NEAR(polygon_irradiance(o, up, {{1, 0, 2}, {0, 1, 2}, {-1, -1, 3}}), .258953915, 1e-9);
  // A wall that goes on for ever on both sides and upwards fills half of what its foot sees; what
  // is below the horizon does not count.
  EXPECT_NEAR(rectangle_irradiance(o, up, {-1e7, 1, -50}, {2e7, 0, 0}, {0, 0, 1e7}), kPi / 2, 1e-5);
  EXPECT_EQ(rectangle_irradiance(o, up, {-1, -1, -1}, {2, 0, 0}, {0, 2, 0}), 0);
}

TEST(Accuracy, FormFactorsOfACubeAddUp) {
  const double opposite = opposite_form_factor(1, 1, 1);
  EXPECT_NEAR(opposite, .199824896, 1e-9);
  EXPECT_NEAR((1 - opposite) / 4, .200043776, 1e-9);
  const double by_points = integrate(0, 1, 4, [](double x) {
    return integrate(0, 1, 4, [x](double y) {
      return rectangle_irradiance({x, y, 0}, {0, 0, 1}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}) / kPi;
    });
  });
  EXPECT_NEAR(by_points, opposite, 1e-9);
}

TEST(Accuracy, GlassReflectsByFresnel) {
  EXPECT_NEAR(mean_fresnel(1.5), .091777959, 1e-7);
  EXPECT_NEAR(slab(1.5, 1).reflected, .076923077, 1e-9);
  EXPECT_NEAR(slab(1.5, 1).transmitted, .923076923, 1e-9);
  const Slab oblique = slab(1.5, .4);
  EXPECT_NEAR(oblique.reflected + oblique.transmitted, 1, 1e-14);
  EXPECT_LT(slab(1.5, .4, .9).reflected + slab(1.5, .4, .9).transmitted, 1);
}

TEST(Accuracy, AlbedosOfGgxAreThoseInPrint) {
  EXPECT_NEAR(ggx_albedo(1, 1), 1 - std::log(2), 1e-6);
  const double expected[3][3] = {
      {.9883, .9692, .8834}, {.8775, .8216, .8888}, {.6882, .6982, .8601}};
  const double alphas[3] = {.1, .3, .5}, cosines[3] = {1, .5, .1};
  for (int a = 0; a < 3; ++a)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(ggx_albedo(alphas[a], cosines[c]), expected[a][c], 4e-4)
          << alphas[a] << " " << cosines[c];
  // With roughness 1 LuxRender's lobe has G = c, whatever the direction.
  for (const double c : cosines) EXPECT_NEAR(luxrender_albedo(1, c), .25, 1e-6);
  EXPECT_NEAR(cook_torrance_albedo(.01, 1), 1, 1e-4);
}

/// Over all directions above the horizon.
double horizontal_illuminance(const CieSky& sky) {
  return integrate(0, kPi / 2, 8, [&](double e) {
    return integrate(0, 2 * kPi, 16, [&](double a) {
      const Vec d(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
      return sky.luminance(d) * d.z * std::cos(e);
    });
  });
}

TEST(Accuracy, SkiesOfTheCieHaveUnitIlluminanceAndTheirGradation) {
  const Vec sun(0, -.5, std::sqrt(.75));
  for (int type = 1; type <= 15; ++type)
    EXPECT_NEAR(horizontal_illuminance(CieSky(type, sun)), 1, 2e-5) << type;
  const CieSky overcast(1, sun), uniform(5, sun), clear(12, sun);
  EXPECT_NEAR(overcast.luminance({0, 0, 1}) / overcast.luminance({1, 0, 0 + 1e-12}),
              1 + 4 * std::exp(-.7), 1e-9);
  EXPECT_NEAR(uniform.luminance({.6, 0, .8}), 1 / kPi, 1e-9);
  EXPECT_GT(clear.luminance(sun), 5 * clear.luminance({0, std::sqrt(.75), .5}));
  EXPECT_EQ(clear.luminance({0, .6, -.8}), CieSky::kGround / kPi);
  EXPECT_THROW(CieSky(16, sun), std::invalid_argument);
  EXPECT_THROW(CieSky(1, {0, .6, -.8}), std::invalid_argument);
}

TEST(Accuracy, APictureOfASkyIsAsFineAsItSays) {
  const CieSky sky(12, {0, -.5, std::sqrt(.75)});
  const double texel = kPi / 1024;
  const auto at = [&](double azimuth, double elevation) {
    return sky.luminance({std::cos(elevation) * std::cos(azimuth),
                          std::cos(elevation) * std::sin(azimuth), std::sin(elevation)});
  };
  // Farthest from the middles of texels, a few degrees from sun and horizon.
  for (const double elevation : {.2, .7, 1.3})
    for (const double azimuth : {.3, 1.5, 3.7, 5.5}) {
      double mean = 0;
      for (const double x : {-.5, .5})
        for (const double y : {-.5, .5}) mean += at(azimuth + x * texel, elevation + y * texel) / 4;
      EXPECT_NEAR(mean / at(azimuth, elevation), 1, 2e-5) << elevation << " " << azimuth;
    }
}

TEST(Accuracy, OpeningsAndBlocksAgreeWithClosedForms) {
  const CieSky uniform(5, {0, -.5, std::sqrt(.75)});
  const auto radiance = [&](const Vec& d) { return uniform.luminance(d); };
  const Vec up(0, 0, 1), corner(-.3, -.2, 1), u(1, 0, 0), v(0, .5, 0);
  EXPECT_NEAR(through_opening({0, 0, 0}, up, {corner, u, v}, {}, 4, radiance),
              rectangle_irradiance({0, 0, 0}, up, corner, u, v) / kPi, 1e-9);
  // Half sky and half ground, around a block too small to see; and what a block takes away from the
  // ground below a point is what it takes from a hemisphere.
  const Block speck{{0, 50, 0}, {1e-4, 50 + 1e-4, 1e-4}};
  EXPECT_NEAR(upright_irradiance(uniform, {0, 0, 2}, speck), (1 + CieSky::kGround) / 2, 1e-6);
  EXPECT_NEAR(underside_irradiance({0, 0, 2}, speck), CieSky::kGround, 1e-6);
  const Block room{{-2, 1, 0}, {2, 5, 3}};
  const double front =
      rectangle_irradiance({.3, 0, 3}, {0, 0, -1}, {-2, 1, 0}, {4, 0, 0}, {0, 0, 3});
  EXPECT_NEAR(underside_irradiance({.3, 0, 3}, room), CieSky::kGround * (1 - front / kPi), 1e-6);
  const double seen = rectangle_irradiance({.3, 0, 1}, {0, 1, 0}, {-2, 1, 0}, {4, 0, 0}, {0, 0, 1});
  const double sky = rectangle_irradiance({.3, 0, 1}, {0, 1, 0}, {-2, 1, 1}, {4, 0, 0}, {0, 0, 2});
  EXPECT_NEAR(upright_irradiance(uniform, {.3, 0, 1}, room),
              (1 + CieSky::kGround) / 2 - (sky + CieSky::kGround * seen) / kPi, 1e-5);
}

TEST(Accuracy, ADeviationIsJudgedBySigmaAndByTheStandardError) {
  Outcome outcome;
  outcome.known = {2, 0};
  outcome.measured.value = 2.003;
  outcome.measured.error = .0015;
  EXPECT_NEAR(outcome.sigma(), 2, 1e-5);
  EXPECT_NEAR(outcome.relative_error(), 7.5e-4, 1e-12);
  EXPECT_TRUE(outcome.within({3, 1e-3}));
  EXPECT_FALSE(outcome.within({1.9, 1e-3}));
  EXPECT_FALSE(outcome.within({3, 7e-4}));
  outcome.measured.value = std::nan("");
  EXPECT_FALSE(outcome.within({3, 1e-3}));
  // What never varies is known to the roundings of single precision.
  outcome.measured.error = 0;
  outcome.measured.value = 2 * (1 + 2e-6);
  EXPECT_NEAR(outcome.sigma(), 2, 1e-3);
  // Nothing is exactly nothing.
  outcome.known.value = 0;
  outcome.measured.value = 0;
  EXPECT_TRUE(outcome.within({3, 1e-3}));
  outcome.measured.value = 1e-12;
  EXPECT_FALSE(outcome.within({3, 1e-3}));
}

TEST(Accuracy, ChanceIsStudentsOfTheRunsThereAre) {
  Outcome outcome;
  outcome.known = {1e3};
  outcome.measured.error = 1;  // Much more than roundings.
  outcome.measured.runs = 16;
  // Tables of Student's t, 15 degrees of freedom.
  EXPECT_NEAR(outcome.chance_of(2.131), .05, 5e-5);
  EXPECT_NEAR(outcome.chance_of(-2.947), .01, 2e-5);
  // Two equal errors of 16 runs have 30 (Welch).
  outcome.known.error = 1;
  outcome.known.runs = 16;
  EXPECT_NEAR(outcome.chance_of(2.042), .05, 5e-5);
  // Where roundings are all there is, the normal distribution.
  for (const double error : {0., 1e-13}) {
    outcome.measured.error = outcome.known.error = error;
    EXPECT_NEAR(outcome.chance_of(1.96), .05, 1e-4);
  }
}

TEST(Accuracy, WhatLiesOutsideCountsAsItDoesWhenRepeated) {
  const Limits limits{3, 1e-3};
  Outcome right, wrong;
  right.known = wrong.known = {2};
  right.measured.value = 2.001;
  right.measured.error = wrong.measured.error = .001;
  wrong.measured.value = 2.004;
  EXPECT_TRUE((Verdict{right, {}}.good(limits)));
  EXPECT_FALSE((Verdict{wrong, {}}.good(limits)));
  EXPECT_TRUE((Verdict{wrong, right}.good(limits)));
  EXPECT_FALSE((Verdict{wrong, wrong}.good(limits)));
  // Both are on record.
  const Case c{"a", "b", {}, {}, {}};
  right.c = wrong.c = &c;
  const Json row = json_row({wrong, right}, limits);
  EXPECT_EQ(row["within"], false);
  EXPECT_EQ(row["again"]["within"], true);
  EXPECT_EQ(row["good"], true);
  EXPECT_NE(markdown({{wrong, right}}, {}, limits).find("***"), std::string::npos);
}

class AccuracyProgram : public testing::Test {
 protected:
  void SetUp() override { folder = empty_folder("accuracy"); }
  ProgramResult run(std::vector<std::string> options) const {
    options.insert(options.begin(), std::string(YAT_BENCH_DIR) + "/bench_accuracy");
    return run_program(options, folder);
  }
  std::filesystem::path folder;
};

TEST_F(AccuracyProgram, FewSamplesComeNearTheKnownAnswers) {
  const ProgramResult result =
      run({"--filter", "lights,rooms.concentric,glass.slab,lobes.luxrender.0.3,cie.5.3", "--runs",
           "16", "--scale", ".01", "--sigma", "6", "--error", "5", "--json", "accuracy.json",
           "--threads", "1"});
  EXPECT_EQ(result.code, 0) << result.out << result.err;
  const Json report = Json::parse(read_whole(folder / "accuracy.json"));
  EXPECT_EQ(report["program"], "bench_accuracy");
  ASSERT_EQ(report["cases"].size(), 8u + 2 + 4 + 3 + 10);
  for (const Json& row : report["cases"]) {
    EXPECT_GT(row["samples"], 0) << row["name"];
    EXPECT_EQ(row["within"], true) << row["name"];
    if (!row.contains("published")) continue;
    EXPECT_NEAR(double(row["published"]) / double(row["expected"]), 1, 3e-3) << row["name"];
  }
}

TEST_F(AccuracyProgram, EndsWithOneWhereACaseIsNotWithinTheLimits) {
  const std::vector<std::string> few = {"--filter", "lights.square", "--runs",    "4",
                                        "--scale",  ".001",          "--threads", "1"};
  std::vector<std::string> strict = few;
  strict.insert(strict.end(), {"--sigma", "1e-9", "--error", "100"});
  EXPECT_EQ(run(strict).code, 1);
  strict = few;
  strict.insert(strict.end(), {"--sigma", "1e9", "--error", "1e-9"});
  EXPECT_EQ(run(strict).code, 1);
  EXPECT_EQ(run({"--filter", "no such case"}).code, 2);
}

// Runs are added until the standard error is small, and what is outside is rendered again.
TEST_F(AccuracyProgram, AddsRunsAndRepeatsWhatIsOutside) {
  const std::vector<std::string> few = {"--filter",  "lights.triangle,rooms.cube.adjacent",
                                        "--runs",    "4",
                                        "--scale",   ".001",
                                        "--json",    "accuracy.json",
                                        "--threads", "1",
                                        "--error",   "10"};
  const auto rows = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = few;
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_LE(run(words).code, 1);
    return Json::parse(read_whole(folder / "accuracy.json"))["cases"];
  };
  const Json loose = rows({"--sigma", "1e9"}), other = rows({"--sigma", "1e9", "--seed", "7"});
  // Twice what is there is enough for a little less; the first runs are the same.
  const double error = double(loose[0]["standard_error"]) / double(loose[0]["expected"]);
  std::vector<std::string> tighter = few;
  tighter.back() = fmt::format("{}", 99 * error);
  tighter.insert(tighter.end(), {"--sigma", "1e9"});
  run(tighter);
  const Json tight = Json::parse(read_whole(folder / "accuracy.json"))["cases"];
  EXPECT_EQ(loose[0]["runs"], 4);
  EXPECT_GE(tight[0]["runs"], 8);
  EXPECT_LE(tight[0]["runs"], 32);
  EXPECT_LT(double(tight[0]["standard_error"]), double(loose[0]["standard_error"]));
  EXPECT_EQ(tight[0]["spp"], loose[0]["spp"]);
  EXPECT_NE(other[0]["computed"], loose[0]["computed"]);

  const Json repeated = rows({"--sigma", "1e-9"});
  for (const Json& row : repeated) {
    EXPECT_EQ(row["again"]["runs"], 16) << row;
    EXPECT_NE(row["again"]["computed"], row["computed"]) << row;
    EXPECT_EQ(row["good"], false) << row;
  }
}

TEST_F(AccuracyProgram, ListsItsCases) {
  const ProgramResult result = run({"--list", "--filter", "rooms.cube"});
  EXPECT_EQ(result.code, 0);
  EXPECT_NE(result.out.find("rooms.cube.opposite"), std::string::npos);
  EXPECT_EQ(result.out.find("lights"), std::string::npos);
}

}  // namespace
}  // namespace yat::accuracy

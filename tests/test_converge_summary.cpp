// What is concluded from runs whose truth is known.

#include "converge/summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "converge/ladder.h"
#include "converge/record.h"
#include "converge/summary_json.h"
#include "converge/summary_text.h"

namespace yat {
namespace {

Reference grey_reference(double variance) {
  Reference r;
  r.image = {8, 8, std::vector<float>(8 * 8 * 3, 1.f), true};
  if (variance >= 0) r.variance.assign(8 * 8 * 3, variance);
  r.degrees = 7;
  return r;
}

/// Runs of a method with MSE = a spp^(2 slope) + floor, scattered by `scatter`, that takes
/// `seconds` a sample.
struct Method {
  std::string name;
  double a = 1, slope = -.5, floor = 0, seconds = 1e-3, scatter = .05, trimmed = 1;
};

std::vector<RunRecord> runs_of(const std::vector<Method>& methods,
                               const std::vector<uint32_t>& ladder, uint32_t runs = 16) {
  std::mt19937 rng(3);
  std::normal_distribution<double> normal;
  std::vector<RunRecord> records;
  for (uint32_t run = 0; run < runs; ++run)
    for (const uint32_t spp : ladder)
      for (const Method& m : methods) {
        RunRecord r;
        r.variant = m.name;
        r.spp = spp;
        r.run = run;
        r.samples_per_pixel = spp;
        r.seconds = m.seconds * spp * std::exp(.01 * normal(rng));
        r.cpu_seconds = 2 * r.seconds;
        r.error.mse = m.a * std::pow(spp, 2 * m.slope) * (1 + m.scatter * normal(rng)) + m.floor;
        r.error.rel_mse = r.error.mse;
        r.error.rel_mse_trimmed = r.error.mse * m.trimmed;
        r.error.bias = 1e-3 * normal(rng);
        r.error.epsilon = .01;
        records.push_back(r);
      }
  return records;
}

const std::vector<uint32_t> kLadder = {1, 4, 16, 64, 256};

ConvergeSummary summary_of(const std::vector<Method>& methods, const Reference& reference,
                           const std::vector<RunRecord>& runs) {
  Experiment e;
  for (const Method& m : methods) e.variants.push_back(m.name);
  e.ladder = kLadder;
  e.runs = runs;
  e.reference = &reference;
  return summarize(e);
}

TEST(Summary, KnowsSlopesAndEfficienciesOfSyntheticMethods) {
  // The second takes half the time a sample and has a third of the error: six times as good.
  const std::vector<Method> methods = {{"plain", 3}, {"better", 1, -.5, 0, 5e-4}, {"qmc", 3, -.75}};
  const std::vector<RunRecord> runs = runs_of(methods, kLadder);
  const Reference exact = grey_reference(0);
  const ConvergeSummary s = summary_of(methods, exact, runs);
  ASSERT_EQ(s.variants.size(), 3u);
  EXPECT_NEAR(s.variants[0].slope.value, -.5, .005);
  EXPECT_NEAR(s.variants[2].slope.value, -.75, .005);
  for (const VariantSummary& v : s.variants) {
    EXPECT_TRUE(v.slope.interval.known());
    EXPECT_LT(v.slope.interval.high - v.slope.interval.low, .02);
    EXPECT_EQ(v.headline, 4u);
    EXPECT_EQ(v.rungs.size(), 5u);
  }
  for (const RungSummary& r : s.variants[0].rungs) {
    EXPECT_NEAR(r.ttuv.value, 3e-3, 2e-4);
    EXPECT_FALSE(r.ttuv.interval.excludes(r.ttuv.value));
    EXPECT_NEAR(r.ttuv_cpu.value, 6e-3, 4e-4);
    EXPECT_DOUBLE_EQ(r.ttuv_ratio.value, 1);
    EXPECT_FALSE(r.unreliable);
  }
  const RungSummary& better = s.variants[1].top();
  EXPECT_NEAR(better.ttuv_ratio.value, 1. / 6, .01);
  EXPECT_TRUE(better.ttuv_ratio.interval.excludes(1));
  EXPECT_NEAR(better.rel_cpu_ratio.value, 1. / 6, .01);
  int held = 0;
  for (const RungSummary& r : s.variants[1].rungs) held += !r.ttuv_ratio.interval.excludes(1. / 6);
  EXPECT_GE(held, 3) << "of 5 intervals that should each hold the truth 19 times of 20";
  EXPECT_LT(better.ttuv_ratio.interval.high - better.ttuv_ratio.interval.low, .02);
  // relMSE 3 / spp at 1 ms a sample: 1e-2 after .3 s, just beyond the ladder; 1e-3 after 3 s.
  EXPECT_NEAR(s.variants[0].to_rel_mse[0].seconds, .3, .03);
  EXPECT_TRUE(s.variants[0].to_rel_mse[0].extrapolated);
  EXPECT_NEAR(s.variants[1].to_rel_mse[0].seconds, .05, .005);
  EXPECT_FALSE(s.variants[1].to_rel_mse[0].extrapolated);
  EXPECT_NEAR(s.variants[1].to_rel_mse[1].seconds, .5, .05);
  EXPECT_TRUE(s.warnings.empty()) << s.warnings.front();
}

// A method whose error is that of rare samples: trimming hides it, so nothing may be said of it.
TEST(Summary, HeavyTailsAreUnreliable) {
  const std::vector<Method> methods = {{"calm", 1, -.5, 0, 1e-3, .02, .9},
                                       {"fireflies", 1, -.5, 0, 1e-3, .5, .3}};
  const std::vector<RunRecord> runs = runs_of(methods, kLadder);
  const Reference exact = grey_reference(0);
  const ConvergeSummary s = summary_of(methods, exact, runs);
  EXPECT_FALSE(s.variants[0].top().unreliable);
  EXPECT_TRUE(s.variants[1].top().unreliable);
  const auto says = [&](const char* text) {
    for (const std::string& w : s.warnings)
      if (w.starts_with("fireflies: unreliable") && w.find(text) != std::string::npos) return true;
    return false;
  };
  EXPECT_TRUE(says("0.1 % of pixels"));
  EXPECT_NE(converge_tables(s).find("unreliable"), std::string::npos);
  EXPECT_EQ(summary_json(s)["variants"][1]["rungs"][4]["unreliable"], true);
}

TEST(Summary, ReferenceVarianceIsTakenOffWhereItMatters) {
  // The reference adds .0004 to every MSE: a tenth at 256 spp, below a hundredth at 16 and less.
  const double variance = 4e-4;
  const std::vector<Method> methods = {{"plain", 1, -.5, variance}};
  const std::vector<RunRecord> runs = runs_of(methods, kLadder);
  const Reference noisy = grey_reference(variance);
  const ConvergeSummary s = summary_of(methods, noisy, runs);
  const VariantSummary& v = s.variants[0];
  EXPECT_NEAR(v.top().mse.value * 256, 1, .05);
  EXPECT_NEAR(v.top().mse_measured, 1. / 256 + variance, 2e-4);
  EXPECT_NEAR(v.top().reference_share, variance / (1. / 256 + variance), .01);
  EXPECT_DOUBLE_EQ(v.rungs[1].mse.value, v.rungs[1].mse_measured);
  EXPECT_NEAR(v.slope.value, -.5, .01);
  EXPECT_TRUE(s.warnings.empty()) << s.warnings.front();

  // The same runs with a reference that does not say so look as if they did not converge.
  const Reference silent = grey_reference(-1);
  const ConvergeSummary t = summary_of(methods, silent, runs);
  EXPECT_FALSE(t.reference_variance_known);
  EXPECT_GT(t.variants[0].slope.value, v.slope.value + .005);
  ASSERT_FALSE(t.warnings.empty());
  EXPECT_NE(t.warnings[0].find("counts as exact"), std::string::npos);
}

TEST(Summary, WarnsOfBiasAndLargeReferenceVariance) {
  const std::vector<Method> methods = {{"biased", 1, -.5, .01}};
  std::vector<RunRecord> runs = runs_of(methods, kLadder);
  for (RunRecord& r : runs) r.error.bias += .05;
  const Reference noisy = grey_reference(.005);
  const ConvergeSummary s = summary_of(methods, noisy, runs);
  std::string all;
  for (const std::string& w : s.warnings) all += w + "\n";
  EXPECT_NE(all.find("reference's own variance"), std::string::npos) << all;
  EXPECT_NE(all.find("flatter than"), std::string::npos) << all;
  EXPECT_NEAR(s.variants[0].bias, .05, .002);
  EXPECT_GT(s.variants[0].bias_z(), 3);
}

// Variants that stop at different rungs are compared where both have been.
TEST(Summary, ComparesAtTheHighestRungOfAll) {
  const std::vector<Method> methods = {{"long"}, {"short"}};
  std::vector<RunRecord> runs = runs_of(methods, kLadder);
  std::erase_if(runs, [](const RunRecord& r) { return r.variant == "short" && r.spp > 16; });
  const Reference exact = grey_reference(0);
  const ConvergeSummary s = summary_of(methods, exact, runs);
  EXPECT_EQ(s.variants[0].rungs[s.variants[0].headline].spp, 16u);
  EXPECT_EQ(s.variants[1].rungs[s.variants[1].headline].spp, 16u);
  EXPECT_EQ(s.variants[0].top().spp, 256u);
}

// A variant with a noise target has one point, of some mean number of samples, and is compared with
// the rung next to it.
TEST(Summary, NoiseTargetsAreComparedWithTheNearestRung) {
  const std::vector<Method> methods = {{"plain", 1}};
  std::vector<RunRecord> runs = runs_of(methods, kLadder);
  // 50 samples of three times the efficiency; every third run takes less.
  for (const RunRecord& r : runs_of({{"target", 1. / 3}}, {48, 54})) {
    RunRecord of_target = r;
    of_target.run = 2 * r.run + (r.spp == 54);
    of_target.spp = kTargetRung;
    of_target.hdr_flip = r.spp == 54 ? .1 : .2;
    runs.push_back(of_target);
  }
  const Reference exact = grey_reference(0);
  Experiment e;
  e.variants = {"plain", "target"};
  e.ladder = kLadder;
  e.ladder.insert(e.ladder.begin(), kTargetRung);
  e.runs = runs;
  e.reference = &exact;
  const ConvergeSummary s = summarize(e);
  ASSERT_EQ(s.variants.size(), 2u);
  // The ladder's own headline is not that of the target.
  EXPECT_EQ(s.variants[0].rungs[s.variants[0].headline].spp, 256u);
  const VariantSummary& target = s.variants[1];
  ASSERT_EQ(target.rungs.size(), 1u);
  EXPECT_EQ(target.headline, 0u);
  EXPECT_NEAR(target.top().samples, 51, 1e-9);
  EXPECT_EQ(target.top().runs, 32u);
  EXPECT_NEAR(*target.top().hdr_flip, .15, 1e-9);
  EXPECT_NEAR(target.top().ttuv_ratio.value, 1. / 3, .03);
  EXPECT_TRUE(std::isnan(target.slope.value));
  EXPECT_NE(converge_tables(s).find("~51"), std::string::npos) << converge_tables(s);
  EXPECT_TRUE(s.warnings.empty()) << s.warnings.front();
  // The other way round too.
  e.variants = {"target", "plain"};
  const ConvergeSummary t = summarize(e);
  EXPECT_NEAR(t.variants[1].rungs[3].ttuv_ratio.value, 3, .3);
}

TEST(Summary, OfNothingAndOfOneRun) {
  const Reference exact = grey_reference(0);
  const std::vector<Method> methods = {{"one"}};
  EXPECT_EQ(converge_tables(summary_of(methods, exact, {})), "no run is finished\n");
  const std::vector<RunRecord> one = runs_of(methods, {4}, 1);
  const ConvergeSummary s = summary_of(methods, exact, one);
  EXPECT_FALSE(s.variants[0].top().mse.interval.known());
  EXPECT_TRUE(std::isnan(s.variants[0].slope.value));
  EXPECT_NE(converge_tables(s).find("one"), std::string::npos);
  EXPECT_TRUE(summary_json(s)["variants"][0]["slope"]["value"].is_number_float());
}

}  // namespace
}  // namespace yat

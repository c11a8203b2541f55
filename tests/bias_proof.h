#pragma once
// Proofs that two ways of rendering give the same picture on average (docs/accuracy.md).
//
// Power. A comparison tests nine means or shapes (picture_tests.h) at kProofLevel together, each at
// 1.1e-4. With 31 degrees of freedom, the fewest of 32 runs, that is |t| >= 4.42. Its standard
// error being at most kLargestError of the picture's mean, which every proof asserts, a bias of 1 %
// of the mean is 6.7 standard errors, and is found with probability 1 - P(t < 4.42 - 6.7) = .985;
// of 2 % with certainty; in one tile of 16 of a 64 x 64 picture 6 % or so.
//
// Seeds are fixed. With YAT_FRESH_SEEDS=TEXT they come from TEXT, and with YAT_P_VALUES=FILE each
// comparison appends its name and p-value: tools/nightly.sh compares how often they are small
// with the level.

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>

#include "picture_tests.h"
#include "render_scenes.h"

namespace yat {

inline constexpr double kProofLevel = 1e-3, kLargestError = .0015;

/// First seed of a side of a comparison: different sides have different random numbers.
inline uint32_t proof_seed(uint32_t side) {
  // FNV-1a (Fowler, Noll, Vo 1991).
  uint32_t hash = 2166136261u;
  if (const char* fresh = std::getenv("YAT_FRESH_SEEDS"))
    for (; *fresh; ++fresh) hash = (hash ^ uint8_t(*fresh)) * 16777619u;
  return hash + side * 4096;
}

/// How a side renders.
struct Side {
  PlanOptions options;      ///< the seed is set per run
  uint32_t samples = 16;    ///< of a pixel, in each run
  uint32_t sample_set = 0;  ///< of stratified samplers; 0: all samples of the run
  std::function<void(Plan&)> change = nullptr;  ///< what a plan has that no option asks for
};

inline constexpr uint32_t kRuns = 32;

inline Plan plan_of(const Scene& scene, const KernelTable& kernels, const Side& side,
                    uint32_t seed) {
  PlanOptions options = side.options;
  options.seed = seed;
  options.sample_set = side.sample_set ? side.sample_set : side.samples;
  Plan plan = make_plan(scene, kernels, options);
  if (side.change) side.change(plan);
  return plan;
}

/// Pictures of kRuns seeds from proof_seed(number) on.
inline Runs render_runs(const Scene& scene, const KernelTable& kernels, const Side& side,
                        uint32_t number, uint32_t runs = kRuns) {
  Runs out{scene.film.crop_width(), scene.film.crop_height(), {}};
  for (uint32_t r = 0; r < runs; ++r) {
    const Plan plan = plan_of(scene, kernels, side, proof_seed(number) + r);
    out.pictures.push_back(render_film(scene, plan, 0, side.samples).resolve());
  }
  return out;
}

/// Writes the p-value down, where that is asked for.
inline void note_p_value(const std::string& name, double p) {
  const char* file = std::getenv("YAT_P_VALUES");
  if (!file) return;
  const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
  if (std::FILE* out = std::fopen(file, "a")) {
    std::fprintf(out, "%s.%s %s %.9g\n", test->test_suite_name(), test->name(), name.c_str(), p);
    std::fclose(out);
  } else {
    ADD_FAILURE() << "YAT_P_VALUES: cannot write " << file;
  }
}

/// Fails where the pictures differ by more than their noise, or are too noisy to say anything.
/// largest_error: of comparisons that find 1 % less surely.
inline void expect_same(const std::string& name, const Runs& a, const Runs& b,
                        double largest_error = kLargestError, double rounding = kPictureRounding) {
  const PictureTest test = compare_runs(a, b, rounding);
  // Pixels have no p-value of their own: by chance they hardly ever fail.
  note_p_value(name, test.pixels_passing < kPixelsPassing ? 0 : test.p_value());
  testing::Test::RecordProperty(name + "_p", std::to_string(test.p_value()));
  testing::Test::RecordProperty(name + "_error", std::to_string(test.relative_error));
  EXPECT_TRUE(test.passes(kProofLevel)) << name << ": " << test.text();
  EXPECT_LT(test.relative_error, largest_error) << name << " is too noisy: " << test.text();
}

/// The same for sides with the same random numbers, whose differences vary less than they do: a
/// paired test. `rounding`: relative difference of single and double precision, not looked for.
inline void expect_same_pairs(const std::string& name, Runs a, const Runs& b, double rounding) {
  std::vector<float> mean(b.pictures.front().size());
  for (size_t i = 0; i < mean.size(); ++i) {
    double sum = 0;
    for (const std::vector<float>& picture : b.pictures) sum += double(picture[i]);
    mean[i] = float(sum / double(b.pictures.size()));
  }
  for (size_t r = 0; r < a.pictures.size(); ++r)
    for (size_t i = 0; i < mean.size(); ++i) a.pictures[r][i] += mean[i] - b.pictures[r][i];
  expect_same(name, a, {a.width, a.height, {mean, mean}}, kLargestError, rounding);
}

/// Fails unless nearly all pixels of one run are the same to rounding, with the same random
/// numbers: stronger than any test of means.
inline void expect_same_paths(const std::string& name, const std::vector<float>& a,
                              const std::vector<float>& b, double share, double tolerance = 1e-4) {
  ASSERT_EQ(a.size(), b.size());
  size_t same = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    const auto x = double(a[i]), y = double(b[i]);
    same += std::fabs(x - y) <= tolerance * std::max(std::fabs(x), std::fabs(y));
  }
  EXPECT_GE(double(same) / double(a.size()), share) << name;
}

}  // namespace yat

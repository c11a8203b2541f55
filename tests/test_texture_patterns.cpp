// Patterns and noise of every instruction set: against the oracle's doubles where a random place
// falls, and against what their definitions say of the whole (lxs 8.4, 8.5).

#include "chi2.h"
#include "kernels/textures/all.h"
#include "per_isa.h"
#include "texture_steps.h"

namespace yat {
namespace {

constexpr uint32_t kRows = 20000;

class TexturePatterns : public PerIsa {
 protected:
  /// Share of rows where the kernel shows `value`.
  static double share_of(const TextureRows::Outputs& out, float value) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < kRows; ++i) count += out.found[0][i] == value;
    return double(count) / kRows;
  }
  /// Three columns of an input that is one number everywhere.
  static void constant(TextureRows& rows, float value) {
    for (int c = 0; c < 3; ++c) rows.input(value, value);
  }
};
YAT_INSTANTIATE_PER_ISA(TexturePatterns);

/// Three standard deviations of a share that is measured with kRows places.
double noise_of(double share) {
  return 3 * std::sqrt(share * (1 - share) / kRows);
}

TEST_P(TexturePatterns, BricksTakeWhatMortarLeaves) {
  constexpr float kWidth = .3f, kDepth = .15f, kHeight = .1f, kMortar = .02f;
  TextureRows rows(kRows);
  for (int c = 0; c < 3; ++c) rows.input(-20, 20);
  constant(rows, 3), constant(rows, 7), constant(rows, .5f);
  for (const float run : {0.f, .75f}) {
    rows.constants<BrickParameters>([&](uint32_t) {
      return BrickParameters<Value>{kWidth, kDepth, kHeight, kMortar, run, run ? -.5f : 0};
    });
    const auto out = rows.run(kernels(), StepKind::kBrick, 0, 3, 3);
    EXPECT_LT(TextureRows::share_off(out, 0), 2e-3) << run;
    const double brick =
        double((1 - kMortar / kWidth) * (1 - kMortar / kDepth)) * double(1 - kMortar / kHeight);
    EXPECT_NEAR(share_of(out, 1.5f), brick, noise_of(brick)) << run;
    EXPECT_NEAR(share_of(out, 7), 1 - brick, noise_of(brick)) << run;
  }
}

TEST_P(TexturePatterns, DotsAreDiscsOfTheirRadius) {
  TextureRows rows(kRows);
  for (int c = 0; c < 3; ++c) rows.input(-30, 30);
  constant(rows, 1), constant(rows, 0);
  rows.constants<DotsParameters>([](uint32_t) { return DotsParameters<Value>{0}; });
  const auto out = rows.run(kernels(), StepKind::kDots, 0, 1, 3);
  EXPECT_LT(TextureRows::share_off(out, 0), 1e-3);
  // In the middle of a cell noise is a sum of eight halves, and 0 in about a fifth of the 3600
  // cells; signs are even. A disc of .35 moved by up to .15 stays in its cell.
  const double disc = M_PI * .35 * .35;
  EXPECT_NEAR(share_of(out, 1), .4 * disc, .05 * disc);
  EXPECT_NEAR(share_of(out, 0) + share_of(out, 1), 1, 0);
}

TEST_P(TexturePatterns, UvMaskIsTheUnitSquare) {
  TextureRows rows(kRows);
  for (int c = 0; c < 3; ++c) rows.input(-.5f, 1.5f);
  constant(rows, 4), constant(rows, 9);
  rows.constants<UvMaskParameters>([](uint32_t) { return UvMaskParameters<Value>{0}; });
  const auto out = rows.run(kernels(), StepKind::kUvMask, 0, 1, 3);
  EXPECT_EQ(TextureRows::share_off(out, 0), 0);
  EXPECT_NEAR(share_of(out, 4), .25, noise_of(.25));
}

TEST_P(TexturePatterns, NoiseIsZeroOnItsLattice) {
  TextureRows rows(kRows);
  for (int c = 0; c < 3; ++c) rows.input(-40, 40);
  rows.constants<NoiseParameters>(
      [](uint32_t r) { return NoiseParameters<Value>{float(1 + r), .3f + .1f * float(r)}; });
  for (const uint32_t form : {0, 1, 2})
    EXPECT_LT(TextureRows::share_off(rows.run(kernels(), StepKind::kNoise, form, 1, 3), 1e-4), 1e-3)
        << form;
  // One octave is gradient noise, which is 0 at every corner of its lattice.
  TextureRows corners(kRows);
  for (int c = 0; c < 3; ++c)
    for (float& x : corners.input(-40, 40)) x = std::floor(x);
  corners.constants<NoiseParameters>([](uint32_t) { return NoiseParameters<Value>{1, .5f}; });
  for (const uint32_t form : {0, 1})
    EXPECT_EQ(share_of(corners.run(kernels(), StepKind::kNoise, form, 1, 3), 0), 1) << form;
}

TEST_P(TexturePatterns, WindIsTheProductOfTwoNoises) {
  TextureRows rows(kRows), slow(kRows), fast(kRows);
  for (int c = 0; c < 3; ++c) {
    const std::vector<float> at = rows.input(-40, 40);
    fast.input(0, 0) = at;
    std::vector<float>& tenth = slow.input(0, 0);
    for (size_t i = 0; i < at.size(); ++i) tenth[i] = .1f * at[i];
  }
  const auto octaves = [](float count) {
    return [count](uint32_t) { return NoiseParameters<Value>{count, .5f}; };
  };
  rows.constants<NoiseParameters>(octaves(1));  // has no say
  slow.constants<NoiseParameters>(octaves(3));
  fast.constants<NoiseParameters>(octaves(6));
  const auto wind = rows.run(kernels(), StepKind::kNoise, 2, 1, 3),
             gusts = slow.run(kernels(), StepKind::kNoise, 0, 1, 3),
             waves = fast.run(kernels(), StepKind::kNoise, 0, 1, 3);
  uint32_t strong = 0;
  for (uint32_t i = 0; i < kRows; ++i) {
    const float product = std::fabs(gusts.found[0][i]) * waves.found[0][i];
    ASSERT_NEAR(wind.found[0][i], product, 1e-6f + 1e-5f * std::fabs(product)) << i;
    strong += std::fabs(product) > .01f;
  }
  EXPECT_GT(strong, kRows / 2);
}

TEST_P(TexturePatterns, HarlequinHasOneColourPerPrimitive) {
  TextureRows rows(kRows);
  rows.constants<HarlequinParameters>([](uint32_t) { return HarlequinParameters<Value>{0}; });
  // Primitives one after the other, each of them in two rows that are far apart.
  constexpr uint32_t kHalf = kRows / 2;
  for (uint32_t i = 0; i < kRows; ++i) rows.surfaces().columns().prim[i] = i % kHalf;
  const auto out = rows.run(kernels(), StepKind::kHarlequin, 0, 3, 3);
  EXPECT_LT(TextureRows::share_off(out, 1e-6), 1e-9);
  SquareHistogram pairs[3]{SquareHistogram(16), SquareHistogram(16), SquareHistogram(16)},
      neighbours(16);
  // 256 levels; a hair below the next cell.
  const auto at = [&](uint32_t i, uint32_t c) { return double(out.found[c][i]) * (255. / 256); };
  for (uint32_t i = 0; i < kHalf; ++i) {
    for (uint32_t c = 0; c < 3; ++c) {
      ASSERT_EQ(out.found[c][i], out.found[c][i + kHalf]) << i;
      pairs[c].add(at(i, c), at(i, (c + 1) % 3));
    }
    if (i) neighbours.add(at(i - 1, 0), at(i, 0));
  }
  for (const SquareHistogram& pair : pairs) EXPECT_GT(pair.p_value(), sidak_level(12));
  EXPECT_GT(neighbours.p_value(), sidak_level(12));
}

TEST_P(TexturePatterns, MarbleStaysWithinItsColours) {
  TextureRows rows(kRows);
  for (int c = 0; c < 3; ++c) rows.input(-10, 10);
  rows.constants<MarbleParameters>(
      [](uint32_t r) { return MarbleParameters<Value>{8, .5f, 1 + float(r), .2f}; });
  const auto out = rows.run(kernels(), StepKind::kMarble, 0, 3, 3);
  EXPECT_LT(TextureRows::share_off(out, 1e-4), 2e-3);
  // A Bezier curve lies in the hull of its points; times 1.5.
  for (uint32_t i = 0; i < kRows; ++i) {
    ASSERT_GE(out.found[0][i], 1.5f * .2f * .9999f);
    ASSERT_LE(out.found[0][i], 1.5f * .6f * 1.0001f);
    ASSERT_LE(out.found[1][i], out.found[2][i] + .06f);
  }
}

}  // namespace
}  // namespace yat

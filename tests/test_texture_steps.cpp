// Texture kernels of every instruction set against the oracle's doubles, and closed forms of image
// lookups.

#include "texture_steps.h"

#include "per_isa.h"
#include "scene/image_store.h"

namespace yat {
namespace {

constexpr uint32_t kRows = 1003;

class TextureSteps : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(TextureSteps);

TEST_P(TextureSteps, Mappings) {
  TextureRows rows(kRows);
  rows.constants<MapSurfaceParameters>([](uint32_t r) {
    return MapSurfaceParameters<Value>{1.f + float(r), .25f * float(r), -1.f, 1.f};
  });
  EXPECT_EQ(TextureRows::share_off(rows.run(kernels(), StepKind::kMapSurface, 0, 4, 1), 1e-5), 0);
  rows.constants<MapPlanarParameters>([](uint32_t r) {
    return MapPlanarParameters<Value>{.5f, .2f * float(r), 0, 3, -.1f, .4f, 1, float(r)};
  });
  EXPECT_EQ(TextureRows::share_off(rows.run(kernels(), StepKind::kMapPlanar, 0, 4, 1), 1e-6), 0);
  rows.constants<MapSolidParameters>([](uint32_t r) {
    return MapSolidParameters<Value>{1, .2f, .3f, 4, -.5f, float(r), .7f, 0, 0, 1, -1, .5f};
  });
  for (const uint32_t form : {0, 1, 2})
    EXPECT_EQ(TextureRows::share_off(rows.run(kernels(), StepKind::kMapSolid, form, 3, 1), 2e-6), 0)
        << form;
  rows.constants<MapRoundParameters>([](uint32_t r) {
    return MapRoundParameters<Value>{.9f, .1f,  0, .3f, -.1f, 1.1f, .2f,      -.2f,
                                     0,   -.2f, 1, .1f, 1,    0,    float(r), .5f};
  });
  for (const uint32_t form : {0, 1})
    EXPECT_LT(TextureRows::share_off(rows.run(kernels(), StepKind::kMapRound, form, 4, 1), 4e-5),
              2e-3)
        << form;  // the seam, the axis
}

TEST_P(TextureSteps, Arithmetic) {
  TextureRows rows(kRows);
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c) rows.input(-1, 2);
  rows.constants<ArithmeticParameters>(
      [](uint32_t r) { return ArithmeticParameters<Value>{float(r) - 1.5f}; });
  for (uint32_t form = 0; form < kArithmeticTraits.forms; ++form)
    for (const uint32_t outputs : {1, 3})
      EXPECT_EQ(TextureRows::share_off(rows.run(kernels(), StepKind::kArithmetic, form, outputs, 3),
                                       1e-6),
                0)
          << form;
  rows.constants<RampParameters>([](uint32_t r) {
    return RampParameters<Value>{.25f * float(r), .25f * float(r) + (r ? .5f : 0.f)};
  });
  EXPECT_EQ(TextureRows::share_off(rows.run(kernels(), StepKind::kRamp, 0, 1, 3), 1e-6), 0);
  rows.constants<ClampParameters>(
      [](uint32_t r) { return ClampParameters<Value>{-.5f, .25f * float(r), 2.f}; });
  EXPECT_EQ(TextureRows::share_off(rows.run(kernels(), StepKind::kClamp, 0, 3, 3), 1e-6), 0);
  rows.constants<WeighParameters>(
      [](uint32_t r) { return WeighParameters<Value>{.2f, .7f, .1f * float(r)}; });
  EXPECT_EQ(TextureRows::share_off(rows.run(kernels(), StepKind::kWeigh, 0, 1, 3), 1e-6), 0);
  rows.constants<ConstantParameters>(
      [](uint32_t r) { return ConstantParameters<Value>{.2f, .7f, .1f * float(r)}; });
  for (const uint32_t outputs : {1, 3})
    EXPECT_EQ(TextureRows::share_off(rows.run(kernels(), StepKind::kConstant, 0, outputs, 3), 0),
              0);
}

TEST_P(TextureSteps, BandsOfColours) {
  TextureRows rows(kRows);
  for (int c = 0; c < 3; ++c) rows.input(0, 1);
  rows.constants<BandsParameters>(
      [](uint32_t r) { return BandsParameters<Value>{1.8f + .2f * float(r)}; });
  EXPECT_EQ(TextureRows::share_off(rows.run(kernels(), StepKind::kBands, 0, 3, 3), 1e-6), 0);
  EXPECT_EQ(TextureRows::share_off(rows.run(kernels(), StepKind::kBands, kBandsRaised, 3, 3), 1e-5),
            0);
}

TEST_P(TextureSteps, ClampKeepsWhatIsNotANumber) {
  TextureRows rows(40);
  std::vector<float>& in = rows.input(0, 1);
  in[3] = NAN, in[7] = INFINITY, in[9] = -INFINITY;
  rows.constants<ClampParameters>([](uint32_t) { return ClampParameters<Value>{0, 1, 1}; });
  const auto out = rows.run(kernels(), StepKind::kClamp, 0, 1, 1).found[0];
  EXPECT_TRUE(std::isnan(out[3]));
  EXPECT_EQ(out[7], 1);
  EXPECT_EQ(out[9], 0);
}

// ---- Images ------------------------------------------------------------------------------------

/// Random texels of every format, in levels of a width and height that are no powers of two.
class ImageSteps : public TextureSteps {
 protected:
  static constexpr uint32_t kWidth = 13, kHeight = 6, kLevels = 4;

  ImageSteps() : levels_(2 * kTexelLevels) {
    std::mt19937 random(7);
    words_.resize(40000);
    for (uint32_t& word : words_) {
      word = uint32_t(random());
      if (as_floats_) word = std::bit_cast<uint32_t>(float(word % 1000) / 500);
    }
    for (uint32_t l = 0; l < kLevels; ++l) levels_[kTexelLevels + l] = 64 + 4000 * l;
  }
  void use_floats() {
    for (uint32_t& word : words_) word = std::bit_cast<uint32_t>(float(word % 1000) / 500);
  }
  TexelView view() const { return {words_.data(), levels_.data()}; }
  ImageParameters<Value> parameters(float gain, float gamma) const {
    return {
        levels_[kTexelLevels], kWidth, kHeight, 1, kLevels - 1, gain, gamma, .2f, .3f, .4f, .1f};
  }

  bool as_floats_ = false;
  std::vector<uint32_t> words_, levels_;
};
YAT_INSTANTIATE_PER_ISA(ImageSteps);

TEST_P(ImageSteps, EveryFormAgreesWithTheOracle) {
  for (const bool floats : {false, true}) {
    if (floats) use_floats();
    for (uint32_t form = 0; form < kImageTraits.forms; ++form) {
      const auto format = TexelFormat(form & 3);
      const uint32_t filter = form >> 2 & 3;
      const bool is_float = format == TexelFormat::kFloat1 || format == TexelFormat::kFloat4;
      if (filter == 3 || is_float != floats) continue;
      for (uint32_t wrap = 0; wrap < 4; ++wrap) {
        TextureRows rows(401, form + 1);
        for (int c = 0; c < 2; ++c) rows.input(-1.7f, 2.6f);
        for (int c = 0; c < 2; ++c) rows.input(0, 1.5f);
        const float one = is_float ? 1.f : 1.f / 255;
        rows.constants<ImageParameters>(
            [&](uint32_t r) { return parameters(one * (1 + .1f * float(r)), 1 + .4f * float(r)); });
        const bool single = format == TexelFormat::kByte1 || format == TexelFormat::kFloat1;
        const uint32_t outputs = single || form & kImageNumber ? 1 : 3;
        const auto out =
            rows.run(kernels(), StepKind::kImage,
                     image_variant(format, filter, ImageWrap(wrap)) | (form & kImageNumber),
                     outputs, 2, view());
        EXPECT_LE(TextureRows::share_off(out, 2e-5), filter ? 0 : 2e-3)
            << "form " << form << " wrap " << wrap;
      }
    }
  }
}

TEST_P(ImageSteps, TexelCentresAndWraps) {
  // One row of the picture: the texel itself at its centre, whatever the filter.
  for (const uint32_t filter : {0u, 1u}) {
    for (const ImageWrap wrap :
         {ImageWrap::kRepeat, ImageWrap::kBlack, ImageWrap::kWhite, ImageWrap::kClamp}) {
      TextureRows rows(5 * kWidth);
      std::vector<float>&s = rows.input(0, 0), &t = rows.input(0, 0);
      for (uint32_t i = 0; i < 5 * kWidth; ++i) {
        s[i] = (float(int(i) - 2 * int(kWidth)) + .5f) / kWidth;  // two pictures to either side
        t[i] = 2.5f / kHeight;
      }
      rows.constants<ImageParameters>([&](uint32_t) { return parameters(1.f / 255, 1); });
      const auto out =
          rows.run(kernels(), StepKind::kImage,
                   image_variant(TexelFormat::kByte4, filter, wrap) | kImageLinear, 3, 2, view());
      for (uint32_t i = 0; i < 5 * kWidth; ++i) {
        const int x = int(i) - 2 * int(kWidth);
        const bool inside = x >= 0 && x < int(kWidth);
        const uint32_t column =
            wrap == ImageWrap::kClamp ? uint32_t(std::clamp(x, 0, int(kWidth) - 1)) : i % kWidth;
        const uint32_t word = words_[64 + (column / 4) * 16 + 2 * 4 + column % 4];
        for (uint32_t k = 0; k < 3; ++k) {
          float expected = float(word >> (8 * k) & 255) / 255;
          if (!inside && wrap == ImageWrap::kBlack) expected = 0;
          if (!inside && wrap == ImageWrap::kWhite) expected = 1;
          EXPECT_NEAR(out.found[k][i], expected, 3e-5) << filter << " " << int(wrap) << " " << x;
        }
      }
    }
  }
}

TEST_P(ImageSteps, LevelFollowsTheFootprint) {
  // Level l holds the grey 10 (l + 1) throughout: the result tells the level.
  for (uint32_t l = 0; l < kLevels; ++l)
    for (uint32_t i = 0; i < 512; ++i)
      words_[levels_[kTexelLevels + l] + i] = 0x01010101u * (10 * (l + 1));
  TextureRows rows(64);
  std::vector<float>&s = rows.input(0, 1), &t = rows.input(0, 1);
  std::vector<float>&fs = rows.input(0, 0), &ft = rows.input(0, 0);
  (void)s, (void)t;
  for (uint32_t i = 0; i < 64; ++i) {
    // i / 8 is the level along s; along t the footprint is smaller.
    fs[i] = std::exp2(float(i) / 8 - 2) / kWidth;
    ft[i] = .25f * fs[i] * kWidth / kHeight;
  }
  rows.constants<ImageParameters>([&](uint32_t) { return parameters(1, 1); });
  const auto out = rows.run(
      kernels(), StepKind::kImage,
      image_variant(TexelFormat::kByte4, 2, ImageWrap::kRepeat) | kImageLinear, 3, 2, view());
  for (uint32_t i = 0; i < 64; ++i) {
    const float level = std::clamp(float(i) / 8 - 2, 0.f, float(kLevels - 1));
    EXPECT_NEAR(out.found[0][i], 10 * (level + 1), 1e-4) << i;
  }
}

TEST_P(ImageSteps, CoordinatesThatAreNoNumbersReadATexel) {
  for (uint32_t filter = 0; filter < 3; ++filter)
    for (uint32_t wrap = 0; wrap < 4; ++wrap) {
      TextureRows rows(32);
      std::vector<float>&s = rows.input(0, 1), &t = rows.input(0, 1), &f = rows.input(0, 1);
      const float odd[] = {NAN, INFINITY, -INFINITY, 3e38f, -3e38f, 1e10f, -1e10f, 0};
      for (uint32_t i = 0; i < 32; ++i) s[i] = odd[i % 8], t[i] = odd[i / 4], f[i] = odd[i % 8];
      rows.input(0, 1);
      rows.constants<ImageParameters>([&](uint32_t) { return parameters(1, 2.2f); });
      // Nothing to compare: it must not read elsewhere (the sanitizers look).
      const auto out = rows.run(
          kernels(), StepKind::kImage,
          image_variant(TexelFormat::kByte4, filter, ImageWrap(wrap)) | kImageNumber, 1, 2, view());
      EXPECT_EQ(out.found[0].size(), 32u + kRowPad);
    }
}

TEST_P(ImageSteps, OneToAnyPowerIsOne) {
  std::fill(words_.begin(), words_.end(), 0xffffffffu);
  TextureRows rows(64);
  rows.input(0, 1), rows.input(0, 1);
  rows.constants<ImageParameters>(
      [&](uint32_t r) { return parameters(1.f / 255, 1.5f + float(r)); });
  for (const auto& column :
       rows.run(kernels(), StepKind::kImage,
                image_variant(TexelFormat::kByte4, 1, ImageWrap::kRepeat), 3, 2, view())
           .found)
    for (uint32_t i = 0; i < 64; ++i) EXPECT_EQ(column[i], 1.f);
}

}  // namespace
}  // namespace yat

// Tone mapping against formulas computed here and against pictures that LuxRender wrote.

#include "film/tonemap.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "base/error.h"
#include "film/colour.h"
#include "shared_scenes.h"

namespace yat {
namespace {

/// Film space = Rec.709, gamma 1: what remains is the tone map alone.
FilmSettings plain(ToneMap kernel) {
  FilmSettings s;
  s.tone_map = kernel;
  s.gamma = 1;
  s.red[0] = .64f, s.red[1] = .33f, s.green[0] = .30f, s.green[1] = .60f;
  s.blue[0] = .15f, s.blue[1] = .06f, s.white[0] = .3127f, s.white[1] = .3290f;
  return s;
}

/// `linear` with factor 1.
FilmSettings identity() {
  FilmSettings s = plain(ToneMap::kLinear);
  s.linear_exposure = 1, s.linear_fstop = 1, s.linear_gamma = 0;
  s.linear_sensitivity = 1 / .065f;
  return s;
}

TEST(ColourSpaces, Rec709ToFilmIsTheKnownMatrix) {
  const ColourMatrix m = inverse(film_to_xyz(FilmSettings())) * rec709_to_xyz();
  const double expected[3][3] = {
      {1.04796, -.05449, -.00981}, {-.01971, 1.04063, -.01680}, {.00164, .00445, 1.00152}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(m[i][j], expected[i][j], 1e-4) << i << j;
  const ColourMatrix y = film_to_xyz(FilmSettings());
  EXPECT_NEAR(y[1][0], .21591, 1e-5);
  EXPECT_NEAR(y[1][1], .69818, 1e-5);
  EXPECT_NEAR(y[1][2], .08591, 1e-5);
}

TEST(ColourSpaces, PrimariesOnOneLineAreRefused) {
  FilmSettings s;
  s.red[0] = s.green[0] = s.blue[0] = .3f;
  EXPECT_THROW(film_to_xyz(s), UsageError);
}

TEST(ToneMap, LinearIsAPlainFactor) {
  FilmSettings s = plain(ToneMap::kLinear);
  // 1 s, f/2.8, ISO 50.
  const double factor = 50 / (2.8 * 2.8) * .065 * 118 / 255;
  const std::vector<float> rgb = {1, .5f, .25f};
  const std::vector<float> out = tone_map(rgb, s);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(out[k], factor * double(rgb[k]), 1e-6);
  s.exposure_stops = 1;
  EXPECT_NEAR(tone_map(rgb, s)[1], factor, 1e-6);
}

TEST(ToneMap, AutoLinearShowsTheMeanAtAFixedLevel) {
  FilmSettings s = plain(ToneMap::kAutoLinear);
  s.gamma = 2.2f;
  // Black pixels do not count.
  const std::vector<float> rgb = {20, 20, 20, 60, 60, 60, 0, 0, 0, 40, 40, 40};
  const std::vector<float> out = tone_map(rgb, s);
  EXPECT_NEAR(std::pow(out[9], 2.2f), .2294f, 1e-3f);
  EXPECT_EQ(out[6], 0.f);
}

TEST(ToneMap, MaxWhiteAndContrast) {
  const std::vector<float> rgb = {2, 2, 2, .5f, .5f, .5f};
  const std::vector<float> white = tone_map(rgb, plain(ToneMap::kMaxWhite));
  EXPECT_NEAR(white[0], 1, 1e-6);
  EXPECT_NEAR(white[3], .25, 1e-6);
  // The logarithmic mean is 1, the display's too.
  const std::vector<float> contrast = tone_map(rgb, plain(ToneMap::kContrast));
  EXPECT_NEAR(contrast[0], .02, 1e-7);
}

TEST(ToneMap, ReinhardFollowsItsFormula) {
  FilmSettings s = plain(ToneMap::kReinhard);
  s.reinhard_prescale = 2, s.reinhard_postscale = 1.5f, s.reinhard_burn = 3;
  const std::vector<float> rgb = {4, 4, 4, 1, 1, 1};  // logarithmic mean 2
  const std::vector<float> out = tone_map(rgb, s);
  for (int i = 0; i < 2; ++i) {
    const double value = i ? 1 : 4, scale = .1 / 2, y = value * scale / 2;
    EXPECT_NEAR(out[3 * i], value * scale * 1.5 * (1 + y / 9) / (1 + y), 1e-6);
  }
}

TEST(ToneMap, ColoursOutsideTheGamutMoveToWhiteAtTheirLuminance) {
  FilmSettings s = identity();
  // A film space narrower than Rec.709: pure Rec.709 green lies outside.
  s.green[0] = .31f, s.green[1] = .5f;
  const std::vector<float> out = tone_map(std::vector<float>{0, .4f, 0}, s);
  const ColourMatrix film = film_to_xyz(s);
  EXPECT_EQ(std::min({out[0], out[1], out[2]}), 0.f);
  EXPECT_NEAR((film * Colour{double(out[0]), double(out[1]), double(out[2])})[1], .4 * .71517,
              1e-4);
}

TEST(ToneMap, ClampMethods) {
  FilmSettings s = identity();
  const std::vector<float> rgb = {2, .5f, .25f};
  const double y = .21264 * 2 + .71517 * .5 + .07219 * .25;
  const auto expect = [&](ClampMethod method, double r, double g, double b) {
    s.clamp = method;
    const std::vector<float> out = tone_map(rgb, s);
    EXPECT_NEAR(out[0], r, 1e-4);
    EXPECT_NEAR(out[1], g, 1e-4);
    EXPECT_NEAR(out[2], b, 1e-4);
  };
  expect(ClampMethod::kCut, 1, .5, .25);
  expect(ClampMethod::kDarken, 1, .25, .125);
  const double t = (1 - y) / (2 - y);
  expect(ClampMethod::kLum, 1, y + t * (.5 - y), y + t * (.25 - y));
  const double mean = 2.75 / 3, u = (1 - mean) / (2 - mean);
  expect(ClampMethod::kHue, 1, mean + u * (.5 - mean), mean + u * (.25 - mean));
  const std::vector<float> bright = tone_map(std::vector<float>{9, 2, 1}, s);
  EXPECT_EQ(bright, (std::vector<float>{1, 1, 1}));
}

TEST(ToneMap, BadAndBlackPixelsAreBlackAndSpoilNoOther) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  for (const ToneMap kernel : {ToneMap::kLinear, ToneMap::kReinhard, ToneMap::kAutoLinear,
                               ToneMap::kMaxWhite, ToneMap::kContrast}) {
    const FilmSettings s = plain(kernel);
    const std::vector<float> good = tone_map(std::vector<float>{.1f, .2f, .3f}, s);
    const std::vector<float> out =
        tone_map(std::vector<float>{.1f, .2f, .3f, nan, 1, 1, 1, inf, 1, 0, 0, 0, -1, -1, -1}, s);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(out[k], good[k]);
    for (int k = 3; k < 15; ++k) EXPECT_EQ(out[k], 0.f);
    EXPECT_EQ(tone_map(std::vector<float>(6, 0.f), s), std::vector<float>(6, 0.f));
  }
}

TEST(Quantise, Truncates) {
  EXPECT_EQ(quantise(1.f, 255), 255u);
  EXPECT_EQ(quantise(.9999f, 255), 254u);
  EXPECT_EQ(quantise(0.f, 255), 0u);
  EXPECT_EQ(quantise(.5f, 65535), 32767u);
}

// ---- LuxRender's own pictures ----------------------------------------------------------------

struct Picture {
  int width = 0, height = 0, channels = 0;
  std::vector<float> values;
  std::vector<uint8_t> bytes;
};

Picture read(const std::string& path, OIIO::TypeDesc type) {
  Picture p;
  const auto file = OIIO::ImageInput::open(path);
  if (!file) throw std::runtime_error(OIIO::geterror());
  p.width = file->spec().width, p.height = file->spec().height, p.channels = file->spec().nchannels;
  const size_t n = size_t(p.width) * p.height * p.channels;
  void* to;
  if (type == OIIO::TypeDesc::FLOAT) {
    p.values.resize(n);
    to = p.values.data();
  } else {
    p.bytes.resize(n);
    to = p.bytes.data();
  }
  if (!file->read_image(0, 0, 0, p.channels, type, to)) throw std::runtime_error(file->geterror());
  return p;
}

/// Channels of `name`.png that differ from the tone map of `name`.exr, which holds film RGB.
int differing_bytes(const std::string& exr, const std::string& png, const FilmSettings& s) {
  const Picture linear = read(exr, OIIO::TypeDesc::FLOAT);
  const Picture expected = read(png, OIIO::TypeDesc::UINT8);
  EXPECT_EQ(linear.width, expected.width);
  EXPECT_EQ(linear.height, expected.height);
  EXPECT_GE(linear.channels, 3);
  EXPECT_EQ(expected.channels, 3);
  const ColourMatrix to_rec709 = inverse(rec709_to_xyz()) * film_to_xyz(s);
  const size_t pixels = size_t(linear.width) * linear.height;
  std::vector<float> rgb(pixels * 3);
  for (size_t i = 0; i < pixels; ++i) {
    const float* p = &linear.values[i * linear.channels];
    const Colour c = to_rec709 * Colour{double(p[0]), double(p[1]), double(p[2])};
    for (int k = 0; k < 3; ++k) rgb[3 * i + k] = float(c[k]);
  }
  const std::vector<float> display = tone_map(rgb, s);
  int differ = 0;
  for (size_t i = 0; i < display.size(); ++i) {
    const int difference = int(quantise(display[i], 255)) - int(expected.bytes[i]);
    EXPECT_LE(std::abs(difference), 1) << "channel " << i;
    differ += difference != 0;
  }
  return differ;
}

TEST(LuxRenderPictures, ReinhardGivesItsBytes) {
  YAT_NEED_SHARED(exr, "luxrender-reference-images/cornell-path10-256spp.exr");
  YAT_NEED_SHARED(png, "luxrender-reference-images/cornell-path10-256spp.png");
  FilmSettings s;
  s.tone_map = ToneMap::kReinhard;
  // All of them lie within 2e-4 of an edge between two bytes: LuxRender's logarithmic mean is 4e-6
  // larger than the exact one of these pixels (with it, 18 of the 1 555 200 bytes are left).
  EXPECT_LE(differing_bytes(exr, png, s), 160);
}

TEST(LuxRenderPictures, AutoLinearGivesItsBytes) {
  YAT_NEED_SHARED(exr, "luxrender-reference-images/dragon-202k-path10-32spp.exr");
  YAT_NEED_SHARED(png, "luxrender-reference-images/dragon-202k-path10-32spp.png");
  FilmSettings s;
  s.tone_map = ToneMap::kAutoLinear;
  EXPECT_LE(differing_bytes(exr, png, s), 251);
}

// ---- False colours and YART's kernels ----------------------------------------------------------

TEST(FalseColors, LuminanceIsAPlaceOnTheScale) {
  FilmSettings s = plain(ToneMap::kFalseColors);
  s.gamma = 2.2f;  // changes nothing: scales are display colours
  s.false_scale = FalseColorScale::kWhite;
  s.false_min = 1;
  s.false_max = 11;
  // Greys of luminance 0, 1, 6, 11 and 100.
  const std::vector<float> rgb = {0, 0, 0, 1, 1, 1, 6, 6, 6, 11, 11, 11, 100, 100, 100};
  std::vector<float> out = tone_map(rgb, s);
  const double linear[] = {0, 0, .5, 1, 1};
  for (size_t i = 0; i < 5; ++i) EXPECT_NEAR(double(out[3 * i]), linear[i], 1e-5);
  s.false_method = FalseColorMethod::kLog;
  EXPECT_NEAR(double(tone_map(rgb, s)[6]), std::log10(5.5), 1e-5);
  s.false_method = FalseColorMethod::kLog3;
  EXPECT_NEAR(double(tone_map(rgb, s)[6]), std::log10(500.5) / 3, 1e-5);
  // Without a range: that of the lit pixels, here 1 to 100, from blue to red.
  s.false_method = FalseColorMethod::kLinear;
  s.false_scale = FalseColorScale::kStd;
  s.false_max = 0;
  out = tone_map(rgb, s);
  EXPECT_EQ((std::vector<float>{out[3], out[4], out[5]}), (std::vector<float>{0, 0, 1}));
  EXPECT_EQ((std::vector<float>{out[12], out[13], out[14]}), (std::vector<float>{1, 0, 0}));
}

TEST(YartToneMap, LinearDividesByTheLargestChannelAboveOne) {
  FilmSettings s;  // a film colour space that YART does not know
  s.tone_map = ToneMap::kYartLinear;
  const std::vector<float> out = tone_map(std::vector<float>{.5f, .25f, 1, 4, 2, 1, -1, 0, .5f}, s);
  const double expected[] = {.5, .25, 1, 1, .5, .25, 0, 0, .5};
  for (size_t i = 0; i < 9; ++i) EXPECT_NEAR(double(out[i]), std::pow(expected[i], 1 / 2.2), 1e-6);
}

TEST(YartToneMap, ReinhardIsByChannelAndOutOfGamutPaints) {
  FilmSettings s;
  s.tone_map = ToneMap::kYartReinhard;
  const std::vector<float> rgb = {3, 1, 0, .5f, .5f, .5f};
  std::vector<float> out = tone_map(rgb, s);
  EXPECT_NEAR(double(out[0]), std::pow(.75, 1 / 2.2), 1e-6);
  EXPECT_NEAR(double(out[1]), std::pow(.5, 1 / 2.2), 1e-6);
  EXPECT_EQ(out[2], 0);
  s.tone_map = ToneMap::kOutOfGamut;
  s.out_of_gamut[0] = .1f, s.out_of_gamut[1] = .2f, s.out_of_gamut[2] = .3f;
  out = tone_map(rgb, s);
  EXPECT_EQ(out[1], .2f);  // no gamma
  EXPECT_NEAR(double(out[3]), std::pow(.5, 1 / 2.2), 1e-6);
}

}  // namespace
}  // namespace yat

// The page and its parts.

#include "converge/report_html.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "converge/error_pictures.h"
#include "converge/html.h"

namespace yat {
namespace {

/// Whether the elements of HTML or XML are closed in the order in which they were opened.
bool balanced(const std::string& text) {
  constexpr std::string_view kEmpty[] = {"meta", "br", "img"};
  std::vector<std::string> open;
  for (size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1)) {
    const size_t end = text.find('>', at);
    if (end == std::string::npos) return false;
    std::string tag = text.substr(at + 1, end - at - 1);
    if (tag.starts_with("!") || tag.ends_with("/")) continue;
    const std::string name = tag.substr(0, tag.find(' '));
    if (name.starts_with("/")) {
      if (open.empty() || "/" + open.back() != name) return false;
      open.pop_back();
    } else if (std::find(std::begin(kEmpty), std::end(kEmpty), name) == std::end(kEmpty)) {
      open.push_back(name);
    }
  }
  return open.empty();
}

std::string as_text(std::string_view bytes) {
  return base64({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
}

// The examples of RFC 4648, section 10.
TEST(Html, Base64AndEntities) {
  EXPECT_EQ(as_text(""), "");
  EXPECT_EQ(as_text("f"), "Zg==");
  EXPECT_EQ(as_text("fo"), "Zm8=");
  EXPECT_EQ(as_text("foo"), "Zm9v");
  EXPECT_EQ(as_text("foobar"), "Zm9vYmFy");
  EXPECT_EQ(as_text("\xff\xfe"), "//4=");
  EXPECT_EQ(escaped_html("<a & \"b\">\n"), "&lt;a &amp; &quot;b&quot;&gt; ");
}

/// The pixels of a data: URI, RGB of 8 bits.
std::vector<uint8_t> pixels_of(const std::string& uri, int width, int height) {
  constexpr std::string_view kHead = "data:image/png;base64,";
  EXPECT_TRUE(uri.starts_with(kHead));
  constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> bytes;
  uint32_t word = 0;
  int bits = 0;
  for (const char letter : uri.substr(kHead.size())) {
    if (letter == '=') break;
    word = word << 6 | uint32_t(kLetters.find(letter));
    bits += 6;
    if (bits >= 8) bytes.push_back(uint8_t(word >> (bits -= 8)));
  }
  OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
  const auto file = OIIO::ImageInput::open("picture.png", nullptr, &memory);
  std::vector<uint8_t> rgb(size_t(width) * size_t(height) * 3);
  if (!file || file->spec().width != width || file->spec().height != height) {
    ADD_FAILURE() << "not a PNG of that size";
    return rgb;
  }
  file->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, rgb.data());
  return rgb;
}

/// Light from 0 to 1 over the width.
Image ramp(uint32_t width, uint32_t height) {
  Image image{width, height, {}, true};
  for (uint32_t p = 0; p < image.pixels(); ++p)
    image.rgb.insert(image.rgb.end(), 3, float(p % width) / float(width - 1));
  return image;
}

TEST(ErrorPictures, ShowLightByOneRule) {
  const Image image = ramp(101, 3);
  Showing showing;
  showing.white = .5;
  const auto rgb = pixels_of(picture_uri(image, {0, 1, 101, 1, 1}, showing), 101, 1);
  EXPECT_EQ(rgb[0], 0);
  EXPECT_EQ(rgb[3 * 25], 188);  // sRGB of one half.
  EXPECT_EQ(rgb[3 * 50], 255);
  EXPECT_EQ(rgb[3 * 100], 255);
  // Two pixels as one show their mean.
  const auto half = pixels_of(picture_uri(image, {24, 0, 4, 2, 2}, showing), 2, 1);
  EXPECT_EQ(half[0], 186);  // Of .49.
  const Image wide{1000, 2, std::vector<float>(6000), true};
  EXPECT_EQ(whole_of(wide).shrink, 2u) << "no more than the height allows";
}

TEST(ErrorPictures, CropsAreWhereErrorsAre) {
  const Image reference{200, 150, std::vector<float>(200 * 150 * 3, 1.f), true};
  Image picture = reference;
  std::mt19937 rng(1);
  std::normal_distribution<float> normal(0, .05f);
  for (size_t p = 0; p < picture.pixels(); ++p) {
    const bool corner = p % 200 >= 160 && p / 200 >= 110;
    for (size_t c = 0; c < 3; ++c) picture.rgb[3 * p + c] += (corner ? 8.f : 1.f) * normal(rng);
  }
  const std::vector<float> errors = relative_errors(picture, reference);
  EXPECT_EQ(errors.size(), picture.pixels());
  const Showing showing = choose_showing(reference, {picture});
  EXPECT_EQ(showing.white, 1);
  EXPECT_GT(showing.largest, .1);
  ASSERT_EQ(showing.crops.size(), 2u);
  EXPECT_GT(showing.crops[0].x, 110u);
  EXPECT_GT(showing.crops[0].y, 60u);
  for (const Region& crop : showing.crops) {
    EXPECT_LE(crop.x + crop.width, 200u);
    EXPECT_LE(crop.y + crop.height, 150u);
  }
  const auto map =
      pixels_of(error_uri(std::vector<float>(12, 0.f), 4, {0, 0, 4, 3, 1}, showing), 4, 3);
  EXPECT_EQ(map[0], 0);
  // Pictures smaller than a crop, without light, and without error.
  const Image black{5, 4, std::vector<float>(60), true};
  const Showing dark = choose_showing(black, {black});
  EXPECT_EQ(dark.white, 1);
  EXPECT_EQ(dark.largest, 1);
  ASSERT_EQ(dark.crops.size(), 1u);
  EXPECT_EQ(dark.crops[0].width, 5u);
}

TEST(Plot, IsWellFormedAndLeavesOutWhatHasNoLogarithm) {
  Plot plot{"a < b", "x", "y", {}, {}, -.5};
  plot.series.push_back({"one & only", {{1, .5, .4, .6}, {4, .25, NAN, NAN}, {16, 0, 0, .1}}});
  plot.series.push_back({"two", {{1, NAN, NAN, NAN}, {4, .1, -1, .2}}});
  const std::string svg = svg_plot(plot);
  EXPECT_TRUE(balanced(svg)) << svg;
  EXPECT_NE(svg.find("one &amp; only"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos) << svg;
  EXPECT_EQ(svg.find("inf"), std::string::npos) << svg;
  EXPECT_NE(svg.find("slope -0.5"), std::string::npos);
  // Twice in the curve, once in the legend.
  size_t circles = 0;
  for (size_t at = svg.find("<circle"); at != std::string::npos; at = svg.find("<circle", at + 1))
    ++circles;
  EXPECT_EQ(circles, 3u);
  EXPECT_NE(svg_plot({"nothing", "x", "y", {}, {}, 0}).find("no run is finished"),
            std::string::npos);
  // Styles come again after the last.
  EXPECT_EQ(svg_marker(0), svg_marker(kPlotStyles));
}

TEST(ReportPage, HoldsWhatWasMeasured) {
  std::vector<RunRecord> runs;
  for (uint32_t run = 0; run < 4; ++run)
    for (const uint32_t spp : {4u, 16u})
      for (const char* name : {"first", "<second>"}) {
        RunRecord r;
        r.variant = name;
        r.spp = spp;
        r.run = run;
        r.seconds = r.cpu_seconds = .01 * spp;
        r.error.mse = r.error.rel_mse = r.error.rel_mse_trimmed = (1 + .01 * run) / spp;
        r.error.bias = .001 * run;
        r.error.epsilon = .01;
        runs.push_back(r);
      }
  Reference reference;
  reference.image = ramp(32, 24);
  Experiment experiment;
  experiment.variants = {"first", "<second>"};
  experiment.ladder = {4, 16};
  experiment.runs = runs;
  experiment.reference = &reference;
  const ConvergeSummary summary = summarize(experiment);
  ReportPage page;
  page.scene = "a&b.lxs";
  page.facts = {{"machine", "a \"fast\" one"}};
  page.variants = {{"first", ""}, {"<second>", "--sampler cmj"}};
  page.summary = &summary;
  page.reference = &reference;
  const std::string plain = report_html(page);
  EXPECT_TRUE(balanced(plain));
  EXPECT_EQ(plain.find("equal CPU time"), std::string::npos);
  for (const char* text : {"a&amp;b.lxs", "&lt;second&gt;", "--sampler cmj", "&quot;fast&quot;",
                           "counts as exact", "no difference shown", "prefers-color-scheme"})
    EXPECT_NE(plain.find(text), std::string::npos) << text;
  EXPECT_EQ(plain.find("<second>"), std::string::npos);
  for (const char* name : {"first", "<second>"})
    page.pictures.push_back({name, reference.image, 16, .16});
  const std::string full = report_html(page);
  EXPECT_TRUE(balanced(full));
  EXPECT_NE(full.find("equal CPU time"), std::string::npos);
  EXPECT_NE(full.find("data:image/png;base64,"), std::string::npos);

  const ConvergeSummary nothing;
  page.summary = &nothing;
  EXPECT_NE(report_html(page).find("No run is finished"), std::string::npos);
}

}  // namespace
}  // namespace yat

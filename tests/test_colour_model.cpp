// The bands that colours multiply in: what must hold exactly, and how near they come to products of
// LuxRender's spectra.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/vector_relational.hpp>
#include <random>
#include <vector>

#include "scene/colour_model.h"

namespace yat {
namespace {

using Colour = glm::dvec3;

double luminance_709(const Colour& c) {
  return .2126 * c.x + .7152 * c.y + .0722 * c.z;
}

std::vector<Colour> random_colours(int count) {
  std::mt19937 engine(5);
  // Floats, as a scene file gives them.
  const auto number = [&] { return double(float(engine() >> 8) * 0x1p-24f); };
  std::vector<Colour> colours;
  for (int x = 0; x <= 1; ++x)
    for (int y = 0; y <= 1; ++y)
      for (int z = 0; z <= 1; ++z) colours.emplace_back(x, y, z);
  while (int(colours.size()) < count) {
    Colour c(number(), number(), number());
    if (colours.size() % 4 == 1) c.y = c.x;  // two channels alike, and black channels
    if (colours.size() % 4 == 2) c.z = 0;
    colours.push_back(c);
  }
  return colours;
}

TEST(ColourModel, GreyStaysAsItIs) {
  for (const ColourMode mode : {ColourMode::kBands, ColourMode::kRgb}) {
    const ColourModel& model = colour_model(mode);
    for (const double grey : {0., 1e-30, .1, .64, .9, 1., 741.57, 1e30}) {
      EXPECT_EQ(to_bands(Colour(grey), model.reflectance), Colour(grey));
      EXPECT_EQ(to_bands(Colour(grey), model.light), Colour(grey));
      EXPECT_EQ(to_rgb(Colour(grey), model.film), Colour(grey));
      EXPECT_EQ(to_rgb(Colour(-grey), model.film), Colour(-grey));
    }
  }
}

TEST(ColourModel, RgbModeChangesNothing) {
  const ColourModel& model = colour_model(ColourMode::kRgb);
  for (const Colour& c : random_colours(2000)) {
    // The sums of a mixed colour may round in the last of a double's bits; columns hold floats.
    EXPECT_EQ(glm::vec3(to_bands(c, model.reflectance)), glm::vec3(c));
    EXPECT_EQ(glm::vec3(to_bands(c, model.light)), glm::vec3(c));
    EXPECT_EQ(to_rgb(c, model.film), c);
  }
}

TEST(ColourModel, EnergyIsConserved) {
  const ColourModel& model = colour_model(ColourMode::kBands);
  for (const Colour& c : random_colours(2000)) {
    const Colour surface = to_bands(c, model.reflectance), lamp = to_bands(c, model.light);
    const double most = std::max({c.x, c.y, c.z}), least = std::min({c.x, c.y, c.z});
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(surface[k], least * (1 - 1e-7));
      EXPECT_LE(surface[k], most * (1 + 1e-7));
      EXPECT_GE(lamp[k], least * (1 - 1e-7));
    }
    EXPECT_GE(luminance_709(to_rgb(surface, model.film)), 0);
  }
  // A band alone: lights are chosen by luminance, so that none may have less than nothing.
  for (int k = 0; k < 3; ++k) {
    Colour alone(0.);
    alone[k] = 1;
    EXPECT_GT(luminance_709(to_rgb(alone, model.film)), .02);
  }
}

TEST(ColourModel, ScalesWithTheColourAndHasNoSteps) {
  for (const ColourMode mode : {ColourMode::kBands, ColourMode::kRgb}) {
    const ColourModel& model = colour_model(mode);
    const std::vector<Colour> colours = random_colours(500);
    for (size_t i = 1; i < colours.size(); ++i) {
      const Colour& c = colours[i];
      EXPECT_EQ(to_bands(8. * c, model.light), 8. * to_bands(c, model.light));
      // A little way towards another colour is a little way in bands.
      const Colour near = glm::mix(c, colours[i - 1], 1e-6);
      const Colour step = to_bands(near, model.reflectance) - to_bands(c, model.reflectance);
      EXPECT_LT(std::max({std::fabs(step.x), std::fabs(step.y), std::fabs(step.z)}), 5e-6);
    }
  }
}

struct Product {
  const char* name;
  Colour light;
  std::vector<Colour> reflectances;
  Colour
      rgb;  ///< linear Rec.709 of the product of LuxRender's spectra, integrated over 380..720 nm
};

/// Sum over products of the relative error in luminance; `check` is called with each product's.
template <class Check>
double luminance_error(ColourMode mode, const std::vector<Product>& products, Check check) {
  const ColourModel& model = colour_model(mode);
  double sum = 0;
  for (const Product& p : products) {
    Colour bands = to_bands(p.light, model.light);
    for (const Colour& r : p.reflectances) bands *= to_bands(r, model.reflectance);
    const Colour rgb = to_rgb(bands, model.film);
    const double error = luminance_709(rgb) / luminance_709(p.rgb) - 1;
    check(p, rgb, error);
    sum += std::fabs(error);
  }
  return sum;
}

TEST(ColourModel, LoneColoursComeBackAsInLuxRender) {
  const Colour white(1.);
  const std::vector<Product> products = {{"white", white, {}, {1.0057, .9987, .9964}},
                                         {"red", white, {{1, 0, 0}}, {1.0160, .0005, .0031}},
                                         {"green", white, {{0, 1, 0}}, {-.0054, 1.0015, .0219}},
                                         {"blue", white, {{0, 0, 1}}, {-.0049, -.0018, .9796}},
                                         {"cyan", white, {{0, 1, 1}}, {-.0001, .9996, .9909}},
                                         {"magenta", white, {{1, 0, 1}}, {1.0301, -.0102, .9878}},
                                         {"yellow", white, {{1, 1, 0}}, {1.0069, .9997, .0241}},
                                         {"red lamp", {1, 0, 0}, {}, {.9570, -.0044, -.0005}},
                                         {"green lamp", {0, 1, 0}, {}, {.0421, 1.0049, .0126}},
                                         {"blue lamp", {0, 0, 1}, {}, {-.0015, -.0018, .9941}},
                                         {"warm lamp", {1, .92, .62}, {}, {1.0041, .9180, .6217}}};
  luminance_error(ColourMode::kBands, products,
                  [](const Product& p, const Colour& rgb, double error) {
                    EXPECT_LT(std::fabs(error), .004) << p.name;
                    for (int k = 0; k < 3; ++k)
                      EXPECT_NEAR(rgb[k], p.rgb[k], .009) << p.name << " channel " << k;
                  });
}

TEST(ColourModel, ProductsFollowSpectra) {
  const Colour white(1.), warm(1, .92, .62), orange(1, .68, .36), brick(.53, .011, .0059),
      leaf(.0058, .2, .02), blue(.1, .2, .7), rose(.9, .6, .7);
  const std::vector<Product> products = {
      {"orange once", warm, {orange}, {1.0095, .6169, .2210}},
      {"orange twice", warm, {orange, orange}, {.9983, .4110, .0664}},
      {"orange four times", warm, {orange, orange, orange, orange}, {.9487, .1782, -.0127}},
      {"brick", warm, {brick}, {.5334, .0082, .0006}},
      {"brick, orange", warm, {brick, orange}, {.5113, .0039, -.0058}},
      {"leaf, orange", warm, {leaf, orange}, {.0187, .1205, .0025}},
      {"blue twice", white, {blue, blue}, {.0109, .0290, .4545}},
      {"rose three times", white, {rose, rose, rose}, {.7142, .2101, .3390}},
      {"blue, rose", warm, {blue, rose}, {.0928, .1141, .3071}}};
  const double bands = luminance_error(
      ColourMode::kBands, products, [](const Product& p, const Colour& rgb, double error) {
        EXPECT_LT(std::fabs(error), .01) << p.name;
        const double brightest = std::max({p.rgb.x, p.rgb.y, p.rgb.z});
        for (int k = 0; k < 3; ++k)
          EXPECT_NEAR(rgb[k], p.rgb[k], .025 * brightest) << p.name << " channel " << k;
      });
  const double rgb =
      luminance_error(ColourMode::kRgb, products, [](const Product&, const Colour&, double) {});
  EXPECT_LT(bands, .15 * rgb) << "bands " << bands << ", rgb " << rgb;
}

/// What an image's gamma makes of a stored colour: LuxRender raises its spectrum, wavelength by
/// wavelength. Spectra by the ten samples of Smits (1999), linear in between; the colour of the
/// result under D65, relative to white's.
struct Stored {
  const char* name;
  Colour texel, rgb;
};

TEST(ColourModel, GammaActsOnBandsAsOnSpectra) {
  constexpr double kGamma = 2.2;
  const std::vector<Stored> colours = {{"wood", {.93, .72, .25}, {.8648, .4686, .0309}},
                                       {"curtain", {.5, .15, .1}, {.2020, .0151, .0040}},
                                       {"crimson", {.8, .2, .3}, {.5622, .0271, .0664}},
                                       {"denim", {.15, .3, .5}, {.0088, .0691, .2074}},
                                       {"grass", {.2, .5, .2}, {.0166, .2029, .0289}},
                                       {"gold", {.9, .7, .1}, {.8107, .4303, -.0231}},
                                       {"skin", {.95, .8, .7}, {.8974, .6130, .4588}},
                                       {"plum", {.4, .1, .6}, {.1311, -.0067, .2985}}};
  const ColourModel& model = colour_model(ColourMode::kBands);
  double on_bands = 0, on_channels = 0;
  for (const Stored& c : colours) {
    const Colour found =
        to_rgb(glm::pow(to_bands(c.texel, model.reflectance), Colour(kGamma)), model.film);
    const double expected = luminance_709(c.rgb);
    EXPECT_NEAR(luminance_709(found), expected, .045 * expected) << c.name;
    const double brightest = std::max({c.rgb.x, c.rgb.y, c.rgb.z});
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(found[k], c.rgb[k], .045 * brightest) << c.name << " channel " << k;
    on_bands += std::fabs(luminance_709(found) / expected - 1);
    const Colour decoded = glm::pow(c.texel, Colour(kGamma));
    on_channels += std::fabs(
        luminance_709(to_rgb(to_bands(decoded, model.reflectance), model.film)) / expected - 1);
  }
  EXPECT_LT(on_bands, .2 * on_channels) << on_bands << " against " << on_channels;
}

}  // namespace
}  // namespace yat

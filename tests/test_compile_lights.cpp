// Lights: radiance by LuxRender's units, positions, and the table they are chosen from.

#include <cmath>
#include <numbers>
#include <random>

#include "environment_scenes.h"
#include "scene/alias_table.h"
#include "scene/compile_parts.h"
#include "scene_builder.h"

namespace yat {
namespace {

constexpr double kPi = std::numbers::pi;

glm::dvec3 bands_of_row(const LightRow<Value>& l) {
  return {l.radiance_r, l.radiance_g, l.radiance_b};
}
double y_of(const Scene& scene, const LightRow<Value>& l) {
  return luminance(to_rgb(bands_of_row(l), scene.colour.film));
}
Matrix scale(double x, double y, double z) {
  return glm::scale(Matrix(1.), glm::dvec3(x, y, z));
}
Matrix translate(double x, double y, double z) {
  return glm::translate(Matrix(1.), glm::dvec3(x, y, z));
}
std::vector<Parameter> plain(float gain) {
  return {number("power", 0), number("efficacy", 0), number("gain", gain)};
}

using CompileLights = SceneTest;

// The lamp of a known scene: measured 741.5 with the classic renderer.
TEST_F(CompileLights, PowerRule) {
  const uint32_t lamp = area_light({number("power", 100), number("efficacy", 17), number("gain", 2),
                                    color("L", 1.f, .91917193f, .62339652f),
                                    number("importance", 1), integers("nsamples", {1})});
  const float h = .050000000745058f;
  shape(plugin("trianglemesh",
               {integers("indices", {0, 1, 2, 0, 2, 3}),
                numbers(ParameterType::kPoint, "P", {-h, h, 0, h, h, 0, h, -h, 0, -h, -h, 0})}),
        translate(.12, 2.86, 5.45) *
            scale(12.080706596374512, 12.080706596374512, 12.080706596374512))
      .area_light = lamp;
  const Scene scene = compile();
  ASSERT_EQ(scene.lights.size(), 1u);
  const auto l = scene.lights.row(0);
  // gain * power * efficacy / (pi * area); the classic renderer's own figure is rounded to 741.57.
  EXPECT_NEAR(y_of(scene, l), 2 * 1700 / (kPi * std::pow(12.080706596374512 * 2 * double(h), 2)),
              1e-4);
  EXPECT_NEAR(y_of(scene, l), 741.57, .02);
  // The hue is that of L in bands.
  const glm::dvec3 hue = to_bands({1, double(.91917193f), double(.62339652f)}, scene.colour.light);
  const glm::dvec3 bands = bands_of_row(l);
  EXPECT_NEAR(bands.y / bands.x, hue.y / hue.x, 1e-6);
  EXPECT_NEAR(bands.z / bands.x, hue.z / hue.x, 1e-6);
  EXPECT_GT(std::fabs(hue.z / hue.x - double(.62339652f)), .01);
  EXPECT_NEAR(l.extra, 12.0807 * 12.0807 * .1 * .1, 1e-4);
  EXPECT_EQ(l.kind, uint32_t(LightKind::kRectangle));
  // b x c is the outside: this lamp faces down.
  EXPECT_LT(l.b_x * l.c_y - l.b_y * l.c_x, 0);
  EXPECT_EQ(scene.triangles.row(0).light, 0u);
  EXPECT_EQ(scene.triangles.row(1).light, 0u);
  EXPECT_EQ(scene.light_kinds, 1u << uint32_t(LightKind::kRectangle));
  EXPECT_FLOAT_EQ(l.probability, 1);
  EXPECT_SILENT();
}

// Two triangles that make a rectangle are one light, whichever corner they begin at; what is
// skewed, bent, of other sides or of other meshes is not.
TEST_F(CompileLights, PairsThatMakeARectangleAreOneLight) {
  const uint32_t lamp = area_light(plain(1));
  struct Case {
    const char* name;
    std::vector<float> p;
    std::vector<int32_t> indices;
    uint32_t lights;
  };
  const std::vector<float> wide = {0, 0, 0, 3, 0, 0, 3, 1, 0, 0, 1, 0};
  const Case cases[] = {{"from the corner", wide, {0, 1, 2, 0, 2, 3}, 1},
                        {"the other diagonal", wide, {3, 0, 1, 2, 3, 1}, 1},
                        {"others first", wide, {0, 1, 2, 1, 2, 3, 2, 3, 0}, 2},
                        {"facing to both sides", wide, {0, 1, 2, 0, 3, 2}, 2},
                        {"skewed", {0, 0, 0, 3, 0, 0, 4, 1, 0, 1, 1, 0}, {0, 1, 2, 0, 2, 3}, 2},
                        {"bent", {0, 0, 0, 3, 0, 0, 3, 1, 0, 0, 1, .01f}, {0, 1, 2, 0, 2, 3}, 2},
                        {"kite", {0, 0, 0, 3, 0, 0, 3, 1, 0, .6f, 1.8f, 0}, {0, 1, 2, 0, 2, 3}, 2},
                        {"one of three",
                         {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 1, 0},
                         {0, 1, 2, 0, 2, 3, 1, 4, 2},
                         2}};
  for (const Case& c : cases) {
    description.shapes.clear();
    shape(mesh(c.p, c.indices)).area_light = lamp;
    const Scene scene = compile();
    EXPECT_EQ(scene.lights.size(), c.lights) << c.name;
    double area = 0, triangles = 0;
    for (uint32_t i = 0; i < scene.lights.size(); ++i) {
      const LightRow<Value> l = scene.lights.row(i);
      area += double(l.extra);
      if (l.kind != uint32_t(LightKind::kRectangle)) continue;
      const glm::dvec3 b(l.b_x, l.b_y, l.b_z), c2(l.c_x, l.c_y, l.c_z);
      EXPECT_EQ(glm::dot(b, c2), 0);
      EXPECT_LE(glm::length(b), glm::length(c2));
      EXPECT_GT(glm::cross(b, c2).z, 0);
    }
    for (uint32_t t = 0; t < scene.triangles.size(); ++t) {
      EXPECT_LT(scene.triangles.row(t).light, c.lights) << c.name;
      const LightRow<Value> l = triangle_light(scene.triangles.row(t), glm::dvec3(1));
      triangles += double(l.extra);
    }
    EXPECT_NEAR(area, triangles, 1e-5) << c.name;
  }
}

// The tree does better with the halves of a rectangle.
TEST_F(CompileLights, ManyLightsStayTriangles) {
  const uint32_t lamp = area_light(plain(1));
  shape(square()).area_light = lamp;
  shape(triangle(), translate(0, 0, 2)).area_light = lamp;
  EXPECT_EQ(compile().lights.size(), 2u);
  light(plugin("point", {}));
  Scene scene = compile();
  EXPECT_EQ(scene.lights.size(), 4u);
  EXPECT_EQ(scene.light_tree.nodes.size(), 3u);
  options.light_choice = LightChoosing::kPower;
  EXPECT_EQ(compile().lights.size(), 3u);
}

// There is no kernel for it: where two could be rectangles, there are many lights already.
TEST_F(CompileLights, NoTreeIsOverRectanglesAlone) {
  const auto bit = [](LightKind kind) { return 1u << uint32_t(kind); };
  const uint32_t lamp = area_light(plain(1));
  options.light_choice = LightChoosing::kTree;
  shape(square()).area_light = lamp;
  EXPECT_EQ(compile().light_tree.nodes.size(), 0u);
  shape(triangle(), translate(0, 0, 2)).area_light = lamp;
  Scene scene = compile();
  EXPECT_GT(scene.light_tree.nodes.size(), 0u);
  EXPECT_EQ(scene.light_kinds, bit(LightKind::kTriangle) | bit(LightKind::kRectangle));
  description.shapes.back() = description.shapes.front();
  scene = compile();
  EXPECT_GT(scene.light_tree.nodes.size(), 0u);
  EXPECT_EQ(scene.light_kinds, bit(LightKind::kTriangle));
}

// In shared objects the rectangle must be one in every instance.
TEST_F(CompileLights, RectanglesOfSharedObjectsAreThoseOfAllInstances) {
  const auto lights_of = [&](const Matrix& second) {
    description.objects = {{"o", {}}};
    description.shapes.clear();
    description.instances.clear();
    ShapeEntry& lamp = shape(square());
    lamp.object = 0;
    lamp.area_light = area_light(plain(1));
    shape(triangle());
    description.instances.push_back({0, scale(2, 1, 1), kNone, {}});
    description.instances.push_back({0, second, kNone, {}});
    options.instances = InstanceMode::kShare;
    options.light_choice = LightChoosing::kPower;
    const Scene scene = compile();
    EXPECT_EQ(scene.instances.rows.size(), 2u);
    return scene.lights.size();
  };
  EXPECT_EQ(lights_of(translate(0, 0, 3)), 2u);
  EXPECT_EQ(lights_of(glm::rotate(Matrix(1.), .7, glm::dvec3(1, 2, 3)) * scale(-1, 5, 2)), 2u);
  Matrix sheared(1.);
  sheared[1][0] = .5;
  EXPECT_EQ(lights_of(sheared), 4u);
}

TEST_F(CompileLights, WithoutPowerTheColourIsTheRadiance) {
  shape(square(), scale(3, 3, 3)).area_light = area_light(plain(4));
  const auto l = compile().lights.row(0);
  EXPECT_EQ(l.radiance_r, 4);
  EXPECT_EQ(l.radiance_b, 4);
}

TEST_F(CompileLights, SphereAreaIgnoresTheTransform) {
  shape(plugin("sphere", {number("radius", .5f)}), translate(0, 0, 9) * scale(2, 2, 2)).area_light =
      area_light({});
  const Scene scene = compile();
  const auto l = scene.lights.row(0);
  EXPECT_EQ(l.kind, uint32_t(LightKind::kSphere));
  EXPECT_NEAR(y_of(scene, l), 1700 / (kPi * 4 * kPi * .25), 1e-3);
  EXPECT_EQ(l.extra, 1);
  EXPECT_EQ(l.b_x, 0);
  EXPECT_EQ(scene.spheres.row(0).light, 0u);
  EXPECT_TRUE(scene.bins[scene.prim_bin[0]].emissive);
}

TEST_F(CompileLights, InstancedLightShinesOncePerInstanceByItsOwnArea) {
  description.objects = {{"o", {}}};
  ShapeEntry& lamp = shape(square());
  lamp.object = 0;
  lamp.area_light = area_light({});
  shape(triangle());
  description.instances.push_back({0, scale(2, 2, 2), kNone, {}});
  description.instances.push_back({0, translate(0, 0, 3), kNone, {}});
  options.light_choice = LightChoosing::kPower;
  const Scene scene = compile();
  ASSERT_EQ(scene.lights.size(), 2u);
  for (uint32_t i = 0; i < 2; ++i)
    EXPECT_NEAR(y_of(scene, scene.lights.row(i)), 1700 / (4 * kPi), 1e-3);
  EXPECT_FLOAT_EQ(scene.lights.row(0).extra, 16);
  // The larger copy has four times the power.
  EXPECT_FLOAT_EQ(scene.lights.row(0).probability, .8f);
  EXPECT_FLOAT_EQ(scene.lights.row(1).probability, .2f);
}

TEST_F(CompileLights, LightsThatCannotShine) {
  shape(triangle());
  shape(mesh({0, 0, 0, 1, 0, 0, 2, 0, 0}, {0, 1, 2})).area_light = area_light({});
  shape(square()).area_light = area_light({color("L", 0, 0, 0)});
  shape(plugin("plane", {}, 60)).area_light = 0;
  description.area_lights.push_back({plugin("volume", {}, 70)});
  shape(square()).area_light = 2;
  const Scene scene = compile();
  EXPECT_EQ(scene.lights.size(), 0u);
  for (const Bin& bin : scene.bins) EXPECT_FALSE(bin.emissive);
  EXPECT_SAID("scene.lxs:10:1: warning: the area light has no area: it does not shine");
  EXPECT_SAID(
      "scene.lxs:30:1: warning: the area light has power but no area or a black \"L\": \"L\" times "
      "\"gain\" is taken as its radiance");
  EXPECT_SAID("scene.lxs:60:1: warning: an infinite plane cannot be a light: it does not shine");
  EXPECT_SAID("scene.lxs:70:1: error: unknown area light \"volume\": the shapes do not shine");
}

TEST_F(CompileLights, MirroredLampKeepsItsSideAndIsNoted) {
  shape(square(), scale(-1, 1, 1)).area_light = area_light(plain(1));
  const auto l = compile().lights.row(0);
  EXPECT_GT(l.b_x * l.c_y - l.b_y * l.c_x, 0);
  EXPECT_SAID(
      "scene.lxs:10:1: note: a mesh light under a mirrored transform shines to the side that its "
      "mesh says, mirrored with it (LuxRender: to the other side)");
}

TEST_F(CompileLights, PointLight) {
  shape(triangle());
  // Position is from + CTM * origin: `from` is neither turned nor scaled.
  light(plugin("point", {number("gain", 3), numbers(ParameterType::kPoint, "from", {1, 2, 3})}),
        translate(10, 0, 0) * scale(5, 5, 5));
  light(plugin("point", {number("power", 100), number("efficacy", 17), color("L", .5f, .5f, .5f)}));
  const Scene scene = compile();
  const auto l = scene.lights.row(0);
  EXPECT_EQ(l.kind, uint32_t(LightKind::kPoint));
  EXPECT_DOUBLE_EQ(double(l.a_x) + scene.center.x, 11);
  EXPECT_DOUBLE_EQ(double(l.a_y) + scene.center.y, 2);
  EXPECT_EQ(l.radiance_g, 3);
  EXPECT_NEAR(y_of(scene, scene.lights.row(1)), 1700 / (4 * kPi), 1e-3);
  EXPECT_NEAR(double(scene.lights.row(1).probability), 1700 / (4 * kPi) / (3 + 1700 / (4 * kPi)),
              1e-6);
}

// A sky's power is that through the whole scene, little of which may be seen: a lamp keeps half.
TEST_F(CompileLights, LampsUnderASkyKeepHalfOfTheChances) {
  shape(square(), scale(100, 100, 100));
  light(plugin("point", {number("gain", 1)}));
  light(plugin("infinite", {number("gain", 50)}));
  options.leaves_even_skies = false;
  const Scene scene = compile();
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_FLOAT_EQ(scene.lights.row(0).probability, .5f);
  EXPECT_FLOAT_EQ(scene.lights.row(1).probability, .5f);
  options.light_choice = LightChoosing::kPower;
  EXPECT_LT(compile().lights.row(0).probability, .01f);
}

TEST_F(CompileLights, EvenSkiesAreLeftToChance) {
  shape(square());
  light(plugin("infinite", {}));
  // Asked, of how many.
  const auto asked = [&] {
    const Scene scene = compile();
    for (uint32_t i = 0; i < scene.lights.size(); ++i)
      EXPECT_EQ(scene.lights.row(i).probability > 0, i < scene.asked_lights) << i;
    return std::pair(scene.asked_lights, scene.lights.size());
  };
  EXPECT_EQ(asked(), std::pair(0u, 1u)) << "all is matte";
  light(plugin("sky", {}));
  EXPECT_EQ(asked(), std::pair(0u, 2u));
  shape(square()).material = material(plugin("velvet", {}));
  EXPECT_EQ(asked(), std::pair(2u, 2u)) << "no other light, and not all is matte";
  light(plugin("sun", {numbers(ParameterType::kVector, "sundir", {0, 0, 1})}));
  EXPECT_EQ(asked(), std::pair(1u, 3u));
  EXPECT_EQ(compile().lights.row(0).kind, uint32_t(LightKind::kSun));
  light(plugin("point", {}));
  EXPECT_EQ(asked(), std::pair(2u, 4u));
  for (const LightChoosing choosing : {LightChoosing::kPower, LightChoosing::kTree,
                                       LightChoosing::kUniform, LightChoosing::kAll}) {
    options.light_choice = choosing;
    EXPECT_EQ(asked(), std::pair(4u, 4u));
  }
  options.light_choice = LightChoosing::kAuto;
  options.leaves_even_skies = false;
  EXPECT_EQ(asked(), std::pair(4u, 4u));
  options = {};
  options.light_choice = LightChoosing::kAll;
  for (uint32_t i = 4; i <= kMostAskedLights; ++i) light(plugin("point", {}));
  EXPECT_EQ(asked(), std::pair(kMostAskedLights - 1, kMostAskedLights + 1)) << "as auto";
}

TEST_F(CompileLights, UnevenSkiesAreAsked) {
  shape(square());
  // A bright band over this part of the sphere; the mean square over the squared mean is 1 / share.
  const auto asked = [&](uint32_t bright_rows) {
    std::vector<uint8_t> texels(3 * 8 * 64, 0);
    std::fill_n(texels.begin(), 3 * 8 * bright_rows, uint8_t(200));
    const std::string picture = write_ppm("band.ppm", 8, 64, texels);
    light(plugin("infinite", {text("mapname", picture)}));
    const Scene scene = compile();
    description.lights.pop_back();
    return scene.asked_lights;
  };
  EXPECT_EQ(asked(64), 0u);
  EXPECT_EQ(asked(34), 0u) << "a little more than half";
  EXPECT_EQ(asked(28), 1u);
  EXPECT_EQ(asked(1), 1u);
}

TEST_F(CompileLights, TwoLightsAreBothAskedIfOneIsASkyOrASun) {
  const auto asks_all = [&] {
    const Scene scene = compile();
    for (uint32_t i = 0; scene.every_light && i < scene.lights.size(); ++i)
      EXPECT_EQ(scene.lights.row(i).probability, 1) << i;
    EXPECT_EQ(scene.light_choice.size(), scene.every_light ? 0 : scene.lights.size());
    return scene.every_light;
  };
  options.leaves_even_skies = false;
  shape(square(), scale(100, 100, 100));
  light(plugin("sun", {numbers(ParameterType::kVector, "sundir", {0, 0, 1})}));
  EXPECT_FALSE(asks_all()) << "one light";
  light(plugin("sky", {}));
  EXPECT_TRUE(asks_all());
  for (const LightChoosing choosing : {LightChoosing::kPower, LightChoosing::kUniform}) {
    options.light_choice = choosing;
    EXPECT_FALSE(asks_all());
  }
  options.light_choice = LightChoosing::kAuto;
  light(plugin("point", {number("gain", 1e12f)}));
  EXPECT_FALSE(asks_all()) << "three lights";
  options.light_choice = LightChoosing::kAll;
  EXPECT_TRUE(asks_all());
}

TEST_F(CompileLights, LampsAndLightsOfNoWeightAreNotAskedEach) {
  options.leaves_even_skies = false;
  shape(square(), scale(100, 100, 100));
  light(plugin("infinite", {}));
  const double sky =
      light_power(compile().lights.row(0), compile().colour, double(compile().radius));
  const auto asks_all_beside = [&](double lamp) {
    light(plugin("point", {number("gain", float(lamp * sky / (4 * kPi)))}));
    const bool asks_all = compile().every_light;
    description.lights.pop_back();
    return asks_all;
  };
  EXPECT_TRUE(asks_all_beside(1));
  EXPECT_TRUE(asks_all_beside(.06));
  EXPECT_FALSE(asks_all_beside(.04));
  EXPECT_TRUE(asks_all_beside(18));
  EXPECT_FALSE(asks_all_beside(20));
  description.lights.clear();
  for (int i = 0; i < 2; ++i) light(plugin("point", {}));
  EXPECT_FALSE(compile().every_light) << "two lamps";
}

TEST_F(CompileLights, DistantLight) {
  shape(triangle());
  light(plugin("distant", {numbers(ParameterType::kPoint, "from", {0, 0, 2}),
                           numbers(ParameterType::kPoint, "to", {0, 0, 0}), number("gain", 5)}),
        translate(7, 7, 7));
  light(plugin("distant", {number("theta", .25f)}));
  light(plugin("distant", {number("theta", .0001f)}));
  options.light_choice = LightChoosing::kPower;
  const Scene scene = compile();
  const auto l = scene.lights.row(0);
  EXPECT_EQ(l.a_z, 1) << "towards the light";
  EXPECT_EQ(l.radiance_r, 5);
  EXPECT_EQ(l.extra, 1);
  const auto disc = scene.lights.row(1);
  EXPECT_EQ(disc.a_z, -1);
  EXPECT_LT(disc.extra, 1);
  // Irradiance of the disc as the kernels see it: exactly L whatever the cosine rounds to.
  EXPECT_NEAR(double(disc.radiance_r) * 2 * kPi * (1 - double(disc.extra)), 1, 1e-6);
  EXPECT_EQ(scene.lights.row(2).extra, 1) << "too small for a float: a direction";
  EXPECT_EQ(scene.lights.row(2).radiance_r, 1);
  // Power relative to the scene's size: 5 : 1 : 1.
  EXPECT_FLOAT_EQ(l.probability, 5.f / 7);
}

TEST_F(CompileLights, OthersAreLeftOut) {
  shape(triangle());
  light(plugin("pointt", {}, 22));
  light(plugin("distant", {numbers(ParameterType::kPoint, "to", {0, 0, 0})}, 23));
  light(plugin("spot", {numbers(ParameterType::kPoint, "to", {0, 0, 0})}, 25));
  EXPECT_EQ(compile().lights.size(), 0u);
  EXPECT_EQ(
      all_said(),
      "scene.lxs:22:1: error: unknown light \"pointt\" (did you mean \"point\"?): left out\n"
      "scene.lxs:23:1: error: light \"distant\" has no direction (\"from\" and \"to\" are the same "
      "point): left out\n"
      "scene.lxs:25:1: error: light \"spot\" has no direction (\"from\" and \"to\" are the same "
      "point): left out\n"
      "warning: the scene has no light that can be used: the picture will be black\n");
}

// ---- The alias table -------------------------------------------------------------------------

/// What the table does: each row's share of the intervals, from the thresholds as stored.
std::vector<double> shares(const AliasTable& table) {
  const size_t n = table.choice.size();
  std::vector<double> p(n, 0.);
  for (size_t i = 0; i < n; ++i) {
    EXPECT_GE(table.choice[i].threshold, 0);
    EXPECT_LE(table.choice[i].threshold, 1);
    EXPECT_LT(table.choice[i].other, n);
    p[i] += double(table.choice[i].threshold) / double(n);
    p[table.choice[i].other] += (1 - double(table.choice[i].threshold)) / double(n);
  }
  return p;
}

void check(const std::vector<double>& weights) {
  const AliasTable table = make_alias_table(weights);
  const std::vector<double> p = shares(table);
  double sum = 0, stated = 0;
  for (size_t i = 0; i < weights.size(); ++i) {
    sum += p[i];
    stated += double(table.probability[i]);
    // Stated as done, to the last bit but one of a float.
    ASSERT_NEAR(double(table.probability[i]), p[i], 1e-7 * p[i]) << i;
    if (weights[i] > 0)
      ASSERT_GE(p[i] * double(weights.size()), .99 / 1024) << i;
    else
      ASSERT_EQ(p[i], 0) << i;
  }
  EXPECT_NEAR(sum, 1, 1e-9);
  EXPECT_NEAR(stated, 1, 1e-6);
}

TEST(AliasTable, ChoosesByWeight) {
  const std::vector<double> weights = {1, 2, 3, 4, 0, 10};
  const AliasTable table = make_alias_table(weights);
  for (size_t i = 0; i < weights.size(); ++i)
    EXPECT_NEAR(double(table.probability[i]), weights[i] / 20, 1e-7);
  check(weights);
}

TEST(AliasTable, OneRow) {
  const AliasTable table = make_alias_table(std::vector<double>{3e-300});
  EXPECT_EQ(table.choice[0].threshold, 1);
  EXPECT_EQ(table.probability[0], 1);
}

TEST(AliasTable, HoldsForAnyWeights) {
  check(std::vector<double>(1000, 7.));
  check({0, 0, 1, 0});
  check({1e-300, 1e300, 0, 1});
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> exponent(-20, 20);
  std::vector<double> weights(1'000'000);
  for (double& w : weights) w = random() % 10 ? std::pow(10., exponent(random)) : 0;
  check(weights);
}

}  // namespace
}  // namespace yat

// Environments, sun and sky as rows: what is read, what stands in, what is said.

#include <bit>
#include <cmath>
#include <numbers>

#include "scene/compile_parts.h"
#include "scene/light_maps.h"
#include "scene_builder.h"

namespace yat {
namespace {

constexpr double kPi = std::numbers::pi;

using CompileEnvironment = SceneTest;

Parameter vector(std::string name, float x, float y, float z) {
  return numbers(ParameterType::kVector, std::move(name), {x, y, z});
}

TEST_F(CompileEnvironment, RowsOfEnvironmentsAreTheLast) {
  light(plugin("infinite", {color("L", .5f, 1, 2), number("gain", 3)}));
  light(plugin("point", {}));
  shape(square()).area_light = area_light({number("power", 0), number("efficacy", 0)});
  options.colour = ColourMode::kRgb;
  options.light_choice = LightChoosing::kPower;
  const Scene scene = compile();
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.first_environment, 2u);
  EXPECT_EQ(scene.lights.row(0).kind, uint32_t(LightKind::kRectangle));
  EXPECT_EQ(scene.lights.row(1).kind, uint32_t(LightKind::kPoint));
  const LightRow<Value> row = scene.lights.row(2);
  EXPECT_EQ(row.kind, uint32_t(LightKind::kConstant));
  EXPECT_EQ(row.radiance_r, 1.5f);
  EXPECT_EQ(row.radiance_b, 6);
  // Power: the flux through the scene, against pi A and 4 pi.
  const double through =
      4 * kPi * kPi * double(scene.radius) * double(scene.radius) * luminance({1.5, 3, 6});
  const double all = through + 4 * kPi + 4 * kPi;
  EXPECT_NEAR(double(row.probability), through / all, 1e-5);
  EXPECT_SILENT();
}

TEST_F(CompileEnvironment, WhatCannotBeReadShinesWithout) {
  shape(triangle());
  light(plugin("infinite", {text("mapname", "no.exr"), text("mapping", "latlon")}, 40));
  light(plugin("infinitesample",
               {integers("imapmaxresolution", {100}), integers("nsamples", {4}),
                number("importance", 2), color("L", 0, 0, 0)},
               50));
  light(plugin("point", {text("iesname", "no.ies")}, 60));
  const Scene scene = compile();
  EXPECT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(
      all_said(),
      "scene.lxs:42:2: error: unknown mapping \"latlon\" (did you mean \"latlong\"?): latlong "
      "is used\n"
      "scene.lxs:41:2: error: image \"no.exr\" not found: light \"infinite\" shines without "
      "it\n"
      "scene.lxs:50:1: warning: light \"infinitesample\" is black: left out\n"
      "scene.lxs:61:2: error: IES profile \"no.ies\" not found: light \"point\" shines without "
      "it\n");
}

TEST_F(CompileEnvironment, SunAndSky) {
  shape(triangle());
  light(plugin("sunsky", {vector("sundir", 0, 3, 4), number("relsize", 2)}, 40));
  const Scene scene = compile();
  ASSERT_EQ(scene.lights.size(), 2u);
  const LightRow<Value> sun = scene.lights.row(0), sky = scene.lights.row(1);
  EXPECT_EQ(sun.kind, uint32_t(LightKind::kSun));
  EXPECT_FLOAT_EQ(sun.a_y, .6f);
  EXPECT_FLOAT_EQ(sun.a_z, .8f);
  // 1 - cos of an angle whose sine is twice the sun's, to all its digits.
  EXPECT_NEAR(double(sun.extra), 4.322855e-5, 1e-10);
  EXPECT_EQ(sky.kind, uint32_t(LightKind::kSky));
  EXPECT_EQ(std::bit_cast<uint32_t>(sky.b_x), 0u);
  EXPECT_EQ(scene.skies.size(), 1u);
  EXPECT_EQ(scene.light_maps.size(), 1u);
  EXPECT_TRUE(scene.light_texels.empty()) << "the formula needs no picture";
  EXPECT_GT(sky.extra, 1000);
  EXPECT_SILENT();
}

TEST_F(CompileEnvironment, WhereFormulasEnd) {
  shape(triangle());
  light(plugin("sun", {}, 40));
  light(plugin("sky", {vector("sundir", 0, 1, -.1f), number("turbidity", .5f)}, 50));
  light(plugin("sky2", {vector("sundir", 0, 0, 0)}, 60));
  light(plugin("sun", {vector("sundir", 0, 0, 1), number("relsize", -1), number("gain", -2)}, 70));
  EXPECT_EQ(compile().lights.size(), 2u);
  EXPECT_EQ(
      all_said(),
      "scene.lxs:40:1: warning: the sun is below the horizon: it does not shine\n"
      "scene.lxs:52:2: warning: \"turbidity\" is 0.5, but must be from 1.7 to 30: 1.7 is "
      "used\n"
      "scene.lxs:50:1: warning: the sun is below the horizon, where the formula of the sky has "
      "not been fitted\n"
      "scene.lxs:61:2: warning: \"sundir\" is no direction: the default is used\n"
      "scene.lxs:60:1: warning: light \"sky2\": the data of its sky (Hosek, Wilkie 2012) are "
      "not part of yat: \"sky\" is used\n"
      "scene.lxs:72:2: warning: \"relsize\" is -1, but must be above 0 and at most 215: 1 is "
      "used\n"
      "scene.lxs:73:2: warning: \"gain\" is negative or infinite: 0 is used\n"
      "scene.lxs:70:1: warning: light \"sun\" is black: left out\n");
}

TEST_F(CompileEnvironment, SpotsOutOfRange) {
  shape(triangle());
  light(plugin("spot", {number("coneangle", 190), number("conedeltaangle", 40)}, 40));
  const Scene scene = compile();
  EXPECT_FLOAT_EQ(scene.lights.row(0).extra, float(std::cos(kPi / 6)));
  EXPECT_EQ(
      all_said(),
      "scene.lxs:41:2: warning: \"coneangle\" is 190 degrees, but must be from 0 to 180: 30 is "
      "used\n"
      "scene.lxs:42:2: warning: \"conedeltaangle\" is 40 degrees, but must be from 0 to "
      "\"coneangle\": 5 is used\n");
}

TEST_F(CompileEnvironment, TheCameraMayNotSeeIt) {
  shape(triangle());
  light(plugin("infinite", {}));
  EXPECT_TRUE(compile().show_environment);
  Parameter hide = text("includeenvironment", "false", ParameterType::kBool);
  description.integrator = plugin("path", {hide}, 90);
  EXPECT_FALSE(compile().show_environment);
  EXPECT_SILENT();
}

// The table by which directions are drawn: whole, ascending, every cell with some of it.
TEST(LightCells, CoverWhatShinesAndAllElseALittle) {
  CellMeans cells{4, 2, {0, 0, 100, 0, 0, 0, 0, 0}};
  LightTables tables;
  LightMapRow<Value> map{};
  add_cells(cells, tables, map);
  ASSERT_EQ(tables.cells.size(), 5u + 2 * 7);
  EXPECT_EQ(tables.cells[0], 0);
  EXPECT_EQ(tables.cells[2], 1);
  const float* top = tables.cells.data() + 5;
  EXPECT_EQ(top[4], 1);
  EXPECT_NEAR(double(tables.cells[1]), 1 - .5 / kEvenShare, 1e-6);
  // One in kEvenShare is drawn evenly, an eighth of those in each cell.
  const double wanted = 1 - 1 / kEvenShare + .125 / kEvenShare;
  EXPECT_NEAR(double(top[3] - top[2]) * double(tables.cells[1]), wanted, 1e-6);
  for (int i = 0; i < 4; ++i) EXPECT_GT(top[i + 1], top[i]);
  EXPECT_NEAR(cells.average(), 12.5, 1e-12);
}

// Each guide is the last cell that starts at or below its share of the way.
TEST(LightCells, GuidesPointAtTheirCells) {
  CellMeans cells{64, 32, std::vector<double>(64 * 32, 1.)};
  for (uint32_t i = 0; i < cells.mean.size(); i += 7) cells.mean[i] = i % 5 ? 0 : 300;
  LightTables tables;
  LightMapRow<Value> map{};
  add_cells(cells, tables, map);
  const float* list = tables.cells.data();
  for (uint32_t row = 0; row <= map.rows; ++row) {
    const uint32_t count = row ? map.columns : map.rows, guides = cell_guides(count);
    for (uint32_t k = 0; k <= guides; ++k) {
      const auto cell = uint32_t(list[count + 1 + k]);
      ASSERT_LT(cell, count);
      EXPECT_LE(list[cell], float(k) / float(guides));
      if (cell + 1 < count) {
        EXPECT_GT(list[cell + 1], float(k) / float(guides));
      }
    }
    list += cell_list_words(count);
  }
  EXPECT_EQ(list, tables.cells.data() + tables.cells.size());
}

}  // namespace
}  // namespace yat

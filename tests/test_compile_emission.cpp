// Area lights that do not shine evenly, compiled: what becomes a program, what a warning.

#include "scene_builder.h"

namespace yat {
namespace {

class CompileEmission : public SceneTest {
 protected:
  uint32_t bilerp(float least, float most) {
    description.textures.push_back(
        {"ramp", "color",
         plugin("bilerp", {color("v00", least, least, least), color("v01", least, least, least),
                           color("v10", most, most, most), color("v11", most, most, most)})});
    return uint32_t(description.textures.size() - 1);
  }
  Plugin uv_square() {
    return mesh({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}, {0, 1, 2, 0, 2, 3},
                {numbers(ParameterType::kFloat, "uv", {0, 0, 1, 0, 1, 1, 0, 1})});
  }
};

TEST_F(CompileEmission, AVaryingLIsAProgramOverItsMean) {
  const uint32_t light = area_light(
      {texture("L", bilerp(1, 3)), number("gain", 5), number("power", 0), number("efficacy", 0)});
  shape(uv_square()).area_light = light;
  const Scene scene = compile();
  EXPECT_SILENT();
  ASSERT_EQ(scene.lights.size(), 2u);
  ASSERT_EQ(scene.emission.size(), 2u);
  ASSERT_EQ(scene.emission_programs.size(), 1u);
  for (uint32_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(scene.lights.row(i).radiance_g, 2 * 5, 1e-5) << "the mean, times gain";
    const EmissionRow<Value> row = scene.emission.row(i);
    EXPECT_EQ(row.program, 0u);
    EXPECT_EQ(row.map, kNone);
    EXPECT_EQ(row.prim, i);
  }
  EXPECT_EQ(scene.emission.row(1).u1, 1);
  EXPECT_EQ(scene.emission.row(1).v2, 1);
  bool found = false;
  for (const Bin& bin : scene.bins) found = found || (bin.emissive && bin.emission_program == 0);
  EXPECT_TRUE(found);
}

// One program for all lights of one kind of texture; those that shine evenly have none.
TEST_F(CompileEmission, ProgramsAreSharedByTheirShape) {
  const uint32_t a = area_light({texture("L", bilerp(1, 3))});
  const uint32_t b = area_light({texture("L", bilerp(0, 8))});
  const uint32_t even = area_light({color("L", 1, 1, 1)});
  shape(uv_square()).area_light = a;
  shape(uv_square(), glm::translate(Matrix(1.), {0, 0, 1})).area_light = b;
  shape(uv_square(), glm::translate(Matrix(1.), {0, 0, 2})).area_light = even;
  const Scene scene = compile();
  EXPECT_SILENT();
  ASSERT_EQ(scene.emission_programs.size(), 1u);
  EXPECT_EQ(scene.emission_programs[0].rows, 2u);
  ASSERT_EQ(scene.emission.size(), 6u);
  EXPECT_EQ(scene.emission.row(2).parameter, 1u);
  EXPECT_EQ(scene.emission.row(4).program, kNone);
  // By power: as bright in the mean, whatever L.
  EXPECT_NEAR(scene.lights.row(0).radiance_g, scene.lights.row(4).radiance_g, 1e-3);
}

TEST_F(CompileEmission, EvenLightsHaveNoTables) {
  shape(uv_square()).area_light = area_light({color("L", 1, 2, 3)});
  const Scene scene = compile();
  EXPECT_EQ(scene.emission.size(), 0u);
  EXPECT_TRUE(scene.emission_programs.empty());
  EXPECT_EQ(scene.light_maps.size(), 0u);
}

TEST_F(CompileEmission, WhatCannotVarySaysSo) {
  shape(square()).area_light = area_light({texture("L", bilerp(1, 3))});
  compile();
  EXPECT_SAID(
      "scene.lxs:10:1: warning: the light's texture is mapped by uv, which the mesh has not: it "
      "has one colour");
}

TEST_F(CompileEmission, AProfileThatIsNotThereLeavesTheLightEven) {
  shape(square()).area_light = area_light({text("iesname", "no.ies")});
  const Scene scene = compile();
  EXPECT_EQ(scene.emission.size(), 0u);
  EXPECT_SAID(
      "scene.lxs:31:2: error: IES profile \"no.ies\" not found: area light shines without it");
}

}  // namespace
}  // namespace yat

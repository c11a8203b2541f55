// What scene text means: tokens, transforms, blocks, names.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/matrix.hpp>
#include <string>
#include <vector>

#include "scene_text.h"

namespace yat {
namespace {

constexpr uint32_t kNone = 0xffffffffu;

Matrix shape_matrix(const std::string& directives) {
  const ReadResult result = read_world(directives + " Shape \"s\"");
  EXPECT_TRUE(result.said.empty()) << result.said.front();
  return result.scene.shapes.at(0).to_world;
}

void expect_maps(const Matrix& m, glm::dvec3 from, glm::dvec3 to) {
  const glm::dvec4 p = m * glm::dvec4(from, 1);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(p[i], to[i], 1e-12) << i;
}

const Parameter& first(const ReadResult& result) {
  return result.scene.shapes.at(0).plugin.parameters.at(0);
}

TEST(SceneText, NumbersInEveryForm) {
  const ReadResult result = read_world(
      "Shape \"s\" \"float a\" [1 +1 -1 1. .5 -.5 1e3 1E-3 1e+2 0.000000000000000 1e-60 -1e-60 "
      "16777217 0.1]");
  EXPECT_TRUE(result.said.empty());
  EXPECT_EQ(first(result).floats, (std::vector<float>{1, 1, -1, 1, .5f, -.5f, 1e3f, 1e-3f, 1e2f, 0,
                                                      0, -0.f, 16777216, 0.1f}));
}

TEST(SceneText, IntegersAreExact) {
  const ReadResult result =
      read_world("Shape \"s\" \"integer a\" [16777217 -2147483648 +2147483647 5.0 1e3]");
  EXPECT_TRUE(result.said.empty());
  EXPECT_EQ(first(result).integers,
            (std::vector<int32_t>{16777217, INT32_MIN, INT32_MAX, 5, 1000}));
}

TEST(SceneText, StringsWithEscapes) {
  const ReadResult result = read_world(
      "Shape \"s\" \"string a\" [\"q\\\"q\" \"b\\\\b\" \"n\\nn\" \"t\\tt\" \"A\\066C\" \"x\\y\" "
      "\"two\\\nlines\" \"\" \"plain\"]");
  EXPECT_EQ(first(result).strings, (std::vector<std::string>{"q\"q", "b\\b", "n\nn", "t\tt", "ABC",
                                                             "xy", "twolines", "", "plain"}));
}

TEST(SceneText, LayoutMeansNothing) {
  const ReadResult result = read_text(
      "\xef\xbb\xbfWorldBegin#c\r\nShape\t\"s\"\r\" float   a \"[1#\"x\"\n2]\n\n\"float b\"3 "
      "WorldEnd");
  EXPECT_TRUE(result.said.empty()) << result.said.front();
  ASSERT_EQ(result.scene.shapes.size(), 1u);
  const Plugin& plugin = result.scene.shapes[0].plugin;
  EXPECT_EQ(plugin.parameters[0].name, "a");
  EXPECT_EQ(plugin.parameters[0].floats, (std::vector<float>{1, 2}));
  EXPECT_EQ(plugin.parameters[1].floats, (std::vector<float>{3}));
  // CRLF and CR each end one line.
  EXPECT_EQ(plugin.loc.line, 2u);
  EXPECT_EQ(plugin.loc.column, 1u);
  EXPECT_EQ(plugin.parameters[0].loc.line, 3u);
  EXPECT_EQ(plugin.parameters[1].loc.line, 6u);
}

TEST(SceneText, TransformsActRightmostFirst) {
  expect_maps(shape_matrix("Translate 1 2 3 Scale 2 2 2"), {1, 0, 0}, {3, 2, 3});
  expect_maps(shape_matrix("Scale 2 2 2 Translate 1 2 3"), {1, 0, 0}, {4, 4, 6});
  expect_maps(shape_matrix("Rotate 90 0 0 5"), {1, 0, 0}, {0, 1, 0});
  expect_maps(shape_matrix("Rotate 120 1 1 1"), {1, 2, 3}, {3, 1, 2});
  expect_maps(shape_matrix("Scale 9 9 9 Transform [1 0 0 0 0 1 0 0 0 0 1 0 5 6 7 1]"), {1, 0, 0},
              {6, 6, 7});
  expect_maps(shape_matrix("Scale 2 2 2 ConcatTransform [0 1 0 0 -1 0 0 0 0 0 1 0 5 6 7 1]"),
              {1, 0, 0}, {10, 14, 14});
  expect_maps(shape_matrix("Scale 9 9 9 Identity"), {1, 2, 3}, {1, 2, 3});
  expect_maps(shape_matrix("Translate 1 0 0 CoordinateSystem \"c\" Identity Scale 3 3 3 "
                           "CoordSysTransform \"c\""),
              {0, 0, 0}, {1, 0, 0});
}

TEST(SceneText, LookAtPutsXToTheRight) {
  const ReadResult result = read_text(
      "LookAt 0 -5 0 0 0 0 0 0 1 Camera \"perspective\" WorldBegin CoordSysTransform \"camera\" "
      "Shape \"s\" WorldEnd");
  EXPECT_TRUE(result.said.empty());
  const Matrix& m = result.scene.world_to_camera;
  expect_maps(m, {0, -5, 0}, {0, 0, 0});
  expect_maps(m, {1, -5, 0}, {1, 0, 0});
  expect_maps(m, {0, -5, 1}, {0, 1, 0});
  expect_maps(m, {0, 0, 0}, {0, 0, 5});
  expect_maps(result.scene.shapes[0].to_world, {0, 0, 5}, {0, 0, 0});
}

TEST(SceneText, WhatIsWrittenBeforeLookAtActsInCameraSpace) {
  const ReadResult result = read_text(
      "Scale -1 1 1 LookAt 0 -5 0 0 0 0 0 0 1 Camera \"perspective\" WorldBegin WorldEnd");
  expect_maps(result.scene.world_to_camera, {1, -5, 0}, {-1, 0, 0});
}

TEST(SceneText, DegenerateLookAtStillGivesAFrame) {
  for (const char* numbers :
       {"0 0 0 0 0 1 0 0 1", "0 0 0 0 1 0 0 -1 0", "1 2 3 1 2 3 0 0 1", "0 0 0 1 0 0 0 0 0",
        "0 0 0 1e-320 0 0 0 1e-320 0", "0 0 0 1e300 1e300 0 0 0 1e300"}) {
    const ReadResult result =
        read_text(std::string("LookAt ") + numbers + " Camera \"perspective\" WorldBegin WorldEnd");
    const glm::dmat3 m(result.scene.world_to_camera);
    const glm::dmat3 identity = m * glm::transpose(m);
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(identity[i / 3][i % 3], i % 4 == 0, 1e-12) << numbers;
    // x right, y up, z forward: left-handed, as LuxRender's camera space.
    EXPECT_NEAR(glm::determinant(m), -1, 1e-12) << numbers;
  }
}

TEST(SceneText, WorldBeginResetsTheTransformOnly) {
  const ReadResult result = read_text(
      "Translate 1 0 0 CoordinateSystem \"c\" WorldBegin Shape \"a\" CoordSysTransform \"c\" Shape "
      "\"b\" WorldEnd");
  EXPECT_EQ(result.scene.shapes[0].to_world, Matrix(1.0));
  expect_maps(result.scene.shapes[1].to_world, {0, 0, 0}, {1, 0, 0});
}

TEST(SceneText, AttributeBlocksSaveEverything) {
  const ReadResult result = read_world(
      "Material \"matte\" AttributeBegin Material \"glass\" AreaLightSource \"area\" "
      "ReverseOrientation Translate 1 0 0 Shape \"in\" Shape \"too\" AttributeEnd Shape \"out\"");
  EXPECT_TRUE(result.said.empty());
  const auto& shapes = result.scene.shapes;
  for (int i : {0, 1}) {
    EXPECT_EQ(shapes[size_t(i)].material, 1u);
    EXPECT_EQ(shapes[size_t(i)].area_light, 0u);
    EXPECT_TRUE(shapes[size_t(i)].reverse_orientation);
    expect_maps(shapes[size_t(i)].to_world, {0, 0, 0}, {1, 0, 0});
  }
  EXPECT_EQ(shapes[2].material, 0u);
  EXPECT_EQ(shapes[2].area_light, kNone);
  EXPECT_FALSE(shapes[2].reverse_orientation);
  EXPECT_EQ(shapes[2].to_world, Matrix(1.0));
}

TEST(SceneText, TransformBlocksSaveTheTransformOnly) {
  const ReadResult result = read_world(
      "TransformBegin Translate 1 0 0 Material \"glass\" ReverseOrientation TransformEnd Shape "
      "\"s\"");
  EXPECT_EQ(result.scene.shapes[0].to_world, Matrix(1.0));
  EXPECT_EQ(result.scene.shapes[0].material, 0u);
  EXPECT_TRUE(result.scene.shapes[0].reverse_orientation);
}

TEST(SceneText, MismatchedEndsUnwindToTheirBegin) {
  const ReadResult result = read_world(
      "AttributeBegin Translate 1 0 0 TransformBegin Translate 1 0 0 AttributeEnd Shape \"s\"");
  EXPECT_EQ(result.said.size(), 1u);
  EXPECT_EQ(result.scene.shapes[0].to_world, Matrix(1.0));
}

TEST(SceneText, NamesMeanWhatTheyMeantWhereTheyAreUsed) {
  const ReadResult result = read_world(
      "Texture \"t\" \"color\" \"one\"\n"
      "MakeNamedMaterial \"m\" \"string type\" [\"matte\"] \"texture Kd\" [\"t\"]\n"
      "NamedMaterial \"m\" Shape \"a\"\n"
      "AttributeBegin Texture \"t\" \"color\" \"two\"\n"
      "MakeNamedMaterial \"m\" \"string type\" [\"matte\"] \"texture Kd\" [\"t\"]\n"
      "Shape \"b\" NamedMaterial \"m\" Shape \"c\" AttributeEnd\n"
      "NamedMaterial \"m\" Shape \"d\"");
  const Description& scene = result.scene;
  EXPECT_EQ(scene.materials[0].plugin.parameters[0].texture, 0u);
  EXPECT_EQ(scene.materials[1].plugin.parameters[0].texture, 1u);
  const uint32_t expected[] = {0, 0, 1, 0};
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(scene.shapes[i].material, expected[i]) << i;
}

TEST(SceneText, MaterialsAreMadeOfWhatIsVisibleThere) {
  const ReadResult result = read_world(
      "MakeNamedMaterial \"a\" \"string type\" [\"matte\"]\n"
      "AttributeBegin MakeNamedMaterial \"b\" \"string type\" [\"glass\"]\n"
      "Material \"mix\" \"string namedmaterial1\" [\"a\"] \"string namedmaterial2\" [\"b\"]\n"
      "MakeNamedMaterial \"a\" \"string type\" [\"doubleside\"] \"string frontnamedmaterial\" "
      "[\"a\"] "
      "\"string backnamedmaterial\" [\"b\"] AttributeEnd\n"
      "Material \"mix\" \"string namedmaterial1\" [\"a\"] \"string namedmaterial2\" [\"b\"]\n"
      "Material \"matte\" \"string namedmaterial1\" [\"nobody\"]");
  const auto child = [&](size_t material, size_t parameter) {
    return result.scene.materials[material].plugin.parameters[parameter].material;
  };
  ASSERT_EQ(result.scene.materials.size(), 6u);
  EXPECT_EQ(child(2, 0), 0u);
  EXPECT_EQ(child(2, 1), 1u);
  EXPECT_EQ(child(3, 0), 0u) << "of itself it is not made";
  EXPECT_EQ(child(4, 0), 0u) << "the inner a has gone";
  EXPECT_EQ(child(4, 1), kNone);
  EXPECT_EQ(child(5, 0), kNone) << "not asked for";
  ASSERT_EQ(result.said.size(), 2u);
  EXPECT_EQ(
      result.said[1],
      "t.lxs:6:46: error: no material \"b\", it was defined at t.lxs:3:16 in a block that has "
      "ended, define it outside, for \"namedmaterial2\"");
}

TEST(SceneText, TextureKindsAreSeparateNameSpaces) {
  const ReadResult result = read_world(
      "Texture \"t\" \"float\" \"constant\" Texture \"t\" \"color\" \"constant\" Texture \"t\" "
      "\"fresnel\" \"constant\" Texture \"g\" \"float\" \"constant\"\n"
      "Material \"x\" \"texture sigma\" [\"t\"] \"texture Kd\" [\"t\"] \"texture fresnel\" [\"t\"] "
      "\"texture bumpmap\" [\"t\"] \"texture Ks\" [\"g\"]\n"
      "Texture \"u\" \"float\" \"scale\" \"texture tex1\" [\"t\"]");
  EXPECT_TRUE(result.said.empty());
  const auto& p = result.scene.materials[0].plugin.parameters;
  EXPECT_EQ(p[0].texture, 0u);
  EXPECT_EQ(p[1].texture, 1u);
  EXPECT_EQ(p[2].texture, 2u);
  EXPECT_EQ(p[3].texture, 0u);
  EXPECT_EQ(p[4].texture, 3u);  // of another kind: the compiler decides
  EXPECT_EQ(result.scene.textures[4].plugin.parameters[0].texture, 0u);
}

TEST(SceneText, ObjectsAndInstances) {
  const ReadResult result = read_world(
      "Translate 1 0 0 ObjectBegin \"o\" Material \"glass\" Scale 2 2 2 Shape \"a\" Shape \"b\" "
      "ObjectEnd Shape \"c\" ObjectInstance \"o\" Material \"matte\" Translate 0 1 0 "
      "ObjectInstance \"o\"");
  EXPECT_TRUE(result.said.empty());
  const Description& scene = result.scene;
  EXPECT_EQ(scene.shapes[0].object, 0u);
  EXPECT_EQ(scene.shapes[1].object, 0u);
  EXPECT_EQ(scene.shapes[2].object, kNone);
  expect_maps(scene.shapes[0].to_world, {1, 0, 0}, {3, 0, 0});
  expect_maps(scene.instances[0].to_world, {0, 0, 0}, {1, 0, 0});
  EXPECT_EQ(scene.instances[0].material, kNone);
  EXPECT_EQ(scene.instances[1].material, 1u);
  expect_maps(scene.instances[1].to_world, {0, 0, 0}, {1, 1, 0});
}

TEST(SceneText, OfAMovingTransformTheFirstCounts) {
  const ReadResult result = read_world(
      "Translate 1 0 0 MotionBegin [0 1] Translate 0 1 0 Translate 0 9 0 MotionEnd Translate 0 0 1 "
      "Shape \"s\"");
  expect_maps(result.scene.shapes[0].to_world, {0, 0, 0}, {1, 1, 1});
}

}  // namespace
}  // namespace yat

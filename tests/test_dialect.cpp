// YART's rules beside LuxRender's: the same text, read and compiled by both.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render_scenes.h"
#include "scene/compile_parts.h"

namespace yat {
namespace {

constexpr std::string_view kTriangle =
    "Shape \"mesh\" \"integer triindices\" [0 1 2] \"point P\" [0 0 0 1 0 0 0 1 0]\n";

struct Read {
  Description scene;
  std::vector<std::string> said;
};
Read read(const std::string& text, Dialect dialect) {
  Read result;
  Diagnostics diagnostics([&](Severity, std::string_view line) { result.said.emplace_back(line); });
  result.scene = parse_scene(text, "t.lxs", "", diagnostics, false, dialect);
  return result;
}
Read read_world(const std::string& text, Dialect dialect) {
  return read("WorldBegin\n" + text + "WorldEnd\n", dialect);
}

glm::dvec3 apply(const Matrix& m, glm::dvec3 p) {
  return glm::dvec3(m * glm::dvec4(p, 1));
}

// ---- State -------------------------------------------------------------------------------------

TEST(DialectState, AMaterialAndALampAreForOneShapeInYart) {
  const std::string text = "Material \"mirror\"\nAreaLightSource \"area\"\n" +
                           std::string(kTriangle) + std::string(kTriangle);
  const Read lux = read_world(text, Dialect::kLuxRender), yart = read_world(text, Dialect::kYart);
  EXPECT_EQ(lux.scene.shapes[1].material, 0u);
  EXPECT_EQ(lux.scene.shapes[1].area_light, 0u);
  EXPECT_TRUE(lux.scene.dialect_hints.empty());
  EXPECT_EQ(yart.scene.shapes[0].material, 0u);
  EXPECT_EQ(yart.scene.shapes[0].area_light, 0u);
  EXPECT_EQ(yart.scene.shapes[1].material, kNone);
  EXPECT_EQ(yart.scene.shapes[1].area_light, kNone);
  // The second shape is not what LuxRender would make of it: said once, with its place.
  ASSERT_EQ(yart.scene.dialect_hints.size(), 1u);
  EXPECT_EQ(yart.scene.dialect_hints[0].loc.line, 5u);
}

TEST(DialectState, BlocksSaveTheTransformAloneInYart) {
  const std::string text =
      "AttributeBegin\nTranslate 1 2 3\n"
      "Texture \"t\" \"color\" \"constant\" \"color value\" [.1 .2 .3]\n"
      "MakeNamedMaterial \"m\" \"string type\" [\"matte\"] \"texture Kd\" [\"t\"]\n"
      "NamedMaterial \"m\"\nAttributeEnd\n" +
      std::string(kTriangle) + "NamedMaterial \"m\"\n" + std::string(kTriangle);
  const Read lux = read_world(text, Dialect::kLuxRender), yart = read_world(text, Dialect::kYart);
  EXPECT_EQ(lux.scene.shapes[0].material, kNone);
  EXPECT_EQ(lux.scene.shapes[1].material, kNone);  // "m" is out of sight, with an error
  EXPECT_EQ(lux.said.size(), 1u);
  EXPECT_EQ(yart.scene.shapes[0].material, 0u);
  EXPECT_EQ(yart.scene.shapes[0].to_world, Matrix(1.));
  EXPECT_EQ(yart.scene.shapes[1].material, 0u);
  EXPECT_TRUE(yart.said.empty());
}

TEST(DialectState, ObjectsAreDrawnWhereTheyAreInYart) {
  const std::string text = "ObjectBegin \"o\"\nTranslate 1 0 0\n" + std::string(kTriangle) +
                           "ObjectEnd\n" + std::string(kTriangle) + "ObjectInstance \"o\"\n";
  const Read yart = read_world(text, Dialect::kYart);
  EXPECT_EQ(yart.scene.shapes[0].object, kNone);
  EXPECT_EQ(yart.scene.shapes[0].to_world[3][0], 1);
  EXPECT_EQ(yart.scene.shapes[1].to_world, Matrix(1.));
  EXPECT_TRUE(yart.scene.instances.empty());
  ASSERT_EQ(yart.said.size(), 1u);
  EXPECT_NE(yart.said[0].find("t.lxs:7:1: error: ObjectInstance is ignored"), std::string::npos);
}

TEST(DialectState, NamesOfParametersMatchInAnyCaseInYart) {
  const std::string text =
      "MakeNamedMaterial \"M\" \"string Type\" [\"matte\"] \"color kd\" [.1 .2 .3]\n"
      "NamedMaterial \"m\"\n" +
      std::string(kTriangle);
  const Read yart = read_world(text, Dialect::kYart);
  EXPECT_TRUE(yart.said.empty());
  ASSERT_EQ(yart.scene.materials.size(), 1u);
  EXPECT_EQ(yart.scene.materials[0].plugin.type, "matte");
  EXPECT_EQ(yart.scene.shapes[0].material, 0u);
  Diagnostics diagnostics([](Severity, std::string_view line) { ADD_FAILURE() << line; });
  Parameters p(yart.scene.materials[0].plugin, "matte", diagnostics);
  EXPECT_FLOAT_EQ(float(p.triple("Kd", ParameterType::kColor, glm::dvec3(0)).y), .2f);
  p.report_unused();
  EXPECT_EQ(read_world(text, Dialect::kLuxRender).said.size(), 2u);  // no type, no "m"
}

// ---- Transforms --------------------------------------------------------------------------------

TEST(DialectTransforms, YartAppliesTheFirstWrittenFirst) {
  // The bunny's: Scale, Rotate, Translate.
  const std::string text =
      "Scale 15 15 15\nRotate 90 1 0 0\nTranslate 0.2 0.4 -0.8\n" + std::string(kTriangle);
  const glm::dvec3 p(.1, .2, .3);
  const glm::dvec3 yart = apply(read_world(text, Dialect::kYart).scene.shapes[0].to_world, p);
  EXPECT_NEAR(yart.x, 15 * .1 + .2, 1e-12);
  EXPECT_NEAR(yart.y, -15 * .3 + .4, 1e-12);
  EXPECT_NEAR(yart.z, 15 * .2 - .8, 1e-12);
  const Read lux = read_world(text, Dialect::kLuxRender);
  const glm::dvec3 other = apply(lux.scene.shapes[0].to_world, p);
  EXPECT_NEAR(other.x, 15 * (.1 + .2), 1e-12);
  EXPECT_NEAR(other.y, -15 * (.3 - .8), 1e-12);
  EXPECT_NEAR(other.z, 15 * (.2 + .4), 1e-12);
  // Where the order matters LuxRender's rules point to YART's: once in a file.
  ASSERT_EQ(lux.scene.dialect_hints.size(), 1u);
  EXPECT_EQ(lux.scene.dialect_hints[0].loc.line, 4u);  // Scale and Rotate commute
  EXPECT_TRUE(
      read_world("Translate 1 0 0\nTranslate 0 1 0\n" + std::string(kTriangle), Dialect::kLuxRender)
          .scene.dialect_hints.empty());
}

TEST(DialectTransforms, YartTurnsAboutTruncatedAxesOneAfterTheOther) {
  const auto turned = [](const std::string& rotate) {
    return apply(
        read_world(rotate + std::string(kTriangle), Dialect::kYart).scene.shapes[0].to_world,
        {1, 2, 3});
  };
  // x by 90: (1, -3, 2); then z by 90: (3, 1, 2). Negative components turn the same way.
  for (const char* rotate : {"Rotate 90 1 0 1\n", "Rotate 90 -1.9 0.9 1.2\n"}) {
    const glm::dvec3 p = turned(rotate);
    EXPECT_NEAR(p.x, 3, 1e-12);
    EXPECT_NEAR(p.y, 1, 1e-12);
    EXPECT_NEAR(p.z, 2, 1e-12);
  }
  EXPECT_EQ(turned("Rotate 90 .5 .5 0\n"), glm::dvec3(1, 2, 3));
}

TEST(DialectTransforms, YartsCameraSeesLookAtAlone) {
  const std::string text =
      "Scale -1 1 1\nLookAt 0 -5 0 0 0 0 0 0 1\nTranslate 7 0 0\nCamera \"perspective\"\n"
      "WorldBegin\n" +
      std::string(kTriangle) + "WorldEnd\n";
  const Matrix yart = read(text, Dialect::kYart).scene.world_to_camera;
  EXPECT_NEAR(apply(yart, {2, 0, 1}).x, 2, 1e-12);
  EXPECT_NEAR(apply(yart, {2, 0, 1}).z, 5, 1e-12);
  EXPECT_NEAR(apply(read(text, Dialect::kLuxRender).scene.world_to_camera, {2, 0, 1}).x, -9, 1e-12);
}

TEST(DialectHints, TypesThatOnlyYartHasSuggestItsRules) {
  const Read lux = read(
      "Camera \"fisheye\"\nFilm \"fleximage\" \"string tonemapkernel\" [\"outofgamut\"]\n"
      "WorldBegin\nShape \"plane\"\nWorldEnd\n",
      Dialect::kLuxRender);
  ASSERT_EQ(lux.scene.dialect_hints.size(), 1u);  // one of a sort
  EXPECT_NE(lux.scene.dialect_hints[0].message.find("Camera \"fisheye\""), std::string::npos);
  EXPECT_NE(lux.scene.dialect_hints[0].message.find("--compat yart"), std::string::npos);
  EXPECT_TRUE(
      read("WorldBegin\nShape \"plane\"\nWorldEnd\n", Dialect::kYart).scene.dialect_hints.empty());
}

// ---- What is compiled --------------------------------------------------------------------------

constexpr std::string_view kView =
    "LookAt 0 0 -5 0 0 0 0 1 0\nCamera \"perspective\" \"float screenwindow\" [-1 1 -.5 .5]\n"
    "Film \"fleximage\" \"integer xresolution\" [40] \"integer yresolution\" [40]\nWorldBegin\n";

Scene compile(const std::string& world, Dialect dialect, CompileOptions options = {},
              std::vector<std::string>* said = nullptr) {
  Diagnostics diagnostics([&](Severity severity, std::string_view line) {
    if (!said)
      fail_at_warnings(severity, line);
    else if (severity != Severity::kNote)
      said->emplace_back(line);
  });
  options.colour = ColourMode::kRgb;
  ThreadPool pool(1);
  const Description description = parse_scene(std::string(kView) + world + "WorldEnd\n", "t.lxs",
                                              "", diagnostics, false, dialect);
  return compile_scene(description, options, pool, diagnostics);
}

constexpr std::string_view kLitQuad =
    "AreaLightSource \"area\" \"color L\" [1 .5 .25] \"float gain\" [2]\n"
    "Shape \"mesh\" \"integer triindices\" [0 1 2 0 2 3] \"point P\" [0 0 0 2 0 0 2 2 0 0 2 0]\n";

TEST(DialectLights, AnAreaLightIsAsBrightWhateverItsAreaInYart) {
  const Scene scene = compile(std::string(kLitQuad), Dialect::kYart);
  // gain * power * efficacy / 100 with the defaults 100 and 17.
  EXPECT_FLOAT_EQ(scene.lights.row(0).radiance_r, 34);
  EXPECT_FLOAT_EQ(scene.lights.row(0).radiance_b, 34 / 4.f);
  std::vector<std::string> stretched;
  const double y = .21264 + .71517 / 2 + .07219 / 4;
  EXPECT_NEAR(
      compile(std::string(kLitQuad), Dialect::kLuxRender, {}, &stretched).lights.row(0).radiance_r,
      2 * 1700 / (4 * std::numbers::pi * y), 1e-3);
  EXPECT_EQ(stretched.size(), 1u);  // the window's aspect
  const Scene plain = compile(
      "AreaLightSource \"area\" \"float power\" [0] \"float efficacy\" [0] "
      "\"float gain\" [3]\n" +
          std::string(kTriangle),
      Dialect::kYart);
  EXPECT_FLOAT_EQ(plain.lights.row(0).radiance_g, 3);
}

constexpr std::string_view kPoint =
    "Translate 1 0 0\nScale 2 2 2\nLightSource \"point\" \"point from\" [0 0 3] \"float gain\" "
    "[2]\n";

TEST(DialectLights, PointsDoNotFallOffInYartsRayTracer) {
  CompileOptions direct;
  direct.direct_only = true;
  const Scene scene = compile(std::string(kPoint) + std::string(kTriangle), Dialect::kYart, direct);
  ASSERT_EQ(scene.lights.size(), 1u);
  const LightRow<Value> row = scene.lights.row(0);
  EXPECT_EQ(LightKind(row.kind), LightKind::kPoint);
  EXPECT_EQ(row.b_x, 0);
  EXPECT_EQ(row.b_y, 1);
  EXPECT_FLOAT_EQ(row.radiance_r, 34);
  // At CTM * from: scaled after the move, as YART orders them.
  EXPECT_NEAR(double(row.a_x) + scene.center.x, 2, 1e-5);
  EXPECT_NEAR(double(row.a_z) + scene.center.z, 6, 1e-5);
}

TEST(DialectLights, PointsAreSmallSpheresInYartsPathTracer) {
  const Scene scene = compile(std::string(kPoint) + std::string(kTriangle), Dialect::kYart);
  ASSERT_EQ(scene.spheres.size(), 1u);
  const SphereRow<Value> sphere = scene.spheres.row(0);
  EXPECT_FLOAT_EQ(sphere.radius, .05f);
  EXPECT_NEAR(double(sphere.center_x) + scene.center.x, 2, 1e-5);
  EXPECT_NEAR(double(sphere.center_z) + scene.center.z, 0, 1e-5);
  ASSERT_NE(sphere.light, kNone);
  EXPECT_EQ(LightKind(scene.lights.row(0).kind), LightKind::kSphere);
  EXPECT_FLOAT_EQ(scene.lights.row(0).radiance_r, 34);
}

TEST(DialectLights, ShadowRaysOfAHitAreTheSumOfNsamples) {
  const std::string world = "AreaLightSource \"area\" \"integer nsamples\" [100]\n" +
                            std::string(kTriangle) +
                            "AreaLightSource \"area\" \"integer nsamples\" [7]\n" +
                            std::string(kTriangle) + "LightSource \"point\"\n";
  CompileOptions direct;
  direct.direct_only = true;
  EXPECT_EQ(compile(world, Dialect::kYart, direct).light_samples, 108u);
}

TEST(DialectMaterials, SurfacesWithoutAMaterialAndNullOnesAreYartsGrey) {
  const Scene scene = compile("Material \"null\"\n" + std::string(kLitQuad), Dialect::kYart);
  ASSERT_EQ(scene.parameter_rows[uint32_t(MaterialKind::kMatte)], 1u);
  EXPECT_EQ(scene.parameter_rows[uint32_t(MaterialKind::kNull)], 0u);
  float kd = 0;
  std::memcpy(&kd, scene.parameters[uint32_t(MaterialKind::kMatte)].data(), sizeof kd);
  EXPECT_FLOAT_EQ(kd, .375f);
  EXPECT_TRUE(scene.all_occlude);
}

TEST(DialectShapes, AMeshWithoutNormalsIsSmoothInYart) {
  // Two faces at a right angle, one twice as large: the shared vertices lean to it.
  const std::string bent =
      "Shape \"mesh\" \"integer triindices\" [0 1 2 1 0 3] "
      "\"point P\" [0 0 0 1 0 0 0 2 0 0 0 1]\n";
  const Scene yart = compile(bent + "LightSource \"point\"\n", Dialect::kYart);
  ASSERT_EQ(yart.triangle_vertices.size(), 2u);
  // Cross products (0, 0, 2) and (0, -1, 0)... of [1 0 3]: (0-1,0,0) x (-1,0,1) = (0, 1, 0).
  const TriangleVertexRow<Value> row = yart.triangle_vertices.row(0);
  const float length = std::sqrt(5.f);
  EXPECT_NEAR(row.n0_x, 0, 1e-6);
  EXPECT_NEAR(row.n0_y, 1 / length, 1e-6);
  EXPECT_NEAR(row.n0_z, 2 / length, 1e-6);
  EXPECT_NEAR(row.n2_z, 1, 1e-6);
  std::vector<std::string> said;
  EXPECT_EQ(compile(bent + "LightSource \"point\"\n", Dialect::kLuxRender, {}, &said)
                .triangle_vertices.size(),
            0u);
}

TEST(DialectCamera, PixelsAreSquareInYart) {
  const Scene scene = compile(std::string(kLitQuad), Dialect::kYart);
  const CameraView& c = scene.camera;
  // fov 90: the shorter side of the window, 1 wide, over 40 pixels, both ways.
  const auto length = [](const float* v) { return std::hypot(v[0], v[1], v[2]); };
  EXPECT_NEAR(length(c.dx), 1. / 40, 1e-7);
  EXPECT_NEAR(length(c.dy), 1. / 40, 1e-7);
  EXPECT_NEAR(std::hypot(c.corner[0], c.corner[1]), .5 * std::sqrt(2.), 1e-6);
}

TEST(DialectFilm, TheDefaultKernelIsYartsLinear) {
  const Scene scene = compile(std::string(kLitQuad), Dialect::kYart);
  EXPECT_EQ(scene.film.tone_map, ToneMap::kYartLinear);
  // YART knows no pixel filters.
  EXPECT_EQ(scene.filter.kind, FilterKind::kBox);
  EXPECT_EQ(scene.filter.radius_x, .5f);
}

// ---- A picture ---------------------------------------------------------------------------------

// A floor under a point without fall-off: radiance Kd / pi L cos, the same at any height.
TEST(DialectPicture, YartsPointLightsByTheCosineAlone) {
  for (const double height : {2., 8.}) {
    CompileOptions options;
    options.direct_only = true;
    Diagnostics diagnostics([](Severity, std::string_view line) { ADD_FAILURE() << line; });
    const std::string text =
        "LookAt 0 0 5 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" [.1]\n"
        "PixelFilter \"box\"\nFilm \"fleximage\" \"integer xresolution\" [1] \"integer "
        "yresolution\" "
        "[1]\nWorldBegin\nMaterial \"matte\" \"color Kd\" [.5 .4 .3]\nShape \"plane\"\n"
        "LightSource \"point\" \"point from\" [" +
        std::to_string(height) + " 0 " + std::to_string(height) +
        "] \"float power\" [0] \"float efficacy\" [0]\nWorldEnd\n";
    ThreadPool pool(1);
    options.colour = ColourMode::kRgb;
    const KernelTable& kernels = select_kernels("");
    options.block_width = kernels.lanes;
    const Scene scene =
        compile_scene(parse_scene(text, "t.lxs", "", diagnostics, false, Dialect::kYart), options,
                      pool, diagnostics);
    PlanOptions plan;
    plan.integrator = Integrator::kDirect;
    const std::vector<float> rgb =
        render_film(scene, make_plan(scene, kernels, plan), 0, 16).resolve();
    EXPECT_NEAR(double(rgb[0]), .5 / std::numbers::pi * std::sqrt(.5), 1e-3);
    EXPECT_NEAR(double(rgb[2]), .3 / std::numbers::pi * std::sqrt(.5), 1e-3);
  }
}

}  // namespace
}  // namespace yat

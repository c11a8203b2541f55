// Textures -> programs: shapes, constants, ranges, messages.

#include <cmath>
#include <cstring>

#include "kernels/textures/all.h"
#include "scene/spectrum.h"
#include "scene_builder.h"
#include "texture_images.h"

namespace yat {
namespace {

class CompileTextures : public SceneTest {
 protected:
  CompileTextures() {
    light(plugin("point", {}));
    const std::string file =
        write_image("compile", "picture.png", 4, 4, 3, OIIO::TypeDesc::UINT8,
                    [](int x, int y, int) { return float(x + 4 * y) * 16 / 255; });
    description.directory = std::filesystem::path(file).parent_path().string();
  }
  /// Adds a texture; returns its row.
  uint32_t add(std::string kind, Plugin p) {
    description.textures.push_back({"t" + std::to_string(description.textures.size()),
                                    std::move(kind), std::move(p), Matrix(1.)});
    return uint32_t(description.textures.size() - 1);
  }
  Plugin picture(std::vector<Parameter> more = {}) {
    more.push_back(text("filename", "picture.png"));
    return plugin("imagemap", std::move(more));
  }
  void square_of(Plugin m) {
    Plugin p = square();
    p.parameters.push_back(numbers(ParameterType::kFloat, "uv", {0, 0, 1, 0, 1, 1, 0, 1}));
    shape(std::move(p)).material = material(std::move(m));
  }
  static std::vector<StepKind> kinds(const std::vector<TextureStep>& steps) {
    std::vector<StepKind> out;
    for (const TextureStep& step : steps) out.push_back(step.kind);
    return out;
  }
  template <template <template <class> class> class Record>
  static Record<Value> constants(const TextureStep& step, uint32_t row) {
    Record<Value> out;
    for_each_field(
        [&](auto i, auto& field) {
          std::memcpy(&field, step.constants.data() + row * row_words<Record> + i, 4);
        },
        out);
    return out;
  }
};

TEST_F(CompileTextures, MaterialsOfOneShapeShareAProgram) {
  for (const float gamma : {2.2f, 1.8f})
    square_of(plugin("matte", {texture("Kd", add("color", picture({number("gamma", gamma)})))}));
  square_of(
      plugin("matte",
             {texture("Kd", add("color", picture({text("wrap", "black"), number("gamma", 2)})))}));
  const Scene scene = compile();
  EXPECT_SILENT();
  ASSERT_EQ(scene.programs.size(), 2u);  // wraps differ: another shape
  const TextureProgram& p = scene.programs[0];
  EXPECT_EQ(p.rows, 2u);
  EXPECT_EQ(kinds(p.steps),
            (std::vector{StepKind::kMapSurface, StepKind::kImage, StepKind::kBands}));
  EXPECT_EQ(p.steps[0].rows, 1u);  // the same for both
  // Gamma acts on bands.
  EXPECT_EQ(p.steps[1].rows, 1u);
  EXPECT_EQ(constants<ImageParameters>(p.steps[1], 0).gamma, 1.f);
  ASSERT_EQ(p.steps[2].rows, 2u);
  EXPECT_EQ(p.steps[2].variant, kBandsRaised);
  EXPECT_EQ(constants<BandsParameters>(p.steps[2], 0).gamma, 2.2f);
  EXPECT_EQ(constants<BandsParameters>(p.steps[2], 1).gamma, 1.8f);
  EXPECT_EQ(scene.texels.images, 1u);  // one file
  EXPECT_EQ(constants<ImageParameters>(p.steps[1], 0).width, 4u);
  // Three fields of a matte, all from the texture; the square keeps its texture coordinates.
  EXPECT_EQ(p.fields.size(), 3u);
  EXPECT_EQ(scene.bins[scene.prim_bin[0]].geometry, GeometryKind::kTriangleVertex);
  EXPECT_EQ(scene.bins[scene.prim_bin[0]].program, 0u);
  EXPECT_EQ(scene.prim_bin[0], scene.prim_bin[2]);
  EXPECT_EQ(scene.triangles.row(2).parameter, 1u);
  EXPECT_EQ(scene.parameter_rows[uint32_t(MaterialKind::kMatte)], 0u);
}

TEST_F(CompileTextures, ConstantsLeaveNoProgram) {
  const uint32_t one = add("color", plugin("constant", {color("value", .5f, .4f, .3f)}));
  const uint32_t two =
      add("color", plugin("scale", {texture("tex1", one), color("tex2", 1, .5f, 1)}));
  const uint32_t check =
      add("float", plugin("checkerboard", {number("tex1", .3f), number("tex2", .3f)}));
  const uint32_t three =
      add("color",
          plugin("mix", {texture("tex1", two), color("tex2", 0, 0, 0), texture("amount", check)}));
  square_of(plugin("matte", {texture("Kd", three)}));
  options.colour = ColourMode::kRgb;
  const Scene scene = compile();
  EXPECT_SILENT();
  EXPECT_TRUE(scene.programs.empty());
  ASSERT_EQ(scene.parameter_rows[uint32_t(MaterialKind::kMatte)], 1u);
  float kd[3];
  std::memcpy(kd, scene.parameters[uint32_t(MaterialKind::kMatte)].data(), sizeof kd);
  EXPECT_FLOAT_EQ(kd[0], .5f * .7f);
  EXPECT_FLOAT_EQ(kd[1], .2f * .7f);
  EXPECT_FLOAT_EQ(kd[2], .3f * .7f);
}

TEST_F(CompileTextures, OnlyWhatCanLeaveItsRangeIsClamped) {
  const uint32_t image = add("color", picture());
  const uint32_t bright = add("color", picture({number("gain", 2)}));
  const uint32_t dim =
      add("color", plugin("scale", {texture("tex1", image), color("tex2", .5f, .5f, .5f)}));
  square_of(plugin("matte", {texture("Kd", dim)}));
  square_of(plugin("matte", {texture("Kd", bright)}));
  const Scene scene = compile();
  ASSERT_EQ(scene.programs.size(), 2u);
  EXPECT_EQ(scene.programs[0].steps.back().kind, StepKind::kArithmetic);
  EXPECT_EQ(scene.programs[1].steps.back().kind, StepKind::kClamp);
  EXPECT_SILENT();
}

TEST_F(CompileTextures, TheOtherKindIsConvertedWithAWarning) {
  const uint32_t number = add("float", picture()), colour = add("color", picture());
  square_of(plugin("matte", {texture("Kd", number), texture("sigma", colour)}));
  const Scene scene = compile();
  ASSERT_EQ(scene.programs.size(), 1u);
  const TextureProgram& p = scene.programs[0];
  EXPECT_EQ(p.material, MaterialKind::kOrenNayar);
  ASSERT_EQ(p.fields.size(), 4u);
  EXPECT_EQ(p.fields[0].column, p.fields[2].column);  // grey
  EXPECT_SAID(
      "scene.lxs:11:2: warning: texture \"t0\" for \"Kd\" is a float texture where a color is "
      "wanted: it is used as a grey");
  EXPECT_SAID(
      "scene.lxs:12:2: warning: texture \"t1\" for \"sigma\" is a color texture where a float is "
      "wanted: its luminance is used");
}

TEST_F(CompileTextures, MeshesWithoutCoordinatesAreNamed) {
  shape(square()).material = material(plugin("matte", {texture("Kd", add("color", picture()))}));
  compile();
  EXPECT_SAID(
      "scene.lxs:10:1: warning: the material's texture is mapped by uv, which the mesh has not: it "
      "has one colour");
}

TEST_F(CompileTextures, PositionsAreAboutTheSceneCentre) {
  const uint32_t planar =
      add("color", picture({text("mapping", "planar"), number("udelta", .25f)}));
  square_of(plugin("matte", {texture("Kd", planar)}));
  description.shapes.back().to_world = glm::translate(Matrix(1.), glm::dvec3(1000, 0, 0));
  const Scene scene = compile();
  ASSERT_EQ(scene.programs.size(), 1u);
  EXPECT_EQ(scene.center.x, 1000);
  const auto p = constants<MapPlanarParameters>(scene.programs[0].steps[0], 0);
  EXPECT_EQ(p.s_x, 1);
  EXPECT_EQ(p.s_delta, 1000.25f);
  EXPECT_EQ(scene.programs[0].uv, UvUse::kUnread);
}

TEST_F(CompileTextures, MipsAskForFootprints) {
  square_of(plugin(
      "matte", {texture("Kd", add("color", picture({text("filtertype", "mipmap_trilinear")})))}));
  const Scene scene = compile();
  ASSERT_EQ(scene.programs.size(), 1u);
  EXPECT_TRUE(scene.programs[0].derivatives);
  EXPECT_EQ(scene.programs[0].steps[0].out.size(), 4u);
  EXPECT_EQ(constants<ImageParameters>(scene.programs[0].steps[1], 0).last_level, 2);
}

TEST_F(CompileTextures, BumpsHaveStepsOfTheirOwn) {
  const uint32_t height =
      add("float", plugin("scale", {texture("tex1", add("float", picture({number("uscale", 2)}))),
                                    number("tex2", .01f)}));
  square_of(plugin("mirror", {texture("bumpmap", height)}));
  square_of(plugin(
      "matte",
      {texture("bumpmap", add("float", plugin("normalmap", {text("filename", "picture.png")})))}));
  const Scene scene = compile();
  EXPECT_SILENT();
  ASSERT_EQ(scene.programs.size(), 2u);
  const TextureProgram& p = scene.programs[0];
  EXPECT_TRUE(p.steps.empty());
  EXPECT_TRUE(p.derivatives);
  EXPECT_FALSE(p.normal_map);
  ASSERT_EQ(p.bump_steps.size(), 4u);
  float bump[3];
  std::memcpy(bump, p.bump.data(), sizeof bump);
  EXPECT_EQ(bump[0], .001f);
  EXPECT_EQ(bump[1], 1.f / 8);  // a texel: 4 across half a unit
  EXPECT_EQ(bump[2], 1.f / 4);
  EXPECT_TRUE(scene.programs[1].normal_map);
}

TEST_F(CompileTextures, Messages) {
  square_of(plugin("matte", {texture("Kd", add("color", picture({text("wrap", "repeats"),
                                                                 text("filtertype", "mipmap_ewa"),
                                                                 text("mapping", "uvv")})))}));
  square_of(plugin("matte", {texture("Kd", add("color", plugin("blender_clouds", {})))}));
  compile();
  EXPECT_SAID(
      "scene.lxs:11:2: warning: texture \"t0\": unknown wrap \"repeats\" (did you mean "
      "\"repeat\"?): repeat is used");
  EXPECT_SAID("scene.lxs:12:2: note: filtertype \"mipmap_ewa\": filtered as \"mipmap_trilinear\"");
  EXPECT_SAID(
      "scene.lxs:13:2: error: texture \"t0\": unknown mapping \"uvv\" (did you mean \"uv\"?): uv "
      "is "
      "used");
  EXPECT_SAID(
      "scene.lxs:10:1: warning: texture \"t1\": \"blender_clouds\" is made of Perlin's noise "
      "instead "
      "of \"blender_original\": it looks alike, but is not the same");
}

// ---- Spectra -----------------------------------------------------------------------------------

TEST(Spectra, FlatReflectanceIsWhite) {
  const glm::dvec3 rgb = rgb_of_reflectance([](double) { return .5; });
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(rgb[k], .5, 1e-12);
}

/// lxs A.1: linear Rec.709 of black bodies scaled to Y = 1, and Y.
TEST(Spectra, BlackBodiesHaveTheirColour) {
  struct Row {
    double kelvin, y, r, g, b;
  };
  for (const Row& row : {Row{2000, 16443, 2.517, .648, .021}, Row{3000, 38296, 1.770, .845, .272},
                         Row{5000, 71724, 1.213, .961, .762}, Row{6500, 64650, 1.043, .984, 1.035},
                         Row{10000, 38011, .871, .995, 1.430}}) {
    const glm::dvec3 rgb = rgb_of_light(blackbody_curve(row.kelvin));
    const double y = .21264 * rgb.x + .71517 * rgb.y + .07219 * rgb.z;
    EXPECT_NEAR(y / row.y, 1, .01) << row.kelvin;
    EXPECT_NEAR(rgb.x / y, row.r, .03 * std::max(1., row.r)) << row.kelvin;
    EXPECT_NEAR(rgb.y / y, row.g, .02) << row.kelvin;
    EXPECT_NEAR(rgb.z / y, row.b, .03) << row.kelvin;
  }
}

}  // namespace
}  // namespace yat

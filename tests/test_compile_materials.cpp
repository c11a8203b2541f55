// Materials and constant textures: parameter rows, fallbacks, messages.

#include <cmath>
#include <cstring>

#include "kernels/materials/all.h"
#include "scene/compile_fresnel.h"
#include "scene_builder.h"

namespace yat {
namespace {

template <template <template <class> class> class Record>
Record<Value> row_of(const Scene& scene, MaterialKind kind, uint32_t row = 0) {
  Record<Value> out;
  EXPECT_LT(row, scene.parameter_rows[uint32_t(kind)]);
  for_each_field(
      [&](auto index, auto& field) {
        std::memcpy(&field, &scene.parameters[uint32_t(kind)][row * row_words<Record> + index], 4);
      },
      out);
  return out;
}

class CompileMaterials : public SceneTest {
 protected:
  CompileMaterials() {
    light(plugin("point", {}));
    options.colour = ColourMode::kRgb;  // rows then hold the channels that the tests name
  }
  Scene with(Plugin m) {
    description.shapes.clear();
    shape(square()).material = material(std::move(m));
    return compile();
  }
};

TEST_F(CompileMaterials, EachKindHasItsRow) {
  const auto matte = row_of<MatteParameters>(with(plugin("matte", {color("Kd", .1f, .2f, .3f)})),
                                             MaterialKind::kMatte);
  EXPECT_EQ(matte.kd_b, .3f);
  const auto rough = row_of<OrenNayarParameters>(with(plugin("matte", {number("sigma", 90)})),
                                                 MaterialKind::kOrenNayar);
  EXPECT_EQ(rough.sigma, 90);
  EXPECT_FLOAT_EQ(rough.kd_r, .9f);
  const auto mirror = row_of<MirrorParameters>(with(plugin("mirror", {})), MaterialKind::kMirror);
  EXPECT_EQ(mirror.kr_g, 1);
  const auto glass = row_of<GlassParameters>(
      with(plugin("glass", {color("Kt", .5f, 1, 1), number("index", 1.33f)})),
      MaterialKind::kGlass);
  EXPECT_EQ(glass.kt_r, .5f);
  EXPECT_EQ(glass.kr_r, 1);
  EXPECT_EQ(glass.index, 1.33f);
  EXPECT_SILENT();
}

TEST_F(CompileMaterials, ReflectancesAreInBands) {
  options.colour = ColourMode::kBands;
  const auto expect_bands = [](float r, float g, float b, const glm::vec3& rgb) {
    const glm::vec3 bands(to_bands(rgb, colour_model(ColourMode::kBands).reflectance));
    EXPECT_NE(bands, rgb);
    EXPECT_EQ(glm::vec3(r, g, b), bands);
  };
  const auto matte = row_of<MatteParameters>(with(plugin("matte", {color("Kd", .1f, .2f, .3f)})),
                                             MaterialKind::kMatte);
  expect_bands(matte.kd_r, matte.kd_g, matte.kd_b, {.1f, .2f, .3f});
  const auto rough = row_of<OrenNayarParameters>(
      with(plugin("matte", {color("Kd", 1, 0, .5f), number("sigma", 20)})),
      MaterialKind::kOrenNayar);
  expect_bands(rough.kd_r, rough.kd_g, rough.kd_b, {1, 0, .5f});
  const auto mirror = row_of<MirrorParameters>(with(plugin("mirror", {color("Kr", 1, .9f, .5f)})),
                                               MaterialKind::kMirror);
  expect_bands(mirror.kr_r, mirror.kr_g, mirror.kr_b, {1, .9f, .5f});
  const auto glass = row_of<GlassParameters>(
      with(plugin("glass", {color("Kr", 0, 1, 0), color("Kt", .5f, 1, 1)})), MaterialKind::kGlass);
  expect_bands(glass.kr_r, glass.kr_g, glass.kr_b, {0, 1, 0});
  expect_bands(glass.kt_r, glass.kt_g, glass.kt_b, {.5f, 1, 1});
  EXPECT_SILENT();
}

TEST_F(CompileMaterials, DefaultIsMatteNine) {
  description.shapes.clear();
  shape(square());
  EXPECT_FLOAT_EQ(row_of<MatteParameters>(compile(), MaterialKind::kMatte).kd_g, .9f);
}

TEST_F(CompileMaterials, OneRowPerMaterialHoweverOftenUsed) {
  const uint32_t a = material(plugin("matte", {})), b = material(plugin("matte", {}));
  for (uint32_t m : {a, b, a, b, a}) shape(square()).material = m;
  const Scene scene = compile();
  EXPECT_EQ(scene.parameter_rows[uint32_t(MaterialKind::kMatte)], 2u);
  EXPECT_EQ(scene.triangles.row(8).parameter, scene.triangles.row(0).parameter);
  EXPECT_NE(scene.triangles.row(2).parameter, scene.triangles.row(0).parameter);
}

TEST_F(CompileMaterials, ColoursAreClampedWithOneWarning) {
  const uint32_t a = material(plugin("matte", {color("Kd", 2, -1, .5f)}));
  const uint32_t b = material(plugin("matte", {color("Kd", NAN, 0, 7)}));
  shape(square()).material = a;
  shape(square()).material = b;
  const Scene scene = compile();
  const auto kd = row_of<MatteParameters>(scene, MaterialKind::kMatte);
  EXPECT_EQ(kd.kd_r, 1);
  EXPECT_EQ(kd.kd_g, 0);
  EXPECT_EQ(kd.kd_b, .5f);
  EXPECT_EQ(row_of<MatteParameters>(scene, MaterialKind::kMatte, 1).kd_r, 0);
  EXPECT_EQ(all_said(),
            "scene.lxs:11:2: warning: \"Kd\" of material \"matte\" is 2 -1 0.5: clamped to "
            "0..1\n");
}

TEST_F(CompileMaterials, Diffuse) {
  const auto sheet = row_of<MatteTranslucentParameters>(
      with(plugin("mattetranslucent",
                  {color("Kr", .5f, .25f, 0), color("Kt", .5f, 0, 1), number("sigma", 20)})),
      MaterialKind::kMatteTranslucent);
  EXPECT_EQ(sheet.kr_g, .25f);
  EXPECT_EQ(sheet.kt_b, 1);
  EXPECT_EQ(sheet.sigma, 20);
  EXPECT_EQ(sheet.conserve, 0);
  const auto velvet = row_of<VelvetParameters>(
      with(plugin("velvet", {number("p2", 10), number("thickness", .5f)})), MaterialKind::kVelvet);
  EXPECT_FLOAT_EQ(velvet.kd_r, .3f);
  EXPECT_EQ(velvet.p1, -2);
  EXPECT_EQ(velvet.p2, 10);
  EXPECT_EQ(velvet.p3, 2);
  EXPECT_EQ(velvet.thickness, .5f);
  const auto scatter = row_of<ScatterParameters>(
      with(plugin("scatter", {color("g", .5f, .5f, .5f)})), MaterialKind::kScatter);
  EXPECT_FLOAT_EQ(scatter.kd_b, .9f);
  EXPECT_EQ(scatter.g, .5f);
  EXPECT_SILENT();
}

TEST_F(CompileMaterials, DiffuseWithSomethingToSay) {
  Scene scene = with(plugin("mattetranslucent", {}));
  EXPECT_SAID(
      "scene.lxs:10:1: note: \"Kr\" and \"Kt\" of material \"mattetranslucent\" are 2 2 2 "
      "together: "
      "it scatters more light than it gets, as in LuxRender without \"energyconserving\"");
  scene =
      with(plugin("mattetranslucent", {text("energyconserving", "true", ParameterType::kBool)}));
  EXPECT_EQ(row_of<MatteTranslucentParameters>(scene, MaterialKind::kMatteTranslucent).conserve, 1);
  with(plugin("velvet", {number("thickness", 2)}));
  EXPECT_SAID(
      "scene.lxs:11:2: warning: \"thickness\" of material \"velvet\" is 2: clamped to 0..1");
  with(plugin("scatter", {color("g", .3f, 0, 0)}));
  EXPECT_SAID("scene.lxs:11:2: warning: \"g\" is one number for all colours here: 0.1 is used");
  scene = with(plugin("cloth", {color("warp_Kd", .5f, .25f, 0), color("weft_Kd", .5f, .75f, 1),
                                number("repeat_u", 10)}));
  const auto kd = row_of<MatteParameters>(scene, MaterialKind::kMatte);
  EXPECT_EQ(glm::vec3(kd.kd_r, kd.kd_g, kd.kd_b), glm::vec3(.5f));
  EXPECT_SAID(
      "scene.lxs:10:1: warning: material \"cloth\" has no weave: rendered as matte with the mean "
      "of \"warp_Kd\" and \"weft_Kd\", 0.5 0.5 0.5");
  EXPECT_EQ(messages.size(), 4u) << all_said();
}

TEST_F(CompileMaterials, Coated) {
  const auto glossy = row_of<GlossyParameters>(
      with(plugin("glossy", {color("Kd", .5f, .25f, 0), number("index", 1.5f), number("d", .1f),
                             color("Ka", 0, .5f, 1), number("uroughness", .2f),
                             number("vroughness", .2f), number("sigma", 20)})),
      MaterialKind::kGlossy);
  EXPECT_EQ(glossy.kd_g, .25f);
  EXPECT_EQ(glossy.ks_r, 1);
  EXPECT_EQ(glossy.ka_b, 1);
  EXPECT_EQ(glossy.depth, .1f);
  EXPECT_EQ(glossy.index, 1.5f);
  EXPECT_EQ(glossy.uroughness, .2f);
  EXPECT_EQ(glossy.sigma, 20);
  EXPECT_EQ(glossy.multibounce, 0);
  EXPECT_FALSE(with(plugin("glossy", {})).bins[1].tangents);
  for (const char* name : {"glossy", "plastic", "glossytranslucent"})
    EXPECT_TRUE(with(plugin(name, {number("uroughness", .2f)})).bins[1].tangents) << name;
  const Parameter single = text("separable", "false", ParameterType::kBool);
  const auto joint =
      row_of<GlossySingleParameters>(with(plugin("glossy", {single})), MaterialKind::kGlossySingle);
  EXPECT_FLOAT_EQ(joint.uroughness, .1f);
  const Scene black = with(plugin("glossy", {single, color("Ks", 0, 0, 0)}));
  EXPECT_EQ(row_of<MatteParameters>(black, MaterialKind::kMatte).kd_r, 1);
  for (const char* name : {"glossy_lossy", "substrate", "plastic"})
    EXPECT_EQ(row_of<GlossyLossyParameters>(with(plugin(name, {color("Ks", .5f, .5f, .5f)})),
                                            MaterialKind::kGlossyLossy)
                  .ks_g,
              .5f);
  const auto sheet = row_of<GlossyTranslucentParameters>(
      with(plugin("glossytranslucent", {color("Kt", .5f, 0, 1)})),
      MaterialKind::kGlossyTranslucent);
  EXPECT_EQ(sheet.kt_r, .5f);
  EXPECT_EQ(sheet.back_ks_r, 1);
  EXPECT_FLOAT_EQ(sheet.back_uroughness, .1f);
  const auto two = row_of<GlossyTranslucentParameters>(
      with(plugin("glossytranslucent",
                  {text("onesided", "false", ParameterType::kBool), number("backface_index", 2)})),
      MaterialKind::kGlossyTranslucent);
  EXPECT_EQ(two.back_ks_r, 0);
  EXPECT_EQ(two.back_index, 2);
  EXPECT_EQ(two.index, 0);
  const auto paint = row_of<CarPaintParameters>(with(plugin("carpaint", {text("name", "bmw339")})),
                                                MaterialKind::kCarPaint);
  EXPECT_FLOAT_EQ(paint.kd_g, .015f);
  EXPECT_FLOAT_EQ(paint.ks3_b, .016f);
  EXPECT_FLOAT_EQ(paint.r2, .87f);
  EXPECT_FLOAT_EQ(paint.m1, .39f);
  const auto own = row_of<CarPaintParameters>(
      with(plugin("carpaint", {color("Ks2", .5f, .5f, .5f), number("M2", .25f)})),
      MaterialKind::kCarPaint);
  EXPECT_EQ(own.ks2_r, .5f);
  EXPECT_EQ(own.m2, .25f);
  EXPECT_FLOAT_EQ(own.ks1_r, .0049f);
  EXPECT_SILENT();
}

TEST_F(CompileMaterials, CoatedWithSomethingToSay) {
  with(plugin("carpaint", {text("name", "bmw 339")}));
  EXPECT_SAID(
      "scene.lxs:11:2: warning: no car paint \"bmw 339\" (did you mean \"bmw339\"?): \"ford f8\" "
      "is "
      "used");
}

TEST_F(CompileMaterials, CoatOverAnyMaterial) {
  const uint32_t base = material(plugin("mirror", {}));
  Parameter named = text("basematerial", "base");
  named.material = base;
  const Scene scene = with(plugin(
      "glossycoating", {named, number("index", 1.5f), color("Ks", 1, .5f, .5f), number("d", .5f)}));
  EXPECT_EQ(scene.bins[1].material, MaterialKind::kCoating);
  const MaterialSplit& split = scene.splits[scene.bins[1].split];
  EXPECT_EQ(split.child[0].kind, MaterialKind::kGlossy);
  EXPECT_EQ(split.child[1].kind, MaterialKind::kMirror);
  const auto coat = row_of<CoatingParameters>(scene, MaterialKind::kCoating);
  EXPECT_EQ(coat.index, 1.5f);
  EXPECT_EQ(coat.ks_g, .5f);
  EXPECT_EQ(coat.depth, .5f);
  EXPECT_EQ(row_of<GlossyParameters>(scene, MaterialKind::kGlossy, coat.first).kd_r, 0);
  EXPECT_SILENT();
}

TEST_F(CompileMaterials, CoatsThatAreLeftOut) {
  Parameter named = text("basematerial", "base");
  named.material = material(plugin("mirror", {}));
  // One coat is enough.
  named.material = material(plugin("glossycoating", {named}));
  const Scene twice = with(plugin("glossycoating", {named}));
  EXPECT_EQ(twice.bins[1].material, MaterialKind::kCoating);
  EXPECT_EQ(twice.splits[twice.bins[1].split].child[1].kind, MaterialKind::kMirror);
  EXPECT_SAID(
      "scene.lxs:10:1: warning: material \"glossycoating\" shows its base \"base\" without the "
      "coat: it has a coat already");
}

TEST_F(CompileMaterials, NoCoatOverVeils) {
  Parameter named = text("basematerial", "base");
  named.material = material(plugin("glass", {flag("architectural", true)}));
  EXPECT_EQ(with(plugin("glossycoating", {named})).bins[1].material,
            MaterialKind::kArchitecturalGlass);
  EXPECT_SAID(
      "scene.lxs:10:1: warning: material \"glossycoating\" shows its base \"base\" without the "
      "coat: it lets light pass unturned");
}

TEST_F(CompileMaterials, Unknown) {
  with(plugin("mate", {}));
  EXPECT_SAID(
      "scene.lxs:10:1: error: unknown material \"mate\" (did you mean \"matte\"?): matte with Kd "
      "0.9 is used");
}

TEST_F(CompileMaterials, FilmsOnMirrorsAndGlass) {
  const auto mirror = row_of<MirrorFilmParameters>(
      with(plugin("mirror", {number("film", 200), number("filmindex", 1.33f)})),
      MaterialKind::kMirrorFilm);
  EXPECT_EQ(mirror.film, 200);
  EXPECT_EQ(mirror.filmindex, 1.33f);
  const auto glass = row_of<GlassFilmParameters>(
      with(plugin("glass", {number("film", 300), color("Kr", 1, .5f, 0)})),
      MaterialKind::kGlassFilm);
  EXPECT_EQ(glass.kr_g, .5f);
  EXPECT_EQ(glass.film, 300);
  EXPECT_EQ(glass.filmindex, 1.5f);
  EXPECT_SILENT();
}

TEST_F(CompileMaterials, GlassOfAllKinds) {
  const auto rough = row_of<RoughGlassParameters>(
      with(plugin("roughglass", {number("index", 2), number("uroughness", .25f)})),
      MaterialKind::kRoughGlass);
  EXPECT_EQ(rough.index, 2);
  EXPECT_EQ(rough.uroughness, .25f);
  EXPECT_EQ(rough.vroughness, .001f);
  EXPECT_SILENT();
  // No facets can be seen on glass that does not bend light.
  EXPECT_EQ(row_of<GlassParameters>(with(plugin("roughglass", {number("index", 1)})),
                                    MaterialKind::kGlass)
                .index,
            1);
  const auto pane = row_of<ArchitecturalGlassParameters>(
      with(plugin("glass", {flag("architectural", true), color("Kt", .5f, 1, 1)})),
      MaterialKind::kArchitecturalGlass);
  EXPECT_EQ(pane.kt_r, .5f);
  EXPECT_EQ(pane.film, 0);
}

TEST_F(CompileMaterials, MetalPresetsHaveTheirColour) {
  const std::pair<const char*, glm::dvec3> presets[] = {{"aluminium", {.913, .922, .925}},
                                                        {"silver", {.971, .960, .914}},
                                                        {"gold", {.999, .786, .343}},
                                                        {"copper", {.951, .639, .536}},
                                                        {"amorphous carbon", {.212, .212, .2}}};
  for (const auto& [name, colour] : presets) {
    const auto p = row_of<MetalParameters>(
        with(plugin("metal", {text("name", name), number("uroughness", .2f)})),
        MaterialKind::kMetal);
    EXPECT_EQ(p.uroughness, .2f);
    EXPECT_EQ(p.vroughness, .1f);
    const float n[] = {p.n_r, p.n_g, p.n_b}, k[] = {p.k_r, p.k_g, p.k_b};
    for (int b = 0; b < 3; ++b) {
      const double a = double(n[b]), e = double(k[b]);
      EXPECT_NEAR(((a - 1) * (a - 1) + e * e) / ((a + 1) * (a + 1) + e * e), colour[b], 1e-3)
          << name << ", band " << b;
    }
  }
  EXPECT_SILENT();
  const auto unknown = row_of<MetalParameters>(with(plugin("metal", {text("name", "silber")})),
                                               MaterialKind::kMetal);
  EXPECT_EQ(unknown.n_r, 1.248f);
  EXPECT_SAID(
      "scene.lxs:11:2: warning: metal \"silber\" (did you mean \"silver\"?): there is no such "
      "preset or file; aluminium is used");
}

TEST_F(CompileMaterials, MetalDataFiles) {
  std::string problem;
  // Luxpop: Angstrom, n, k. 610 and 550 nm lie between samples, 465 nm below them.
  const auto luxpop =
      read_metal_data("; comment 7 8\n5000 1 2\n6000 3 4 ; more\n7000 5 8\n", problem);
  ASSERT_TRUE(luxpop);
  EXPECT_DOUBLE_EQ(luxpop->n[0], 3.2);
  EXPECT_DOUBLE_EQ(luxpop->k[0], 4.4);
  EXPECT_DOUBLE_EQ(luxpop->n[1], 2);
  EXPECT_DOUBLE_EQ(luxpop->n[2], 1);
  // SOPRA in um, from the last sample to the first: sample i at .4 + .4 i / 4.
  const auto sopra = read_metal_data("2 .4 .8 4\n4 .4\n3 .3\n2 .2\n1 .1\n", problem);
  ASSERT_TRUE(sopra);
  EXPECT_NEAR(sopra->n[1], 2.5, 1e-9);
  EXPECT_NEAR(sopra->k[0], .31, 1e-9);
  // In eV, which falls with the wavelength: first and last change places.
  const auto energy = read_metal_data("1 1.5 3 3\n1 1\n2 2\n3 3\n", problem);
  ASSERT_TRUE(energy);
  EXPECT_NEAR(energy->n[0], 1.08, .01);
  EXPECT_NEAR(energy->n[2], 2.37, .01);
  EXPECT_FALSE(read_metal_data("1 2 three", problem));
  EXPECT_EQ(problem, "it is not a table of numbers");
}

TEST_F(CompileMaterials, FresnelOfMetal2) {
  const auto fresnel = [&](Plugin texture_plugin) {
    description.textures.clear();
    description.textures.push_back({"f", "fresnel", std::move(texture_plugin), Matrix(1.)});
    return with(plugin("metal2", {texture("fresnel", 0)}));
  };
  auto index = row_of<MetalIndexParameters>(with(plugin("metal2", {})), MaterialKind::kMetalIndex);
  EXPECT_EQ(index.n_g, 5);
  EXPECT_EQ(index.k_g, 0);
  index = row_of<MetalIndexParameters>(with(plugin("metal2", {number("fresnel", 1.5f)})),
                                       MaterialKind::kMetalIndex);
  EXPECT_EQ(index.n_b, 1.5f);
  index = row_of<MetalIndexParameters>(fresnel(plugin("constant", {number("value", 2)})),
                                       MaterialKind::kMetalIndex);
  EXPECT_EQ(index.n_r, 2);
  index = row_of<MetalIndexParameters>(
      fresnel(plugin("cauchy", {number("index", 1.5f), number("cauchyb", .01f)})),
      MaterialKind::kMetalIndex);
  EXPECT_NEAR(index.n_g, 1.5 - 1e4 / (720. * 380.) + 1e4 / (550. * 550.), 1e-6);
  EXPECT_LT(index.n_r, index.n_b);
  // BK7, by Abbe's number and by Sellmeier's terms.
  index = row_of<MetalIndexParameters>(fresnel(plugin("abbe", {})), MaterialKind::kMetalIndex);
  EXPECT_NEAR(index.n_g, 1.5185, 2e-4);
  const auto colour = row_of<MetalColourParameters>(
      fresnel(plugin("fresnelcolor", {color("Kr", .25f, .5f, 1)})), MaterialKind::kMetalColour);
  EXPECT_EQ(colour.kr_r, .25f);
  EXPECT_EQ(colour.kr_b, 1);
  const auto gold = row_of<MetalParameters>(fresnel(plugin("preset", {text("name", "gold")})),
                                            MaterialKind::kMetal);
  EXPECT_EQ(gold.n_r, .206f);
  EXPECT_SILENT();
  // lxs 7.4: colours where LuxRender wants a fresnel texture.
  const auto kr = row_of<MetalColourParameters>(
      with(plugin("metal2", {color("Kr", .2f, .3f, .4f), number("uroughness", .5f)})),
      MaterialKind::kMetalColour);
  EXPECT_EQ(kr.kr_g, .3f);
  EXPECT_EQ(kr.uroughness, .5f);
  EXPECT_EQ(kr.vroughness, .1f);
  EXPECT_SAID(
      "scene.lxs:11:2: warning: \"Kr\" of material \"metal2\" is a colour, which LuxRender would "
      "ignore: taken as that of a fresnelcolor texture");
}

TEST_F(CompileMaterials, Metal2ByYartIsCookTorrance) {
  description.dialect = Dialect::kYart;
  const auto by_colour = row_of<CookTorranceParameters>(
      with(plugin("metal2", {color("fresnel", .2f, .3f, .4f), number("uroughness", .25f),
                             color("Kr", 1, 0, 0)})),
      MaterialKind::kCookTorrance);
  EXPECT_EQ(by_colour.kr_r, .2f);
  EXPECT_EQ(by_colour.kr_b, .4f);
  EXPECT_EQ(by_colour.roughness, .25f);
  const auto by_default =
      row_of<CookTorranceParameters>(with(plugin("metal2", {})), MaterialKind::kCookTorrance);
  EXPECT_EQ(by_default.kr_g, .5f);
  EXPECT_EQ(by_default.roughness, .001f);
  // Of a fresnel texture: its reflectance head-on.
  description.textures.push_back(
      {"f", "fresnel", plugin("constant", {number("value", 3)}), Matrix(1.)});
  EXPECT_FLOAT_EQ(row_of<CookTorranceParameters>(with(plugin("metal2", {texture("fresnel", 0)})),
                                                 MaterialKind::kCookTorrance)
                      .kr_r,
                  .25f);
  options.compensation = EnergyCompensation::kOff;
  EXPECT_EQ(row_of<CookTorranceSingleParameters>(with(plugin("metal2", {number("uroughness", 1)})),
                                                 MaterialKind::kCookTorranceSingle)
                .roughness,
            1);
  EXPECT_SILENT();
  // LuxRender's lobes are as LuxRender has them, whatever the option says.
  description.dialect = Dialect::kLuxRender;
  options.compensation = EnergyCompensation::kOn;
  EXPECT_EQ(row_of<MetalIndexParameters>(with(plugin("metal2", {})), MaterialKind::kMetalIndex).n_g,
            5);
}

TEST_F(CompileMaterials, BrushedByATextureNeedsTangents) {
  description.textures.push_back(
      {"t", "float", plugin("checkerboard", {number("tex1", .1f), number("tex2", .5f)}),
       Matrix(1.)});
  description.textures.push_back(
      {"c", "color", plugin("checkerboard", {color("tex1", 1, 0, 0), color("tex2", 0, 0, 1)}),
       Matrix(1.)});
  const auto tangents = [&](Plugin m) {
    const Scene scene = with(std::move(m));
    const Bin& bin = scene.bins[scene.prim_bin[0]];
    EXPECT_NE(bin.program, kNone);
    return bin.tangents;
  };
  EXPECT_TRUE(tangents(plugin("metal", {texture("uroughness", 0)})));
  EXPECT_TRUE(tangents(plugin("glossy", {texture("vroughness", 0)})));
  // The same all around: nothing varies but the colour, or both roughnesses are one texture's.
  EXPECT_FALSE(tangents(plugin("glossy", {texture("Kd", 1)})));
  EXPECT_FALSE(tangents(plugin("metal", {texture("uroughness", 0), texture("vroughness", 0)})));
}

TEST_F(CompileMaterials, BrushedMetalNeedsTangents) {
  const Scene round = with(plugin("metal", {}));
  EXPECT_FALSE(round.bins[round.prim_bin[0]].tangents);
  EXPECT_EQ(round.bins[round.prim_bin[0]].geometry, GeometryKind::kTriangleFlat);
  description.shapes.clear();
  Plugin uv = square();
  uv.parameters.push_back(numbers(ParameterType::kFloat, "uv", {0, 0, 1, 0, 1, 1, 0, 1}));
  shape(std::move(uv)).material =
      material(plugin("metal", {number("uroughness", .5f), number("vroughness", .2f)}));
  const Scene brushed = compile();
  const Bin& bin = brushed.bins[brushed.prim_bin[0]];
  EXPECT_TRUE(bin.tangents);
  // Flat, but dp/du is in the vertex rows.
  EXPECT_EQ(bin.geometry, GeometryKind::kTriangleVertex);
  ASSERT_EQ(brushed.triangle_vertices.size(), brushed.triangles.size());
  EXPECT_EQ(brushed.triangle_vertices.row(0).u1, 1);
  EXPECT_SILENT();
}

TEST_F(CompileMaterials, VolumesFillGlass) {
  description.volumes.push_back(
      {"water", plugin("clear", {number("fresnel", 1.33f), color("absorption", 2, 1, 0)})});
  description.volumes.push_back({"air", plugin("homogeneous", {number("fresnel", 1)})});
  const uint32_t glass2 = material(plugin("glass2", {})), glass = material(plugin("glass", {}));
  const uint32_t matte = material(plugin("matte", {}));
  const auto in = [&](uint32_t m, uint32_t interior, uint32_t exterior) {
    ShapeEntry& entry = shape(square());
    entry.material = m;
    entry.interior = interior;
    entry.exterior = exterior;
  };
  in(glass2, 0, kNone);
  in(glass2, 1, 0);
  in(glass, 0, 1);
  in(matte, 0, 1);
  in(matte, kNone, kNone);
  const Scene scene = compile();
  const auto water = row_of<AbsorbingGlassParameters>(scene, MaterialKind::kAbsorbingGlass);
  EXPECT_EQ(water.index, 1.33f);
  EXPECT_NEAR(water.sigma_r, 2, 1e-5);
  EXPECT_NEAR(water.sigma_g, 1, 1e-5);
  EXPECT_NEAR(water.sigma_b, 0, 1e-5);
  // A bubble in it.
  EXPECT_FLOAT_EQ(row_of<GlassParameters>(scene, MaterialKind::kGlass).index, 1 / 1.33f);
  EXPECT_EQ(row_of<AbsorbingGlassParameters>(scene, MaterialKind::kAbsorbingGlass, 1).index, 1.5f);
  EXPECT_EQ(scene.parameter_rows[uint32_t(MaterialKind::kMatte)], 1u);
  EXPECT_SILENT();
}

TEST_F(CompileMaterials, UnusedParameter) {
  with(plugin("mirror", {color("Kd", 1, 1, 1)}));
  EXPECT_SAID(
      "scene.lxs:11:2: warning: parameter \"color Kd\" of material \"mirror\" is not used (did you "
      "mean \"Kr\"?)");
}

TEST_F(CompileMaterials, NullSurfacesAreDroppedUnlessTheyShine) {
  const uint32_t null = material(plugin("null", {}));
  shape(triangle());
  shape(square()).material = null;
  shape(plugin("sphere", {})).material = null;
  shape(plugin("plane", {})).material = null;
  Scene scene = compile();
  EXPECT_EQ(scene.triangles.size(), 1u);
  EXPECT_EQ(scene.spheres.size() + scene.planes.size(), 0u);
  EXPECT_TRUE(scene.all_occlude);

  description.shapes[1].area_light = description.shapes[2].area_light = area_light({});
  scene = compile();
  ASSERT_EQ(scene.triangles.size(), 3u);
  ASSERT_EQ(scene.spheres.size(), 1u);
  EXPECT_FALSE(scene.all_occlude);
  EXPECT_EQ(scene.spheres.row(0).occludes, 0u);
  const Bin& bin = scene.bins[scene.prim_bin[1]];
  EXPECT_EQ(bin.material, MaterialKind::kNull);
  EXPECT_TRUE(bin.emissive);
  EXPECT_EQ(bin.primitives, 2u);
  // The tree knows which triangles stop shadow rays.
  uint32_t stopping = 0;
  for (uint32_t block = 0; block < scene.tree.view.block_count; ++block)
    for (uint32_t bits = scene.tree.view.block_occluders[block]; bits; bits &= bits - 1) ++stopping;
  EXPECT_EQ(stopping, 1u);
}

TEST_F(CompileMaterials, ConstantTexturesAreEvaluated) {
  description.textures.push_back(
      {"half", "color", plugin("constant", {color("value", .5f, .25f, 1)}), Matrix(1.)});
  description.textures.push_back(
      {"scaled", "color", plugin("scale", {texture("tex1", 0), color("tex2", .5f, .5f, .5f)}),
       Matrix(1.)});
  description.textures.push_back(
      {"mixed", "color",
       plugin("mix", {texture("tex1", 1), color("tex2", 1, 1, 1), number("amount", .25f)}),
       Matrix(1.)});
  const auto kd =
      row_of<MatteParameters>(with(plugin("matte", {texture("Kd", 2)})), MaterialKind::kMatte);
  EXPECT_FLOAT_EQ(kd.kd_r, .75f * .25f + .25f);
  EXPECT_FLOAT_EQ(kd.kd_g, .75f * .125f + .25f);
  EXPECT_FLOAT_EQ(kd.kd_b, .75f * .5f + .25f);
  EXPECT_SILENT();
}

TEST_F(CompileMaterials, MissingAndUnknownTextures) {
  description.textures.push_back(
      {"gone", "color", plugin("imagemap", {text("filename", "gone.png")}), Matrix(1.)});
  auto kd =
      row_of<MatteParameters>(with(plugin("matte", {texture("Kd", 0)})), MaterialKind::kMatte);
  EXPECT_EQ(kd.kd_r, 1);
  EXPECT_SAID("scene.lxs:11:2: error: image \"gone.png\" not found: white is used");
  description.textures[0] = {"m", "color", plugin("marbel", {integers("octaves", {8})}),
                             Matrix(1.)};
  kd = row_of<MatteParameters>(with(plugin("matte", {texture("Kd", 0)})), MaterialKind::kMatte, 0);
  EXPECT_FLOAT_EQ(kd.kd_r, .9f);
  EXPECT_SAID(
      "scene.lxs:10:1: error: texture \"m\": unknown class \"marbel\" (did you mean \"marble\"?): "
      "the "
      "default of the parameter that uses it is taken");
  // A texture that is made of itself ends.
  description.textures[0] = {"loop", "color", plugin("scale", {texture("tex1", 0)}), Matrix(1.)};
  with(plugin("matte", {texture("Kd", 0)}));
  EXPECT_SAID("scene.lxs:10:1: error: texture \"loop\" is made of itself");
}

}  // namespace
}  // namespace yat

// Textured renders: against the oracle path by path, and closed forms.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "oracle.h"
#include "per_isa.h"
#include "texture_images.h"

namespace yat {
namespace {

class TextureRenders : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(TextureRenders);

std::string folder() {
  return (std::filesystem::path(YAT_TEST_OUTPUT_DIR) / "texture_renders").string();
}

Scene compile_in_folder(const std::string& text, const KernelTable& kernels,
                        ColourMode colour = ColourMode::kBands) {
  Diagnostics diagnostics(fail_at_warnings);
  return compile_description(parse_scene(text, "test.lxs", folder(), diagnostics), kernels,
                             diagnostics, 0, 0, colour);
}

std::string uv_quad_text(const std::string& a, const std::string& b, const std::string& c,
                         const std::string& d, const std::string& uv = "0 0 1 0 1 1 0 1") {
  return "Shape \"mesh\" \"integer triindices\" [0 1 2 0 2 3] \"point P\" [" + a + " " + b + " " +
         c + " " + d + "] \"float uv\" [" + uv + "]\n";
}

/// Every mapping, image filter and pattern on the surfaces of a room.
std::string room_of_textures() {
  write_image("texture_renders", "colour.png", 21, 13, 3, OIIO::TypeDesc::UINT8,
              [](int x, int y, int c) { return float((x * 37 + y * 91 + c * 53) % 200) / 255; });
  write_image("texture_renders", "grey.png", 16, 16, 1, OIIO::TypeDesc::UINT8,
              [](int x, int y, int) { return float((x * 7 + y * 29) % 256) / 255; });
  const auto image = [](const std::string& name, const std::string& kind, const std::string& more) {
    return "Texture \"" + name + "\" \"" + kind + "\" \"imagemap\" " + more + "\n";
  };
  std::string text = view_text("0 -2.7 0.1", "0 0 0", 48, 32, 24);
  text += image("smooth", "color",
                "\"string filename\" [\"colour.png\"] \"float gamma\" [2.2] \"float vscale\" [-1] "
                "\"float uscale\" [2]");
  text += image("mips", "color",
                "\"string filename\" [\"colour.png\"] \"float gamma\" [2.2] \"string filtertype\" "
                "[\"mipmap_trilinear\"] \"float uscale\" [9] \"float vscale\" [7] \"string wrap\" "
                "[\"clamp\"]");
  text += image("planar", "color",
                "\"string filename\" [\"colour.png\"] \"float gain\" [.9] \"string mapping\" "
                "[\"planar\"] \"vector v1\" [.5 .1 0] \"vector v2\" [0 .7 .3] \"string wrap\" "
                "[\"black\"]");
  text += image("round", "color",
                "\"string filename\" [\"colour.png\"] \"float gamma\" [1.8] \"string mapping\" "
                "[\"spherical\"] \"float uscale\" [3]");
  text += image("number", "float", "\"string filename\" [\"grey.png\"] \"float gain\" [40]");
  text += "Texture \"wavy\" \"float\" \"fbm\" \"vector scale\" [.3 .3 .3]\n";
  text +=
      "Texture \"half\" \"color\" \"mix\" \"texture tex1\" [\"smooth\"] \"color tex2\" "
      "[.2 .5 .7] \"texture amount\" [\"wrinkles\"]\n";
  // Named before it is defined: no such texture. So first:
  text.insert(text.find("Texture \"half\""),
              "Texture \"wrinkles\" \"float\" \"wrinkled\" \"integer octaves\" [3]\n");
  text += "Texture \"stone\" \"color\" \"marble\" \"float scale\" [3]\n";
  text += matte_text(".6 .6 .6") + uv_quad_text("-1 -1 -1", "1 -1 -1", "1 1 -1", "-1 1 -1") +
          "Material \"matte\" \"texture Kd\" [\"smooth\"]\n" +
          uv_quad_text("-1 1 -1", "1 1 -1", "1 1 1", "-1 1 1") +
          "Material \"matte\" \"texture Kd\" [\"mips\"] \"texture sigma\" [\"number\"]\n" +
          uv_quad_text("-1 -1 -1", "-1 1 -1", "-1 1 1", "-1 -1 1") +
          "Material \"matte\" \"texture Kd\" [\"planar\"]\n" +
          uv_quad_text("1 -1 -1", "1 -1 1", "1 1 1", "1 1 -1") +
          "Material \"matte\" \"texture Kd\" [\"half\"]\n" +
          uv_quad_text("-1 -1 1", "-1 1 1", "1 1 1", "1 -1 1") +
          "Material \"matte\" \"texture Kd\" [\"stone\"] \"texture bumpmap\" [\"wavy\"]\n" +
          sphere_text("-.4 .3 -.6", .35) + "Material \"mirror\" \"texture Kr\" [\"round\"]\n" +
          sphere_text(".45 .2 -.55", .4);
  text += "AttributeBegin\n" + light_text("7 6 5") + matte_text("0 0 0") +
          quad_text("-.3 -.3 .95", "-.3 .3 .95", ".3 .3 .95", ".3 -.3 .95") + "AttributeEnd\n";
  return text + "WorldEnd\n";
}

TEST_P(TextureRenders, PathsAgreeWithTheOracle) {
  const Scene scene = compile_in_folder(room_of_textures(), kernels());
  EXPECT_GE(scene.programs.size(), 6u);
  PlanOptions options;
  options.max_depth = 5;
  options.seed = 3;
  // Slopes of noise over .001 are differences of floats: the bumpy sphere's paths agree less.
  EXPECT_GT(agreement(scene, make_plan(scene, kernels(), options), 4, 5e-3), .85);
}

TEST_P(TextureRenders, PicturesAgreeWithTheOracle) {
  const Scene scene = compile_in_folder(room_of_textures(), kernels());
  expect_same_picture(scene, kernels(), 4, 48, 8);
}

/// How a scene asks for a material kind whose parameters are textures; empty where only YART's
/// rules have it (test_compile_materials.cpp).
std::string type_of(MaterialKind kind) {
  switch (kind) {
    case MaterialKind::kMatte:
    case MaterialKind::kOrenNayar:
      return "\"matte\"";
    case MaterialKind::kMatteTranslucent:
      return "\"mattetranslucent\"";
    case MaterialKind::kGlossySingle:
      return "\"glossy\" \"bool separable\" [\"false\"]";
    case MaterialKind::kGlossyLossy:
      return "\"glossy_lossy\"";
    case MaterialKind::kGlossyTranslucent:
      return "\"glossytranslucent\"";
    case MaterialKind::kMetalIndex:
      return "\"metal2\" \"float fresnel\" [2]";
    case MaterialKind::kMetalColour:
      return "\"metal2\"";
    case MaterialKind::kShinyMetal:
      return "\"shinymetal\"";
    case MaterialKind::kCookTorrance:
    case MaterialKind::kCookTorranceSingle:
      return "";
    case MaterialKind::kRoughGlass:
      return "\"roughglass\"";
    case MaterialKind::kMirrorFilm:
      return "\"mirror\" \"float film\" [300]";
    case MaterialKind::kGlassFilm:
      return "\"glass\" \"float film\" [300]";
    case MaterialKind::kArchitecturalGlass:
      return "\"glass\" \"bool architectural\" [\"true\"]";
    case MaterialKind::kMix:
      return "\"mix\" \"string namedmaterial1\" [\"one\"] \"string namedmaterial2\" [\"other\"]";
    default:
      return fmt::format("\"{}\"", material_traits(kind).name);
  }
}

/// Every parameter that a material's header lists as one that textures may give, all at once.
TEST_P(TextureRenders, EveryTexturedParameterAgreesWithTheOracle) {
  struct Range {
    const char *parameter, *low, *high;
  };
  constexpr Range kNumbers[] = {{"sigma", "5", "40"},       {"index", "1.3", "1.9"},
                                {"uroughness", ".2", ".6"}, {"vroughness", ".3", ".5"},
                                {"d", ".1", ".6"},          {"p1", "-3", "-1"},
                                {"p2", "10", "20"},         {"p3", "1", "3"},
                                {"thickness", ".05", ".2"}, {"amount", ".1", ".9"}};
  const auto ramp = [](const std::string& name, const std::string& kind,
                       const std::string& values) {
    return "Texture \"" + name + "\" \"" + kind + "\" \"bilerp\" " + values +
           " \"float uscale\" [3] \"float vscale\" [2]\n";
  };
  std::string textures = ramp("colour", "color",
                              "\"color v00\" [.1 .2 .7] \"color v10\" [.7 .2 .1] "
                              "\"color v01\" [.1 .7 .2] \"color v11\" [.6 .6 .3]");
  for (const Range& r : kNumbers)
    textures += ramp(r.parameter, "float",
                     std::string("\"float v00\" [") + r.low + "] \"float v11\" [" + r.low +
                         "] \"float v01\" [" + r.high + "] \"float v10\" [" + r.high + "]");
  uint32_t tried = 0;
  for (uint32_t k = 0; k < kMaterialKinds; ++k) {
    const auto kind = MaterialKind(k);
    const MaterialTraits traits = material_traits(kind);
    const std::string type = type_of(kind);
    if (!traits.textured.count || type.empty()) continue;
    SCOPED_TRACE(std::string(traits.name));
    std::string material = type;
    std::vector<uint32_t> fields;
    for (const TexturedField& field : traits.textured) {
      // Two names of one parameter: the first will do.
      if (std::find(fields.begin(), fields.end(), field.field) != fields.end()) continue;
      fields.push_back(field.field);
      const std::string name(field.parameter);
      ASSERT_TRUE(field.channels == 3 ||
                  std::any_of(std::begin(kNumbers), std::end(kNumbers),
                              [&](const Range& r) { return name == r.parameter; }))
          << name;
      material += " \"texture " + name + "\" [\"" + (field.channels == 3 ? "colour" : name) + "\"]";
    }
    const std::string text =
        view_text("0 -2.6 .3", "0 0 -.2", 44, 16, 12) + textures +
        "MakeNamedMaterial \"one\" \"string type\" [\"matte\"] \"color Kd\" [.8 .4 .2]\n"
        "MakeNamedMaterial \"other\" \"string type\" [\"mirror\"]\n" +
        matte_text(".6 .6 .6") + quad_text("-3 -3 -1", "3 -3 -1", "3 3 -1", "-3 3 -1") +
        quad_text("-3 2 -1", "3 2 -1", "3 2 4", "-3 2 4") + "AttributeBegin\n" +
        light_text("9 8 7") + quad_text("-.6 -.6 1.6", "-.6 .6 1.6", ".6 .6 1.6", ".6 -.6 1.6") +
        "AttributeEnd\nLightSource \"point\" \"point from\" [-1.5 -2 1]\nMaterial " + material +
        "\n" + sphere_text("0 0 -.1", .85) + "WorldEnd\n";
    // LuxRender ignores colours for metal2's fresnel, which is said.
    Diagnostics diagnostics([&](Severity severity, std::string_view line) {
      if (severity == Severity::kError ||
          (severity == Severity::kWarning && kind != MaterialKind::kMetalColour))
        ADD_FAILURE() << line;
    });
    const Scene scene = compile_description(parse_scene(text, "test.lxs", ".", diagnostics),
                                            kernels(), diagnostics);
    EXPECT_TRUE(std::any_of(scene.bins.begin(), scene.bins.end(), [&](const Bin& bin) {
      return bin.material == kind && bin.program != kNone;
    })) << text;
    PlanOptions options;
    options.max_depth = 4;
    options.seed = 7;
    // Dark and narrow lobes amplify rounding: paths agree less, their mean does not.
    EXPECT_GT(agreement(scene, make_plan(scene, kernels(), options), 4, 1e-2, 1e-3), .9);
    ++tried;
  }
  EXPECT_GE(tried, 18u);
}

/// A wall lit by one distant light head-on, seen by pixels that are texels: radiance is texel / pi.
TEST_P(TextureRenders, TexelsAreWhereTheyBelong) {
  const int n = 8;
  write_image("texture_renders", "places.png", n, n, 3, OIIO::TypeDesc::UINT8,
              [](int x, int y, int c) {
                return float(c == 0 ? x * 30 : c == 1 ? y * 30 : 128) / 255;
              });
  // A pinhole with a field of view of 90 degrees at distance 1 from a wall of [-1, 1]^2.
  std::string text =
      "LookAt 0 0 1  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" [90]\nPixelFilter \"box\" "
      "\"float xwidth\" [.01] \"float ywidth\" [.01]\nFilm \"fleximage\" \"integer xresolution\" "
      "[8] \"integer yresolution\" [8]\nWorldBegin\n";
  text +=
      "Texture \"t\" \"color\" \"imagemap\" \"string filename\" [\"places.png\"] \"float "
      "vscale\" [-1]\nMaterial \"matte\" \"texture Kd\" [\"t\"]\n";
  text += uv_quad_text("-1 -1 0", "1 -1 0", "1 1 0", "-1 1 0");
  text +=
      "LightSource \"distant\" \"point from\" [0 0 1] \"point to\" [0 0 0] \"color L\" [1 1 1]\n";
  const Scene scene = compile_in_folder(text + "WorldEnd\n", kernels(), ColourMode::kRgb);
  PlanOptions options;
  options.max_depth = 1;
  const Plan plan = make_plan(scene, kernels(), options);
  const std::vector<float> rgb = render_film(scene, plan, 0, 1).resolve();
  const float unit = rgb[2] / (128.f / 255);  // radiance of white, the same in every pixel
  EXPECT_GT(unit, 0);
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      // v upwards and vscale -1: the picture stands upright. A place within a pixel, by the filter,
      // is off by up to .01, which at the rim mixes the other side in.
      const float* p = &rgb[3 * size_t(y * n + x)];
      const float across = p[0] / unit * 255 / 30;
      EXPECT_NEAR(p[1] / unit * 255 / 30, y, .08) << x << " " << y;
      EXPECT_NEAR(across, x, .08) << x << " " << y;
      EXPECT_NEAR(p[2] / unit, 128.f / 255, 1e-4) << x << " " << y;
    }
}

/// A ramp of heights is a tilted wall: h = .5 x over a flat wall, seen by a distant light.
TEST_P(TextureRenders, BumpedSlopeIsATiltedWall) {
  const auto scene_of = [&](const std::string& material) {
    std::string text =
        "LookAt 0 0 5  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" [10]\nPixelFilter "
        "\"box\"\nFilm \"fleximage\" \"integer xresolution\" [4] \"integer yresolution\" "
        "[4]\nWorldBegin\n";
    // h = frac(u) with u from 0 to 1 over 2 m times 1: slope 1/2 along x.
    text +=
        "Texture \"uv\" \"color\" \"uv\"\nTexture \"ramp\" \"float\" \"bilerp\" \"float v00\" "
        "[0] \"float v01\" [0] \"float v10\" [1] \"float v11\" [1]\n";
    text += material + uv_quad_text("-1 -1 0", "1 -1 0", "1 1 0", "-1 1 0");
    text +=
        "LightSource \"distant\" \"point from\" [.3 0 1] \"point to\" [0 0 0] \"color L\" "
        "[1 1 1]\n";
    return compile_in_folder(text + "WorldEnd\n", kernels());
  };
  PlanOptions options;
  options.max_depth = 1;
  const auto mean = [&](const Scene& scene) {
    double sum = 0;
    for (const float v : render_film(scene, make_plan(scene, kernels(), options), 0, 4).resolve())
      sum += double(v);
    return sum;
  };
  const Scene flat = scene_of("Material \"matte\" \"color Kd\" [.5 .5 .5]\n");
  const Scene bent =
      scene_of("Material \"matte\" \"color Kd\" [.5 .5 .5] \"texture bumpmap\" [\"ramp\"]\n");
  ASSERT_EQ(bent.programs.size(), 1u);
  // Normals (0, 0, 1) and (-1/2, 0, 1) / sqrt(5/4), light from (.3, 0, 1) / |.|.
  EXPECT_NEAR(mean(bent) / mean(flat), (1 - .15) / std::sqrt(1.25), 2e-3);
}

/// One colour everywhere is one normal everywhere, 2 rgb - 1 along dp/du, dp/dv and the wall's own.
TEST_P(TextureRenders, NormalMapsTurnAWall) {
  const glm::dvec3 light = glm::normalize(glm::dvec3(.3, .2, 1));
  const auto mean = [&](const std::string& material, const std::string& uv) {
    const std::string text =
        "LookAt 0 0 5  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" [10]\nPixelFilter "
        "\"box\"\nFilm \"fleximage\" \"integer xresolution\" [4] \"integer yresolution\" "
        "[4]\nWorldBegin\n" +
        material + uv_quad_text("-1 -1 0", "1 -1 0", "1 1 0", "-1 1 0", uv) +
        "LightSource \"distant\" \"point from\" [.3 .2 1] \"point to\" [0 0 0]\nWorldEnd\n";
    const Scene scene = compile_in_folder(text, kernels());
    PlanOptions options;
    options.max_depth = 1;
    double sum = 0;
    for (const float v : render_film(scene, make_plan(scene, kernels(), options), 0, 4).resolve())
      sum += double(v);
    return sum;
  };
  const std::string grey = "Material \"matte\" \"color Kd\" [.5 .5 .5]",
                    along_x = "0 0 1 0 1 1 0 1", along_y = "0 0 0 -1 1 -1 1 0";
  const double flat = mean(grey + "\n", along_x);
  const std::pair<const char*, glm::dvec3> normals[] = {
      {"left.exr", {-.6, 0, .8}}, {"up.exr", {0, .6, .8}}, {"both.exr", {.48, -.36, .8}}};
  for (const auto& [name, normal] : normals) {
    const glm::dvec3 n = normal;
    write_image("texture_renders", name, 4, 4, 3, OIIO::TypeDesc::FLOAT,
                [&](int, int, int c) { return float(.5 * n[c] + .5); });
    const std::string bent =
        "Texture \"n\" \"float\" \"normalmap\" \"string filename\" "
        "[\"" +
        std::string(name) + "\"]\n" + grey + " \"texture bumpmap\" [\"n\"]\n";
    EXPECT_NEAR(mean(bent, along_x) / flat, glm::dot(n, light) / light.z, 1e-4);
    // u upwards, v to the left: the map lies a quarter turn round.
    const glm::dvec3 turned = glm::dvec3(-n.y, n.x, n.z);
    EXPECT_NEAR(mean(bent, along_y) / flat, glm::dot(turned, light) / light.z, 1e-4);
  }
}

TEST_P(TextureRenders, SameBitsForAnyBatchAndTile) {
  const Scene scene = compile_in_folder(room_of_textures(), kernels());
  PlanOptions options;
  options.max_depth = 4;
  const Plan plan = make_plan(scene, kernels(), options);
  const Film a = render_film(scene, plan, 0, 3), b = render_film(scene, plan, 0, 3, 2, 512, 8);
  EXPECT_TRUE(same_bits(a, b));
}

}  // namespace
}  // namespace yat

// Textures, bump maps, brushed metal and veils on analytic shapes: path by path against the
// reference, and closed forms.

#include <fmt/format.h>

#include <filesystem>
#include <numbers>

#include "oracle.h"
#include "per_isa.h"
#include "texture_images.h"

namespace yat {
namespace {

class ShapeMaterials : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(ShapeMaterials);

std::string at(const std::string& transform, const std::string& shape) {
  return "AttributeBegin\n" + transform + "\nShape " + shape + "\nAttributeEnd\n";
}

/// One of every shape in a room, on a plane. `count` times over, smaller.
std::string all_over_the_room(int count) {
  std::string text = at("Translate 0 0 -1 Rotate 30 0 0 1 Scale .5 .7 1", "\"plane\"");
  for (int i = 0; i < count; ++i) {
    const std::string set =
        count == 1 ? ""
                   : fmt::format("Translate {} {} {} Scale .5 .5 .5\n", i % 2 - .5, 0, i / 2 - .6);
    const auto place = [&](const char* where) { return set + where; };
    text += at(place("Translate -.65 .4 -.6 Rotate 40 1 .5 0 Scale .3 .3 .3"), "\"sphere\"") +
            at(place("Translate -.7 -.2 .1 Rotate 20 1 0 1 Scale .2 .25 -.15"),
               "\"sphere\" \"float zmin\" [-.7] \"float phimax\" [300]") +
            at(place("Translate .6 .3 -.9 Rotate 100 0 0 1"),
               "\"cylinder\" \"float radius\" [.2] \"float zmin\" [0] \"float zmax\" [.6]") +
            at(place("Translate 0 .5 -.3 Rotate 60 1 .2 0"),
               "\"torus\" \"float majorradius\" [.25] \"float minorradius\" [.1]") +
            at(place("Translate -.2 -.1 -1 Rotate 70 0 0 1"),
               "\"cone\" \"float radius\" [.25] \"float height\" [.5]") +
            at(place("Translate .15 -.2 -.9 Rotate -30 0 1 0"),
               "\"paraboloid\" \"float radius\" [.2] \"float zmax\" [.3]") +
            at(place("Translate .6 -.3 -.5 Rotate 110 1 0 0 Scale .3 .3 .3"),
               "\"disk\" \"float innerradius\" [.3] \"float phimax\" [330]") +
            at(place("Translate -.1 .1 .4 Scale .2 .2 .3"),
               "\"hyperboloid\" \"point p1\" [1 0 0] \"point p2\" [0 1 1]");
  }
  return text;
}

/// Brushed, checkered, bumpy (by uv) and woven of holes: every second shape of all_over_the_room.
std::string room(const std::string& material, int count = 1) {
  return view_text("0 -2.4 .2", "0 0 -.2", 60, 32, 24) + "AttributeBegin\n" + light_text("8 7 6") +
         quad_text("-.4 -.4 1", "-.4 .4 1", ".4 .4 1", ".4 -.4 1") +
         "AttributeEnd\nLightSource \"point\" \"point from\" [-.8 -.9 .8]\n" + material +
         all_over_the_room(count) + "WorldEnd\n";
}

const std::string kPatterns =
    "Texture \"uv\" \"color\" \"bilerp\" \"color v00\" [.1 .2 .9] \"color v10\" [.9 .2 .1] \"color "
    "v01\" [.1 .9 .2] \"color v11\" [.8 .8 .3] \"float uscale\" [1] \"float vscale\" [1]\n"
    "Texture \"ramp\" \"float\" \"bilerp\" \"float v00\" [0] \"float v01\" [.02] \"float v10\" "
    "[.05] \"float v11\" [.01] \"float uscale\" [3] \"float vscale\" [2]\n"
    "Texture \"squares\" \"float\" \"checkerboard\" \"float uscale\" [8] \"float vscale\" [4] "
    "\"float tex1\" [1] \"float tex2\" [0] \"string aamode\" [\"none\"]\n";

double share_of(const Scene& scene, const KernelTable& kernels, double bias) {
  PlanOptions options;
  options.max_depth = 4;
  options.seed = 5;
  return agreement(scene, make_plan(scene, kernels, options), 4, bias);
}

TEST_P(ShapeMaterials, TexturesByUvAgreeWithTheReference) {
  const Scene scene =
      compile_text(room(kPatterns + "Material \"matte\" \"texture Kd\" [\"uv\"]\n"), kernels());
  ASSERT_EQ(scene.programs.size(), 1u);
  // All kinds of analytic shapes.
  EXPECT_EQ(scene.bins.size() - 1, 6u);
  EXPECT_GT(share_of(scene, kernels(), 5e-3), .97);
}

// Mip levels by the footprint, which needs dp/du and dp/dv.
TEST_P(ShapeMaterials, ImagesAgreeWithTheReference) {
  write_image("shape_materials", "noise.png", 64, 32, 3, OIIO::TypeDesc::UINT8,
              [](int x, int y, int c) { return float((x * 37 + y * 91 + c * 53) % 200) / 255; });
  Diagnostics diagnostics(fail_at_warnings);
  const std::string text = room(
      "Texture \"image\" \"color\" \"imagemap\" \"string filename\" [\"noise.png\"] \"string "
      "filtertype\" [\"mipmap_trilinear\"] \"float uscale\" [2]\nMaterial \"matte\" \"texture "
      "Kd\" [\"image\"]\n");
  const std::string folder =
      (std::filesystem::path(YAT_TEST_OUTPUT_DIR) / "shape_materials").string();
  const Scene scene = compile_description(parse_scene(text, "test.lxs", folder, diagnostics),
                                          kernels(), diagnostics);
  ASSERT_EQ(scene.programs.size(), 1u);
  EXPECT_GT(share_of(scene, kernels(), 5e-3), .9);
}

TEST_P(ShapeMaterials, BumpMapsByUvAgreeWithTheReference) {
  const Scene scene = compile_text(
      room(kPatterns +
           "Material \"matte\" \"color Kd\" [.6 .7 .5] \"texture bumpmap\" [\"ramp\"]\n"),
      kernels());
  ASSERT_EQ(scene.programs.size(), 1u);
  // Slopes are differences of heights over .001: known to three digits.
  EXPECT_GT(share_of(scene, kernels(), 5e-3), .5);
}

TEST_P(ShapeMaterials, BrushedMetalAgreesWithTheReference) {
  const Scene scene = compile_text(
      room("Texture \"c\" \"fresnel\" \"fresnelcolor\" \"color Kr\" [.8 .8 .8]\nMaterial "
           "\"metal2\" \"texture fresnel\" [\"c\"] \"float uroughness\" [.6] \"float vroughness\" "
           "[.15]\n"),
      kernels());
  for (uint32_t b = 1; b < scene.bins.size(); ++b)
    EXPECT_EQ(scene.bins[b].tangents, !scene.bins[b].emissive);
  EXPECT_GT(share_of(scene, kernels(), 1e-2), .93);
}

TEST_P(ShapeMaterials, VeilsAgreeWithTheReference) {
  const std::string veil =
      kPatterns +
      "MakeNamedMaterial \"hole\" \"string type\" [\"null\"]\nMakeNamedMaterial \"plate\" \"string "
      "type\" [\"matte\"] \"color Kd\" [.8 .5 .3]\nMaterial \"mix\" \"string namedmaterial1\" "
      "[\"hole\"] \"string namedmaterial2\" [\"plate\"] \"texture amount\" [\"squares\"]\n";
  for (const int count : {1, 3}) {
    Scene scene = compile_text(room(veil, count), kernels());
    // The few one after the other, the many by their trees.
    if (count == 1) {
      scene.shape_tree = Tree();
      scene.veil_shape_tree = Tree();
    }
    PlanOptions options;
    EXPECT_TRUE(make_plan(scene, kernels(), options).veils);
    EXPECT_EQ(make_plan(scene, kernels(), options).veil_shape_tree, count > 1);
    EXPECT_GT(share_of(scene, kernels(), 1e-2), .95) << count;
  }
}

// Half veils: what a point light straight above sends through a shape that it passes n times.
TEST_P(ShapeMaterials, LightThroughVeils) {
  const struct {
    const char* name;
    std::string shape;
    int times;
  } forms[] = {
      {"sphere", "\"sphere\"", 2}, {"half a sphere", "\"sphere\" \"float zmin\" [0]", 1},
      {"disk", "\"disk\"", 1},     {"hole of a disk", "\"disk\" \"float innerradius\" [.5]", 0},
      {"torus", "\"torus\"", 0},   {"paraboloid", "\"paraboloid\"", 1},
      {"plane", "\"plane\"", 1},
  };
  for (const int copies : {1, 30})
    for (const auto& form : forms) {
      std::string text =
          view_text("0 -4 -.01", "0 0 -2", .02, 2, 2) + matte_text(".5 .5 .5") +
          at("Translate 0 0 -2", "\"disk\"") +
          "MakeNamedMaterial \"hole\" \"string type\" [\"null\"]\nMakeNamedMaterial \"black\" "
          "\"string type\" [\"matte\"] \"color Kd\" [0 0 0]\nMaterial \"mix\" \"string "
          "namedmaterial1\" [\"hole\"] \"string namedmaterial2\" [\"black\"] \"float amount\" "
          "[.5]\n" +
          at("Scale .5 .5 .5", form.shape);
      // The others are beside the way, but make a tree.
      for (int i = 1; i < copies; ++i)
        text += at(fmt::format("Translate {} 0 -1 Scale .2 .2 .2", 3 * i), form.shape);
      text += "LightSource \"point\" \"point from\" [0 0 2]\nWorldEnd\n";
      if (form.name == std::string("plane") && copies > 1) continue;
      const Scene scene = compile_text(text, kernels());
      PlanOptions options;
      options.max_depth = 1;
      const std::vector<float> rgb =
          render_film(scene, make_plan(scene, kernels(), options), 0, 4).resolve();
      const double unshaded = .5 / std::numbers::pi / 16;
      for (const float v : rgb)
        EXPECT_NEAR(double(v) / unshaded, std::pow(.5, form.times), 2e-3)
            << form.name << " " << copies;
    }
}

}  // namespace
}  // namespace yat

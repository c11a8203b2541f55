// Scenes of each material: against the scalar reference, and where there is a closed form.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "oracle.h"
#include "per_isa.h"

namespace yat {
namespace {

class MaterialRenders : public PerIsa {
 protected:
  /// A lit room with balls of the materials, path by path as the reference has it.
  void expect_paths_agree(const std::vector<std::string>& materials) {
    std::string text = view_text("0 -2.6 .3", "0 0 -.2", 50, 24, 16) + matte_text(".6 .6 .6") +
                       quad_text("-1 -1 -1", "1 -1 -1", "1 1 -1", "-1 1 -1") +
                       quad_text("-1 1 -1", "1 1 -1", "1 1 1", "-1 1 1") + "AttributeBegin\n" +
                       light_text("9 8 7") +
                       quad_text("-.4 -.4 1", "-.4 .4 1", ".4 .4 1", ".4 -.4 1") +
                       "AttributeEnd\nLightSource \"point\" \"point from\" [-.8 -.9 .6]\n";
    for (size_t i = 0; i < materials.size(); ++i)
      text += materials[i] + "\n" +
              sphere_text(std::to_string(-.6 + .6 * double(i % 3)) + " " +
                              std::to_string(double(i / 3 % 2) * .6 - .3) + " " +
                              std::to_string(-.7 + .6 * double(i / 6)),
                          .28);
    const Scene scene = compile_text(text + "WorldEnd\n", kernels());
    PlanOptions options;
    options.max_depth = 6;
    options.seed = 5;
    // Directions that leave at grazing angles after several bounces part from their double.
    EXPECT_GT(agreement(scene, make_plan(scene, kernels(), options), 6, 1e-2), .97);
  }

  /// Mean of the red channel over renders with several seeds.
  Estimate mean_radiance(const std::string& text, uint32_t samples, uint32_t max_depth) {
    const Scene scene = compile_text(text, kernels(), ColourMode::kRgb);
    PlanOptions options;
    options.max_depth = max_depth;
    std::vector<double> means;
    for (options.seed = 0; options.seed < 16; ++options.seed) {
      const Film film = render_film(scene, make_plan(scene, kernels(), options), 0, samples);
      const std::vector<float> rgb = film.resolve();
      double sum = 0;
      for (size_t i = 0; i < rgb.size(); i += 3) sum += double(rgb[i]);
      means.push_back(sum * 3 / double(rgb.size()));
    }
    return estimate(means);
  }
  static void expect_value(const Estimate& e, double exact) {
    EXPECT_LE(std::fabs(e.mean - exact), 3.5 * e.error + 5e-6 * exact)
        << e.mean << " +- " << e.error << ", should be " << exact;
    EXPECT_LT(e.error, .02 * exact) << "too noisy to say anything";
  }
  /// A closed room that shines with 1, seen from inside an object of the material there: looked at
  /// from outside, the object shows its albedo.
  static std::string furnace_text(const std::string& object) {
    return view_text("0 -1.5 .2", "0 0 0", 8, 4, 4) + "AttributeBegin\n" + light_text("1 1 1") +
           matte_text("0 0 0") + room_text(3) + "AttributeEnd\n" + object + "WorldEnd\n";
  }
};
YAT_INSTANTIATE_PER_ISA(MaterialRenders);

TEST_P(MaterialRenders, DiffusePathsAgree) {
  expect_paths_agree(
      {"Material \"mattetranslucent\" \"color Kr\" [.5 .3 .2] \"color Kt\" [.3 .6 .7] \"float "
       "sigma\" [20]",
       "Material \"mattetranslucent\" \"color Kr\" [.5 .3 .2] \"color Kt\" [.9 .6 .7] \"bool "
       "energyconserving\" [\"true\"]",
       "Material \"velvet\" \"color Kd\" [.4 .1 .2]",
       "Material \"velvet\" \"color Kd\" [.4 .5 .2] \"float p1\" [0] \"float p2\" [3] \"float "
       "thickness\" [.4]",
       "Material \"scatter\" \"color Kd\" [.8 .7 .2] \"color g\" [.4 .4 .4]",
       "Material \"matte\" \"color Kd\" [.8 .7 .2] \"float sigma\" [50]"});
}

TEST_P(MaterialRenders, CoatedPathsAgree) {
  const std::string rough = " \"float uroughness\" [.3] \"float vroughness\" [.3]";
  const std::string absorbs = " \"color Ka\" [.2 .5 .8] \"float d\" [.4]";
  expect_paths_agree(
      {"Material \"glossy\" \"color Kd\" [.6 .3 .2] \"color Ks\" [.1 .1 .1]" + rough,
       "Material \"glossy\" \"color Kd\" [.6 .3 .2] \"float index\" [1.5] \"float "
       "sigma\" [20] \"bool multibounce\" [\"true\"]" +
           rough + absorbs,
       "Material \"glossy\" \"color Kd\" [.2 .6 .3] \"color Ks\" [.2 .1 .1] \"bool "
       "separable\" [\"false\"]" +
           rough + absorbs,
       "Material \"substrate\" \"color Kd\" [.5 .6 .3] \"color Ks\" [.2 .1 .1]" + rough,
       "Material \"glossytranslucent\" \"color Kd\" [.3 .4 .3] \"color Kt\" [.6 .5 .4] "
       "\"color Ks\" [.1 .1 .1]" +
           rough + absorbs,
       "Material \"carpaint\" \"string name\" [\"polaris silber\"]"});
}

TEST_P(MaterialRenders, ASheetInAFurnaceShowsBothSides) {
  const std::string sheet = quad_text("-2 0 -2", "2 0 -2", "2 0 2", "-2 0 2");
  const std::string colours =
      "Material \"mattetranslucent\" \"color Kr\" [.5 .5 .5] \"color Kt\" "
      "[.25 .25 .25]";
  expect_value(mean_radiance(furnace_text(colours + sheet), 16, 1), .75);
  expect_value(
      mean_radiance(furnace_text(colours + " \"bool energyconserving\" [\"true\"]\n" + sheet), 16,
                    1),
      .5 + .25 * .5);
  expect_value(
      mean_radiance(furnace_text("Material \"scatter\" \"color Kd\" [.6 .6 .6]\n" + sheet), 16, 1),
      .6);
}

TEST_P(MaterialRenders, LightThroughASheet) {
  // A point light straight behind a sheet at a distance of 2: E = 1/4, what is seen is Kt E / pi.
  const auto text = [](const std::string& from) {
    return view_text("0 -3 0", "0 0 0", .01, 2, 2) +
           "Material \"mattetranslucent\" \"color Kr\" [.2 .2 .2] \"color Kt\" [.6 .6 .6]\n" +
           quad_text("-2 0 -2", "2 0 -2", "2 0 2", "-2 0 2") +
           "LightSource \"point\" \"point from\" [" + from + "]\nWorldEnd\n";
  };
  expect_value(mean_radiance(text("0 2 0"), 1, 1), .6 / 4 / std::numbers::pi);
  expect_value(mean_radiance(text("0 -2 0"), 1, 1), .2 / 4 / std::numbers::pi);
}

TEST_P(MaterialRenders, MetalPathsAgree) {
  expect_paths_agree(
      {"Material \"metal\" \"string name\" [\"gold\"] \"float uroughness\" [.3] "
       "\"float vroughness\" [.3]",
       "Material \"metal2\" \"float fresnel\" [2] \"float uroughness\" [.5] "
       "\"float vroughness\" [.5]",
       "Texture \"c\" \"fresnel\" \"fresnelcolor\" \"color Kr\" [.9 .6 .3]\nMaterial \"metal2\" "
       "\"texture fresnel\" [\"c\"] \"float uroughness\" [.15] "
       "\"float vroughness\" [.5]",
       "Material \"shinymetal\" \"color Kr\" [.3 .3 .3] \"color Ks\" [.5 .4 .3] "
       "\"float uroughness\" [.3] \"float vroughness\" [.3] \"float film\" [250]",
       "Material \"metal\" \"float uroughness\" [0] \"float vroughness\" [0]",
       "Material \"mirror\" \"float film\" [300]"});
}

TEST_P(MaterialRenders, GlassPathsAgree) {
  expect_paths_agree(
      {"Material \"roughglass\" \"float uroughness\" [.3] \"float vroughness\" [.3]",
       "Material \"roughglass\" \"float uroughness\" [.2] \"float vroughness\" [.5] \"float "
       "index\" "
       "[1.33] \"color Kt\" [.9 .8 .3]",
       "Material \"glass\" \"float film\" [300] \"float filmindex\" [1.33]",
       "Material \"glass\" \"bool architectural\" [\"true\"] \"color Kt\" [.9 .8 .3]",
       "MakeNamedVolume \"dark\" \"clear\" \"float fresnel\" [1.4] \"color absorption\" [3 1 0]\n"
       "Interior \"dark\"\nMaterial \"glass2\""});
}

// dp/du by texture coordinates, in the plane, on instances, and where there are none.
TEST_P(MaterialRenders, BrushedPathsAgree) {
  const std::string brushed =
      "Texture \"c\" \"fresnel\" \"fresnelcolor\" \"color Kr\" [.8 .8 .8]\nMaterial \"metal2\" "
      "\"texture fresnel\" [\"c\"] \"float uroughness\" [.6] \"float "
      "vroughness\" [.15]\n";
  const std::string uv = "\"float uv\" [0 0  1 .3  1.2 1  0 1]\n";
  const std::string quad =
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-1 -1 0  1 -1 0  1 1 "
      "0  "
      "-1 1 0]\n";
  std::string text =
      view_text("0 -2.6 1", "0 0 -.2", 50, 24, 16) + "AttributeBegin\n" + light_text("9 8 7") +
      quad_text("-.4 -.4 1", "-.4 .4 1", ".4 .4 1", ".4 -.4 1") +
      "AttributeEnd\nLightSource \"point\" \"point from\" [-.8 -.9 .6]\n" + brushed +
      "AttributeBegin\nTranslate 0 0 -.5\n" + quad + uv + "AttributeEnd\n" +
      "ObjectBegin \"plate\"\n" + quad + uv + "ObjectEnd\n" + "AttributeBegin\n" +
      "Translate .5 .6 0\nRotate 70 1 .3 0\nScale .5 -.6 .5\n" +
      "ObjectInstance \"plate\"\nAttributeEnd\nAttributeBegin\nTranslate -.7 .7 0\n" +
      "Rotate 60 1 0 .2\nScale .5 .5 .5\nObjectInstance \"plate\"\nAttributeEnd\n" +
      sphere_text("0 0 -.2", .3) + "AttributeBegin\nTranslate .8 -.5 -.3\nRotate 40 1 1 0\n" +
      "Scale .2 .2 .2\n" + quad + "AttributeEnd\n";
  const Scene scene = compile_text(text + "WorldEnd\n", kernels());
  uint32_t with_tangents = 0;
  for (const Bin& bin : scene.bins) with_tangents += bin.tangents;
  EXPECT_GE(with_tangents, 3u);
  PlanOptions options;
  options.max_depth = 4;
  EXPECT_GT(agreement(scene, make_plan(scene, kernels(), options), 6, 1e-2), .97);
}

TEST_P(MaterialRenders, GlassAbsorbsByItsThickness) {
  // Of index 1, so that all light goes straight through the middle: e^(-sigma 2 r).
  const std::string text = view_text("0 -1.5 0", "0 0 0", .01, 2, 2) + "AttributeBegin\n" +
                           light_text("1 1 1") + matte_text("0 0 0") + room_text(3) +
                           "AttributeEnd\nMakeNamedVolume \"v\" \"clear\" \"float fresnel\" [1] "
                           "\"color absorption\" [.8 .8 "
                           ".8]\nInterior \"v\"\nMaterial \"glass2\"\n" +
                           sphere_text("0 0 0", .5) + "WorldEnd\n";
  expect_value(mean_radiance(text, 1, 4), std::exp(-.8));
}

// Rays start off the surface by roundings of its size: of a slab 80 m wide, by 2e-4 of its
// thickness. Nothing of that is seen.
TEST_P(MaterialRenders, AWideSlabAbsorbsByItsThickness) {
  const std::string text =
      "AttributeBegin\n" + light_text("1 1 1") + matte_text("0 0 0") + room_text(50) +
      "AttributeEnd\nMakeNamedVolume \"v\" \"clear\" \"float fresnel\" [1] "
      "\"color absorption\" [.8 .8 .8]\nInterior \"v\"\nMaterial "
      "\"glass2\"\n" +
      quad_text("-40 -40 0", "40 -40 0", "40 40 0", "-40 40 0") +
      quad_text("-40 -40 -.4", "-40 40 -.4", "40 40 -.4", "40 -40 -.4") + "WorldEnd\n";
  const std::pair<const char*, double> views[] = {{"0 0 1", 1}, {"0 1.7320508075688772 1", .5}};
  for (const auto& [eye, cos] : views) {
    const double exact = std::exp(-.8 * .4 / cos);
    const Estimate e = mean_radiance(view_text(eye, "0 0 0", .01, 2, 2) + text, 1, 4);
    EXPECT_NEAR(e.mean / exact, 1, 2e-5) << eye;
  }
}

TEST_P(MaterialRenders, APaneReflectsOnceAndLetsTheRestThrough) {
  const std::string pane = "Material \"glass\" \"bool architectural\" [\"true\"]\n" +
                           quad_text("-2 0 -2", "2 0 -2", "2 0 2", "-2 0 2") +
                           quad_text("-2 .1 -2", "-2 .1 2", "2 .1 2", "2 .1 -2");
  const std::string text = view_text("0 -1.5 0", "0 0 0", .01, 2, 2) + "AttributeBegin\n" +
                           light_text("1 1 1") + matte_text("0 0 0") + room_text(3) +
                           "AttributeEnd\n" + pane + "WorldEnd\n";
  const double f = .04;
  expect_value(mean_radiance(text, 256, 4), f + 1 - f * (1 + (1 - f) * (1 - f)));
}

}  // namespace
}  // namespace yat

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

}  // namespace
}  // namespace yat

// Whole renders with analytic shapes against the scalar reference, path by path; the tree over
// shapes against one after the other.

#include <fmt/format.h>

#include "oracle.h"
#include "per_isa.h"

namespace yat {
namespace {

class ShapeRenders : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(ShapeRenders);

std::string at(const std::string& transform, const std::string& shape) {
  return "AttributeBegin\n" + transform + "\nShape " + shape + "\nAttributeEnd\n";
}

/// A room with every analytic shape, whole, partial or squeezed, in four materials, lit by a disk,
/// a cylinder, an ellipsoid, a torus and a cone.
std::string shapes_text(uint32_t width, uint32_t height) {
  std::string text = view_text("0 -.98 0.1", "0 0 -.1", 90, width, height);
  text += matte_text(".7 .6 .5") + room_text(1);
  text += matte_text(".8 .4 .3") + at("Translate -.6 .4 -.7 Scale .3 .2 .3", "\"sphere\"") +
          at("Translate .5 .3 -1 Rotate 20 1 0 0",
             "\"cylinder\" \"float radius\" [.2] \"float zmin\" [0] \"float zmax\" [.6] "
             "\"float phimax\" [250]");
  text += matte_text(".3 .7 .4") +
          at("Translate 0 .5 -.8 Rotate 60 1 .2 0",
             "\"torus\" \"float majorradius\" [.25] \"float minorradius\" [.1]") +
          at("Translate -.2 -.1 -1", "\"cone\" \"float radius\" [.2] \"float height\" [.5]");
  text += "Material \"mirror\" \"color Kr\" [.9 .85 .8]\n" +
          at("Translate .1 .1 -.9 Rotate -30 0 1 0",
             "\"paraboloid\" \"float radius\" [.2] \"float zmax\" [.3]");
  text +=
      "Material \"glass\" \"color Kr\" [1 1 1] \"color Kt\" [.9 1 .95] \"float index\" [1.5]\n" +
      at("Translate .55 -.3 -.75 Scale .2 .25 .2", "\"sphere\"");
  text += matte_text(".6 .6 .2") + at("Translate -.5 -.3 -.95 Scale .2 .2 .3",
                                      "\"hyperboloid\" \"point p1\" [1 0 0] \"point p2\" [0 1 1]");
  const auto lamp = [&](const std::string& radiance, const std::string& body) {
    text += "AttributeBegin\n" + light_text(radiance) + body + "AttributeEnd\n";
  };
  lamp("6 5 4", "ReverseOrientation\n" + at("Translate 0 0 .95",
                                            "\"disk\" \"float radius\" [.3] \"float innerradius\" "
                                            "[.1]"));
  lamp("3 4 6", at("Translate -.7 .7 .2",
                   "\"cylinder\" \"float radius\" [.05] \"float zmin\" "
                   "[-.3] \"float zmax\" [.3]"));
  lamp("5 3 2", "Material \"null\"\n" + at("Translate .6 .6 .3 Scale .1 .15 .2", "\"sphere\""));
  lamp("2 6 3", at("Translate .5 -.2 .4 Rotate 50 1 1 0",
                   "\"torus\" \"float majorradius\" [.15] \"float minorradius\" [.04]"));
  lamp("4 4 4", "Scale 1 1 -1\n" + at("Translate -.4 -.4 -.9",
                                      "\"cone\" \"float radius\" [.15] \"float radius2\" [.05] "
                                      "\"float height\" [.3] \"float phimax\" [200]"));
  return text + "WorldEnd\n";
}

/// Curved surfaces round more than flat ones.
constexpr double kTolerance = 1e-3;

TEST_P(ShapeRenders, PathsAgreeWithTheReference) {
  const Scene scene = compile_text(shapes_text(32, 24), kernels());
  PlanOptions options;
  options.max_depth = 6;
  options.seed = 3;
  const Plan plan = make_plan(scene, kernels(), options);
  EXPECT_TRUE(plan.shape_tree);
  const double share = agreement(scene, plan, 4, 1e-2, kTolerance);
  RecordProperty("share", std::to_string(share));
  EXPECT_GT(share, .96);
}

/// The same scene without its tree.
Plan without_tree(Scene& scene, const KernelTable& kernels, const PlanOptions& options) {
  scene.shape_tree = Tree();
  return make_plan(scene, kernels, options);
}

TEST_P(ShapeRenders, TheTreeGivesTheSameBits) {
  PlanOptions options;
  options.max_depth = 5;
  const std::string text = shapes_text(48, 32);
  const Scene with = compile_text(text, kernels());
  const Film film = render_film(with, make_plan(with, kernels(), options), 0, 4);
  Scene scene = compile_text(text, kernels());
  const Plan plan = without_tree(scene, kernels(), options);
  EXPECT_FALSE(plan.shape_tree);
  EXPECT_TRUE(same_bits(film, render_film(scene, plan, 0, 4)));
  // Any batch size and number of threads.
  EXPECT_TRUE(
      same_bits(film, render_film(with, make_plan(with, kernels(), options), 0, 4, 2, 96, 16)));
}

TEST_P(ShapeRenders, ThousandsOfSpheresByTheTree) {
  std::string text = view_text("0 -3 0.5", "0 0 0", 50, 48, 32) + matte_text(".6 .6 .6");
  for (int i = 0; i < 3000; ++i)
    text += sphere_text(
        fmt::format("{} {} {}", i % 15 * .13 - .9, i / 15 % 15 * .13 - .9, i / 225 * .13 - .9),
        i % 3 ? .05 : .03);
  text += "LightSource \"point\" \"point from\" [0 -2 3] \"color L\" [9 9 9]\nWorldEnd\n";
  PlanOptions options;
  options.max_depth = 3;
  Scene scene = compile_text(text, kernels());
  const Plan plan = make_plan(scene, kernels(), options);
  EXPECT_TRUE(plan.shape_tree);
  EXPECT_FALSE(plan.spheres);
  const Film film = render_film(scene, plan, 0, 1);
  const Plan tried = without_tree(scene, kernels(), options);
  EXPECT_TRUE(same_bits(film, render_film(scene, tried, 0, 1)));
}

}  // namespace
}  // namespace yat

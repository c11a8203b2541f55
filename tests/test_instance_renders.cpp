// Whole renders of shared objects: against the oracle path by path, against copies, and the same
// bits however the work is cut.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "instance_scenes.h"
#include "per_isa.h"
#include "wavefront/reference.h"

namespace yat {
namespace {

/// A room with instances of three objects: one that shines (mirrored and stretched too), one of two
/// shapes, with and without vertex normals, one of which is see-through and shines; materials of
/// their own and materials of the instance's; a sphere in an object, which is always copied.
std::string room_of_instances() {
  std::string text = view_text("0 -1.45 .2", "0 0 -.1", 75, 32, 24);
  text += "ObjectBegin \"lamp\"\nAttributeBegin\n" + light_text("5 4 3") + matte_text(".4 .4 .4") +
          "Scale .2 .2 .2\n" + ball_text(3, 5, 0, false) + "AttributeEnd\nObjectEnd\n";
  text += "ObjectBegin \"pair\"\nAttributeBegin\n" + matte_text(".7 .3 .2", 20) +
          "Scale .3 .3 .3\n" + ball_text(4, 6, .2, true) +
          "Material \"mirror\" \"color Kr\" [.8 .8 .9]\nTranslate 0 0 1.2\nScale .5 .5 .5\n" +
          ball_text(3, 5, 0, false) + "AttributeEnd\nObjectEnd\n";
  text += "ObjectBegin \"panel\"\nAttributeBegin\n" + light_text("1 2 4") + "Material \"null\"\n" +
          quad_text("-.3 0 -.3", ".3 0 -.3", ".3 0 .3", "-.3 0 .3") + "AttributeEnd\n" +
          "AttributeBegin\n" + matte_text(".2 .6 .3") + sphere_text("0 .2 .2", .1) +
          "AttributeEnd\nObjectEnd\n";
  text +=
      "AttributeBegin\nScale 1 1 1\n" + matte_text(".7 .7 .7") + room_text(1.5) + "AttributeEnd\n";
  text += instance_text("lamp", "-.8 .3 .9", "Scale 1 1 .5\n");
  text += instance_text("lamp", ".8 .3 .9", "Rotate 30 1 1 0 Scale -1.2 .6 1\n");
  text += instance_text("pair", "-.5 .2 -.8", "Rotate 20 0 0 1\n");
  text += instance_text("pair", ".6 .1 -.7", "Scale 1 -1 1.3\n");
  text += instance_text("pair", "0 .9 -.5", "ConcatTransform [1 0 0 0 .4 1 0 0 0 0 1 0 0 0 0 1]\n",
                        "Material \"glass\" \"float index\" [1.5]\n");
  text += instance_text("panel", "0 .4 .2", "Rotate 50 0 0 1\n");
  text += instance_text("panel", ".3 1 .9", "Scale -1 1 1\n");
  // Overridden by what is solid: not the same to rays as the others, so a copy.
  text += instance_text("panel", "-1 .9 .4", "Rotate 90 0 0 1\n", matte_text(".8 .8 .1"));
  return text + "WorldEnd\n";
}

class InstanceRenders : public PerIsa {
 protected:
  Plan plan_of(const Scene& scene, uint32_t depth, uint32_t seed = 5) {
    PlanOptions options;
    options.max_depth = depth;
    options.seed = seed;
    return make_plan(scene, kernels(), options);
  }
};
YAT_INSTANTIATE_PER_ISA(InstanceRenders);

TEST_P(InstanceRenders, SceneIsAsDescribed) {
  const Scene scene = compile_instances(room_of_instances(), kernels(), InstanceMode::kShare);
  EXPECT_EQ(scene.instances.objects.size(), 3u);
  EXPECT_EQ(scene.instances.rows.size(), 7u) << "the solid panel is a copy";
  EXPECT_EQ(scene.triangles.size(), 12u + 2u);
  EXPECT_EQ(scene.spheres.size(), 3u);
  EXPECT_FALSE(scene.instances.all_occlude);
  // A light per emissive triangle and instance, and the copied panel's two.
  const uint32_t lamp = scene.instances.objects[0].triangles;
  EXPECT_EQ(scene.lights.size(), 2 * lamp + 2 * 2 + 2);
  // By power, rectangles are one: the five faces around the middle of each lamp, and the panels.
  EXPECT_EQ(
      compile_instances(room_of_instances(), kernels(), InstanceMode::kShare, LightChoosing::kPower)
          .lights.size(),
      2 * (lamp - 5) + 2 + 1);
}

TEST_P(InstanceRenders, PathsAgreeWithTheOracle) {
  for (const LightChoosing choosing : {LightChoosing::kAuto, LightChoosing::kPower}) {
    const Scene scene =
        compile_instances(room_of_instances(), kernels(), InstanceMode::kShare, choosing);
    const Plan plan = plan_of(scene, 6);
    EXPECT_TRUE(plan.instances);
    EXPECT_EQ(plan.light_tree, choosing == LightChoosing::kAuto);
    uint64_t same = 0, all = 0;
    double difference = 0, total = 0;
    for (uint32_t sample = 0; sample < 3; ++sample) {
      const std::vector<float> rgb = render_film(scene, plan, sample, sample + 1).resolve();
      for (uint32_t y = 0; y < 24; ++y)
        for (uint32_t x = 0; x < 32; ++x) {
          const glm::dvec3 expected = reference_sample(scene, plan, x, y, sample);
          const float* p = &rgb[3 * (size_t(y) * 32 + x)];
          const glm::dvec3 found(p[0], p[1], p[2]);
          same += glm::length(found - expected) <= 1e-3 * glm::length(expected);
          ++all;
          difference += found.x + found.y + found.z - (expected.x + expected.y + expected.z);
          total += expected.x + expected.y + expected.z;
        }
    }
    // Roulette lets paths go on for long, and at each vertex a few part by rounding.
    EXPECT_GT(double(same) / double(all), .96);
    EXPECT_LT(std::fabs(difference / total), 1e-2);
    EXPECT_GT(total, 100);
  }
}

TEST_P(InstanceRenders, PictureIsThatOfCopies) {
  const std::string text = room_of_instances();
  const Scene shared = compile_instances(text, kernels(), InstanceMode::kShare);
  const Scene copies = compile_instances(text, kernels(), InstanceMode::kCopy);
  ASSERT_TRUE(copies.instances.empty());
  constexpr uint32_t samples = 64, block = 8;
  // Lights are in another order, and one random number chooses among them: pictures agree as
  // independent ones do. Per block and channel, its sum for each sample.
  std::vector<std::vector<double>> ours(12 * 3, std::vector<double>(samples)), theirs = ours;
  const auto collect = [&](const Scene& scene, uint32_t seed,
                           std::vector<std::vector<double>>& to) {
    const Plan plan = plan_of(scene, 6, seed);
    for (uint32_t sample = 0; sample < samples; ++sample) {
      const std::vector<float> rgb = render_film(scene, plan, sample, sample + 1).resolve();
      for (uint32_t y = 0; y < 24; ++y)
        for (uint32_t x = 0; x < 32; ++x)
          for (uint32_t k = 0; k < 3; ++k)
            to[3 * (y / block * 4 + x / block) + k][sample] +=
                double(rgb[3 * (size_t(y) * 32 + x) + k]);
    }
  };
  collect(shared, 1, ours);
  collect(copies, 2, theirs);
  for (size_t i = 0; i < ours.size(); ++i) {
    const Estimate a = estimate(ours[i]), b = estimate(theirs[i]);
    EXPECT_LT(std::fabs(a.mean - b.mean), 4.5 * std::hypot(a.error, b.error))
        << "block " << i / 3 << ": " << a.mean << " against " << b.mean;
    EXPECT_GT(a.mean, 0);
  }
}

TEST_P(InstanceRenders, SameBitsHoweverTheWorkIsCut) {
  const Scene scene = compile_instances(room_of_instances(), kernels(), InstanceMode::kShare);
  const Plan plan = plan_of(scene, 6);
  const Film film = render_film(scene, plan, 0, 8);
  for (const uint32_t threads : {2u, 3u})
    for (const uint32_t batch : {64u, 1000u, 20000u})
      EXPECT_TRUE(same_bits(film, render_film(scene, plan, 0, 8, threads, batch, 8)))
          << threads << " threads, " << batch << " rows";
  Film halves = render_film(scene, plan, 0, 3);
  halves.merge(render_film(scene, plan, 3, 8));
  EXPECT_TRUE(same_bits(film, halves));
}

/// No surface loses or gains by being far from the scene's origin or in a mirrored instance: a
/// white closed room of instances lit by itself keeps its radiance (furnace).
TEST_P(InstanceRenders, FurnaceOfInstances) {
  for (const double far : {0., 1e6}) {
    // Radiance 1 from walls of albedo 1/2 sums up to 2, inside a ball seen from its middle. Normals
    // point outwards, so the ball is turned inside out.
    std::string text =
        view_text(fmt::format("{0} {0} 0", far), fmt::format("{0} {1} 0", far, far + 1), 60, 8, 8);
    text += "ObjectBegin \"shell\"\nReverseOrientation\n" + light_text("1 1 1") +
            matte_text(".5 .5 .5") + ball_text(8, 12, .1, false) + "ObjectEnd\n";
    text += "AttributeBegin\n" + std::string("Translate ") + number_text(far) + number_text(far) +
            "0\nRotate 30 1 2 3 Scale -2 1.5 3\nObjectInstance \"shell\"\nAttributeEnd\nWorldEnd\n";
    const Scene scene = compile_instances(text, kernels(), InstanceMode::kShare);
    ASSERT_EQ(scene.instances.rows.size(), 1u);
    PlanOptions options;
    options.max_depth = 40;
    RenderResult result;
    const Film film =
        render_film(scene, make_plan(scene, kernels(), options), 0, 64, 1, 0, 0, &result);
    const std::vector<float> rgb = film.resolve();
    double sum = 0;
    for (const float c : rgb) sum += double(c);
    EXPECT_NEAR(sum / double(rgb.size()), 2, .03) << far;
    for (uint32_t cause = 0; cause < kDropCauses; ++cause)
      EXPECT_EQ(result.drops.count[cause], 0u) << far;
  }
}

}  // namespace
}  // namespace yat

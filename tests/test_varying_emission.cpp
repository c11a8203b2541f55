// Area lights whose L is a texture, or that shine by a profile: against the oracle path by path,
// against quadrature, by light samples alone and by paths alone, and against what is known.

#include <fmt/format.h>

#include <numbers>

#include "environment_scenes.h"
#include "instance_scenes.h"
#include "oracle.h"
#include "per_isa.h"
#include "wavefront/emission.h"

namespace yat {
namespace {

constexpr double kPi = std::numbers::pi;

class VaryingEmission : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(VaryingEmission);

std::string lit_by_texture(const std::string& texture, const std::string& more = "") {
  return "AreaLightSource \"area\" \"texture L\" [\"" + texture +
         "\"] \"float power\" [0] \"float efficacy\" [0] " + more + "\n";
}
std::string uv_quad(const std::string& points, const std::string& uv) {
  return "Shape \"mesh\" \"integer triindices\" [0 1 2 0 2 3] \"point P\" [" + points +
         "] \"float uv\" [" + uv + "]\n";
}
/// [-1, 1]^2 at a height, shining downwards, u along x and v along y from 0 to 1.
std::string lamp_quad(double height = 1) {
  return uv_quad(fmt::format("-1 -1 {0} -1 1 {0} 1 1 {0} 1 -1 {0}", height), "0 0 0 1 1 1 1 0");
}
const std::string kSlope =
    "Texture \"slope\" \"color\" \"bilerp\" \"color v00\" [.2 1 3] \"color v01\" [4 0 1] "
    "\"color v10\" [0 2 1] \"color v11\" [1 1 6]\n";
glm::dvec3 slope(double u, double v) {
  return (1 - u) * (1 - v) * glm::dvec3(.2, 1, 3) + (1 - u) * v * glm::dvec3(4, 0, 1) +
         u * (1 - v) * glm::dvec3(0, 2, 1) + u * v * glm::dvec3(1, 1, 6);
}
/// 0 where u < 1/2, else 2.
const std::string kHalves =
    "Texture \"squares\" \"float\" \"checkerboard\" \"integer dimension\" [2] \"float tex1\" [0] "
    "\"float tex2\" [1] \"float uscale\" [2]\n"
    "Texture \"halves\" \"color\" \"mix\" \"color tex1\" [0 0 0] \"color tex2\" [2 2 2] \"texture "
    "amount\" [\"squares\"]\n";
glm::dvec3 halves(double u, double) {
  return glm::dvec3(u < .5 ? 0 : 2);
}

/// Irradiance at (x, y, 0), facing +z, from the lamp moved by `offset` with u, v of its place.
template <class Texture>
glm::dvec3 quadrature(const glm::dvec3& at, const glm::dvec3& offset, bool mirrored,
                      const Texture& texture) {
  constexpr int kSteps = 400;
  glm::dvec3 sum(0.);
  for (int j = 0; j < kSteps; ++j)
    for (int i = 0; i < kSteps; ++i) {
      const double u = (i + .5) / kSteps, v = (j + .5) / kSteps;
      const glm::dvec3 p = offset + glm::dvec3(mirrored ? 1 - 2 * u : 2 * u - 1, 2 * v - 1, 0);
      const glm::dvec3 way = p - at;
      const double squared = glm::dot(way, way);
      sum += texture(u, v) * (way.z * way.z / (squared * squared));
    }
  return sum * 4. / double(kSteps * kSteps);
}

/// The same by light samples alone.
glm::dvec3 sampled(const Scene& scene, const KernelTable& kernels, const glm::dvec3& at) {
  constexpr uint32_t kRows = 256, kSide = 181;
  EmissionStage stage(scene, kernels, kRows);
  Table<Surface> surfaces(kRows);
  Table<Randoms> randoms(kRows);
  Table<LightSample> samples(kRows);
  const SceneView view = scene.view();
  glm::dvec3 sum(0.);
  uint32_t k = 0;
  while (k < kSide * kSide) {
    uint32_t n = 0;
    for (; n < kRows && k < kSide * kSide; ++n, ++k) {
      Surface<Value> s{};
      s.pos_x = float(at.x - scene.center.x);
      s.pos_y = float(at.y - scene.center.y);
      s.pos_z = float(at.z - scene.center.z);
      s.ng_z = s.wo_z = 1;
      surfaces.set(n, s);
      Randoms<Value> r{};
      r.light_u = (float(k % kSide) + .5f) / kSide;
      r.light_v = (float(k / kSide) + .5f) / kSide;
      // The golden section: spread evenly among its neighbours too.
      r.light_choice = float(std::fmod(.618033988749895 * k, 1));
      randoms.set(n, r);
    }
    const bool by_tree = scene.light_tree.nodes.size() > 0;
    kernels.sample_varying_lights[by_tree](view, surfaces.view(), randoms.view(), false,
                                           samples.columns(), stage.lights(), n);
    stage.scale(view, samples.columns(), n);
    for (uint32_t i = 0; i < n; ++i) {
      const LightSample<Value> s = samples.row(i);
      if (s.wi_z > 0) sum += double(s.wi_z) * glm::dvec3(s.weight_r, s.weight_g, s.weight_b);
    }
  }
  return sum / double(kSide * kSide);
}

/// The same by paths that scatter once on a white floor there.
glm::dvec3 rendered(const Scene& scene, const KernelTable& kernels, uint32_t samples,
                    LightSampling ways = LightSampling::kBoth) {
  PlanOptions options;
  options.max_depth = 1;
  options.light_sampling = ways;
  const std::vector<float> rgb =
      render_film(scene, make_plan(scene, kernels, options), 0, samples).resolve();
  return kPi * glm::dvec3(rgb[0], rgb[1], rgb[2]);
}
/// One pixel, a point of the floor.
std::string floor_view() {
  return view_text("2.8 -.9 .5", ".3 -.4 0", .01, 1, 1) + matte_text("1 1 1") +
         quad_text("-9 -9 0", "9 -9 0", "9 9 0", "-9 9 0");
}
const glm::dvec3 kFloorPoint(.3, -.4, 0);

void expect_near(const glm::dvec3& found, const glm::dvec3& expected, double share,
                 const char* what) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(found[c], expected[c], share * expected[c]) << what << ", channel " << c;
}

TEST_P(VaryingEmission, ATexturedSquareLightsAsQuadratureSays) {
  const std::string text = floor_view() + kSlope + kHalves + lit_by_texture("slope") +
                           "Material \"null\"\n" + lamp_quad() + "WorldEnd\n";
  const Scene scene = compile_text(text, kernels(), ColourMode::kRgb);
  const glm::dvec3 expected = quadrature(kFloorPoint, {0, 0, 1}, false, slope);
  expect_near(sampled(scene, kernels(), kFloorPoint), expected, 3e-3, "light samples");
  expect_near(rendered(scene, kernels(), 8192), expected, 1e-2, "both ways");
  expect_near(rendered(scene, kernels(), 8192, LightSampling::kLights), expected, 1e-2, "lights");
  expect_near(rendered(scene, kernels(), 8192, LightSampling::kBsdf), expected, 2e-2, "by chance");
}

TEST_P(VaryingEmission, ACheckerboardIsItsHalves) {
  const auto scene_of = [&](const std::string& lights) {
    return compile_text(floor_view() + kHalves + "Material \"null\"\n" + lights + "WorldEnd\n",
                        kernels(), ColourMode::kRgb);
  };
  const Scene checked = scene_of(lit_by_texture("halves") + lamp_quad());
  const Scene half =
      scene_of(light_text("2 2 2") + quad_text("0 -1 1", "0 1 1", "1 1 1", "1 -1 1"));
  const glm::dvec3 expected = quadrature(kFloorPoint, {0, 0, 1}, false, halves);
  // Triangles of the light are cut by the edge: grids of numbers are off by their step there.
  expect_near(sampled(checked, kernels(), kFloorPoint), expected, 1e-2, "light samples");
  expect_near(rendered(checked, kernels(), 8192), expected, 1e-2, "paths");
  expect_near(rendered(half, kernels(), 8192), expected, 1e-2, "half a lamp");
}

// What paths see of a light, over all directions from a point, is its irradiance there.
TEST_P(VaryingEmission, WhatIsSeenIsWhatLights) {
  constexpr uint32_t kSize = 200;
  // From (0, 0, 0) straight up, 120 degrees wide and high: x of the picture along +x or -x.
  const std::string text =
      "LookAt 0 0 0  0 0 1  0 1 0\nCamera \"perspective\" \"float fov\" [120]\nPixelFilter \"box\" "
      "\"float xwidth\" [.5] \"float ywidth\" [.5]\nFilm \"fleximage\" \"integer xresolution\" [" +
      std::to_string(kSize) + "] \"integer yresolution\" [" + std::to_string(kSize) +
      "]\nWorldBegin\n" + kSlope + lit_by_texture("slope") + lamp_quad() + "WorldEnd\n";
  const Scene scene = compile_text(text, kernels(), ColourMode::kRgb);
  PlanOptions options;
  options.max_depth = 0;
  const std::vector<float> rgb =
      render_film(scene, make_plan(scene, kernels(), options), 0, 4).resolve();
  glm::dvec3 sum(0.);
  const double half = std::tan(60 * kPi / 180), area = std::pow(2 * half / kSize, 2);
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) {
      const double px = ((x + .5) / kSize * 2 - 1) * half, py = ((y + .5) / kSize * 2 - 1) * half;
      const double cosine = 1 / std::sqrt(1 + px * px + py * py);
      const float* p = &rgb[3 * (size_t(y) * kSize + x)];
      sum += glm::dvec3(p[0], p[1], p[2]) * (area * std::pow(cosine, 4));
    }
  const glm::dvec3 expected = quadrature({0, 0, 0}, {0, 0, 1}, false, slope);
  expect_near(sum, expected, 5e-3, "seen");
  expect_near(sampled(scene, kernels(), {0, 0, 0}), expected, 3e-3, "light samples");
}

TEST_P(VaryingEmission, InstancesShineAsTheyArePlaced) {
  const std::string text = floor_view() + kSlope + "ObjectBegin \"lamp\"\nMaterial \"null\"\n" +
                           lit_by_texture("slope") + lamp_quad(0) +
                           "ObjectEnd\nAttributeBegin\nTranslate .5 .2 1.5\nObjectInstance "
                           "\"lamp\"\nAttributeEnd\n"
                           "AttributeBegin\nTranslate -.3 0 2\nScale -1 1 1\nObjectInstance "
                           "\"lamp\"\nAttributeEnd\nWorldEnd\n";
  const glm::dvec3 expected = to_bands(quadrature(kFloorPoint, {.5, .2, 1.5}, false, slope),
                                       colour_model(ColourMode::kRgb).light) +
                              quadrature(kFloorPoint, {-.3, 0, 2}, true, slope);
  for (const InstanceMode mode : {InstanceMode::kShare, InstanceMode::kCopy}) {
    Diagnostics diagnostics(fail_at_warnings);
    CompileOptions options;
    options.block_width = kernels().lanes;
    options.instances = mode;
    options.colour = ColourMode::kRgb;
    options.light_choice = LightChoosing::kPower;
    ThreadPool pool(1);
    const Scene scene =
        compile_scene(parse_scene(text, "test.lxs", ".", diagnostics), options, pool, diagnostics);
    EXPECT_EQ(scene.instances.empty(), mode == InstanceMode::kCopy);
    expect_near(sampled(scene, kernels(), kFloorPoint), expected, 1e-2, "light samples");
  }
}

/// Textures on lights of every shape, seen and shining, in a room.
std::string lamp_room(const std::string& picture, const std::string& profile) {
  std::string text = view_text("0 -1.15 .1", "0 0 0", 80, 32, 24) + kSlope + kHalves +
                     "Texture \"screen\" \"color\" \"imagemap\" \"string filename\" [\"" + picture +
                     "\"] \"float gamma\" [2.2] \"string filtertype\" [\"bilinear\"]\n"
                     "Texture \"cloud\" \"float\" \"fbm\" \"integer octaves\" [2]\n"
                     "Texture \"flame\" \"color\" \"mix\" \"color tex1\" [9 2 .1] \"color tex2\" "
                     "[2 5 9] \"texture amount\" [\"cloud\"]\n" +
                     matte_text(".6 .5 .4") + room_text(1.2);
  const auto lamp = [](const std::string& light, const std::string& place,
                       const std::string& shape) {
    return "AttributeBegin\n" + light + matte_text(".3 .3 .3") + place + shape + "AttributeEnd\n";
  };
  text += lamp(lit_by_texture("screen", "\"float gain\" [4]"), "",
               uv_quad("-1 1.1 -.2 -.2 1.1 -.2 -.2 1.1 .6 -1 1.1 .6", "0 1 1 1 1 0 0 0"));
  text += lamp(lit_by_texture("slope"), "Translate .5 .5 .2\nRotate 40 1 2 0\n",
               "Shape \"sphere\" \"float radius\" [.25]\n");
  text += lamp(lit_by_texture("halves"), "Translate .6 0 -.6\nRotate 30 0 1 0\n",
               "Shape \"disk\" \"float radius\" [.3]\n");
  text += lamp(lit_by_texture("flame"), "Translate -.6 .3 -.8\n",
               "Shape \"cylinder\" \"float radius\" [.1] \"float zmin\" [0] \"float zmax\" [.4]\n");
  text += lamp(lit_by_texture("slope"), "Translate .1 .6 -.9\n",
               "Shape \"torus\" \"float majorradius\" [.2] \"float minorradius\" [.06]\n");
  text += lamp("AreaLightSource \"area\" \"texture L\" [\"slope\"] \"string iesname\" [\"" +
                   profile + "\"] \"float power\" [5]\n",
               "", uv_quad("-.3 -.3 1.1 -.3 .3 1.1 .3 .3 1.1 .3 -.3 1.1", "0 0 0 1 1 1 1 0"));
  text += light_text("3 3 3") + "Material \"null\"\n" +
          quad_text("-.9 -.5 .3", "-.9 -.1 .3", "-.6 -.1 .5", "-.6 -.5 .5");
  return text + "WorldEnd\n";
}

std::string lamp_picture() {
  std::vector<uint8_t> texels;
  for (uint32_t k = 0; k < 8 * 5; ++k)
    texels.insert(texels.end(), {uint8_t(k * 6), uint8_t(255 - k * 5), uint8_t(k * 71 % 256)});
  return write_ppm("lamp_screen.ppm", 8, 5, texels);
}
/// Another one in each quarter of the azimuth.
std::string lamp_profile() {
  return write_for_scenes(
      "area_lamp.ies",
      "IESNA:LM-63-1995\n[TEST] none\nTILT=NONE\n1 1000 1 3 5 1 2 0 0 0\n1 1 50\n"
      "0 45 90\n0 90 180 270 360\n10 8 1\n10 4 1\n10 2 0\n10 6 2\n10 8 1\n");
}

TEST_P(VaryingEmission, PathsAgreeWithTheOracle) {
  for (const LightChoosing choosing : {LightChoosing::kPower, LightChoosing::kTree}) {
    Diagnostics diagnostics(fail_at_warnings);
    CompileOptions options;
    options.block_width = kernels().lanes;
    options.light_choice = choosing;
    ThreadPool pool(1);
    const Scene scene = compile_scene(
        parse_scene(lamp_room(lamp_picture(), lamp_profile()), "test.lxs", ".", diagnostics),
        options, pool, diagnostics);
    EXPECT_GE(scene.emission_programs.size(), 4u);
    PlanOptions plan;
    plan.max_depth = 4;
    plan.seed = 3;
    const double share = agreement(scene, make_plan(scene, kernels(), plan), 4, 5e-3, 1e-3);
    RecordProperty("share", std::to_string(share));
    EXPECT_GT(share, .97);
  }
}

TEST_P(VaryingEmission, SameBitsForAnyThreadsBatchAndTile) {
  const Scene scene = compile_text(lamp_room(lamp_picture(), lamp_profile()), kernels());
  const Plan plan = make_plan(scene, kernels(), {});
  const Film expected = render_film(scene, plan, 0, 4);
  for (const uint32_t threads : {1u, 3u})
    for (const uint32_t batch_rows : {16u, 1000u})
      EXPECT_TRUE(same_bits(expected, render_film(scene, plan, 0, 4, threads, batch_rows, 7)))
          << threads << " threads, " << batch_rows << " rows";
}

// As much power, by the same profile or picture, lights as a point does from far away.
TEST_P(VaryingEmission, ATinyLampByAProfileIsAPoint) {
  for (const std::string& by : {"\"string iesname\" [\"" + lamp_profile() + "\"] ",
                                "\"string mapname\" [\"" + lamp_picture() + "\"] "}) {
    const std::string common = by +
                               "\"color L\" [1 .8 .5] \"float power\" [30] \"float efficacy\" "
                               "[10]\n";
    const auto picture = [&](const std::string& light) {
      const Scene scene =
          compile_text(view_text("0 -6 4", "0 0 0", 30, 8, 8) + matte_text("1 1 1") +
                           quad_text("-9 -9 0", "9 -9 0", "9 9 0", "-9 9 0") + "AttributeBegin\n" +
                           light + "AttributeEnd\nWorldEnd\n",
                       kernels(), ColourMode::kRgb);
      PlanOptions options;
      options.max_depth = 1;
      return render_film(scene, make_plan(scene, kernels(), options), 0, 64).resolve();
    };
    // Both look down, x to x.
    const std::vector<float> point =
        picture("Translate 0 0 2\nRotate 180 1 0 0\nLightSource \"point\" " + common);
    const std::vector<float> area =
        picture("AreaLightSource \"area\" " + common + "Material \"null\"\n" +
                uv_quad("-1e-3 -1e-3 2 -1e-3 1e-3 2 1e-3 1e-3 2 1e-3 -1e-3 2", "0 0 0 1 1 1 1 0"));
    ASSERT_GT(point[0], 0);
    for (size_t i = 0; i < point.size(); ++i)
      EXPECT_NEAR(area[i], point[i], .01 * double(point[i])) << by << i;
  }
}

TEST_P(VaryingEmission, EvenLightsPlanNothingOfIt) {
  const Scene even = compile_text(everything_text(8, 8), kernels());
  const Plan plan = make_plan(even, kernels(), {});
  EXPECT_FALSE(plan.varying_emission);
  EXPECT_EQ(even.emission.size(), 0u);
  EXPECT_EQ(EmissionStage(even, kernels(), 256).bytes(), 0u);
  for (const BinPlan& bin : plan.bins) EXPECT_FALSE(bin.bin.emission_varies());
  const Scene varying = compile_text(lamp_room(lamp_picture(), lamp_profile()), kernels());
  EXPECT_TRUE(make_plan(varying, kernels(), {}).varying_emission);
}

}  // namespace
}  // namespace yat

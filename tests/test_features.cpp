// Feature pictures: what they hold, and that they are the same bits for any threads.

#include "film/features.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "many_lights.h"
#include "per_isa.h"
#include "render_scenes.h"

namespace yat {
namespace {

constexpr uint32_t kSide = 9;
constexpr FeatureSet kAll = (1u << kFeatures) - 1;

class Features : public PerIsa {};
YAT_INSTANTIATE_PER_ISA(Features);

struct Pictures {
  Film film{kSide, kSide};
  FeatureFilm features{kSide, kSide, kAll};
  std::vector<float> of(Feature feature) const { return features.resolve(feature, film); }
};

Pictures render_features(const Scene& scene, const Plan& plan, uint32_t samples,
                         uint32_t threads = 1, uint32_t batch_rows = 0, uint32_t first = 0) {
  Pictures pictures;
  RenderOptions options;
  options.first_sample = first;
  options.end_sample = first + samples;
  options.batch_rows = batch_rows;
  options.features = &pictures.features;
  ThreadPool pool(threads);
  render(scene, plan, options, pool, pictures.film);
  return pictures;
}

/// A floor below and to the right of the middle of nothing: the camera looks down at z = -2.
std::string floor_text(const std::string& material) {
  return view_text("0 0 3", "0 1e-3 0", 40, kSide, kSide) +
         "LightSource \"point\" \"point from\" [0 0 3] \"color L\" [5 5 5]\n" + material +
         "AttributeBegin\nTranslate 0 0 -2\n" +
         "Shape \"mesh\" \"integer triindices\" [0 1 2 0 2 3] \"point P\" [-9 -9 0 0 -9 0 0 9 0 "
         "-9 9 0] \"float uv\" [0 0 1 0 1 1 0 1] \"normal N\" [0 .001 1 0 0 1 0 0 1 0 0 1]\n"
         "AttributeEnd\nWorldEnd\n";
}

TEST_P(Features, OfAFlatFloor) {
  const Scene scene = compile_text(floor_text(matte_text(".6 .3 .1")), kernels());
  const Pictures p = render_features(scene, make_plan(scene, kernels(), {}), 64);
  const auto normal = p.of(Feature::kNormal), geometric = p.of(Feature::kGeometricNormal),
             depth = p.of(Feature::kDepth), position = p.of(Feature::kPosition),
             uv = p.of(Feature::kUv), albedo = p.of(Feature::kAlbedo),
             count = p.of(Feature::kSampleCount);
  uint32_t lit = 0, empty = 0;
  for (uint32_t i = 0; i < kSide * kSide; ++i) {
    EXPECT_EQ(count[i], 64.f);
    if (i % kSide == kSide / 2) continue;  // the edge, x = 0
    if (depth[i] == feature_info(Feature::kDepth).background) {
      ++empty;
      for (const auto* picture : {&normal, &geometric, &position, &albedo})
        for (int c = 0; c < 3; ++c) EXPECT_EQ((*picture)[3 * i + uint32_t(c)], 0.f);
      continue;
    }
    ++lit;
    EXPECT_NEAR(normal[3 * i + 2], 1, 1e-6);
    EXPECT_NEAR(geometric[3 * i + 2], 1, 1e-6);
    const double x = double(position[3 * i]), y = double(position[3 * i + 1]);
    EXPECT_NEAR(position[3 * i + 2], -2, 1e-5);
    EXPECT_NEAR(uv[2 * i], (x + 9) / 9, 1e-4);
    EXPECT_NEAR(uv[2 * i + 1], (y + 9) / 18, 1e-4);
    // The mean distance of a pixel's samples is that of its middle to second order.
    EXPECT_NEAR(depth[i], std::sqrt(x * x + y * y + 25), .01);
    // One direction of a Lambert surface tells its albedo exactly; the bands do to about a
    // hundredth.
    EXPECT_NEAR(albedo[3 * i], .6, .01);
    EXPECT_NEAR(albedo[3 * i + 1], .3, .01);
    EXPECT_NEAR(albedo[3 * i + 2], .1, .01);
  }
  EXPECT_EQ(lit, kSide * (kSide / 2));
  EXPECT_EQ(empty, kSide * (kSide / 2));
}

TEST_P(Features, ThatTheViewerIsBehindDoesNotShow) {
  const Scene scene =
      compile_text(floor_text("ReverseOrientation\n" + matte_text(".5 .5 .5")), kernels());
  const Pictures p = render_features(scene, make_plan(scene, kernels(), {}), 4);
  float most = 0;
  for (const float z : p.of(Feature::kNormal)) most = std::max(most, z);
  EXPECT_NEAR(most, 1, 1e-6);
}

TEST_P(Features, OfACoatedFloor) {
  // What the coat and its base divide among them is seen once.
  const Scene scene = compile_text(
      floor_text(
          "MakeNamedMaterial \"base\" \"string type\" [\"matte\"] \"color Kd\" [.3 .3 .3]\n"
          "Material \"glossycoating\" \"string basematerial\" [\"base\"] \"color Ks\" [.3 .3 "
          ".3]\n"),
      kernels());
  const Pictures p = render_features(scene, make_plan(scene, kernels(), {}), 16);
  const auto normal = p.of(Feature::kNormal), position = p.of(Feature::kPosition);
  uint32_t seen = 0;
  for (uint32_t i = 0; i < kSide * kSide; ++i) {
    if (i % kSide >= kSide / 2) continue;
    ++seen;
    EXPECT_NEAR(normal[3 * i + 2], 1, 1e-5);
    EXPECT_NEAR(position[3 * i + 2], -2, 1e-5);
  }
  EXPECT_EQ(seen, kSide * (kSide / 2));
}

TEST_P(Features, OfAFloorOfUnequalMaterials) {
  // The brighter material is chosen more often: what is seen of it counts the less.
  const Scene scene = compile_text(
      floor_text("MakeNamedMaterial \"a\" \"string type\" [\"matte\"] \"color Kd\" [.04 .04 .04]\n"
                 "MakeNamedMaterial \"b\" \"string type\" [\"matte\"] \"color Kd\" [.8 .8 .8]\n"
                 "Material \"mix\" \"string namedmaterial1\" [\"a\"] \"string namedmaterial2\" "
                 "[\"b\"] \"float amount\" [.25]\n"),
      kernels());
  const Pictures p = render_features(scene, make_plan(scene, kernels(), {}), 256);
  const auto normal = p.of(Feature::kNormal), albedo = p.of(Feature::kAlbedo);
  double sum = 0;
  uint32_t seen = 0;
  for (uint32_t i = 0; i < kSide * kSide; ++i) {
    if (i % kSide >= kSide / 2) continue;
    ++seen;
    EXPECT_NEAR(normal[3 * i + 2], 1, 1e-5);
    sum += double(albedo[3 * i]);
  }
  EXPECT_NEAR(sum / seen, .75 * .04 + .25 * .8, .003);
}

/// A quad about (x, 0, -2), 2 wide, 4 long, flat, with texture coordinates.
std::string tile_text(double x) {
  const std::string left = std::to_string(x - 1), right = std::to_string(x + 1);
  return "Shape \"mesh\" \"integer triindices\" [0 1 2 0 2 3] \"point P\" [" + left + " -2 -2 " +
         right + " -2 -2 " + right + " 2 -2 " + left + " 2 -2] \"float uv\" [0 0 1 0 1 1 0 1]\n";
}

TEST_P(Features, NumbersSayWhichObjectAndMaterial) {
  // Seen from above, from the left: an object of its own, one behind a null surface, two instances.
  const std::string text =
      view_text("0 0 8", "0 1e-3 0", 60, kSide, kSide) +
      "LightSource \"point\" \"point from\" [0 0 3] \"color L\" [5 5 5]\n" +
      "MakeNamedMaterial \"a\" \"string type\" [\"matte\"]\n" + tile_text(-4.5) +
      "NamedMaterial \"a\"\n" + tile_text(-1.5) +
      "AttributeBegin\nTranslate 0 0 1\nMaterial \"null\"\n" + light_text("1 1 1") +
      tile_text(-1.5) + "AttributeEnd\n" + matte_text(".2 .2 .2") + "ObjectBegin \"o\"\n" +
      tile_text(0) + "ObjectEnd\n" +
      "AttributeBegin\nTranslate 1.5 0 0\nObjectInstance \"o\"\nAttributeEnd\n" +
      "AttributeBegin\nTranslate 4.5 0 0\nObjectInstance \"o\"\nAttributeEnd\nWorldEnd\n";
  // Shapes are 1 to 4 (the object's is the fourth), instances 5 and 6; "a" is material 1, null 2.
  constexpr float kObjects[] = {1, 2, 5, 6}, kMaterials[] = {0, 1, 3, 3};
  Diagnostics diagnostics([](Severity, std::string_view) {});
  const Description description = parse_scene(text, "test.lxs", ".", diagnostics);
  for (const InstanceMode mode : {InstanceMode::kCopy, InstanceMode::kShare}) {
    CompileOptions options;
    options.block_width = kernels().lanes;
    options.instances = mode;
    options.ids = true;
    ThreadPool pool(1);
    const Scene scene = compile_scene(description, options, pool, diagnostics);
    // One sample: its place says which object it met.
    const Pictures p = render_features(scene, make_plan(scene, kernels(), {}), 1);
    const auto object = p.of(Feature::kObjectId), material = p.of(Feature::kMaterialId),
               position = p.of(Feature::kPosition), depth = p.of(Feature::kDepth);
    uint32_t seen[4] = {};
    for (uint32_t i = 0; i < kSide * kSide; ++i) {
      if (depth[i] == feature_info(Feature::kDepth).background) {
        EXPECT_EQ(object[i], 0.f);
        EXPECT_EQ(material[i], 0.f);
        continue;
      }
      const auto tile = uint32_t((position[3 * i] + 6) / 3);
      ASSERT_LT(tile, 4u);
      ++seen[tile];
      EXPECT_EQ(object[i], kObjects[tile]);
      EXPECT_EQ(material[i], kMaterials[tile]);
    }
    for (const uint32_t n : seen) EXPECT_GT(n, 0u);
  }
}

TEST_P(Features, FlatMeshesKeepTextureCoordinatesWhereAskedFor) {
  const std::string text = view_text("0 0 3", "0 1e-3 0", 20, kSide, kSide) +
                           "LightSource \"point\" \"color L\" [5 5 5]\n" + matte_text(".5 .5 .5") +
                           tile_text(0) + "WorldEnd\n";
  for (const bool keep : {false, true}) {
    const Scene scene = compile_text(text, kernels(), ColourMode::kBands, keep);
    const Pictures p = render_features(scene, make_plan(scene, kernels(), {}), 4);
    const auto position = p.of(Feature::kPosition), uv = p.of(Feature::kUv);
    for (uint32_t i = 0; i < kSide * kSide; ++i) {
      EXPECT_NEAR(uv[2 * i], keep ? (position[3 * i] + 1) / 2 : 0, 1e-5);
      EXPECT_NEAR(uv[2 * i + 1], keep ? (position[3 * i + 1] + 2) / 4 : 0, 1e-5);
    }
  }
}

TEST_P(Features, PartsOfTheLightAddUp) {
  for (const LightChoosing choosing : {LightChoosing::kAuto, LightChoosing::kAll}) {
    const Scene scene = compile_lamps(everything_text(kSide, kSide), kernels(), choosing);
    ASSERT_EQ(scene.every_light, choosing == LightChoosing::kAll);
    const Plan plan = make_plan(scene, kernels(), {});
    const Pictures p = render_features(scene, plan, 32);
    const auto direct = p.of(Feature::kDirect), indirect = p.of(Feature::kIndirect),
               all = p.film.resolve();
    const std::vector<float> plain = render_film(scene, plan, 0, 32).resolve();
    double sum = 0;
    for (size_t i = 0; i < all.size(); ++i) {
      EXPECT_NEAR(direct[i] + indirect[i], all[i], 1e-5f * (1 + std::fabs(all[i])));
      EXPECT_NEAR(all[i], plain[i], 1e-5f * (1 + std::fabs(plain[i])));
      sum += double(indirect[i]);
    }
    EXPECT_GT(sum, 0);
  }
}

TEST_P(Features, DirectLightIsThatOfDepthOne) {
  for (const LightChoosing choosing : {LightChoosing::kAuto, LightChoosing::kAll}) {
    const Scene scene = compile_lamps(everything_text(kSide, kSide), kernels(), choosing);
    PlanOptions one;
    one.max_depth = 1;
    const std::vector<float> alone =
        render_film(scene, make_plan(scene, kernels(), one), 0, 16).resolve();
    const auto direct =
        render_features(scene, make_plan(scene, kernels(), {}), 16).of(Feature::kDirect);
    // Random numbers are keyed by vertex: the first vertices of both renders are the same.
    for (size_t i = 0; i < alone.size(); ++i)
      EXPECT_NEAR(direct[i], alone[i], 1e-5f * (1 + std::fabs(alone[i])));
  }
}

TEST_P(Features, VarianceIsThatOfTheSamples) {
  const Scene scene = compile_text(everything_text(kSide, kSide), kernels());
  const Plan plan = make_plan(scene, kernels(), {});
  constexpr uint32_t kSamples = 12;
  const auto variance = render_features(scene, plan, kSamples).of(Feature::kVariance);
  std::vector<double> sum(variance.size()), squares(variance.size());
  for (uint32_t s = 0; s < kSamples; ++s) {
    const std::vector<float> sample = render_film(scene, plan, s, s + 1).resolve();
    for (size_t i = 0; i < sample.size(); ++i) {
      sum[i] += double(sample[i]);
      squares[i] += double(sample[i]) * double(sample[i]);
    }
  }
  for (size_t i = 0; i < variance.size(); ++i) {
    const double wanted = (squares[i] - sum[i] * sum[i] / kSamples) / (kSamples - 1);
    EXPECT_NEAR(variance[i], wanted, 1e-5 * (squares[i] + 1e-6));
  }
}

TEST_P(Features, SameBitsForAnyThreadsAndBatch) {
  const Scene scene = compile_text(everything_text(kSide, kSide), kernels());
  const Plan plan = make_plan(scene, kernels(), {});
  const Pictures expected = render_features(scene, plan, 6);
  const auto expect_same = [&](const Pictures& p, const char* what) {
    EXPECT_TRUE(same_bits(expected.film, p.film)) << what;
    for (uint32_t f = 0; f < kFeatures; ++f)
      EXPECT_EQ(expected.of(Feature(f)), p.of(Feature(f)))
          << what << ' ' << feature_info(Feature(f)).name;
  };
  expect_same(render_features(scene, plan, 6, 3), "3 threads");
  expect_same(render_features(scene, plan, 6, 2, 16), "16 rows");
  Pictures merged = render_features(scene, plan, 4, 1, 0, 2);
  const Pictures rest = render_features(scene, plan, 2, 2);
  merged.film.merge(rest.film);
  merged.features.merge(rest.features);
  expect_same(merged, "two ranges merged");
}

TEST(FeatureNames, AreReadAndRefused) {
  EXPECT_EQ(parse_features("--aov", "all"), kAll);
  EXPECT_EQ(parse_features("--aov", "depth,albedo"),
            feature_bit(Feature::kDepth) | feature_bit(Feature::kAlbedo));
  EXPECT_EQ(feature_names(feature_bit(Feature::kUv) | feature_bit(Feature::kNormal)), "normal,uv");
  for (const char* bad : {"", "albedo,", "norml", "Albedo"})
    EXPECT_THROW(parse_features("--aov", bad), UsageError) << bad;
  try {
    parse_features("--aov", "norml");
  } catch (const UsageError& e) {
    EXPECT_NE(std::string(e.what()).find("did you mean \"normal\"?"), std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace yat

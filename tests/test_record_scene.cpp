// The recorded rays are those of the scene.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "kernels/dispatch.h"
#include "record_scene.h"
#include "run_program.h"

namespace yat::bench {
namespace {

constexpr const char* kCornell = YAT_SOURCE_DIR "/scenes/cornell-box/cornell-box.lxs";

std::map<std::string, RaySet> record(const std::string& scene, const RecordOptions& options) {
  Diagnostics diagnostics([](Severity, std::string_view) {});
  std::map<std::string, RaySet> sets;
  for (RaySet& set : record_scene(scene, select_kernels(), options, diagnostics).sets)
    sets[set.name] = std::move(set);
  return sets;
}

TEST(RecordScene, SetsOfTheCornellBox) {
  const auto sets = record(kCornell, {64, 36, 2, 3, 0, RecordMaterials::kMatte});
  ASSERT_EQ(sets.size(), 7u);
  EXPECT_EQ(sets.at("camera").rays.size(), 64u * 36 * 2);
  // Every camera ray that hits something is reflected, and goes on.
  EXPECT_EQ(sets.at("mirror").rays.size(), sets.at("diffuse 1").rays.size());
  EXPECT_LT(sets.at("mirror").rays.size(), sets.at("camera").rays.size());
  EXPECT_LT(sets.at("diffuse 3").rays.size(), sets.at("diffuse 2").rays.size());
  for (const auto& [name, set] : sets) {
    EXPECT_EQ(set.shadow, name.starts_with("shadow")) << name;
    for (const Ray<Value>& r : set.rays) {
      const double length = std::hypot(double(r.dir_x), double(r.dir_y), double(r.dir_z));
      ASSERT_TRUE(set.shadow ? length < 2000 && r.t_max == 1 : std::abs(length - 1) < 1e-5) << name;
    }
  }
}

TEST(RecordScene, SameRaysEveryTime) {
  const RecordOptions options{16, 16, 1, 2, 5, RecordMaterials::kMatte};
  const auto first = record(kCornell, options), second = record(kCornell, options);
  for (const auto& [name, set] : first) {
    const auto& other = second.at(name);
    ASSERT_EQ(set.rays.size(), other.rays.size()) << name;
    for (size_t i = 0; i < set.rays.size(); ++i) {
      ASSERT_EQ(set.rays[i].org_x, other.rays[i].org_x) << name;
      ASSERT_EQ(set.rays[i].dir_z, other.rays[i].dir_z) << name;
    }
  }
}

TEST(RecordScene, OwnMaterialsMakePaths) {
  // What a mirror or glass ball sends on is not lit: fewer shadow rays than where all is matte.
  const std::string scene = YAT_SOURCE_DIR "/scenes/mirror-and-glass/mirror-and-glass.lxs";
  const auto own = record(scene, {64, 64, 1, 3, 0, RecordMaterials::kScene});
  const auto matte = record(scene, {64, 64, 1, 3, 0, RecordMaterials::kMatte});
  EXPECT_TRUE(own.contains("path 1") && own.contains("path 3"));
  EXPECT_FALSE(own.contains("diffuse 1"));
  EXPECT_LT(own.at("shadow 1").rays.size(), matte.at("shadow 1").rays.size());
  EXPECT_FALSE(matte.contains("shadow 3"));
}

TEST(RecordScene, SceneWithoutTriangles) {
  Diagnostics diagnostics([](Severity, std::string_view) {});
  std::filesystem::create_directories(YAT_TEST_OUTPUT_DIR);
  const std::string scene = YAT_TEST_OUTPUT_DIR "/sphere.lxs";
  write_whole(scene,
              "LookAt 0 -5 0 0 0 0 0 0 1\nCamera \"perspective\"\nFilm \"fleximage\"\n"
              "WorldBegin\nLightSource \"point\"\nShape \"sphere\"\nWorldEnd\n");
  try {
    record_scene(scene, select_kernels(), {}, diagnostics);
    FAIL() << "recorded";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              scene +
                  ": error: no triangles, so no rays to trace through a tree; take a scene "
                  "that has a mesh");
  }
}

}  // namespace
}  // namespace yat::bench

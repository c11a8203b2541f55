// Whole scenes from text: the bundled ones, and real ones where they are at hand.

#include <cstdlib>
#include <filesystem>

#include "scene/parse.h"
#include "scene_builder.h"

namespace yat {
namespace {

/// Reads and compiles a file, keeping every message.
class CompileScenes : public testing::Test {
 protected:
  Scene load(const std::filesystem::path& path) {
    const Description description = read_scene(path.string(), diagnostics);
    return compile_scene(description, {}, pool, diagnostics);
  }
  Scene bundled(const std::string& name) {
    return load(std::filesystem::path(YAT_SOURCE_DIR) / "scenes" / name / (name + ".lxs"));
  }
  /// Empty path if the real scenes are not here.
  static std::filesystem::path shared(const std::string& name) {
    const char* given = std::getenv("YAT_SHARED_SCENES");
    const std::filesystem::path folder =
        given ? std::filesystem::path(given)
              : std::filesystem::path(YAT_SOURCE_DIR) / ".." / "shared" / "scenes";
    return std::filesystem::exists(folder / name) ? folder / name : std::filesystem::path();
  }
  static uint32_t bins_of(const Scene& scene, MaterialKind kind) {
    uint32_t n = 0;
    for (size_t b = 1; b < scene.bins.size(); ++b) n += scene.bins[b].material == kind;
    return n;
  }
  /// Warnings and errors: a note, as of an accelerator of another name, loses nothing.
  std::string messages;
  Diagnostics diagnostics{[this](Severity severity, std::string_view line) {
    if (severity != Severity::kNote) messages += std::string(line) + "\n";
  }};
  ThreadPool pool{1};
};

#define SHARED_OR_SKIP(name)                       \
  const std::filesystem::path path = shared(name); \
  if (path.empty()) GTEST_SKIP() << "no real scenes here: set YAT_SHARED_SCENES to their folder"

TEST_F(CompileScenes, CornellBox) {
  const Scene scene = bundled("cornell-box");
  EXPECT_EQ(messages, "");
  EXPECT_EQ(scene.triangles.size(), 2u * (1 + 5 + 5 + 5));
  EXPECT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.bins.size(), 3u) << "flat matte, dark and shining";
  EXPECT_EQ(scene.film.width, 512u);
  // The lamp shines down.
  const auto l = scene.lights.row(0);
  EXPECT_LT(l.b_z * l.c_x - l.b_x * l.c_z, 0);
}

TEST_F(CompileScenes, TheOtherBundledScenesSayNothing) {
  Scene scene = bundled("mirror-and-glass");
  EXPECT_EQ(bins_of(scene, MaterialKind::kMirror), 1u);
  EXPECT_EQ(bins_of(scene, MaterialKind::kGlass), 1u);
  EXPECT_EQ(bins_of(scene, MaterialKind::kOrenNayar), 1u);
  EXPECT_EQ(scene.spheres.size(), 2u);
  scene = bundled("sphere-light");
  EXPECT_EQ(scene.spheres.row(0).occludes, 0u);
  EXPECT_EQ(scene.planes.size(), 1u);
  scene = bundled("point-light");
  EXPECT_TRUE(scene.direct_only);
  EXPECT_EQ(scene.light_kinds, 1u << uint32_t(LightKind::kPoint));
  scene = bundled("sunlit-plane");
  EXPECT_EQ(scene.light_kinds, 1u << uint32_t(LightKind::kDistant));
  EXPECT_EQ(scene.triangles.size(), 36u);
  EXPECT_EQ(scene.spheres.size(), 3u);
  EXPECT_EQ(scene.camera_kind, CameraKind::kThinLens);
  scene = bundled("furnace");
  EXPECT_EQ(scene.lights.size(), 12u);
  for (uint32_t i = 0; i < 12; ++i) {
    // Inwards: b x c points at the origin.
    const auto l = scene.lights.row(i);
    const double n[3] = {double(l.b_y * l.c_z - l.b_z * l.c_y),
                         double(l.b_z * l.c_x - l.b_x * l.c_z),
                         double(l.b_x * l.c_y - l.b_y * l.c_x)};
    EXPECT_LT(n[0] * double(l.a_x) + n[1] * double(l.a_y) + n[2] * double(l.a_z), 0);
  }
  scene = bundled("materials");
  EXPECT_GE(scene.bins.size(), 15u) << "sixteen balls, nearly all of another kind";
  scene = bundled("shapes");
  EXPECT_EQ(scene.spheres.size(), 1u);
  EXPECT_EQ(scene.planes.size(), 1u);
  EXPECT_EQ(scene.shapes.size(), 8u) << "two spheres that are not whole or round, and six kinds";
  scene = bundled("textures");
  EXPECT_EQ(scene.programs.size(), 7u);
  scene = bundled("sun-and-sky");
  EXPECT_EQ(scene.light_kinds, 1u << uint32_t(LightKind::kSun) | 1u << uint32_t(LightKind::kSky));
  EXPECT_EQ(scene.shapes.size(), 10u) << "a column is a cylinder";
  EXPECT_EQ(messages, "");
}

TEST_F(CompileScenes, RealCornellBox) {
  SHARED_OR_SKIP("CornellBox/cornell-box.lxs");
  const Scene scene = load(path);
  EXPECT_EQ(messages, "");
  EXPECT_EQ(scene.film.width, 960u);
  EXPECT_EQ(scene.film.tone_map, ToneMap::kReinhard);
  EXPECT_EQ(scene.light_kinds, 1u << uint32_t(LightKind::kRectangle));
  EXPECT_EQ(scene.lights.size(), 1u);
  EXPECT_FALSE(scene.all_occlude);
  EXPECT_EQ(scene.spheres.size() + scene.planes.size(), 0u);
}

TEST_F(CompileScenes, RealPillars) {
  SHARED_OR_SKIP("Pillar");
  uint32_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(path)) {
    if (entry.path().extension() != ".lxs") continue;
    ++files;
    messages.clear();
    const Scene scene = load(entry.path());
    SCOPED_TRACE(entry.path().string());
    EXPECT_EQ(scene.planes.size(), 1u);
    EXPECT_GE(scene.lights.size(), 1u);
    EXPECT_EQ(messages, "");
  }
  EXPECT_GE(files, 5u);
}

TEST_F(CompileScenes, RealDragon) {
  SHARED_OR_SKIP("Dragon/dragon-202k.lxs");
  const Scene scene = load(path);
  EXPECT_EQ(messages, "");
  EXPECT_GT(scene.triangles.size(), 200000u);
  EXPECT_EQ(scene.triangle_vertices.size(), scene.triangles.size());
  EXPECT_EQ(bins_of(scene, MaterialKind::kMirror), 1u);
}

}  // namespace
}  // namespace yat

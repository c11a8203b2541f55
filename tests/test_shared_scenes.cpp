// Real scenes, where they are at hand: every one is read, and what is said of them is right.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/parse.h"
#include "scene/ply.h"

namespace yat {
namespace {

namespace fs = std::filesystem;

fs::path shared_scenes() {
  const char* path = std::getenv("YAT_SHARED_SCENES");
  return path ? fs::path(path) : fs::path(YAT_SOURCE_DIR).parent_path() / "shared" / "scenes";
}

std::vector<fs::path> files_with(const std::string& extension) {
  std::vector<fs::path> found;
  if (!fs::exists(shared_scenes())) return found;
  for (const auto& entry : fs::recursive_directory_iterator(shared_scenes()))
    if (entry.path().extension() == extension) found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

/// What there is to say of these scenes, checked by hand: one TransformBegin of the Benchmarks has
/// no end.
bool is_right(const std::string& line) {
  const auto has = [&](const char* part) { return line.find(part) != std::string::npos; };
  return has("Benchmarks/Lights.lxs:13:1 is still open when the world ends, add TransformEnd") &&
         has(": warning: TransformBegin at ");
}

TEST(SharedScenes, AllAreReadAndRoundTrip) {
  const std::vector<fs::path> scenes = files_with(".lxs");
  if (scenes.empty())
    GTEST_SKIP() << "no scenes under " << shared_scenes() << "; set YAT_SHARED_SCENES";
  for (const fs::path& path : scenes) {
    // A part that others include, whatever its name says.
    if (path.filename() == "Lights.lxs") continue;
    std::vector<std::string> said;
    Diagnostics diagnostics([&](Severity, std::string_view line) { said.emplace_back(line); });
    Description scene;
    ASSERT_NO_THROW(scene = read_scene(path.string(), diagnostics)) << path;
    EXPECT_TRUE(scene.camera && scene.film) << path;
    EXPECT_FALSE(scene.shapes.empty()) << path;
    for (const std::string& line : said) EXPECT_TRUE(is_right(line)) << line;
    Diagnostics second([](Severity, std::string_view) {});
    const std::string printed = print_description(scene);
    const Description back = parse_scene(printed, "printed.lxs", scene.directory, second, false);
    EXPECT_EQ(back.shapes.size(), scene.shapes.size()) << path;
    EXPECT_EQ(print_description(back), printed) << path;
  }
}

TEST(SharedScenes, AllMeshesAreRead) {
  const std::vector<fs::path> meshes = files_with(".ply");
  if (meshes.empty())
    GTEST_SKIP() << "no meshes under " << shared_scenes() << "; set YAT_SHARED_SCENES";
  for (const fs::path& path : meshes) {
    PlyMesh mesh;
    ASSERT_NO_THROW(mesh = read_ply(path.string())) << path;
    EXPECT_TRUE(mesh.warnings.empty()) << path << mesh.warnings.front();
    EXPECT_EQ(mesh.skipped + mesh.polygons, 0u) << path;
    EXPECT_EQ(mesh.triangles.size() / 3, mesh.faces + mesh.quads) << path;
  }
}

}  // namespace
}  // namespace yat

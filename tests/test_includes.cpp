// Include: where files are looked for, what may go wrong with them, and that the hash covers them.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "scene_text.h"

namespace yat {
namespace {

class Includes : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(YAT_TEST_OUTPUT_DIR) /
              testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder_ / "parts");
  }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  /// Messages with the folder cut out.
  std::vector<std::string> read(const std::string& name) {
    std::vector<std::string> said;
    Diagnostics diagnostics([&](Severity, std::string_view line) { said.emplace_back(line); });
    try {
      scene_ = read_scene((folder_ / name).string(), diagnostics);
    } catch (const Error& error) {
      said.emplace_back(error.what());
    }
    const std::string prefix = folder_.string() + "/";
    for (std::string& line : said)
      for (size_t at; (at = line.find(prefix)) != std::string::npos;) line.erase(at, prefix.size());
    return said;
  }
  using Lines = std::vector<std::string>;
  std::filesystem::path folder_;
  Description scene_;
};

TEST_F(Includes, AreFoundFromTheMainFileThenFromTheIncludingOne) {
  write("main.lxs", "WorldBegin\nInclude \"parts/a.lxo\"\nInclude \"parts\\b.lxo\"\nWorldEnd\n");
  write("parts/a.lxo", "Shape \"a\" Include \"parts/b.lxo\"\nInclude \"b.lxo\" Shape \"end\"");
  write("parts/b.lxo", "Shape \"b\"");
  EXPECT_EQ(read("main.lxs"),
            (Lines{"parts/a.lxo:2:9: note: \"b.lxo\" is not in the folder of the main file, taken "
                   "from the folder of the file that includes it",
                   "main.lxs:3:9: note: the backslashes in \"parts\\b.lxo\" are taken as folder "
                   "separators, write / instead"}));
  Lines types;
  for (const ShapeEntry& shape : scene_.shapes) types.push_back(shape.plugin.type);
  EXPECT_EQ(types, (Lines{"a", "b", "b", "end", "b"}));
}

TEST_F(Includes, StandBetweenAnyTwoTokens) {
  write("main.lxs", "WorldBegin Shape \"s\" \"float a\" [1 Include \"n.lxo\" 4] WorldEnd");
  write("n.lxo", "2 # two\n3");
  EXPECT_EQ(read("main.lxs"), Lines{});
  EXPECT_EQ(scene_.shapes[0].plugin.parameters[0].floats, (std::vector<float>{1, 2, 3, 4}));
}

TEST_F(Includes, Missing) {
  write("main.lxs", "WorldBegin\n  Include \"gone.lxo\"\nWorldEnd\n");
  EXPECT_EQ(read("main.lxs"), (Lines{"main.lxs:2:11: error: Include \"gone.lxo\": no such file, "
                                     "looked for \"gone.lxo\""}));
  EXPECT_EQ(read("none.lxs"),
            (Lines{"none.lxs: error: cannot be read: No such file or directory"}));
}

TEST_F(Includes, AFolderIsNoFile) {
  write("main.lxs", "WorldBegin Include \"parts\" WorldEnd");
  EXPECT_EQ(
      read("main.lxs"),
      (Lines{"main.lxs:1:20: error: Include \"parts\": parts cannot be read: is a directory"}));
}

TEST_F(Includes, Circle) {
  write("main.lxs", "Include \"a.lxo\"");
  write("a.lxo", "\nInclude \"./main.lxs\"");
  EXPECT_EQ(read("main.lxs"), (Lines{"a.lxo:2:9: error: Include \"./main.lxs\": this file is being "
                                     "read already, remove the circle"}));
}

TEST_F(Includes, DepthHasALimit) {
  for (int i = 0; i < 40; ++i)
    write(std::to_string(i) + ".lxs", "Include \"" + std::to_string(i + 1) + ".lxs\"\n");
  EXPECT_EQ(read("0.lxs"), (Lines{"32.lxs:1:9: error: Include is nested more than 32 deep"}));
}

TEST_F(Includes, ErrorsNameTheIncludedFile) {
  write("main.lxs", "WorldBegin Include \"parts/a.lxo\" WorldEnd");
  write("parts/a.lxo", "\r\n\rShape \"s\", \n Shap");
  EXPECT_EQ(read("main.lxs"),
            (Lines{"parts/a.lxo:3:10: warning: character ',' has no meaning here, skipped like any "
                   "further ones in this file",
                   "parts/a.lxo:4:2: error: unknown directive Shap (did you mean \"Shape\"?)"}));
}

TEST_F(Includes, HashCoversAllText) {
  write("main.lxs", "WorldBegin Include \"a.lxo\" WorldEnd");
  write("a.lxo", "# one");
  read("main.lxs");
  const uint64_t first = scene_.hash;
  // FNV-1a 64 of the two texts, one after the other.
  uint64_t hash = 14695981039346656037ull;
  for (const char c : std::string("WorldBegin Include \"a.lxo\" WorldEnd# one"))
    hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  EXPECT_EQ(first, hash);
  write("a.lxo", "# two");
  read("main.lxs");
  EXPECT_NE(scene_.hash, first);
}

}  // namespace
}  // namespace yat

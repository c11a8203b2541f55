#pragma once
// Where scenes and pictures of other renderers lie that the project does not own. Tests that need
// one skip when it is absent.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace yat {

/// Path of a file in the shared scenes: under $YAT_SHARED_SCENES, else beside the repository.
/// Empty when it is not there.
inline std::string shared_scene(const std::string& name) {
  const char* folder = std::getenv("YAT_SHARED_SCENES");
  const std::filesystem::path path =
      (folder && *folder ? std::filesystem::path(folder)
                         : std::filesystem::path(YAT_SOURCE_DIR) / ".." / "shared" / "scenes") /
      name;
  return std::filesystem::exists(path) ? path.string() : std::string();
}

#define YAT_NEED_SHARED(variable, name)                 \
  const std::string variable = yat::shared_scene(name); \
  if (variable.empty())                                 \
  GTEST_SKIP() << name << " is not here: set YAT_SHARED_SCENES to the folder of shared scenes"

}  // namespace yat

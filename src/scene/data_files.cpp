// Where data files are looked for (lxs 1.5).

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "scene/compile_parts.h"

namespace yat {

std::string find_data_file(const std::string& name, SourceLoc loc, const Description& description,
                           Diagnostics& diagnostics) {
  namespace fs = std::filesystem;
  if (name.empty()) return {};
  const auto is_file = [](const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
  };
  const fs::path scene_folder(description.directory);
  const fs::path including = fs::path(std::string(diagnostics.file_name(loc.file))).parent_path();
  // As written; with Windows' separators as our own; the last component alone, which finds files
  // of scenes that were moved from another machine.
  std::string slashes = name;
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  for (const std::string& spelling : {name, slashes})
    for (const fs::path& folder : {scene_folder, including})
      if (const fs::path path = folder / spelling; is_file(path)) return path.string();
  const fs::path last = fs::path(slashes).filename();
  for (const fs::path& folder : {scene_folder, including})
    if (const fs::path path = folder / last; !last.empty() && is_file(path)) {
      diagnostics.note(loc, fmt::format("\"{}\" not found: \"{}\" is used", name, path.string()));
      return path.string();
    }
  return {};
}

}  // namespace yat

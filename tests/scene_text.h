#pragma once
// Reading scene text in tests, with what was said of it.

#include <string>
#include <string_view>
#include <vector>

#include "scene/parse.h"

namespace yat {

struct ReadResult {
  Description scene;
  std::vector<std::string> said;  ///< every message, in order; the error that ended it last
  bool ended = false;             ///< by an error
};

/// Reads `text` as "t.lxs", from memory and without includes.
inline ReadResult read_text(std::string_view text) {
  ReadResult result;
  Diagnostics diagnostics([&](Severity, std::string_view line) { result.said.emplace_back(line); });
  try {
    result.scene = parse_scene(text, "t.lxs", "", diagnostics, false);
  } catch (const Error& error) {
    result.said.emplace_back(error.what());
    result.ended = true;
  }
  return result;
}

/// The same, with `text` in the world: line 2 of the file.
inline ReadResult read_world(std::string_view text) {
  return read_text("WorldBegin\n" + std::string(text) + "\nWorldEnd\n");
}

}  // namespace yat

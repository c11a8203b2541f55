#pragma once
// What this program was built from and how.

#include <string_view>

namespace yat {

struct BuildInfo {
  std::string_view version;     ///< "0.1.0"
  std::string_view commit;      ///< git commit, "+" added for a changed work tree; or "unknown"
  std::string_view compiler;    ///< "GNU 12.2.0"
  std::string_view flags;       ///< of the build type, without those of an instruction set
  std::string_view build_type;  ///< "Release"
};

extern const BuildInfo kBuildInfo;

}  // namespace yat

#pragma once
// Scene text -> Description, and back.

#include <string>
#include <string_view>

#include "base/error.h"
#include "scene/description.h"

namespace yat {

/// Reads a scene file and what it includes. Throws Error (file:line:column: error: ...) when no
/// picture can come of it; lesser trouble goes to `diagnostics` and reading goes on.
Description read_scene(const std::string& path, Diagnostics& diagnostics,
                       Dialect dialect = Dialect::kLuxRender);

/// The same from memory: `name` is shown in messages, `directory` is where includes and data files
/// are looked up. With `may_include` false an Include is an error (fuzzing).
Description parse_scene(std::string_view text, const std::string& name,
                        const std::string& directory, Diagnostics& diagnostics,
                        bool may_include = true, Dialect dialect = Dialect::kLuxRender);

/// The description (as the two functions above make it) as .lxs text that parses to the same rows
/// and parameters by LuxRender's rules, in one file and without blocks that do nothing. Only names
/// may differ: where two definitions had one name each gets its own, and an inline Material gets
/// one.
std::string print_description(const Description& description);

}  // namespace yat

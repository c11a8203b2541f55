#pragma once
// Text files that appear whole or not at all.

#include <string>
#include <string_view>

namespace yat {

/// Makes the folder that `path` is in, and checks that a file can be written there: better before
/// the render than after it. Throws ResourceError naming the path.
void require_writable(const std::string& path);

/// Writes beside the path and renames. Throws ResourceError.
void write_text_file(const std::string& path, std::string_view text);

}  // namespace yat

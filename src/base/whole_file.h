#pragma once
// Files that appear whole or not at all. Pictures and texts are written through here alone.

#include <string>
#include <string_view>

namespace yat {

/// Makes the folder that `path` is in, and checks by doing that a file can be made there: better
/// before the render than after it. Throws ResourceError naming the path.
void require_writable(const std::string& path);

/// Writes beside the path and renames, so that the path never names half a file. A symbolic link
/// stays: what it points to is written. A device, pipe or socket stays too: it is written to
/// directly, for a rename would put a file in its place. Missing folders are made. Throws
/// ResourceError naming the path.
void write_whole_file(const std::string& path, std::string_view bytes);

}  // namespace yat

#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace yat {

/// FNV-1a, 64 bits: tells files and names apart that nobody made to collide.
uint64_t fnv1a_of(std::string_view bytes);
/// Of all bytes of a file; of nothing if it cannot be read.
uint64_t fnv1a_of_file(const std::string& path);

}  // namespace yat

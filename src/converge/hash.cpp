#include "converge/hash.h"

#include <fstream>

namespace yat {

namespace {

constexpr uint64_t kStart = 0xcbf29ce484222325u;

uint64_t add(uint64_t hash, std::string_view bytes) {
  for (const char byte : bytes) hash = (hash ^ uint8_t(byte)) * 0x100000001b3u;
  return hash;
}

}  // namespace

uint64_t fnv1a_of(std::string_view bytes) {
  return add(kStart, bytes);
}

uint64_t fnv1a_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  uint64_t hash = kStart;
  char block[1 << 16];
  while (file.read(block, sizeof block) || file.gcount() > 0)
    hash = add(hash, {block, size_t(file.gcount())});
  return hash;
}

}  // namespace yat

#pragma once
// The header of a PLY file: which elements and properties follow, and in which encoding.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace yat {

enum class PlyFormat { kAscii, kLittleEndian, kBigEndian };

enum class PlyType : uint8_t { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

/// Bytes of one value in a binary file.
constexpr uint32_t ply_bytes(PlyType type) {
  constexpr uint8_t bytes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return bytes[size_t(type)];
}
constexpr bool ply_is_integer(PlyType type) {
  return type < PlyType::kFloat;
}

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat;        ///< of the value, or of each value of the list
  PlyType count_type = PlyType::kUint8;  ///< list: of its length
  bool list = false;
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;  ///< as the file claims
  std::vector<PlyProperty> properties;

  /// Row of the property of that name, or -1.
  int find(std::string_view property) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;
  size_t bytes = 0;  ///< length of the header: the data start there
};

/// Reads the header; line ends may be LF, CRLF or CR. Throws PlyError with "name: reason".
PlyHeader parse_ply_header(std::string_view data, std::string_view name);

}  // namespace yat

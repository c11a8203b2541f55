#include "scene/stl.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>

#include "scene/numbers.h"
#include "scene/read_file.h"

namespace yat {

namespace {

constexpr size_t kHeader = 84, kFacet = 50;

uint32_t little_endian(const char* at) {
  uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value |= uint32_t(static_cast<unsigned char>(at[i])) << (8 * i);
  return value;
}

std::vector<float> parse_binary(std::string_view data, uint32_t facets) {
  std::vector<float> corners;
  corners.reserve(size_t(facets) * 9);
  for (uint32_t f = 0; f < facets; ++f) {
    const char* const at = data.data() + kHeader + f * kFacet + 12;  // behind the normal
    for (int i = 0; i < 9; ++i) corners.push_back(std::bit_cast<float>(little_endian(at + 4 * i)));
  }
  return corners;
}

/// Words are read one by one: what stands on one line varies from writer to writer.
class AsciiReader {
 public:
  AsciiReader(std::string_view data, std::string_view name)
      : at_(data.data()), end_(at_ + data.size()), name_(name) {}

  std::vector<float> read() {
    // "solid", and a name that may hold anything up to the end of its line.
    while (at_ != end_ && *at_ != '\n') ++at_;
    std::vector<float> corners;
    for (std::string_view w = word(); w != "endsolid" && !w.empty(); w = word()) {
      if (w != "vertex") continue;
      for (int i = 0; i < 3; ++i) corners.push_back(number());
    }
    if (corners.size() % 9)
      fail(fmt::format("it has {} corners, which do not make whole triangles", corners.size() / 3));
    return corners;
  }

 private:
  [[noreturn]] void fail(std::string_view reason) const {
    throw StlError(fmt::format("{}: {}", name_, reason));
  }
  std::string_view word() {
    const auto is_space = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
    while (at_ != end_ && is_space(*at_)) ++at_;
    const char* const begin = at_;
    while (at_ != end_ && !is_space(*at_)) ++at_;
    return {begin, size_t(at_ - begin)};
  }
  float number() {
    const std::string_view w = word();
    const NumberRead<float> read = read_number<float>(w.data(), w.data() + w.size());
    if (read.status != NumberStatus::kOk || read.end != w.data() + w.size())
      fail(fmt::format("{} is not a number", quote(w)));
    return read.value;
  }

  const char* at_;
  const char* end_;
  std::string_view name_;
};

}  // namespace

std::vector<float> parse_stl(std::string_view data, std::string_view name) {
  // A binary file may begin with "solid", too: its size tells.
  if (data.size() >= kHeader) {
    const uint32_t facets = little_endian(data.data() + 80);
    if (data.size() == kHeader + size_t(facets) * kFacet) return parse_binary(data, facets);
  }
  if (data.substr(0, 5) == "solid") return AsciiReader(data, name).read();
  if (data.size() < kHeader) throw StlError(fmt::format("{}: is no STL file", name));
  const uint32_t facets = little_endian(data.data() + 80);
  if (data.size() > kHeader + size_t(facets) * kFacet) return parse_binary(data, facets);
  throw StlError(fmt::format("{}: it counts {} triangles, but ends after {}", name, facets,
                             (data.size() - kHeader) / kFacet));
}

std::vector<float> read_stl(const std::string& path) {
  FileText file;
  if (const std::string reason = file.read(path); !reason.empty())
    throw StlError(fmt::format("{}: cannot be read: {}", path, reason));
  return parse_stl(file.view(), path);
}

}  // namespace yat

#pragma once
// Images of textures: read once per file, kept as texels in tiles, with mip levels where a texture
// asks for them, within a given amount of memory.

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "base/error.h"
#include "scene/texture_program.h"

namespace yat {

/// One level: texels in tiles of 4 x 4 as TexelFormat says.
struct TexelLevel {
  uint32_t width = 0, height = 0;
  std::vector<uint32_t> words;
};

/// A texel's channels: r, g, b, a, 0..255 or as the file has them. One-channel formats: all equal,
/// a = what white is.
std::array<float, 4> read_texel(const TexelLevel& level, TexelFormat format, uint32_t x,
                                uint32_t y);

/// The level below, of half the size (at least 1): means of the decoded texels' areas, encoded
/// again. `gamma` decodes: light is texel^gamma.
TexelLevel halve(const TexelLevel& level, TexelFormat format, double gamma);

class ImageStore {
 public:
  /// limit: bytes that all texels may take; beyond it the finest levels of the largest images are
  /// left out.
  explicit ImageStore(uint64_t limit = kDefaultLimit) : limit_(std::min(limit, kMostBytes)) {}

  /// Row of the image; kNone if it cannot be read, with the reason in `problem`. Images of one file
  /// are one image, unless they are filtered with different gammas.
  uint32_t read(const std::string& path, bool mips, double gamma, std::string& problem);

  TexelFormat format(uint32_t row) const { return images_[row].format; }
  bool one_channel(uint32_t row) const {
    return format(row) == TexelFormat::kByte1 || format(row) == TexelFormat::kFloat1;
  }
  /// Largest texel channel (alpha too) / white, and the mean of some texels / white.
  double largest(uint32_t row) const { return images_[row].largest; }
  glm::dvec3 mean(uint32_t row) const { return images_[row].mean; }
  uint32_t bad_texels(uint32_t row) const { return images_[row].bad; }

  struct Place {
    uint32_t texels, width, height, levels;
  };
  /// Where the image lies; right once the last image has been read.
  Place place(uint32_t row) const;
  /// Levels left out so far.
  uint32_t left_out() const { return left_out_; }
  uint64_t limit() const { return limit_; }
  /// Moves all texels out; ends the use of the store.
  Texels take();

  static constexpr uint64_t kDefaultLimit = uint64_t(2048) << 20;

 private:
  /// Gathers index words with 31 bits.
  static constexpr uint64_t kMostBytes = (uint64_t(1) << 33) - (1 << 20);
  struct Image {
    TexelFormat format = TexelFormat::kByte4;
    bool mips = false;
    double gamma = 1;
    double largest = 1;
    glm::dvec3 mean{0.};
    uint32_t bad = 0;  ///< texels that were not finite
    std::vector<TexelLevel> levels;
    uint64_t bytes() const;
  };
  void fit();

  uint64_t limit_, bytes_ = 0;
  uint32_t left_out_ = 0;
  std::vector<Image> images_;
  std::map<std::tuple<std::string, bool, double>, uint32_t> known_;
};

}  // namespace yat

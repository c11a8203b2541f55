#pragma once
// Pictures as the metrics see them: linear Rec.709 in floats, whatever the file holds.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace yat {

/// Three channels per pixel, row by row from the top.
struct Image {
  uint32_t width = 0, height = 0;
  std::vector<float> rgb;      ///< width * height * 3, linear Rec.709
  bool scene_referred = true;  ///< false: display values of 8 or 16 bits, 0..1 after decoding

  size_t pixels() const { return size_t(width) * height; }
};

/// Reads the channels R, G and B, or a grey picture's one for all three. Files of integers (PNG,
/// JPEG, TGA ...) hold display values and are decoded by the sRGB curve (IEC 61966-2-1); files of
/// floats (EXR, HDR, PFM ...) are taken as they are. Throws Error if the file cannot be read.
Image read_image(const std::string& path);

/// A map over the pixels. values: width * height, row by row. .exr and other kinds of float files
/// get the values, the others grey levels, 1 and above white. Throws ResourceError if it cannot be
/// written.
void write_map(const std::string& path, std::span<const float> values, uint32_t width,
               uint32_t height);

}  // namespace yat

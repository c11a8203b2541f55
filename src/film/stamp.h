#pragma once
// A line of text in a dark bar along the bottom of a picture.

#include <cstdint>
#include <span>
#include <string_view>

namespace yat {

inline constexpr uint32_t kStampHeight = 30;  ///< rows of the bar; less where the picture has less

/// rgb: width * height * 3, display values in [0, 1], top row first. Darkens the last rows to a
/// quarter and a grey, and writes the text into them in white.
///
/// Returns whether the text is there: without a font on the system there is a bar alone. The fonts
/// asked for are DejaVu, Liberation, Droid, Noto and Arial without serifs, where OpenImageIO looks.
bool stamp_bar(std::span<float> rgb, uint32_t width, uint32_t height, std::string_view text);

}  // namespace yat

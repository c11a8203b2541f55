#pragma once
// What text and pictures need to stand in a page.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace yat {

/// & < > and " as entities; control characters as spaces. For elements and quoted attributes, of
/// HTML and of XML.
std::string escaped_html(std::string_view text);

/// RFC 4648, padded.
std::string base64(std::span<const unsigned char> bytes);

/// RGB of 8 bits as a PNG in a data: URI. Throws ResourceError if it cannot be made.
std::string png_uri(std::span<const uint8_t> rgb, uint32_t width, uint32_t height);

}  // namespace yat

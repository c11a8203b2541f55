#include "converge/html.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <vector>

#include "base/error.h"

namespace yat {

std::string escaped_html(std::string_view text) {
  std::string out;
  for (const char letter : text) {
    if (letter == '&')
      out += "&amp;";
    else if (letter == '<')
      out += "&lt;";
    else if (letter == '>')
      out += "&gt;";
    else if (letter == '"')
      out += "&quot;";
    else
      out += static_cast<unsigned char>(letter) < 32 ? ' ' : letter;
  }
  return out;
}

std::string base64(std::span<const unsigned char> bytes) {
  constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t n = std::min<size_t>(3, bytes.size() - i);
    uint32_t word = 0;
    for (size_t k = 0; k < 3; ++k) word = word << 8 | (k < n ? bytes[i + k] : 0u);
    for (size_t k = 0; k < 4; ++k) out += k <= n ? kLetters[word >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

std::string png_uri(std::span<const uint8_t> rgb, uint32_t width, uint32_t height) {
  const auto writer = OIIO::ImageOutput::create("png");
  if (!writer) throw ResourceError(fmt::format("error: no PNG can be made: {}", OIIO::geterror()));
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const OIIO::ImageSpec spec(int(width), int(height), 3, OIIO::TypeDesc::UINT8);
  if (!writer->set_ioproxy(&memory) || !writer->open("picture.png", spec) ||
      !writer->write_image(OIIO::TypeDesc::UINT8, rgb.data()) || !writer->close())
    throw ResourceError(fmt::format("error: no PNG can be made: {}", writer->geterror()));
  return "data:image/png;base64," + base64(bytes);
}

}  // namespace yat

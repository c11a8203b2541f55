#include "film/stamp.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <string>
#include <vector>

namespace yat {

namespace {

constexpr const char* kFonts[] = {"DejaVuSans", "LiberationSans-Regular", "DroidSans",
                                  "NotoSans-Regular", "Arial"};
constexpr int kTextSize = 13, kTextX = 10, kBaseline = 20;  // [pixels]

/// Black with the text in white; empty if there is no font.
OIIO::ImageBuf draw_text(uint32_t width, const std::string& text) {
  const float white[] = {1};
  for (const char* font : kFonts) {
    OIIO::ImageBuf image(OIIO::ImageSpec(int(width), int(kStampHeight), 1, OIIO::TypeDesc::FLOAT));
    OIIO::ImageBufAlgo::zero(image);
    if (OIIO::ImageBufAlgo::render_text(image, kTextX, kBaseline, text, kTextSize, font, white))
      return image;
    image.geterror();  // taken, so that it is not printed when the buffer goes
  }
  return {};
}

}  // namespace

bool stamp_bar(std::span<float> rgb, uint32_t width, uint32_t height, std::string_view text) {
  constexpr float kKept = .25f, kGrey = .75f * 25 / 255;
  const uint32_t rows = std::min(kStampHeight, height);
  const std::span<float> bar = rgb.last(size_t(rows) * width * 3);
  for (float& c : bar) c = kKept * c + kGrey;
  const OIIO::ImageBuf drawn = draw_text(width, std::string(text));
  if (!drawn.initialized()) return false;
  const auto* letters = static_cast<const float*>(drawn.localpixels());
  for (size_t i = 0; i < bar.size(); ++i) {
    const float cover = std::clamp(letters[i / 3], 0.f, 1.f);
    bar[i] += cover * (1 - bar[i]);
  }
  return true;
}

}  // namespace yat

#include "metrics/image.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace yat {
namespace {

float from_srgb(float v) {
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

}  // namespace

Image read_image(const std::string& path) {
  const auto cannot = [&](const std::string& why) {
    return Error(fmt::format("{}: error: cannot be read ({}); give a picture, such as .exr or .png",
                             path, why));
  };
  const auto file = OIIO::ImageInput::open(path);
  if (!file) throw cannot(OIIO::geterror());
  const OIIO::ImageSpec& spec = file->spec();
  const auto n = size_t(spec.nchannels);
  Image image;
  image.width = uint32_t(spec.width);
  image.height = uint32_t(spec.height);
  image.scene_referred = spec.format.is_floating_point();
  std::vector<float> all(image.pixels() * n);
  if (!file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, all.data()))
    throw cannot(file->geterror());
  size_t channel[3];
  for (size_t c = 0; c < 3; ++c) {
    const std::string_view name = std::string_view("RGB").substr(c, 1);
    const auto found = std::find(spec.channelnames.begin(), spec.channelnames.end(), name);
    if (found != spec.channelnames.end())
      channel[c] = size_t(found - spec.channelnames.begin());
    else
      channel[c] = n < 3 ? 0 : c;
  }
  image.rgb.resize(image.pixels() * 3);
  for (size_t p = 0; p < image.pixels(); ++p)
    for (size_t c = 0; c < 3; ++c) {
      const float v = all[p * n + channel[c]];
      image.rgb[p * 3 + c] = image.scene_referred ? v : from_srgb(v);
    }
  return image;
}

void write_map(const std::string& path, std::span<const float> values, uint32_t width,
               uint32_t height) {
  const auto file = OIIO::ImageOutput::create(path);
  if (!file)
    throw ResourceError(
        fmt::format("{}: error: no such kind of picture can be written; use .exr or .png", path));
  const bool floats = file->supports("float") || path.ends_with(".exr");
  OIIO::ImageSpec spec(int(width), int(height), 1,
                       floats ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
  if (!file->open(path, spec) || !file->write_image(OIIO::TypeDesc::FLOAT, values.data()) ||
      !file->close())
    throw ResourceError(fmt::format("{}: error: cannot be written ({})", path, file->geterror()));
}

}  // namespace yat

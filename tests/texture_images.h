#pragma once
// Image files for tests.

#include <OpenImageIO/imagebuf.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <string>

namespace yat {

/// Writes an image of `channels` per pixel in the given format; value(x, y, channel) in 0..1 or as
/// a float image takes it. Returns the path.
inline std::string write_image(const std::string& folder, const std::string& name, int width,
                               int height, int channels, OIIO::TypeDesc type,
                               const std::function<float(int, int, int)>& value) {
  const std::filesystem::path path = std::filesystem::path(YAT_TEST_OUTPUT_DIR) / folder / name;
  std::filesystem::create_directories(path.parent_path());
  OIIO::ImageSpec spec(width, height, channels, type);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  OIIO::ImageBuf image(spec);
  std::vector<float> pixel(static_cast<size_t>(channels));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < channels; ++c) pixel[size_t(c)] = value(x, y, c);
      image.setpixel(x, y, pixel.data());
    }
  // Tests run side by side: whoever reads sees a whole file.
  std::filesystem::path own = path;
  own.replace_filename(std::to_string(::getpid()) + name);
  EXPECT_TRUE(image.write(own.string())) << image.geterror();
  std::filesystem::rename(own, path);
  return path.string();
}

}  // namespace yat

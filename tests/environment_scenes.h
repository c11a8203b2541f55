#pragma once
// Scenes lit from all around, and the pictures that they need.

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "render_scenes.h"

namespace yat {

/// Writes a file for scenes and returns its path. Tests run side by side: whoever reads sees a
/// whole file.
inline std::string write_for_scenes(const std::string& name, std::string_view content) {
  const std::filesystem::path folder(YAT_TEST_OUTPUT_DIR);
  std::filesystem::create_directories(folder);
  const std::string path = (folder / name).string();
  const std::string own = path + "." + std::to_string(::getpid());
  std::ofstream(own, std::ios::binary) << content;
  std::filesystem::rename(own, path);
  return path;
}

/// A PPM of 8-bit texels (3 per texel, rows from the top).
inline std::string write_ppm(const std::string& name, uint32_t width, uint32_t height,
                             const std::vector<uint8_t>& texels) {
  std::string content = "P6\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
  content.append(texels.begin(), texels.end());
  return write_for_scenes(name, content);
}

/// Dim everywhere, with a bright texel and a black band: hard to sample.
inline std::string uneven_picture(const std::string& name, uint32_t width, uint32_t height) {
  std::vector<uint8_t> texels;
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x) {
      const bool bright = x == width / 5 && y == height / 3, black = y == height / 2;
      const auto dim = uint8_t(black ? 0 : 8 + (x * 7 + y * 13) % 20);
      texels.insert(texels.end(), {uint8_t(bright ? 255 : dim), uint8_t(bright ? 250 : dim / 2),
                                   uint8_t(bright ? 200 : dim + 5)});
    }
  return write_ppm(name, width, height, texels);
}

/// Turned about a skew axis.
inline std::string turned_text() {
  return "Rotate 50 1 2 .5\n";
}

/// A floor, a ball, a null lamp that paths cross, and light from every kind of far light and from
/// points with a cone and with maps.
inline std::string open_air_text(uint32_t width, uint32_t height) {
  const std::string picture = uneven_picture("open_air.ppm", 32, 16);
  std::string text = view_text("0 -3 .6", "0 0 0", 50, width, height) + matte_text(".7 .6 .5") +
                     quad_text("-2 -2 -.5", "2 -2 -.5", "2 2 -.5", "-2 2 -.5") +
                     matte_text(".5 .6 .7", 20) + sphere_text("-.5 0 -.1", .4) +
                     "Material \"mirror\" \"color Kr\" [.9 .85 .8]\n" +
                     sphere_text(".5 .2 -.1", .4);
  text += "AttributeBegin\n" + light_text("1 .8 .6") + "Material \"null\"\n" +
          quad_text("-.3 -.8 .2", ".3 -.8 .2", ".3 -.7 .5", "-.3 -.7 .5") + "AttributeEnd\n";
  text += "LightSource \"infinite\" \"color L\" [.2 .25 .3]\n";
  text += "AttributeBegin\n" + turned_text() + "LightSource \"infinite\" \"string mapname\" [\"" +
          picture + "\"] \"float gain\" [2]\nAttributeEnd\n";
  text +=
      "LightSource \"sunsky\" \"vector sundir\" [.5 -.6 .7] \"float gain\" [.00005] "
      "\"float relsize\" [20]\n";
  text +=
      "LightSource \"spot\" \"point from\" [1 -1 2] \"point to\" [0 0 0] \"float coneangle\" "
      "[20] \"float conedeltaangle\" [8] \"color L\" [3 2 4]\n";
  text += "AttributeBegin\nTranslate -1 -1 1.5\n" + turned_text() +
          "LightSource \"goniometric\" \"string mapname\" [\"" + picture +
          "\"] \"color L\" [1 2 1]\nAttributeEnd\n";
  text +=
      "AttributeBegin\nTranslate 0 -1 2\nRotate 150 1 0 0\nLightSource \"projection\" \"float "
      "fov\" [60] \"string mapname\" [\"" +
      picture + "\"] \"color L\" [9 9 9]\nAttributeEnd\n";
  return text + "WorldEnd\n";
}

}  // namespace yat

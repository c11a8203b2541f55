#pragma once
// Scenes of objects and instances, compiled with shared objects or with copies.

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "render_scenes.h"

namespace yat {

inline std::string number_text(double x) {
  return fmt::format("{:.9g} ", x);
}

/// A closed sphere of radius 1 with `bump` waves on it, as rings of triangles; outside outwards.
inline std::string ball_text(uint32_t rings, uint32_t segments, double bump, bool normals) {
  std::string points, indices, directions;
  for (uint32_t j = 0; j <= rings; ++j)
    for (uint32_t i = 0; i < segments; ++i) {
      const double theta = std::numbers::pi * j / rings, phi = 2 * std::numbers::pi * i / segments;
      const double r = 1 + bump * std::sin(3 * phi) * std::sin(5 * theta) * std::sin(theta);
      const double n[3] = {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                           std::cos(theta)};
      for (const double x : n) {
        points += number_text(std::abs(x) < 1e-12 ? 0 : r * x);
        directions += number_text(x);
      }
    }
  const auto at = [segments](uint32_t j, uint32_t i) {
    return std::to_string(j * segments + i % segments) + " ";
  };
  for (uint32_t j = 0; j < rings; ++j)
    for (uint32_t i = 0; i < segments; ++i) {
      if (j > 0) indices += at(j, i) + at(j + 1, i + 1) + at(j, i + 1);
      if (j + 1 < rings) indices += at(j, i) + at(j + 1, i) + at(j + 1, i + 1);
    }
  return "Shape \"mesh\" \"integer triindices\" [" + indices + "] \"point P\" [" + points + "]" +
         (normals ? " \"normal N\" [" + directions + "]\n" : "\n");
}

/// Maps of every sort, each about the origin and of a size near 1 unless it says otherwise.
struct NamedMap {
  std::string_view name, text;
};
inline constexpr NamedMap kMaps[] = {
    {"turned", "Rotate 40 1 2 3\n"},
    {"stretched", "Rotate 25 3 1 2 Scale 2 .5 1\n"},
    {"mirrored", "Scale -1 1 1\n"},
    {"turned_mirrored_stretched", "Rotate 70 1 1 0 Scale .7 -1.5 1.1 Rotate 33 0 1 1\n"},
    {"sheared", "ConcatTransform [1 0 0 0  .8 1 0 0  .3 -.6 1 0  0 0 0 1]\n"},
    {"small", "Scale .01 .01 .01 Rotate 10 0 0 1\n"},
    {"flat", "Rotate 15 1 0 1 Scale 1.5 1.5 .002\n"},
};

inline std::string instance_text(const std::string& name, const std::string& place,
                                 std::string_view map, const std::string& material = "") {
  return "AttributeBegin\nTranslate " + place + "\n" + std::string(map) + material +
         "ObjectInstance \"" + name + "\"\nAttributeEnd\n";
}

/// Compiles with shared objects or with copies; warnings fail the test.
inline Scene compile_instances(const std::string& text, const KernelTable& kernels,
                               InstanceMode mode, LightChoosing choosing = LightChoosing::kAuto) {
  Diagnostics diagnostics(fail_at_warnings);
  CompileOptions options;
  options.block_width = kernels.lanes;
  options.instances = mode;
  options.light_choice = choosing;
  ThreadPool pool(1);
  return compile_scene(parse_scene(text, "test.lxs", ".", diagnostics), options, pool, diagnostics);
}

/// All maps of one bumpy object of `rings` x 2 `rings` quads on a floor, about 3 apart, moved by
/// `far` along x and y.
inline std::string crowd_text(uint32_t rings, bool normals, double far = 0) {
  std::string text = view_text(fmt::format("{} {} 6", far, far - 14),
                               fmt::format("{} {} 1", far, far), 50, 32, 24);
  text += "LightSource \"point\" \"point from\" [" + number_text(far) + number_text(far - 3) +
          "8] \"color L\" [80 80 80]\n";
  text += "ObjectBegin \"ball\"\n" + matte_text(".7 .4 .3") + "Translate .3 0 0\n" +
          ball_text(rings, 2 * rings, .2, normals) + "ObjectEnd\n";
  text += fmt::format("Translate {} {} 0\n", far, far);
  text += matte_text(".6 .6 .6") + quad_text("-9 -9 -2", "9 -9 -2", "9 9 -2", "-9 9 -2");
  text += "AttributeBegin\n";
  uint32_t i = 0;
  for (const NamedMap& map : kMaps) {
    text += instance_text("ball", fmt::format("{} {} {}", 3. * (i % 3) - 3, 3. * (i / 3) - 3, .5),
                          map.text);
    ++i;
  }
  return text + "AttributeEnd\nWorldEnd\n";
}

}  // namespace yat

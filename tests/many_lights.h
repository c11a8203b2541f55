#pragma once
// Scenes of many lights.

#include <random>
#include <string>

#include "render_scenes.h"

namespace yat {

/// `count` small triangles that shine, in [-1, 1]^3 and of all orientations; their radiances
/// differ.
inline std::string lamps_text(uint32_t count, double size, double radiance, uint32_t seed = 1) {
  std::mt19937 engine(seed);
  const auto number = [&] { return double(engine() >> 8) * 0x1p-23 - 1; };
  std::string text;
  constexpr uint32_t kShapes = 4;
  for (uint32_t shape = 0; shape < kShapes; ++shape) {
    std::string points, indices;
    const uint32_t end = count * (shape + 1) / kShapes - count * shape / kShapes;
    if (end == 0) continue;
    for (uint32_t i = 0; i < end; ++i) {
      const double center[] = {.9 * number(), .9 * number(), .9 * number()};
      for (uint32_t corner = 0; corner < 3; ++corner) {
        for (const double c : center) points += std::to_string(c + size * number()) + " ";
        indices += std::to_string(3 * i + corner) + " ";
      }
    }
    const std::string l = std::to_string(radiance * (1 + shape));
    text += "AttributeBegin\n" + light_text(l + " " + l + " " + std::to_string(radiance)) +
            matte_text(".5 .5 .5") + "Shape \"mesh\" \"integer triindices\" [" + indices +
            "] \"point P\" [" + points + "]\nAttributeEnd\n";
  }
  return text;
}

/// One light of every other kind that has a place or none.
inline std::string other_lights_text() {
  return "AttributeBegin\n" + light_text("3 4 6") + matte_text(".5 .5 .5") +
         sphere_text("0 .6 .3", .15) + "AttributeEnd\n" + "AttributeBegin\n" + light_text("2 2 1") +
         matte_text(".5 .5 .5") +
         "Translate -.7 .3 -.6\nShape \"disk\" \"float radius\" [.2]\nAttributeEnd\n" +
         "AttributeBegin\n" + light_text("1 2 1") + matte_text(".5 .5 .5") +
         "Translate .7 .5 0\nShape \"cylinder\" \"float radius\" [.1] \"float zmin\" [-.2] "
         "\"float zmax\" [.2]\nAttributeEnd\n" +
         "LightSource \"point\" \"point from\" [-.6 -.6 .6] \"color L\" [.1 .1 .1]\n"
         "LightSource \"spot\" \"point from\" [.6 -.6 .6] \"point to\" [0 0 -1] \"color L\" [.3 .3 "
         ".3]\n"
         "LightSource \"distant\" \"point from\" [0 -1 1] \"point to\" [0 0 0] \"color L\" [.2 .2 "
         ".2]\n"
         "LightSource \"infinite\" \"color L\" [.1 .1 .15]\n";
}

/// A room open towards the camera, many lamps in it, and all that lights must get right: surfaces
/// that are lit from both sides, mirrors, glass and null surfaces on the way.
inline std::string lamp_room_text(uint32_t width, uint32_t height, uint32_t lamps,
                                  const std::string& more = "") {
  std::string text = view_text("0 -2.8 .2", "0 0 -.1", 50, width, height);
  text += matte_text(".7 .6 .5") + quad_text("-1 -1 -1", "1 -1 -1", "1 1 -1", "-1 1 -1") +
          matte_text(".8 .3 .2", 30) + quad_text("-1 -1 -1", "-1 1 -1", "-1 1 1", "-1 -1 1") +
          matte_text(".2 .7 .3") + quad_text("1 -1 -1", "1 -1 1", "1 1 1", "1 1 -1") +
          matte_text(".7 .7 .7") + quad_text("-1 1 -1", "1 1 -1", "1 1 1", "-1 1 1");
  text += "Material \"mattetranslucent\" \"color Kr\" [.3 .3 .3] \"color Kt\" [.4 .3 .2]\n" +
          quad_text("-.8 -.2 -.9", "-.2 .2 -.9", "-.2 .2 -.2", "-.8 -.2 -.2");
  text += "Material \"mirror\" \"color Kr\" [.9 .85 .8]\n" + sphere_text("-.5 .6 .4", .3);
  text += "Material \"roughglass\" \"float uroughness\" [.3] \"float vroughness\" [.3]\n" +
          sphere_text(".5 -.1 -.6", .3);
  text += "Material \"glossy\" \"color Ks\" [.2 .2 .2]\n" + sphere_text(".1 .5 -.6", .3);
  text += lamps_text(lamps, .05, 40. / double(lamps));
  return text + more + "WorldEnd\n";
}

/// Compiles with a given choice of lights. Warnings fail the test.
inline Scene compile_lamps(const std::string& text, const KernelTable& kernels,
                           LightChoosing choosing, uint32_t threads = 1) {
  Diagnostics diagnostics(fail_at_warnings);
  CompileOptions options;
  options.ids = true;  // for feature pictures
  options.block_width = kernels.lanes;
  options.light_choice = choosing;
  ThreadPool pool(threads);
  return compile_scene(parse_scene(text, "lamps.lxs", ".", diagnostics), options, pool,
                       diagnostics);
}

}  // namespace yat

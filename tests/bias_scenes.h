#pragma once
// Scenes of the proofs of no bias: small, and such that every way to render them has little noise
// (lamps that are large, lobes that are wide). Cameras look away from lamps: what they show of
// themselves has no noise, and would hide how noisy the rest is.

#include <string>

#include "environment_scenes.h"
#include "many_lights.h"
#include "render_scenes.h"

namespace yat {

inline constexpr uint32_t kProofSide = 64;

inline std::string square_lamp_text(const std::string& radiance, const std::string& half,
                                    const std::string& z) {
  const std::string m = "-" + half;
  return "AttributeBegin\n" + light_text(radiance) + matte_text("0 0 0") +
         quad_text(m + " " + m + " " + z, m + " " + half + " " + z, half + " " + half + " " + z,
                   half + " " + m + " " + z) +
         "AttributeEnd\n";
}

/// A closed diffuse room with a lamp of a tenth of its surface, a ball and a leaning wall.
inline std::string box_text() {
  return view_text("0 -.95 0", "0 0 -.5", 70, kProofSide, kProofSide) + matte_text(".7 .7 .7") +
         room_text(1) + square_lamp_text("3 2.5 2", ".75", ".99") + matte_text(".8 .3 .2", 30) +
         sphere_text("-.4 .3 -.6", .35) + matte_text(".2 .6 .3") +
         quad_text(".1 .6 -1", ".9 .2 -1", ".9 .5 .2", ".1 .9 .2") + "WorldEnd\n";
}

/// Rough metal plates under spheres that shine, small to large, on a matte floor (after Veach and
/// Guibas 1995, less extreme).
inline std::string plates_text() {
  std::string text = view_text("0 -3 1.2", "0 -.2 .15", 36, kProofSide, kProofSide) +
                     matte_text(".5 .5 .6") + quad_text("-3 -3 0", "3 -3 0", "3 3 0", "-3 3 0") +
                     quad_text("-3 1.5 0", "3 1.5 0", "3 1.5 3", "-3 1.5 3");
  const char* rough[] = {".15", ".3", ".5"};
  for (int i = 0; i < 3; ++i) {
    const std::string y = std::to_string(-.9 + .5 * i), far = std::to_string(-.5 + .5 * i);
    const std::string z = std::to_string(.05 + .15 * i), up = std::to_string(.2 + .2 * i);
    text += std::string("Material \"metal\" \"string name\" [\"silver\"] \"float uroughness\" [") +
            rough[i] + "] \"float vroughness\" [" + rough[i] + "]\n" +
            quad_text("-1 " + y + " " + z, "1 " + y + " " + z, "1 " + far + " " + up,
                      "-1 " + far + " " + up);
  }
  const char* lamps[][3] = {{"-.8 .6 2.1", ".25", "12 8 6"},
                            {"0 .6 2.1", ".4", "5 7 5"},
                            {".9 .5 2.2", ".55", "2 2.4 4"}};
  for (const auto& [place, radius, radiance] : lamps)
    text += "AttributeBegin\n" + light_text(radiance) + matte_text("0 0 0") +
            sphere_text(place, std::stod(radius)) + "AttributeEnd\n";
  return text + "WorldEnd\n";
}

/// An image file around, textures on what stands there, and a glossy ball.
inline std::string open_text() {
  std::vector<uint8_t> texels;
  constexpr uint32_t kWidth = 32, kHeight = 16;
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x) {
      const bool bright = x > 18 && x < 26 && y > 2 && y < 6;
      const auto grey = uint8_t(bright ? 255 : 60 + (x * 7 + y * 13) % 40);
      texels.insert(texels.end(), {grey, uint8_t(grey - 20), uint8_t(bright ? 180 : grey + 30)});
    }
  const std::string picture = write_ppm("bias_around.ppm", kWidth, kHeight, texels);
  const std::string uv_quad =
      "Shape \"mesh\" \"integer triindices\" [0 1 2 0 2 3] \"point P\" [-2 -2 -.5 2 -2 -.5 2 2 -.5 "
      "-2 2 -.5] \"float uv\" [0 0 1 0 1 1 0 1]\n";
  return view_text("0 -2.4 1.2", "0 0 -.3", 40, kProofSide, kProofSide) +
         "Texture \"squares\" \"color\" \"checkerboard\" \"color tex1\" [.7 .6 .5] \"color tex2\" "
         "[.2 .3 .4] \"float uscale\" [6] \"float vscale\" [6]\n"
         "Texture \"drawn\" \"color\" \"imagemap\" \"string filename\" [\"" +
         picture +
         "\"] \"float gamma\" [2.2] \"string mapping\" [\"spherical\"]\n"
         "Material \"matte\" \"texture Kd\" [\"squares\"]\n" +
         uv_quad + "Material \"matte\" \"texture Kd\" [\"drawn\"] \"float sigma\" [20]\n" +
         sphere_text("-.6 0 -.1", .4) +
         "Material \"glossy\" \"color Kd\" [.4 .2 .1] \"color Ks\" [.3 .3 .3] \"float uroughness\" "
         "[.3] \"float vroughness\" [.3]\n" +
         sphere_text(".5 .2 -.1", .4) + "AttributeBegin\n" + turned_text() +
         "LightSource \"infinite\" \"string mapname\" [\"" + picture +
         "\"] \"float gain\" [1]\nAttributeEnd\nWorldEnd\n";
}

/// A dozen triangles of different power that hang there and shine downwards, more or less.
inline std::string hanging_lamps_text() {
  std::string text;
  for (int i = 0; i < 12; ++i) {
    const double x = -.9 + .6 * (i % 4), y = -.6 + .6 * (i / 4), z = .7 + .07 * (i * 5 % 7);
    const auto corner = [&](double dx, double dy, double dz) {
      return std::to_string(x + dx) + " " + std::to_string(y + dy) + " " + std::to_string(z + dz) +
             " ";
    };
    const double l = .3 * (1 + i * 7 % 5);
    text += "AttributeBegin\n" +
            light_text(std::to_string(l) + " " + std::to_string(l * .8) + " .5") +
            matte_text(".3 .3 .3") + "Shape \"mesh\" \"integer triindices\" [0 1 2] \"point P\" [" +
            corner(-.27, -.25, .03 * (i % 3)) + corner(0, .28, .1) + corner(.26, -.22, 0) +
            "]\nAttributeEnd\n";
  }
  return text;
}

/// A room under hanging lamps, with surfaces lit from both sides, and with what else there is of
/// lights.
inline std::string lamps_room_text(const std::string& more = "") {
  return view_text("0 -2.6 .4", "0 .2 -.7", 40, kProofSide, kProofSide) + matte_text(".6 .6 .6") +
         quad_text("-1 -1 -1", "1 -1 -1", "1 1 -1", "-1 1 -1") + matte_text(".7 .4 .3", 20) +
         quad_text("-1 1 -1", "1 1 -1", "1 1 1", "-1 1 1") +
         "Material \"mattetranslucent\" \"color Kr\" [.3 .3 .3] \"color Kt\" [.4 .3 .2]\n" +
         quad_text("-.9 -.2 -.9", "-.2 .2 -.9", "-.2 .2 -.3", "-.9 -.2 -.3") +
         "Material \"metal\" \"string name\" [\"gold\"] \"float uroughness\" [.4] \"float "
         "vroughness\" [.4]\n" +
         sphere_text(".4 .2 -.6", .4) + hanging_lamps_text() + more + "WorldEnd\n";
}

/// Veils of several sorts, coats, a mirror, clear and architectural glass, and two lights, one of
/// which no ray can meet. Lamp and balls are instances of objects.
inline std::string veils_text() {
  const auto named = [](const std::string& name, const std::string& rest) {
    return "MakeNamedMaterial \"" + name + "\" \"string type\" " + rest + "\n";
  };
  const auto use = [](const std::string& name) { return "NamedMaterial \"" + name + "\"\n"; };
  std::string text = view_text("0 -2.6 .3", "0 0 -.4", 40, kProofSide, kProofSide);
  text += named("hole", "[\"null\"]") + named("grey", "[\"matte\"] \"color Kd\" [.6 .6 .6]") +
          named("red", "[\"matte\"] \"color Kd\" [.7 .3 .2]") +
          named("veil",
                "[\"mix\"] \"string namedmaterial1\" [\"red\"] \"string namedmaterial2\" "
                "[\"hole\"] \"float amount\" [.5]") +
          named("pane",
                "[\"glass\"] \"bool architectural\" [\"true\"] \"float index\" [1.5] \"color Kt\" "
                "[.7 .8 .9]") +
          named("sheet", "[\"mattetranslucent\"] \"color Kr\" [.4 .3 .2] \"color Kt\" [.3 .5 .2]") +
          named("coated",
                "[\"glossycoating\"] \"string basematerial\" [\"sheet\"] \"color Ks\" [.3 .2 .1] "
                "\"color Ka\" [.3 .6 .9] \"float d\" [.3] \"float uroughness\" [.4] \"float "
                "vroughness\" [.4]");
  text += "ObjectBegin \"lamp\"\nAttributeBegin\n" + light_text("3 2.7 2.4") + matte_text("0 0 0") +
          quad_text("-.5 -.5 0", "-.5 .5 0", ".5 .5 0", ".5 -.5 0") + "AttributeEnd\nObjectEnd\n";
  text += "ObjectBegin \"balls\"\nAttributeBegin\n" + use("coated") + sphere_text("0 0 0", .3) +
          use("veil") + quad_text("-.4 -.4 -.2", ".4 -.4 -.2", ".4 -.3 .6", "-.4 -.3 .6") +
          "AttributeEnd\nObjectEnd\n";
  text += use("grey") + quad_text("-1.5 -1.5 -1", "1.5 -1.5 -1", "1.5 1.5 -1", "-1.5 1.5 -1") +
          quad_text("-1.5 1 -1", "1.5 1 -1", "1.5 1 1", "-1.5 1 1");
  for (const char* place : {"-.7 0 -.6", "0 .3 -.5", ".8 .1 -.6"})
    text += "AttributeBegin\nTranslate " + std::string(place) +
            "\nObjectInstance \"balls\"\nAttributeEnd\n";
  for (const char* place : {"-.6 0 1.2", ".7 .2 1.1"})
    text += "AttributeBegin\nTranslate " + std::string(place) +
            "\nObjectInstance \"lamp\"\nAttributeEnd\n";
  text += use("pane") + quad_text("-.2 -.8 -1", ".5 -.8 -1", ".5 -.7 .4", "-.2 -.7 .4") +
          "Material \"mirror\" \"color Kr\" [.8 .8 .9]\n" +
          quad_text("1.2 .2 -1", "1.4 .9 -1", "1.4 .9 .3", "1.2 .2 .3");
  return text +
         "LightSource \"point\" \"point from\" [-.8 -.9 .8] \"color L\" [.3 .3 .3]\nWorldEnd\n";
}

/// A screen that shines by a texture, one above that does by texture and profile, and a lamp that
/// shines evenly, over a floor before a wall.
inline std::string screens_text() {
  const auto lamp = [](const std::string& light, const std::string& points) {
    return "AttributeBegin\nAreaLightSource \"area\" " + light +
           " \"float power\" [0] \"float efficacy\" [0]\n" + matte_text("0 0 0") +
           "Shape \"mesh\" \"integer triindices\" [0 1 2 0 2 3] \"point P\" [" + points +
           "] \"float uv\" [0 0 0 1 1 1 1 0]\nAttributeEnd\n";
  };
  return view_text("0 -2.6 .4", "0 .2 -.7", 40, kProofSide, kProofSide) +
         "Texture \"slope\" \"color\" \"bilerp\" \"color v00\" [.2 1 2] \"color v01\" [3 .5 1] "
         "\"color v10\" [.5 2 1] \"color v11\" [1 1 4]\n"
         "Texture \"drawn\" \"color\" \"checkerboard\" \"color tex1\" [3 2 1] \"color tex2\" [.5 1 "
         "2] \"float uscale\" [4] \"float vscale\" [4]\n" +
         matte_text(".6 .6 .6") + quad_text("-1 -1 -1", "1 -1 -1", "1 1 -1", "-1 1 -1") +
         quad_text("-1 1 -1", "1 1 -1", "1 1 1", "-1 1 1") +
         "Material \"metal\" \"string name\" [\"gold\"] \"float uroughness\" [.4] \"float "
         "vroughness\" [.4]\n" +
         sphere_text(".4 .2 -.6", .4) +
         lamp("\"texture L\" [\"slope\"]", "-1 -1.2 .8 -1 .2 .8 .1 .2 .9 .1 -1.2 .9") +
         lamp("\"texture L\" [\"drawn\"] \"string iesname\" [\"" YAT_SOURCE_DIR
              "/scenes/screen/downlight.ies\"]",
              ".2 -1 .8 .2 .4 .8 1.2 .4 .7 1.2 -1 .7") +
         square_lamp_text(".5 .6 .8", ".4", "1.4") + "WorldEnd\n";
}

}  // namespace yat

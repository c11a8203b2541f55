// YART's rule for images: the nearest texel as it is, rows from the bottom, mapped in the space of
// the shape (lxs 12.7).

#include <cmath>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "film/features.h"
#include "render_scenes.h"
#include "texture_images.h"

namespace yat {
namespace {

constexpr uint32_t kSide = 24;
constexpr int kWidth = 5, kHeight = 3;

float channel(int x, int y, int c) {
  return float(20 + 40 * x + 13 * y + 7 * c) / 255;
}

/// What one sample of every pixel sees.
struct Seen {
  std::vector<float> albedo, position, depth;
};

Seen render_yart(const std::string& world, const std::string& camera,
                 std::vector<std::string>* said = nullptr) {
  write_image("yart_textures", "texels.png", kWidth, kHeight, 3, OIIO::TypeDesc::UINT8, channel);
  Diagnostics diagnostics([&](Severity severity, std::string_view line) {
    if (!said)
      fail_at_warnings(severity, line);
    else if (severity != Severity::kNote)
      said->emplace_back(line);
  });
  const std::string side = std::to_string(kSide);
  const std::string text = camera +
                           "Camera \"perspective\" \"float fov\" [40]\nFilm \"fleximage\" "
                           "\"integer xresolution\" [" +
                           side + "] \"integer yresolution\" [" + side + "]\nWorldBegin\n" +
                           "LightSource \"infinite\"\n" + world + "WorldEnd\n";
  const KernelTable& kernels = select_kernels("");
  CompileOptions options;
  options.block_width = kernels.lanes;
  options.colour = ColourMode::kRgb;
  ThreadPool pool(1);
  const std::string folder =
      (std::filesystem::path(YAT_TEST_OUTPUT_DIR) / "yart_textures").string();
  const Scene scene =
      compile_scene(parse_scene(text, "t.lxs", folder, diagnostics, false, Dialect::kYart), options,
                    pool, diagnostics);
  Film film(kSide, kSide);
  FeatureFilm features(kSide, kSide,
                       feature_bit(Feature::kAlbedo) | feature_bit(Feature::kPosition) |
                           feature_bit(Feature::kDepth));
  RenderOptions one;
  one.end_sample = 1;
  one.features = &features;
  render(scene, make_plan(scene, kernels, {}), one, pool, film);
  return {features.resolve(Feature::kAlbedo, film), features.resolve(Feature::kPosition, film),
          features.resolve(Feature::kDepth, film)};
}

std::string texture_text(const std::string& mapping, const std::string& wrap = "repeat") {
  // All that YART does not read is there.
  return "Texture \"t\" \"color\" \"imagemap\" \"string filename\" [\"texels.png\"]\n" +
         ("\"string mapping\" [\"" + mapping + "\"]\n") +
         (wrap.empty() ? "" : "\"string wrap\" [\"" + wrap + "\"]\n") +
         "\"float gamma\" [2.2] \"float gain\" [3] \"float uscale\" [7] \"float vscale\" [-1] "
         "\"float vdelta\" [1]\n";
}
const std::string kTextured = "Material \"matte\" \"texture Kd\" [\"t\"]\n";

/// Checks that every pixel shows the texel at (s, v), v from the bottom row.
template <class Map>
void expect_texels(const Seen& seen, Map&& map, bool repeat = true) {
  uint32_t checked = 0;
  for (uint32_t i = 0; i < kSide * kSide; ++i) {
    if (seen.depth[i] >= 1e10f) continue;
    const glm::dvec3 p(seen.position[3 * i], seen.position[3 * i + 1], seen.position[3 * i + 2]);
    glm::dvec2 st = map(p);
    st.y = 1 - st.y;
    const bool inside = st.x >= 0 && st.x < 1 && st.y >= 0 && st.y < 1;
    const double x = (st.x - std::floor(st.x)) * kWidth, y = (st.y - std::floor(st.y)) * kHeight;
    // On the edge of a texel rounding decides.
    if (std::abs(x - std::round(x)) < 1e-3 || std::abs(y - std::round(y)) < 1e-3) continue;
    ++checked;
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(seen.albedo[3 * i + uint32_t(c)],
                  repeat || inside ? channel(int(x), int(y), c) : 0, 1e-4)
          << "pixel " << i << " at " << p.x << ' ' << p.y << ' ' << p.z;
  }
  EXPECT_GT(checked, kSide * kSide / 4);
}

TEST(YartTextures, ArePlanarInTheSpaceOfEachShape) {
  // Two shapes with one texture. By YART's order the first transform acts first.
  const std::string quad =
      "Shape \"mesh\" \"integer triindices\" [0 1 2 0 2 3] \"point P\" [-2 -2 0 2 -2 0 2 2 0 -2 2 "
      "0]\n";
  const Seen seen = render_yart(texture_text("planar") + "TransformBegin\nScale 1 2 1\n" +
                                    "Rotate 90 0 0 1\nTranslate 2.5 0 0\n" + kTextured + quad +
                                    "TransformEnd\nTransformBegin\nScale .5 .5 .5\n" +
                                    "Translate -2 0 1\n" + kTextured + quad + "TransformEnd\n",
                                "LookAt 0 0 14  0 0 0  0 1 0\n");
  expect_texels(seen, [](const glm::dvec3& p) {
    if (p.z > .5) return glm::dvec2((p.x + 2) / .5, p.y / .5);
    // Undone: the move, the turn (x to y), the scale.
    return glm::dvec2(p.y, -(p.x - 2.5) / 2);
  });
}

TEST(YartTextures, AreBlackOutsideWhereTheySaySo) {
  const Seen seen = render_yart(texture_text("planar", "black") + kTextured +
                                    "Shape \"mesh\" \"integer triindices\" [0 1 2 0 2 3] \"point "
                                    "P\" [-2 -2 0 2 -2 0 2 2 0 -2 2 0]\n",
                                "LookAt 0 0 6  0 0 0  0 1 0\n");
  expect_texels(seen, [](const glm::dvec3& p) { return glm::dvec2(p.x, p.y); }, false);
}

TEST(YartTextures, SphericalOnesHaveYUp) {
  const Seen seen =
      render_yart(texture_text("spherical") + "TransformBegin\nRotate 30 1 0 0\nTranslate 1 2 3\n" +
                      kTextured + "Shape \"sphere\" \"float radius\" [2]\nTransformEnd\n",
                  "LookAt 4 -5 6  1 2 3  0 0 1\n");
  const glm::dmat4 to_world = glm::translate(glm::dmat4(1.), {1, 2, 3}) *
                              glm::rotate(glm::dmat4(1.), glm::radians(30.), {1, 0, 0});
  expect_texels(seen, [&](const glm::dvec3& p) {
    const auto o = glm::dvec3(glm::inverse(to_world) * glm::dvec4(p, 1.)) / 2.;
    return glm::dvec2(std::atan2(o.x, o.z) / (2 * std::numbers::pi),
                      1 - std::acos(o.y) / std::numbers::pi);
  });
}

TEST(YartTextures, ByUvStartAtTheBottom) {
  const Seen seen = render_yart(
      texture_text("uv") + kTextured +
          "Shape \"mesh\" \"integer triindices\" [0 1 2 0 2 3] \"point P\" [-2 -2 0 2 -2 0 2 2 0 "
          "-2 2 0] \"float uv\" [0 0 1 0 1 1 0 1]\n",
      "LookAt 0 0 6  0 0 0  0 1 0\n");
  expect_texels(seen, [](const glm::dvec3& p) { return glm::dvec2((p.x + 2) / 4, (p.y + 2) / 4); });
}

TEST(YartTextures, WithoutWrapWarn) {
  std::vector<std::string> said;
  render_yart(texture_text("planar", "") + kTextured + "Shape \"sphere\"\n",
              "LookAt 0 0 6  0 0 0  0 1 0\n", &said);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("has no \"wrap\""), std::string::npos) << said[0];
}

}  // namespace
}  // namespace yat

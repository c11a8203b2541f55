#pragma once
// Small scenes, and what tests of whole renders do with them.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "kernels/dispatch.h"
#include "scene/compile.h"
#include "scene/parse.h"
#include "wavefront/plan.h"
#include "wavefront/render.h"

namespace yat {

/// A sink of diagnostics for scenes that nothing is to be said about.
inline void fail_at_warnings(Severity severity, std::string_view line) {
  if (severity != Severity::kNote) ADD_FAILURE() << line;
}

/// Compiles a scene for the kernels that will run.
inline Scene compile_description(const Description& description, const KernelTable& kernels,
                                 Diagnostics& diagnostics, uint32_t width = 0, uint32_t height = 0,
                                 ColourMode colour = ColourMode::kBands, bool keep_uv = false) {
  CompileOptions options;
  options.ids = true;  // for feature pictures
  options.keep_uv = keep_uv;
  options.block_width = kernels.lanes;
  options.width = width;
  options.height = height;
  options.colour = colour;
  ThreadPool pool(1);
  return compile_scene(description, options, pool, diagnostics);
}
/// Warnings fail the test.
inline Scene compile_text(const std::string& text, const KernelTable& kernels,
                          ColourMode colour = ColourMode::kBands, bool keep_uv = false) {
  Diagnostics diagnostics(fail_at_warnings);
  return compile_description(parse_scene(text, "test.lxs", ".", diagnostics), kernels, diagnostics,
                             0, 0, colour, keep_uv);
}

inline Film render_film(const Scene& scene, const Plan& plan, uint32_t first, uint32_t end,
                        uint32_t threads = 1, uint32_t batch_rows = 0, uint32_t tile_size = 0,
                        RenderResult* result = nullptr) {
  RenderOptions options;
  options.first_sample = first;
  options.end_sample = end;
  options.batch_rows = batch_rows;
  options.tile_size = tile_size;
  ThreadPool pool(threads);
  Film film(scene.film.crop_width(), scene.film.crop_height());
  RenderResult r = render(scene, plan, options, pool, film);
  if (result) *result = std::move(r);
  return film;
}

inline bool same_bits(const FilmPixel& a, const FilmPixel& b) {
  return a.r == b.r && a.g == b.g && a.b == b.b && a.samples == b.samples;
}
inline bool same_bits(const Film& a, const Film& b) {
  for (uint32_t i = 0; i < a.width() * a.height(); ++i)
    if (!same_bits(a.data()[i], b.data()[i])) return false;
  return a.width() == b.width() && a.height() == b.height();
}

/// Mean of a quantity and the standard error of that mean.
struct Estimate {
  double mean = 0, error = 0;
};
inline Estimate estimate(const std::vector<double>& values) {
  const double n = double(values.size());
  double sum = 0, squares = 0;
  for (const double v : values) sum += v;
  for (const double v : values) squares += (v - sum / n) * (v - sum / n);
  return {sum / n, std::sqrt(squares / (n - 1) / n)};
}

// ---- Scene text --------------------------------------------------------------------------------

/// Camera and film: looks from `from` at `to`, box filter of one pixel.
inline std::string view_text(const std::string& from, const std::string& to, double fov,
                             uint32_t width, uint32_t height, const std::string& more = "") {
  const std::string up = "  0 0.1 1\n";
  return "LookAt " + from + "  " + to + up + "Camera \"perspective\" \"float fov\" [" +
         std::to_string(fov) + "] " + more + "\nPixelFilter \"box\" \"float xwidth\" [.5] " +
         "\"float ywidth\" [.5]\nFilm \"fleximage\" \"integer xresolution\" [" +
         std::to_string(width) + "] \"integer yresolution\" [" + std::to_string(height) +
         "]\nWorldBegin\n";
}

/// Plain radiance: no power.
inline std::string light_text(const std::string& radiance) {
  return "AreaLightSource \"area\" \"color L\" [" + radiance +
         "] \"float power\" [0] \"float efficacy\" [0]\n";
}

/// The quad a b c d, whose outside is that of (b - a) x (c - a).
inline std::string quad_text(const std::string& a, const std::string& b, const std::string& c,
                             const std::string& d) {
  return "Shape \"mesh\" \"integer triindices\" [0 1 2 0 2 3] \"point P\" [" + a + " " + b + " " +
         c + " " + d + "]\n";
}

/// The box [-s, s]^3 with its outside inside.
inline std::string room_text(double s) {
  const auto p = [s](int x, int y, int z) {
    return std::to_string(x * s) + " " + std::to_string(y * s) + " " + std::to_string(z * s);
  };
  return quad_text(p(-1, -1, -1), p(1, -1, -1), p(1, 1, -1), p(-1, 1, -1)) +  // floor, +z
         quad_text(p(-1, -1, 1), p(-1, 1, 1), p(1, 1, 1), p(1, -1, 1)) +      // ceiling, -z
         quad_text(p(-1, -1, -1), p(-1, 1, -1), p(-1, 1, 1), p(-1, -1, 1)) +  // left, +x
         quad_text(p(1, -1, -1), p(1, -1, 1), p(1, 1, 1), p(1, 1, -1)) +      // right, -x
         quad_text(p(-1, 1, -1), p(1, 1, -1), p(1, 1, 1), p(-1, 1, 1)) +      // back, -y
         quad_text(p(-1, -1, -1), p(-1, -1, 1), p(1, -1, 1), p(1, -1, -1));   // front, +y
}

inline std::string sphere_text(const std::string& center, double radius) {
  return "AttributeBegin\nTranslate " + center + "\nShape \"sphere\" \"float radius\" [" +
         std::to_string(radius) + "]\nAttributeEnd\n";
}

inline std::string matte_text(const std::string& kd, double sigma = 0) {
  return "Material \"matte\" \"color Kd\" [" + kd + "] \"float sigma\" [" + std::to_string(sigma) +
         "]\n";
}

/// A room that uses all there is: five materials, triangles with and without normals, spheres,
/// a plane, see-through lamp, three kinds of light, thin lens, a filter with a table.
inline std::string everything_text(uint32_t width, uint32_t height) {
  std::string text =
      "LookAt 0 -2.6 0.2  0 0 -.1  0 0 1\nCamera \"perspective\" \"float fov\" [50] "
      "\"float lensradius\" [.03] \"float focaldistance\" [2.5]\n"
      "PixelFilter \"mitchell\" \"float xwidth\" [1.5] \"float ywidth\" [1.5]\n"
      "Film \"fleximage\" \"integer xresolution\" [" +
      std::to_string(width) + "] \"integer yresolution\" [" + std::to_string(height) +
      "]\nWorldBegin\n";
  text += matte_text(".7 .6 .5");
  text += "AttributeBegin\nTranslate 0 0 -1\nShape \"plane\"\nAttributeEnd\n";
  text += matte_text(".8 .3 .2", 30) + quad_text("-1 -1 -1", "-1 1 -1", "-1 1 1", "-1 -1 1") +
          matte_text(".2 .7 .3") + quad_text("1 -1 -1", "1 -1 1", "1 1 1", "1 1 -1") +
          matte_text(".7 .7 .7") + quad_text("-1 1 -1", "1 1 -1", "1 1 1", "-1 1 1") +
          quad_text("-1 -1 1", "-1 1 1", "1 1 1", "1 -1 1");
  text += "Material \"mirror\" \"color Kr\" [.9 .85 .8]\n" + sphere_text("-.5 .4 -.55", .4);
  text +=
      "Material \"glass\" \"color Kr\" [1 1 1] \"color Kt\" [.9 1 .95] \"float index\" [1.5]\n" +
      sphere_text(".4 -.1 -.6", .35);
  text += "AttributeBegin\n" + light_text("6 5 4") + "Material \"null\"\n" +
          quad_text("-.3 -.3 .95", "-.3 .3 .95", ".3 .3 .95", ".3 -.3 .95") + "AttributeEnd\n";
  text += "AttributeBegin\n" + light_text("3 4 6") + matte_text(".5 .5 .5") +
          sphere_text("0 .6 .3", .15) + "AttributeEnd\n";
  text += "LightSource \"point\" \"point from\" [-.6 -.6 .6] \"color L\" [.4 .4 .5]\n";
  // A wedge with vertex normals.
  text += matte_text(".6 .6 .2") +
          "Shape \"mesh\" \"integer triindices\" [0 1 2 0 2 3] \"point P\" [-.2 .9 -1 .3 .9 -1 "
          ".3 .6 -.4 -.2 .6 -.4] \"normal N\" [0 -.9 .2 0 -.9 .3 0 -.7 .7 0 -.6 .8]\n";
  return text + "WorldEnd\n";
}

}  // namespace yat

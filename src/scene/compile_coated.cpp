// Diffuse bases under a glossy coat (lxs 7.3, A.4).

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/exponential.hpp>
#include <iterator>

#include "kernels/materials/car_paint.h"
#include "kernels/materials/coating.h"
#include "kernels/materials/glossy.h"
#include "kernels/materials/glossy_lossy.h"
#include "kernels/materials/glossy_single.h"
#include "kernels/materials/glossy_translucent.h"
#include "kernels/materials/matte.h"
#include "scene/compile_materials.h"

namespace yat {

namespace {

struct Roughness {
  float u, v;
};
struct CoatNames {
  std::string_view ks, ka, depth, index, u, v;
};
constexpr CoatNames kFront{"Ks", "Ka", "d", "index", "uroughness", "vroughness"};
constexpr CoatNames kBack{"backface_Ks",    "backface_Ka",         "backface_d",
                          "backface_index", "backface_uroughness", "backface_vroughness"};

struct CoatGiven {
  glm::vec3 ks, ka;
  float depth, index;
  Roughness rough;
};
CoatGiven read_coat(MaterialCompiler& compiler, Parameters& p, const CoatNames& names, double ks,
                    double roughness, double least) {
  CoatGiven coat{};
  coat.ks = compiler.reflectance_bands(p, names.ks, ks);
  coat.ka = compiler.reflectance_bands(p, names.ka, 0);
  coat.depth = float(compiler.clamped(p, names.depth, 0, 0, 1e6));
  coat.index = float(compiler.clamped(p, names.index, 0, 0, 100));
  coat.rough.u = float(compiler.clamped(p, names.u, roughness, least, 1));
  coat.rough.v = float(compiler.clamped(p, names.v, roughness, least, 1));
  return coat;
}

float flag_of(Parameters& p, std::string_view name, bool fallback) {
  return p.flag(name, fallback) ? 1.f : 0.f;
}

/// Old files call the roughness by one name, which LuxRender no longer reads.
void warn_old_roughness(Parameters& p) {
  p.unsupported({"roughness"}, "LuxRender reads \"uroughness\" and \"vroughness\"");
}

}  // namespace

MaterialRef build_glossy(MaterialCompiler& compiler, Parameters& p) {
  const glm::vec3 kd = compiler.reflectance_bands(p, "Kd", 1);
  const bool separable = p.flag("separable", true);
  const CoatGiven c = read_coat(compiler, p, kFront, 1, .1, separable ? 1e-6 : .006);
  const float multibounce = flag_of(p, "multibounce", false);
  const auto sigma = float(compiler.clamped(p, "sigma", 0, 0, 90));
  if (separable)
    return compiler.add_rough<GlossyParameters>(
        MaterialKind::kGlossy, {kd.x, kd.y, kd.z, c.ks.x, c.ks.y, c.ks.z, c.ka.x, c.ka.y, c.ka.z,
                                c.depth, c.index, c.rough.u, c.rough.v, sigma, multibounce});
  // LuxRender: without Ks this one has no coat at all, not even edge-on.
  if (c.ks == glm::vec3(0))
    return compiler.add<MatteParameters>(MaterialKind::kMatte, {kd.x, kd.y, kd.z});
  return compiler.add_rough<GlossySingleParameters>(
      MaterialKind::kGlossySingle, {kd.x, kd.y, kd.z, c.ks.x, c.ks.y, c.ks.z, c.ka.x, c.ka.y,
                                    c.ka.z, c.depth, c.index, c.rough.u, c.rough.v, multibounce});
}

MaterialRef build_glossycoating(MaterialCompiler& compiler, Parameters& p) {
  const auto base = compiler.child(p, "basematerial");
  const CoatGiven c = read_coat(compiler, p, kFront, 1, .1, 1e-6);
  const float multibounce = flag_of(p, "multibounce", false);
  if (!base) return add_matte(compiler, glm::dvec3(.9), 0);
  const bool passes = base->passing != Passing::kSolid;
  if (passes || compiler.has_coating(MaterialCompiler::form_of(*base))) {
    const std::string_view reason =
        passes ? "it lets light pass unturned" : "it has a coat already";
    p.diagnostics().warning(p.plugin().loc,
                            fmt::format("material \"glossycoating\" shows its base \"{}\" without "
                                        "the coat: {}",
                                        p.text("basematerial", ""), reason),
                            "material \"glossycoating\" shows its base without the coat");
    return *base;
  }
  const MaterialRef lobe = compiler.add_rough<GlossyParameters>(
      MaterialKind::kGlossy, {0, 0, 0, c.ks.x, c.ks.y, c.ks.z, c.ka.x, c.ka.y, c.ka.z, c.depth,
                              c.index, c.rough.u, c.rough.v, 0, multibounce});
  MaterialRef made = compiler.add_split<CoatingParameters>(
      MaterialKind::kCoating,
      {c.ks.x, c.ks.y, c.ks.z, c.ka.x, c.ka.y, c.ka.z, c.depth, c.index, brightness(*base),
       lobe.row, base->row},
      lobe, *base, false, false);
  made.albedo = coated_albedo(c.ks, c.index, glm::exp(-2 * c.depth * c.ka) * base->albedo);
  return made;
}

MaterialRef build_glossy_lossy(MaterialCompiler& compiler, Parameters& p) {
  const glm::vec3 kd = compiler.reflectance_bands(p, "Kd", 1);
  const CoatGiven c = read_coat(compiler, p, kFront, 1, .1, 0);
  warn_old_roughness(p);
  return compiler.add_rough<GlossyLossyParameters>(
      MaterialKind::kGlossyLossy, {kd.x, kd.y, kd.z, c.ks.x, c.ks.y, c.ks.z, c.ka.x, c.ka.y, c.ka.z,
                                   c.depth, c.index, c.rough.u, c.rough.v});
}

MaterialRef build_glossytranslucent(MaterialCompiler& compiler, Parameters& p) {
  const glm::vec3 kd = compiler.reflectance_bands(p, "Kd", 1);
  const glm::vec3 kt = compiler.reflectance_bands(p, "Kt", 1);
  const CoatGiven front = read_coat(compiler, p, kFront, 1, .1, .006);
  const float front_bounce = flag_of(p, "multibounce", false);
  // Both sides have the front's coat where it is called one-sided.
  const bool same = p.flag("onesided", true);
  CoatGiven back = front;
  float back_bounce = front_bounce;
  if (same) {
    p.accept({"backface_Ks", "backface_Ka", "backface_d", "backface_index", "backface_uroughness",
              "backface_vroughness", "backface_multibounce"});
  } else {
    back = read_coat(compiler, p, kBack, 0, 0, 0);
    back_bounce = flag_of(p, "backface_multibounce", false);
  }
  MaterialRef made = compiler.add_rough<GlossyTranslucentParameters>(
      MaterialKind::kGlossyTranslucent,
      {kd.x,        kd.y,         kd.z,          kt.x,          kt.y,         kt.z,
       front.ks.x,  front.ks.y,   front.ks.z,    front.ka.x,    front.ka.y,   front.ka.z,
       front.depth, front.index,  front.rough.u, front.rough.v, front_bounce, back.ks.x,
       back.ks.y,   back.ks.z,    back.ka.x,     back.ka.y,     back.ka.z,    back.depth,
       back.index,  back.rough.u, back.rough.v,  back_bounce});
  made.tangents = made.tangents || back.rough.u != back.rough.v;
  return made;
}

namespace {

/// lxs A.4.
struct CarPaintPreset {
  std::string_view name;
  glm::dvec3 kd, ks[3];
  double r[3], m[3];
};
const CarPaintPreset kCarPaints[] = {
    {"ford f8",
     {.0012, .0015, .0018},
     {{.0049, .0076, .0120}, {.0100, .0130, .0180}, {.0070, .0065, .0077}},
     {.15, .087, .9},
     {.32, .11, .013}},
    {"polaris silber",
     {.055, .063, .071},
     {{.065, .082, .088}, {.11, .11, .13}, {.008, .013, .015}},
     {1, .92, .9},
     {.38, .17, .013}},
    {"opel titan",
     {.011, .013, .015},
     {{.057, .066, .078}, {.11, .12, .13}, {.0095, .014, .016}},
     {.85, .86, .9},
     {.38, .17, .014}},
    {"bmw339",
     {.012, .015, .016},
     {{.062, .076, .080}, {.11, .12, .12}, {.0083, .015, .016}},
     {.92, .87, .9},
     {.39, .17, .013}},
    {"2k acrylack",
     {.42, .32, .10},
     {{0, 0, 0}, {.028, .026, .006}, {.017, .0075, .0041}},
     {1, .9, .17},
     {.88, .8, .015}},
    {"white",
     {.61, .63, .55},
     {{2.6e-6, 3.1e-4, 3.1e-8}, {.013, .011, .0083}, {.049, .042, .037}},
     {.049, .45, .17},
     {1, .15, .015}},
    {"blue",
     {.0079, .023, .10},
     {{.0011, .0015, .0019}, {.025, .030, .043}, {.059, .074, .082}},
     {1, .094, .17},
     {.15, .043, .02}},
    {"blue matte",
     {.0099, .036, .12},
     {{.0032, .0045, .0059}, {.18, .23, .28}, {.04, .049, .051}},
     {1, .046, .17},
     {.16, .075, .034}},
};

}  // namespace

MaterialRef build_carpaint(MaterialCompiler& compiler, Parameters& p) {
  CarPaintPreset paint = kCarPaints[0];
  const std::string name = p.text("name", "");
  if (!name.empty()) {
    const auto found = std::find_if(std::begin(kCarPaints), std::end(kCarPaints),
                                    [&](const CarPaintPreset& c) { return c.name == name; });
    if (found != std::end(kCarPaints)) {
      paint = *found;
    } else {
      std::vector<std::string_view> names;
      for (const CarPaintPreset& c : kCarPaints) names.push_back(c.name);
      p.diagnostics().warning(p.loc("name"),
                              fmt::format("no car paint \"{}\"{}: \"ford f8\" is used", name,
                                          did_you_mean(name, names)));
    }
    p.accept({"Kd", "Ks1", "Ks2", "Ks3", "R1", "R2", "R3", "M1", "M2", "M3"});
  } else {
    const auto colour = [&](std::string_view of, const glm::dvec3& fallback) {
      return p.given(of) ? compiler.reflectance(p, of, 0) : fallback;
    };
    paint.kd = colour("Kd", paint.kd);
    constexpr std::string_view kKs[] = {"Ks1", "Ks2", "Ks3"}, kR[] = {"R1", "R2", "R3"},
                               kM[] = {"M1", "M2", "M3"};
    for (int k = 0; k < 3; ++k) {
      paint.ks[k] = colour(kKs[k], paint.ks[k]);
      paint.r[k] = compiler.clamped(p, kR[k], paint.r[k], 0, 1);
      paint.m[k] = compiler.clamped(p, kM[k], paint.m[k], 0, 1);
    }
  }
  const glm::vec3 ka = compiler.reflectance_bands(p, "Ka", 0);
  const auto depth = float(compiler.clamped(p, "d", 0, 0, 1e6));
  const glm::vec3 kd = compiler.bands(paint.kd), a = compiler.bands(paint.ks[0]),
                  b = compiler.bands(paint.ks[1]), c = compiler.bands(paint.ks[2]);
  return compiler.add<CarPaintParameters>(MaterialKind::kCarPaint, {kd.x,
                                                                    kd.y,
                                                                    kd.z,
                                                                    a.x,
                                                                    a.y,
                                                                    a.z,
                                                                    b.x,
                                                                    b.y,
                                                                    b.z,
                                                                    c.x,
                                                                    c.y,
                                                                    c.z,
                                                                    float(paint.r[0]),
                                                                    float(paint.r[1]),
                                                                    float(paint.r[2]),
                                                                    float(paint.m[0]),
                                                                    float(paint.m[1]),
                                                                    float(paint.m[2]),
                                                                    ka.x,
                                                                    ka.y,
                                                                    ka.z,
                                                                    depth});
}

}  // namespace yat

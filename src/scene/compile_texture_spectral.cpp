// Spectra as colours (lxs 8.6, 9): blackbody, equalenergy, gaussian, frequency, regulardata,
// irregulardata, tabulateddata, lampspectrum, colordepth.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "scene/compile_parts.h"
#include "scene/compile_textures.h"
#include "scene/spectrum.h"

namespace yat {

namespace {

/// The curve as a colour of what the texture is for, which nothing makes negative.
TextureValue colour_of(TextureContext& c, const SpectralCurve& curve) {
  const bool light = c.textures.use() == TextureUse::kLight;
  const glm::dvec3 rgb = light ? rgb_of_light(curve) : rgb_of_reflectance(curve);
  const glm::dvec3 inside = glm::max(rgb, glm::dvec3(0.));
  return c.colour() ? TextureValue::of_colour(inside) : TextureValue::number(luminance(inside));
}

TextureValue blackbody(TextureContext& c) {
  auto temperature = double(c.p.number("temperature", 6500));
  if (!(temperature > 0)) {
    c.diagnostics().warning(c.p.loc("temperature"),
                            fmt::format("{}: \"temperature\" is {}, but must be above 0: 6500 is "
                                        "used",
                                        c.what(), temperature));
    temperature = 6500;
  }
  return colour_of(c, blackbody_curve(temperature));
}

TextureValue equalenergy(TextureContext& c) {
  const auto energy = double(c.p.number("energy", 1));
  return colour_of(c, [=](double) { return energy; });
}

TextureValue gaussian(TextureContext& c) {
  const auto center = double(c.p.number("wavelength", 550)),
             width = double(c.p.number("width", 50)), energy = double(c.p.number("energy", 1));
  return colour_of(c, [=](double w) {
    const double t = (w - center) / width;
    return width != 0 ? energy * std::exp(-.5 * t * t) : 0;
  });
}

TextureValue frequency(TextureContext& c) {
  const auto freq = double(c.p.number("freq", .03f)), phase = double(c.p.number("phase", .5f)),
             energy = double(c.p.number("energy", 1));
  return colour_of(c, [=](double w) { return energy * (.5 + .5 * std::sin(w * freq + phase)); });
}

/// Samples at ascending wavelengths, linear in between, 0 outside.
SpectralCurve sampled(std::vector<std::pair<double, double>> samples) {
  std::sort(samples.begin(), samples.end());
  return [samples = std::move(samples)](double w) {
    if (samples.empty() || w < samples.front().first || w > samples.back().first) return 0.;
    const auto above = std::lower_bound(samples.begin(), samples.end(), std::pair(w, -1e300));
    if (above == samples.begin()) return above->second;
    const auto below = above - 1;
    const double way = above->first - below->first;
    return way > 0 ? below->second + (w - below->first) / way * (above->second - below->second)
                   : above->second;
  };
}

TextureValue nothing(TextureContext& c, SourceLoc loc, std::string_view why) {
  c.diagnostics().error(loc, fmt::format("{}: {}: 1 at all wavelengths is used", c.what(), why));
  return colour_of(c, [](double) { return 1.; });
}

TextureValue regulardata(TextureContext& c) {
  const auto start = double(c.p.number("start", 380)), end = double(c.p.number("end", 720));
  std::vector<float> storage;
  const auto data = c.p.floats("data", ParameterType::kFloat, storage);
  if (data.size() < 2 || !(start < end))
    return nothing(c, c.p.loc("data"), "\"data\" needs two samples from \"start\" to \"end\"");
  std::vector<std::pair<double, double>> samples;
  for (size_t i = 0; i < data.size(); ++i)
    samples.emplace_back(start + (end - start) * double(i) / double(data.size() - 1),
                         double(data[i]));
  return colour_of(c, sampled(std::move(samples)));
}

TextureValue irregulardata(TextureContext& c) {
  std::vector<float> wavelength_storage, storage;
  const auto wavelengths = c.p.floats("wavelengths", ParameterType::kFloat, wavelength_storage);
  const auto data = c.p.floats("data", ParameterType::kFloat, storage);
  if (data.size() != wavelengths.size() || data.size() < 2)
    return nothing(
        c, c.p.loc("data"),
        fmt::format("\"wavelengths\" has {} numbers and \"data\" {}, two or more of each "
                    "are wanted",
                    wavelengths.size(), data.size()));
  std::vector<std::pair<double, double>> samples;
  for (size_t i = 0; i < data.size(); ++i)
    samples.emplace_back(double(wavelengths[i]), double(data[i]));
  return colour_of(c, sampled(std::move(samples)));
}

/// A text file of pairs "wavelength value"; what is no number separates them, # begins a comment.
TextureValue tabulateddata(TextureContext& c) {
  const std::string name = c.p.text("filename", "");
  const SourceLoc loc = c.p.loc("filename");
  const std::string path = find_data_file(name, loc, c.textures.description(), c.diagnostics());
  std::ifstream file(path);
  if (path.empty() || !file)
    return nothing(c, loc, fmt::format("file \"{}\" cannot be read", name));
  std::vector<std::pair<double, double>> samples;
  std::string line;
  while (std::getline(file, line)) {
    double pair[2];
    int count = 0;
    const std::string text = line.substr(0, line.find('#'));
    for (size_t i = 0; i < text.size() && count < 2;) {
      const char* begin = text.c_str() + i;
      const auto [end, error] = std::from_chars(begin, text.c_str() + text.size(), pair[count]);
      if (error == std::errc{}) ++count;
      i += error == std::errc{} ? size_t(end - begin) : 1;
    }
    if (count == 2) samples.emplace_back(pair[0], pair[1]);
  }
  if (samples.size() < 2)
    return nothing(c, loc, fmt::format("file \"{}\" has no pairs of wavelength and value", name));
  return colour_of(c, sampled(std::move(samples)));
}

TextureValue lampspectrum(TextureContext& c) {
  const std::string name = c.p.text("name", "Incandescent2");
  if (name == "Candle") return colour_of(c, blackbody_curve(1020));
  if (name == "Incandescent1") return colour_of(c, blackbody_curve(2750));
  if (name == "Incandescent2") return colour_of(c, blackbody_curve(2900));
  static constexpr std::array<std::string_view, 64> kMeasured = {"Alcohol",
                                                                 "AntiInsect",
                                                                 "Ar",
                                                                 "BLAU",
                                                                 "BLNG",
                                                                 "BLP",
                                                                 "Butane",
                                                                 "CarbonArc",
                                                                 "Cd",
                                                                 "CFL27K",
                                                                 "CFL4K",
                                                                 "CFL6K",
                                                                 "CL42053",
                                                                 "CobaltGlass",
                                                                 "Daylight",
                                                                 "FeCo",
                                                                 "FL37K",
                                                                 "FLAV17K",
                                                                 "FLAV8K",
                                                                 "FLBL",
                                                                 "FLBLB",
                                                                 "FLD2",
                                                                 "GaPb",
                                                                 "GreenLaser",
                                                                 "GroLux",
                                                                 "GRUN",
                                                                 "HPM2",
                                                                 "HPMFL1",
                                                                 "HPMFL2",
                                                                 "HPMFL2Glow",
                                                                 "HPMFLCL42053",
                                                                 "HPMFLCobaltGlass",
                                                                 "HPMFLRedGlass",
                                                                 "HPMSB",
                                                                 "HPMSBFL",
                                                                 "HPS",
                                                                 "HPX",
                                                                 "LCDS",
                                                                 "LEDB",
                                                                 "LPM2",
                                                                 "LPS",
                                                                 "MHD",
                                                                 "MHN",
                                                                 "MHSc",
                                                                 "MHWWD",
                                                                 "MPS",
                                                                 "Ne",
                                                                 "NeKrFL",
                                                                 "NeXeFL1",
                                                                 "NeXeFL2",
                                                                 "OliveOil",
                                                                 "PLANTA",
                                                                 "Rb",
                                                                 "RedGlass",
                                                                 "RedLaser",
                                                                 "SHPS",
                                                                 "SS1",
                                                                 "SS2",
                                                                 "TV",
                                                                 "UVA",
                                                                 "Welsbach",
                                                                 "Xe",
                                                                 "XeI",
                                                                 "Zn"};
  if (std::find(kMeasured.begin(), kMeasured.end(), name) == kMeasured.end()) {
    c.diagnostics().warning(
        c.p.loc("name"),
        fmt::format("{}: unknown lamp \"{}\"{}: a black body of 2900 K is used", c.what(), name,
                    did_you_mean(name, {kMeasured.begin(), kMeasured.end()})));
    return colour_of(c, blackbody_curve(2900));
  }
  c.diagnostics().warning(c.p.loc("name"),
                          fmt::format("{}: the spectrum of lamp \"{}\" is not at hand: neutral "
                                      "white is used",
                                      c.what(), name));
  return colour_of(c, [](double) { return 1.; });
}

/// Absorption so that Kt is left after a depth.
TextureValue colordepth(TextureContext& c) {
  const TextureValue kt = c.textures.color(c.p, "Kt", glm::dvec3(0.), c.depth + 1);
  const double depth = std::max(.001, double(c.p.number("depth", 1)));
  if (kt.varies())
    c.diagnostics().warning(
        c.p.loc("Kt"), c.what() + ": \"Kt\" cannot vary over a surface: about its mean is used");
  glm::dvec3 rgb;
  for (int k = 0; k < 3; ++k) rgb[k] = -std::log(std::clamp(kt.constant[k], 1e-9, 1.)) / depth;
  return c.colour() ? TextureValue::of_colour(rgb) : TextureValue::number(luminance(rgb));
}

constexpr TextureClass kClasses[] = {
    {"blackbody", &blackbody},         {"equalenergy", &equalenergy},
    {"gaussian", &gaussian},           {"frequency", &frequency},
    {"regulardata", &regulardata},     {"irregulardata", &irregulardata},
    {"tabulateddata", &tabulateddata}, {"lampspectrum", &lampspectrum},
    {"colordepth", &colordepth},
};

}  // namespace

std::span<const TextureClass> spectral_textures() {
  return kClasses;
}

}  // namespace yat

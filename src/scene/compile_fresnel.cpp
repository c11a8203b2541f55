#include "scene/compile_fresnel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kernels/materials/thin_film.h"
#include "scene/numbers.h"
#include "scene/read_file.h"

namespace yat {

namespace {

/// lxs A.3. colour: reflectance head-on in linear Rec.709; n at 610, 550 and 465 nm.
struct Preset {
  std::string_view name;
  double colour[3], n[3];
};
constexpr Preset kPresets[] = {
    {"aluminium", {.913, .922, .925}, {1.248, .959, .660}},
    {"amorphous carbon", {.212, .212, .200}, {2.421, 2.357, 2.216}},
    {"silver", {.971, .960, .914}, {.127, .125, .140}},
    {"gold", {1.016, .786, .343}, {.206, .350, 1.372}},
    {"copper", {.951, .639, .536}, {.324, .958, 1.157}},
};

/// (n, k) at a wavelength [nm].
struct IndexSample {
  double wavelength, n, k;
};

IndexBands at_band_wavelengths(std::vector<IndexSample> samples) {
  std::sort(samples.begin(), samples.end(),
            [](const auto& a, const auto& b) { return a.wavelength < b.wavelength; });
  IndexBands bands;
  for (size_t b = 0; b < 3; ++b) {
    const auto wanted = double(kBandWavelengths[b]);
    const auto above = std::find_if(samples.begin(), samples.end(),
                                    [&](const IndexSample& s) { return s.wavelength >= wanted; });
    const IndexSample& high = above == samples.end() ? samples.back() : *above;
    const IndexSample& low = above == samples.begin() ? high : *(above - 1);
    const double span = high.wavelength - low.wavelength;
    const double t = span > 0 ? std::clamp((wanted - low.wavelength) / span, 0., 1.) : 0;
    bands.n[b] = low.n + t * (high.n - low.n);
    bands.k[b] = low.k + t * (high.k - low.k);
  }
  return bands;
}

/// The numbers of a text, comments (`;` to the end of the line) left out. Empty at the first word
/// that is no number.
std::vector<double> numbers_of(std::string_view text) {
  std::vector<double> numbers;
  const char *p = text.data(), *end = p + text.size();
  while (p != end) {
    if (*p == ';') {
      p = std::find(p, end, '\n');
    } else if (*p == ' ' || *p == '\t' || *p == '\r' || *p == '\n' || *p == ',') {
      ++p;
    } else {
      const NumberRead<double> read = read_number<double>(p, end);
      if (read.status != NumberStatus::kOk) return {};
      numbers.push_back(read.value);
      p = read.end;
    }
  }
  return numbers;
}

/// SOPRA's header: unit, first, last and number of the steps between samples.
std::vector<IndexSample> sopra_samples(const std::vector<double>& v, std::string& problem) {
  const int unit = int(v[0]);
  if (unit < 1 || unit > 4 || double(unit) != v[0] || !(v[3] >= 1)) {
    problem = "its header is not that of a SOPRA file";
    return {};
  }
  const auto wavelength = [unit](double x) {
    return unit == 1 ? 1239.84193 / x : unit == 2 ? x * 1000 : unit == 3 ? 1e7 / x : x;
  };
  // Samples go from the last to the first in wavelength; eV and 1/cm decrease with it.
  const bool falls = unit == 1 || unit == 3;
  const double first = falls ? v[2] : v[1], last = falls ? v[1] : v[2];
  const size_t count = std::min(size_t(v[3]), (v.size() - 4) / 2);
  std::vector<IndexSample> samples;
  for (size_t i = 0; i < count; ++i) {
    const double x = first + (last - first) * double(count - 1 - i) / v[3];
    samples.push_back({wavelength(x), v[4 + 2 * i], v[5 + 2 * i]});
  }
  return samples;
}

bool usable(const IndexSample& s) {
  return std::isfinite(s.wavelength) && s.wavelength > 0 && std::isfinite(s.n) && s.n > 0 &&
         std::isfinite(s.k) && s.k >= 0;
}

/// lambda in nm; b in square micrometres (LuxRender's fresnelcauchy).
double cauchy_index(double a, double b, double wavelength) {
  return a + 1e6 * b / (wavelength * wavelength);
}
IndexBands cauchy_bands(double a, double b) {
  IndexBands bands;
  for (size_t i = 0; i < 3; ++i) bands.n[i] = cauchy_index(a, b, double(kBandWavelengths[i]));
  return bands;
}

IndexBands abbe_bands(Parameters& p) {
  const std::string type = p.text("type", "d");
  // Fraunhofer's lines [nm].
  double d = 587.5618, f = 486.13, c = 656.28;
  if (type == "D") d = 589.29;
  if (type == "e") d = 546.07, f = 479.99, c = 643.85;
  if (type == "custom") {
    d = double(p.number("lambda_D", 587.5618f));
    f = double(p.number("lambda_F", 486.13f));
    c = double(p.number("lambda_C", 656.28f));
  }
  const auto v = double(p.number("V", 64.17f)), n = double(p.number("n", 1.5168f));
  const double b = (n - 1) * c * c * f * f / (v * (c * c - f * f));  // [nm2]
  return cauchy_bands(n - b / (d * d), b * 1e-6);
}

IndexBands sellmeier_bands(Parameters& p) {
  std::vector<float> b_storage, c_storage;
  const auto b = p.floats("B", ParameterType::kFloat, b_storage);
  const auto c = p.floats("C", ParameterType::kFloat, c_storage);
  const auto a = double(p.number("A", 1));
  IndexBands bands;
  for (size_t i = 0; i < 3; ++i) {
    const double l2 = std::pow(double(kBandWavelengths[i]) * 1e-3, 2);
    double n2 = a;
    for (size_t j = 0; j < std::min(b.size(), c.size()); ++j)
      n2 += double(b[j]) * l2 / (l2 - double(c[j]) * double(c[j]));
    bands.n[i] = std::sqrt(n2);
  }
  return bands;
}

IndexBands checked(Parameters& p, IndexBands bands) {
  for (const double n : bands.n)
    if (!(n > 0) || !std::isfinite(n)) {
      p.diagnostics().warning(p.plugin().loc,
                              fmt::format("{} has an index of {:.6g}, but it must be above 0: 1.5 "
                                          "is used",
                                          p.what(), n));
      return {{1.5, 1.5, 1.5}, {}};
    }
  return bands;
}

Fresnel fresnel_texture(MaterialCompiler& compiler, const TextureEntry& entry) {
  const std::string& type = entry.plugin.type;
  Parameters p(entry.plugin, fmt::format("texture \"{}\"", entry.name), compiler.diagnostics());
  Fresnel fresnel = IndexBands{{5, 5, 5}, {}};
  if (type == "constant") {
    const auto n = double(p.number("value", 1));
    fresnel = checked(p, {{n, n, n}, {}});
  } else if (type == "fresnelcolor") {
    fresnel = FresnelColour{compiler.reflectance(p, "Kr", .5)};
  } else if (type == "cauchy") {
    const auto b = double(p.number("cauchyb", 0)), index = double(p.number("index", -1));
    const double a = index > 0 ? index - 1e6 * b / (720. * 380.) : 1.5;
    fresnel = checked(p, cauchy_bands(double(p.number("cauchya", float(a))), b));
  } else if (type == "abbe") {
    fresnel = checked(p, abbe_bands(p));
  } else if (type == "sellmeier") {
    fresnel = checked(p, sellmeier_bands(p));
  } else if (type == "preset" || type == "sopra" || type == "luxpop" || type == "fresnelname") {
    fresnel = named_metal(compiler, p);
  } else {
    compiler.diagnostics().warning(
        entry.plugin.loc,
        fmt::format("texture \"{}\": \"{}\" is no fresnel texture: index 5 is used", entry.name,
                    type));
    p.accept_all();
  }
  p.report_unused();
  return fresnel;
}

const Parameter* parameter_named(const Plugin& plugin, std::string_view name) {
  for (const Parameter& parameter : plugin.parameters)
    if (parameter.name == name) return &parameter;
  return nullptr;
}

}  // namespace

std::optional<IndexBands> metal_preset(std::string_view name, const MaterialCompiler& compiler) {
  for (const Preset& preset : kPresets) {
    if (preset.name != name) continue;
    const glm::vec3 reflectance = compiler.bands(
        glm::min(glm::dvec3(preset.colour[0], preset.colour[1], preset.colour[2]), 1.));
    IndexBands bands;
    for (size_t b = 0; b < 3; ++b) {
      const double n = preset.n[b], r = std::min(double(reflectance[int(b)]), .999);
      bands.n[b] = n;
      // r = ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2)
      bands.k[b] = std::sqrt(std::max((r * (n + 1) * (n + 1) - (n - 1) * (n - 1)) / (1 - r), 0.));
    }
    return bands;
  }
  return std::nullopt;
}

std::optional<IndexBands> read_metal_data(std::string_view text, std::string& problem) {
  const bool luxpop = text.find(';') != std::string_view::npos;
  const std::vector<double> v = numbers_of(text);
  std::vector<IndexSample> samples;
  if (v.size() < 3) {
    problem = "it is not a table of numbers";
    return std::nullopt;
  }
  if (luxpop) {
    for (size_t i = 0; i + 2 < v.size(); i += 3) samples.push_back({v[i] / 10, v[i + 1], v[i + 2]});
  } else if (v.size() >= 6) {
    samples = sopra_samples(v, problem);
  }
  std::erase_if(samples, [](const IndexSample& s) { return !usable(s); });
  if (samples.empty()) {
    if (problem.empty()) problem = "it has no samples";
    return std::nullopt;
  }
  return at_band_wavelengths(std::move(samples));
}

IndexBands named_metal(MaterialCompiler& compiler, Parameters& p) {
  const bool from_file = p.given("filename");
  const std::string_view parameter = from_file ? "filename" : "name";
  const std::string name = p.text(parameter, "aluminium");
  p.accept({"name", "filename"});
  if (const auto preset = metal_preset(name, compiler)) return *preset;
  Diagnostics& diagnostics = compiler.diagnostics();
  const std::string path =
      find_data_file(name, p.loc(parameter), compiler.description(), diagnostics);
  std::string problem = "there is no such preset or file";
  if (!path.empty()) {
    FileText file;
    problem = file.read(path);
    if (problem.empty())
      if (const auto bands = read_metal_data(file.view(), problem)) return *bands;
  }
  std::vector<std::string_view> presets;
  for (const Preset& preset : kPresets) presets.push_back(preset.name);
  diagnostics.warning(p.loc(parameter), fmt::format("metal \"{}\"{}: {}; aluminium is used", name,
                                                    did_you_mean(name, presets), problem));
  return *metal_preset("aluminium", compiler);
}

bool has_fresnel_texture(const MaterialCompiler& compiler, const Parameters& p) {
  const Parameter* fresnel = parameter_named(p.plugin(), "fresnel");
  const auto& textures = compiler.description().textures;
  return fresnel && fresnel->type == ParameterType::kTexture &&
         fresnel->texture < textures.size() && textures[fresnel->texture].kind == "fresnel";
}

double reflectance_head_on(double n, double k) {
  return ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
}

Fresnel fresnel_parameter(MaterialCompiler& compiler, Parameters& p) {
  const Description& description = compiler.description();
  const Parameter* fresnel = parameter_named(p.plugin(), "fresnel");
  const auto as_colour = [&](std::string_view name) {
    p.diagnostics().warning(
        p.loc(name),
        fmt::format("\"{}\" of {} is a colour, which LuxRender would ignore: taken as that of a "
                    "fresnelcolor texture",
                    name, p.what()),
        fmt::format("\"{}\" of {} is a colour", name, p.what()));
    return FresnelColour{compiler.reflectance(p, name, .5)};
  };
  if (fresnel && fresnel->type == ParameterType::kTexture) {
    if (fresnel->texture < description.textures.size()) {
      const TextureEntry& entry = description.textures[fresnel->texture];
      if (entry.kind == "color") return as_colour("fresnel");
      p.texture("fresnel");
      if (entry.kind == "fresnel") return fresnel_texture(compiler, entry);
    }
  } else if (fresnel && fresnel->type != ParameterType::kFloat &&
             fresnel->type != ParameterType::kInteger) {
    return as_colour("fresnel");
  }
  if (fresnel) {
    const double n = float_parameter(p, "fresnel", 5, compiler.textures());
    return checked(p, {{n, n, n}, {}});
  }
  if (p.given("Kr")) return as_colour("Kr");
  return IndexBands{{5, 5, 5}, {}};
}

double index_parameter(MaterialCompiler& compiler, Parameters& p, std::string_view name,
                       double fallback) {
  if (const Parameter* t = p.texture(name);
      t && t->texture < compiler.description().textures.size())
    if (const TextureEntry& entry = compiler.description().textures[t->texture];
        entry.kind == "fresnel") {
      const Fresnel fresnel = fresnel_texture(compiler, entry);
      if (const IndexBands* bands = std::get_if<IndexBands>(&fresnel)) return bands->n[1];
      const double root = std::sqrt(std::min(std::get<FresnelColour>(fresnel).kr.y, .999));
      return (1 + root) / (1 - root);
    }
  return float_parameter(p, name, fallback, compiler.textures());
}

}  // namespace yat

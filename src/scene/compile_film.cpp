// Film -> FilmSettings (lxs 4.1, 4.3, 4.4), SurfaceIntegrator -> depth (lxs 4.7).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/compile_parts.h"

namespace yat {

namespace {

/// YART knows three kernels, without parameters; its default is linear.
ToneMap yart_tone_map_by_name(Parameters& film) {
  const std::string name = film.text("tonemapkernel", "linear");
  if (name == "linear") return ToneMap::kYartLinear;
  if (name == "reinhard") return ToneMap::kYartReinhard;
  if (name == "outofgamut") return ToneMap::kOutOfGamut;
  film.diagnostics().warning(film.loc("tonemapkernel"),
                             fmt::format("YART has no tonemapkernel \"{}\": its \"linear\" is "
                                         "used, which leaves colours up to 1 as they are",
                                         name));
  return ToneMap::kYartLinear;
}

ToneMap tone_map_by_name(Parameters& film) {
  const std::string name = film.text("tonemapkernel", "autolinear");
  if (name == "outofgamut") return ToneMap::kOutOfGamut;
  if (name == "autolinear") return ToneMap::kAutoLinear;
  if (name == "linear") return ToneMap::kLinear;
  if (name == "reinhard") return ToneMap::kReinhard;
  if (name == "maxwhite") return ToneMap::kMaxWhite;
  if (name == "contrast") return ToneMap::kContrast;
  if (name == "falsecolors") return ToneMap::kFalseColors;
  film.diagnostics().warning(
      film.loc("tonemapkernel"),
      fmt::format("unknown tonemapkernel \"{}\"{}: \"autolinear\" is used", name,
                  did_you_mean(name, {"autolinear", "linear", "reinhard", "maxwhite", "contrast",
                                      "falsecolors", "outofgamut"})));
  return ToneMap::kAutoLinear;
}

ClampMethod clamp_by_name(Parameters& film) {
  const std::string name = film.text("ldr_clamp_method", "cut");
  if (name == "cut") return ClampMethod::kCut;
  if (name == "lum") return ClampMethod::kLum;
  if (name == "hue") return ClampMethod::kHue;
  if (name == "darken") return ClampMethod::kDarken;
  film.diagnostics().warning(film.loc("ldr_clamp_method"),
                             fmt::format("unknown ldr_clamp_method \"{}\"{}: \"cut\" is used", name,
                                         did_you_mean(name, {"cut", "lum", "hue", "darken"})));
  return ClampMethod::kCut;
}

/// Exactly `count` numbers into `to`, or a warning and `to` as it was.
bool read_floats(Parameters& film, std::string_view name, uint32_t count, float* to) {
  std::vector<float> storage;
  const auto values = film.floats(name, ParameterType::kFloat, storage);
  if (values.empty()) return false;
  if (values.size() != count) {
    film.diagnostics().warning(
        film.loc(name),
        fmt::format("\"{}\" has {} numbers where {} are wanted: the default is used", name,
                    values.size(), count));
    return false;
  }
  std::copy(values.begin(), values.end(), to);
  return true;
}

/// A number that must be above zero.
float positive(Parameters& film, std::string_view name, float fallback) {
  const float value = film.number(name, fallback);
  if (value > 0) return value;
  film.diagnostics().warning(film.loc(name), fmt::format("\"{}\" is {}, but must be above 0: {} "
                                                         "is used",
                                                         name, value, fallback));
  return fallback;
}

FalseColorScale false_scale_by_name(Parameters& film) {
  static constexpr std::pair<std::string_view, FalseColorScale> kScales[] = {
      {"std", FalseColorScale::kStd},       {"lmk", FalseColorScale::kLmk},
      {"red", FalseColorScale::kRed},       {"white", FalseColorScale::kWhite},
      {"yellow", FalseColorScale::kYellow}, {"speos", FalseColorScale::kSpeos}};
  const std::string name = film.text("false_colorscale", "std");
  for (const auto& [known, scale] : kScales)
    if (name == known) return scale;
  film.diagnostics().warning(
      film.loc("false_colorscale"),
      fmt::format("unknown false_colorscale \"{}\"{}: \"std\" is used", name,
                  did_you_mean(name, {"std", "lmk", "red", "white", "yellow", "speos"})));
  return FalseColorScale::kStd;
}

FalseColorMethod false_method_by_name(Parameters& film) {
  const std::string name = film.text("false_method", "linear");
  if (name == "linear") return FalseColorMethod::kLinear;
  if (name == "log") return FalseColorMethod::kLog;
  if (name == "log3") return FalseColorMethod::kLog3;
  film.diagnostics().warning(film.loc("false_method"),
                             fmt::format("unknown false_method \"{}\"{}: \"linear\" is used", name,
                                         did_you_mean(name, {"linear", "log", "log3"})));
  return FalseColorMethod::kLinear;
}

/// write_png, write_tga, write_exr and how: "kind" is "png", "tga" or "exr".
void add_file(Parameters& film, const std::string& kind, bool by_default,
              std::vector<PictureFile>& files) {
  const std::string prefix = "write_" + kind;
  const bool wanted = film.flag(prefix, by_default);
  PictureFile file;
  file.extension = "." + kind;
  const std::string channels = film.text(prefix + "_channels", "RGB");
  using Channels = PictureFile::Channels;
  if (channels == "Y")
    file.channels = Channels::kY;
  else if (channels == "YA")
    file.channels = Channels::kYA;
  else if (channels == "RGBA")
    file.channels = Channels::kRgba;
  else if (channels != "RGB")
    film.diagnostics().warning(
        film.loc(prefix + "_channels"),
        fmt::format("unknown {}_channels \"{}\": \"RGB\" is used", prefix, channels));
  if (film.flag(prefix + "_ZBuf", false) && wanted)
    film.diagnostics().warning(film.loc(prefix + "_ZBuf"),
                               fmt::format("\"{}_ZBuf\": depth is not written", prefix));
  film.accept({kind == "png"   ? "write_png_gamutclamp"
               : kind == "tga" ? "write_tga_gamutclamp"
                               : "write_exr_gamutclamp",
               kind == "png"   ? "write_png_zbuf_normalizationtype"
               : kind == "tga" ? "write_tga_zbuf_normalizationtype"
                               : "write_exr_zbuf_normalizationtype"});
  if (kind == "png") file.deep = film.flag("write_png_16bit", false);
  if (kind == "exr") {
    file.half = film.flag("write_exr_halftype", true);
    file.tone_mapped = film.flag("write_exr_applyimaging", true);
    const std::string name = film.text("write_exr_compressiontype", "PIZ (lossless)");
    static constexpr std::pair<std::string_view, const char*> kTypes[] = {
        {"RLE (lossless)", "rle"},
        {"PIZ (lossless)", "piz"},
        {"ZIP (lossless)", "zip"},
        {"Pxr24 (lossy)", "pxr24"},
        {"None", "none"}};
    for (const auto& [known, type] : kTypes)
      if (name == known) file.compression = type;
    if (file.compression.empty()) {
      file.compression = "piz";
      film.diagnostics().warning(film.loc("write_exr_compressiontype"),
                                 fmt::format("unknown write_exr_compressiontype \"{}\": \"PIZ "
                                             "(lossless)\" is used",
                                             name));
    }
  }
  if (wanted) files.push_back(file);
}

/// Statements that only say where and how LuxRender writes its files.
void accept_output_names(Parameters& film) {
  film.accept({"premultiplyalpha", "write_exr_straightcolors", "write_resume_flm",
               "restart_resume_flm", "write_flm_direct", "writeinterval", "flmwriteinterval",
               "displayinterval", "haltthreshold", "convergencestep", "outlierrejection_k",
               "filterquality", "tilecount", "debug", "usersamplingmap_filename"});
}

/// Names of older versions: one warning for all of them.
void warn_obsolete(Parameters& film) {
  static constexpr std::string_view kObsolete[] = {"hdr_filename",
                                                   "ldr_filename",
                                                   "igi_filename",
                                                   "hdr_writeinterval",
                                                   "ldr_writeinterval",
                                                   "igi_writeinterval",
                                                   "ldr_displayinterval",
                                                   "tonemapper",
                                                   "dither",
                                                   "bloomwidth",
                                                   "bloomradius",
                                                   "reject_warmup",
                                                   "write_tonemapped_exr",
                                                   "write_untonemapped_exr",
                                                   "write_tonemapped_tga",
                                                   "write_tonemapped_igi",
                                                   "write_untonemapped_igi"};
  std::string names;
  SourceLoc first = film.plugin().loc;
  for (std::string_view name : kObsolete) {
    if (!film.given(name)) continue;
    if (names.empty()) first = film.loc(name);
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", name);
    film.accept({name});
  }
  if (!names.empty())
    film.diagnostics().warning(first,
                               fmt::format("obsolete Film parameters are not used: {}", names),
                               "obsolete Film parameters");
}

void warn_effects(Parameters& film) {
  for (std::string_view effect :
       {"bloom_enabled", "vignetting_enabled", "abberation_enabled", "glare_enabled"})
    if (film.flag(effect, false))
      film.diagnostics().warning(film.loc(effect),
                                 fmt::format("\"{}\": post effects are not supported", effect));
  if (!film.text("cameraresponse", "").empty())
    film.diagnostics().warning(film.loc("cameraresponse"),
                               "\"cameraresponse\": response curves are not supported");
  film.accept({"bloom_radius", "bloom_weight", "vignetting_scale", "abberation_amount",
               "glare_amount", "glare_radius", "glare_blades", "glare_threshold",
               "glarelashesfilename", "glarepupilfilename"});
}

void set_crop(FilmSettings& film, const float (&crop)[4], SourceLoc loc, Diagnostics& diagnostics) {
  const bool in_range = std::all_of(crop, crop + 4, [](float x) { return x >= 0 && x <= 1; });
  if (!in_range || crop[0] >= crop[1] || crop[2] >= crop[3])
    diagnostics.fail(loc, fmt::format("the crop window {} {} {} {} is empty or not within 0 to 1 "
                                      "(x0 x1 y0 y1)",
                                      crop[0], crop[1], crop[2], crop[3]));
  // First pixel = ceil(res * x0), end = ceil(res * x1), at least one pixel.
  const auto range = [](uint32_t n, float from, float to, uint32_t& first, uint32_t& end) {
    first = std::min(uint32_t(std::ceil(double(n) * double(from))), n - 1);
    end = std::clamp(uint32_t(std::ceil(double(n) * double(to))), first + 1, n);
  };
  range(film.width, crop[0], crop[1], film.crop_x0, film.crop_x1);
  range(film.height, crop[2], crop[3], film.crop_y0, film.crop_y1);
}

}  // namespace

FilmSettings compile_film(const Description& description, const CompileOptions& options,
                          Diagnostics& diagnostics) {
  static const Plugin kDefault{"fleximage", {}, {}};  // what LuxRender takes without a Film
  const Plugin& plugin = description.film ? *description.film : kDefault;
  if (plugin.type != "fleximage" && plugin.type != "multiimage")
    diagnostics.fail(plugin.loc,
                     fmt::format("unknown film \"{}\"{}: use \"fleximage\"", plugin.type,
                                 did_you_mean(plugin.type, {"fleximage"})));
  Parameters film(plugin, "film \"" + plugin.type + "\"", diagnostics);
  FilmSettings settings;

  const int32_t width = film.integer("xresolution", 800), height = film.integer("yresolution", 600);
  settings.width = options.width ? options.width : uint32_t(std::max(width, 0));
  settings.height = options.height ? options.height : uint32_t(std::max(height, 0));
  // Pixels are named by 16 bits each way (PathState::pixel).
  if (settings.width == 0 || settings.height == 0 || settings.width > 65535 ||
      settings.height > 65535)
    diagnostics.fail(plugin.loc, fmt::format("the film is {} x {} pixels: both must be from 1 to "
                                             "65535",
                                             options.width ? int32_t(options.width) : width,
                                             options.height ? int32_t(options.height) : height));

  float crop[4] = {0, 1, 0, 1};
  read_floats(film, "cropwindow", 4, crop);
  if (options.crop_given)
    set_crop(settings, options.crop, {}, diagnostics);
  else
    set_crop(settings, crop, film.loc("cropwindow"), diagnostics);

  settings.filename = film.text("filename", settings.filename);
  settings.tone_map =
      description.dialect == Dialect::kYart ? yart_tone_map_by_name(film) : tone_map_by_name(film);
  const glm::dvec3 paint = film.triple("outofgamut_color", ParameterType::kColor, {1, 0, 0});
  for (int i = 0; i < 3; ++i) settings.out_of_gamut[i] = float(paint[i]);
  settings.gamma = positive(film, "gamma", settings.gamma);
  settings.linear_sensitivity = film.number("linear_sensitivity", settings.linear_sensitivity);
  settings.linear_exposure = film.number("linear_exposure", settings.linear_exposure);
  settings.linear_fstop = positive(film, "linear_fstop", settings.linear_fstop);
  settings.linear_gamma = film.number("linear_gamma", settings.linear_gamma);
  settings.reinhard_prescale = positive(film, "reinhard_prescale", settings.reinhard_prescale);
  settings.reinhard_postscale = film.number("reinhard_postscale", settings.reinhard_postscale);
  settings.reinhard_burn = film.number("reinhard_burn", settings.reinhard_burn);
  settings.contrast_ywa = film.number("contrast_ywa", settings.contrast_ywa);
  settings.clamp = clamp_by_name(film);
  read_floats(film, "colorspace_red", 2, settings.red);
  read_floats(film, "colorspace_green", 2, settings.green);
  read_floats(film, "colorspace_blue", 2, settings.blue);
  read_floats(film, "colorspace_white", 2, settings.white);
  settings.halt_spp = film.integer("haltspp", -1);
  settings.halt_time = film.integer("halttime", -1);

  settings.false_scale = false_scale_by_name(film);
  settings.false_method = false_method_by_name(film);
  settings.false_min = film.number("false_min", 0);
  settings.false_max = film.number("false_max", 0);
  add_file(film, "png", true, settings.files);
  add_file(film, "tga", false, settings.files);
  add_file(film, "exr", false, settings.files);
  accept_output_names(film);
  warn_obsolete(film);
  warn_effects(film);
  film.report_unused();
  return settings;
}

IntegratorSettings compile_integrator(const std::optional<Plugin>& integrator,
                                      Diagnostics& diagnostics) {
  IntegratorSettings settings;
  if (!integrator) return settings;
  const std::string& type = integrator->type;
  Parameters p(*integrator, "integrator \"" + type + "\"", diagnostics);
  const auto depth = [&](std::string_view name, int32_t fallback) {
    const int32_t value = p.integer(name, fallback);
    if (value >= 0 && value <= 65535) return value;
    diagnostics.warning(p.loc(name), fmt::format("\"{}\" is {}, but must be from 0 to 65535: {} is "
                                                 "used",
                                                 name, value, fallback));
    return fallback;
  };
  if (type == "path") {
    settings.max_depth = depth("maxdepth", 16);
    settings.show_environment = p.flag("includeenvironment", true);
    p.accept({"rrstrategy", "rrcontinueprob", "directlightsampling", "shadowraycount",
              "lightstrategy", "strategy"});
  } else if (type == "bidirectional") {
    // Its longest paths have eyedepth + lightdepth - 1 vertices; the eye's share is what a path
    // tracer of sensible length needs.
    settings.max_depth = std::max(depth("eyedepth", 8), 16);
    p.accept({"lightdepth", "eyerrthreshold", "lightrrthreshold", "lightstrategy",
              "lightpathstrategy", "strategy", "shadowraycount", "lightraycount", "hybridusemis",
              "debug"});
  } else if (type == "directlighting") {
    settings.direct_only = true;
    settings.max_depth = depth("maxdepth", 5);
    p.accept({"lightstrategy", "strategy", "shadowraycount"});
  } else {
    static const std::vector<std::string_view> kKnown = {
        "path", "bidirectional", "directlighting", "distributedpath", "exphotonmap", "igi", "sppm"};
    const bool known = std::find(kKnown.begin(), kKnown.end(), type) != kKnown.end();
    diagnostics.warning(integrator->loc,
                        fmt::format("{} integrator \"{}\"{}: \"path\" with maxdepth 16 is used",
                                    known ? "unsupported" : "unknown", type,
                                    known ? std::string() : did_you_mean(type, kKnown)));
    p.accept_all();
  }
  p.report_unused();
  return settings;
}

}  // namespace yat

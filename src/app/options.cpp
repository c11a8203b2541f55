#include "app/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/build_info.h"
#include "app/converge_options.h"
#include "app/option_values.h"
#include "base/error.h"
#include "kernels/strata.h"

namespace yat {

namespace {

// Samples are keyed by 32-bit indices; this leaves room for the next pass in any sum.
constexpr uint32_t kMostSamples = uint32_t(1) << 30;

constexpr OptionText kRenderOptions[] = {
    {"-o,--output", "FILE", "as the film's filename and write_ flags say",
     "picture to write: .png, .exr, .jpg or .tga; may be given several times"},
    {"--spp", "N", "the scene's haltspp, or 64; no limit with --time",
     "samples per pixel; powers of two suit the sobol sampler"},
    {"--samples-range", "A,B", "0 to --spp",
     "render only the samples A to B-1 of every pixel, to repeat or to split a render"},
    {"--time", "SECONDS", "the scene's halttime, or no limit",
     "stop rendering after this time; what comes first of this and --spp counts"},
    {"--noise-target", "X", "none",
     "stop when relMSE is below X, by the picture's own estimate; --spp and --time stay bounds"},
    {"--adaptive", "auto|on|off", "off",
     "with --noise-target: more samples where the picture is noisy; auto: if that pays"},
    {"--threads", "N", "one per processor", "worker threads; the picture does not depend on them"},
    {"--integrator", "path|direct", "the scene's",
     "path: all light; direct: direct light, mirrors and glass"},
    {"--max-depth", "N", "the scene's",
     "vertices after which a path ends; 0 sees light sources only"},
    {"--sampler", "NAME", "the scene's",
     "where random numbers come from: sobol, independent, regular, jittered, nrooks, multijittered "
     "or cmj"},
    {"--sample-set", "N", "all samples of a pixel",
     "samples that the samplers regular to cmj spread over a pixel together"},
    {"--compat", "luxrender|yart", "luxrender",
     "whose rules the scene follows: LuxRender's, or those of YART"},
    {"--colour", "bands|rgb", "bands; with --compat yart rgb",
     "how colours multiply: bands: as LuxRender's spectra do; rgb: channel by channel"},
    {"--seed", "N", "0", "another seed gives another, independent picture"},
    {"--resolution", "WxH", "the film's", "size of the full picture in pixels"},
    {"--crop", "x0,x1,y0,y1", "the film's", "part to render, as fractions of width and height"},
    {"--instances", "auto|copy|share", "auto",
     "objects placed by ObjectInstance: copied, stored once, or as their size says"},
    {"--light-choice", "auto|power|tree|uniform", "auto",
     "how a lamp is chosen: by power, by a tree that knows distances too, or each alike; auto: the "
     "tree from four lamps on, else power, of which sky and sun get at most half"},
    {"--light-sampling", "mis|lights|bsdf", "mis",
     "how light is found: by asking lamps and by chance, weighted; by asking alone; by chance "
     "alone. To compare and to debug: mis is the least noisy"},
    {"--roulette", "N|off", "1",
     "vertex from which on dim paths end by chance, brighter survivors making up for it; off: "
     "paths go on to --max-depth"},
    {"--texture-cache", "MB", "2048",
     "most memory for the texels of images; the finest levels are left out beyond it"},
    {"--energy-compensation", "auto|on|off", "auto",
     "add back what the facets of a rough lobe lose to each other; auto: where the look is not "
     "LuxRender's own (metal2 with --compat yart)"},
    {"--isa", "NAME", "YAT_ISA, or the best here", "instruction set of the kernels"},
    {"--tree", "auto|kd", "the scene's",
     "tree over the triangles; auto: the fastest for them, kd: a strict kd-tree; the picture is "
     "the same"},
    {"--tonemap", "NAME", "the film's",
     "linear, reinhard, autolinear, maxwhite, contrast, falsecolors, outofgamut, yart-linear or "
     "yart-reinhard; for .png, .jpg and .tga"},
    {"--exposure", "STOPS", "0", "brighten .png and .jpg by 2^STOPS before tone mapping"},
    {"--aov", "LIST", "none",
     "feature pictures into the .exr, comma-separated: albedo, normal, geometric_normal, depth, "
     "position, uv, direct, indirect, variance, sample_count, object_id, material_id, or all"},
    {"--stats", "FILE", "none", "write what was done and how long it took as JSON"},
    {"--trace", "FILE", "none", "write the stages of each thread over time as Chrome trace events"},
    {"--progress", "auto|bar|plain|json|none", "auto",
     "how to report progress on stderr; auto: bar on a terminal, else plain"},
    {"-v,--verbose", "", "off", "say more: notes, passes, memory"},
    {"-q,--quiet", "", "off", "say only what went wrong"},
    {"-h,--help", "", "", "print this"},
};

constexpr OptionText kInfoOptions[] = {
    {"--compat", "luxrender|yart", "luxrender",
     "whose rules the scene follows: LuxRender's, or those of YART"},
    {"--threads", "N", "one per processor", "worker threads for building the tree"},
    {"--integrator", "path|direct", "the scene's", "plan for this integrator"},
    {"--max-depth", "N", "the scene's", "plan for this depth"},
    {"--sampler", "NAME", "the scene's", "plan for this sampler"},
    {"--resolution", "WxH", "the film's", "size of the full picture in pixels"},
    {"--crop", "x0,x1,y0,y1", "the film's", "part to render, as fractions of width and height"},
    {"--instances", "auto|copy|share", "auto",
     "objects placed by ObjectInstance: copied, stored once, or as their size says"},
    {"--light-choice", "auto|power|tree|uniform", "auto",
     "how a lamp is chosen: by power, by a tree that knows distances too, or each alike; auto: the "
     "tree from four lamps on, else power, of which sky and sun get at most half"},
    {"--light-sampling", "mis|lights|bsdf", "mis",
     "how light is found: by asking lamps and by chance, weighted; by asking alone; by chance "
     "alone. To compare and to debug: mis is the least noisy"},
    {"--roulette", "N|off", "1",
     "vertex from which on dim paths end by chance, brighter survivors making up for it; off: "
     "paths go on to --max-depth"},
    {"--texture-cache", "MB", "2048",
     "most memory for the texels of images; the finest levels are left out beyond it"},
    {"--isa", "NAME", "YAT_ISA, or the best here", "instruction set of the kernels"},
    {"--tree", "auto|kd", "the scene's",
     "tree over the triangles; auto: the fastest for them, kd: a strict kd-tree; the picture is "
     "the same"},
    {"-v,--verbose", "", "off", "say more: notes"},
    {"-q,--quiet", "", "off", "no warnings"},
    {"-h,--help", "", "", "print this"},
};

constexpr OptionText kDiffOptions[] = {
    {"-o,--output", "FILE", "none", "map of FLIP per pixel: .exr for the values, .png for greys"},
    {"--fail", "X", "0 if another --fail option is there",
     "a pixel with a channel that differs by more than X counts as failed"},
    {"--failpercent", "P", "0", "so many percent of the pixels may fail"},
    {"--hardfail", "X", "none", "one pixel that differs by more than X is enough"},
    {"--failrelmse", "X", "none", "fail where relMSE is above X"},
    {"--failflip", "X", "none", "fail where FLIP (HDR-FLIP of radiance) is above X"},
    {"--warn", "X", "0 if another --warn option is there", "as --fail, for a warning"},
    {"--warnpercent", "P", "0", "as --failpercent, for a warning"},
    {"--hardwarn", "X", "none", "as --hardfail, for a warning"},
    {"-h,--help", "", "", "print this"},
};

constexpr std::array<std::pair<std::string_view, Integrator>, 2> kIntegrators = {
    {{"path", Integrator::kPath}, {"direct", Integrator::kDirect}}};
constexpr std::array<std::pair<std::string_view, SamplerKind>, 7> kSamplers = {
    {{"sobol", SamplerKind::kSobol},
     {"independent", SamplerKind::kIndependent},
     {"regular", SamplerKind::kRegular},
     {"jittered", SamplerKind::kJittered},
     {"nrooks", SamplerKind::kNRooks},
     {"multijittered", SamplerKind::kMultiJittered},
     {"cmj", SamplerKind::kCorrelatedMultiJittered}}};
constexpr std::array<std::pair<std::string_view, Dialect>, 2> kDialects = {
    {{"luxrender", Dialect::kLuxRender}, {"yart", Dialect::kYart}}};
constexpr std::array<std::pair<std::string_view, TreeChoice>, 2> kTrees = {
    {{"auto", TreeChoice::kAuto}, {"kd", TreeChoice::kKd}}};
constexpr std::array<std::pair<std::string_view, ColourMode>, 2> kColourModes = {
    {{"bands", ColourMode::kBands}, {"rgb", ColourMode::kRgb}}};
constexpr std::array<std::pair<std::string_view, InstanceMode>, 3> kInstanceModes = {
    {{"auto", InstanceMode::kAuto},
     {"copy", InstanceMode::kCopy},
     {"share", InstanceMode::kShare}}};
constexpr std::array<std::pair<std::string_view, Adaptive>, 3> kAdaptives = {
    {{"auto", Adaptive::kAuto}, {"on", Adaptive::kOn}, {"off", Adaptive::kOff}}};
constexpr std::array<std::pair<std::string_view, EnergyCompensation>, 3> kCompensations = {
    {{"auto", EnergyCompensation::kAuto},
     {"on", EnergyCompensation::kOn},
     {"off", EnergyCompensation::kOff}}};
constexpr std::array<std::pair<std::string_view, LightChoosing>, 4> kLightChoices = {
    {{"auto", LightChoosing::kAuto},
     {"power", LightChoosing::kPower},
     {"tree", LightChoosing::kTree},
     {"uniform", LightChoosing::kUniform}}};
constexpr std::array<std::pair<std::string_view, LightSampling>, 3> kLightSamplings = {
    {{"mis", LightSampling::kBoth},
     {"lights", LightSampling::kLights},
     {"bsdf", LightSampling::kBsdf}}};
constexpr std::array<std::pair<std::string_view, ToneMap>, 9> kToneMaps = {
    {{"linear", ToneMap::kLinear},
     {"reinhard", ToneMap::kReinhard},
     {"autolinear", ToneMap::kAutoLinear},
     {"maxwhite", ToneMap::kMaxWhite},
     {"contrast", ToneMap::kContrast},
     {"falsecolors", ToneMap::kFalseColors},
     {"outofgamut", ToneMap::kOutOfGamut},
     {"yart-linear", ToneMap::kYartLinear},
     {"yart-reinhard", ToneMap::kYartReinhard}}};
constexpr std::array<std::pair<std::string_view, ProgressKind>, 5> kProgressKinds = {
    {{"auto", ProgressKind::kAuto},
     {"bar", ProgressKind::kBar},
     {"plain", ProgressKind::kPlain},
     {"json", ProgressKind::kJson},
     {"none", ProgressKind::kSilent}}};

/// The value called `name`, or a UsageError that lists the names.
template <class T, size_t N>
T by_name(std::string_view option, std::string_view name,
          const std::array<std::pair<std::string_view, T>, N>& names) {
  std::vector<std::string_view> all;
  for (const auto& [known, value] : names) {
    if (known == name) return value;
    all.push_back(known);
  }
  throw UsageError(fmt::format("{} {}: unknown{}; choose from {}", option, name,
                               did_you_mean(name, all), fmt::join(all, ", ")));
}

template <class T, size_t N>
std::string_view name_of(T wanted, const std::array<std::pair<std::string_view, T>, N>& names) {
  for (const auto& [name, value] : names)
    if (value == wanted) return name;
  return "unknown";
}

/// Text of every option as given; read into Arguments once all are known.
struct Given {
  std::string spp, samples_range, time, noise_target, adaptive, threads, integrator, max_depth,
      sampler, sample_set, compat, colour, seed, resolution, crop, instances, light_choice,
      light_sampling, roulette, texture_cache, compensation, tree, tone_map, exposure, aov,
      progress;
  bool verbose = false, quiet = false;
};

const OptionText& text_of(std::span<const OptionText> options, std::string_view name) {
  for (const OptionText& option : options)
    if (option.flags.ends_with(name)) return option;
  throw std::logic_error(fmt::format("option {} is not in the table", name));
}

/// Adds options by their entry in the table.
class Adder {
 public:
  Adder(CLI::App& app, std::span<const OptionText> options) : app_(app), options_(options) {}
  template <class T>
  void operator()(std::string_view name, T& value) {
    const std::string flags(text_of(options_, name).flags);
    if constexpr (std::is_same_v<T, bool>)
      app_.add_flag(flags, value);
    else
      app_.add_option(flags, value)
          ->allow_extra_args(false)
          ->multi_option_policy(std::is_same_v<T, std::string> ? CLI::MultiOptionPolicy::Throw
                                                               : CLI::MultiOptionPolicy::TakeAll);
  }

 private:
  CLI::App& app_;
  std::span<const OptionText> options_;
};

void add_shared(Adder& add, Arguments& arguments, Given& given) {
  add("--compat", given.compat);
  add("--threads", given.threads);
  add("--integrator", given.integrator);
  add("--max-depth", given.max_depth);
  add("--sampler", given.sampler);
  add("--resolution", given.resolution);
  add("--crop", given.crop);
  add("--instances", given.instances);
  add("--light-choice", given.light_choice);
  add("--light-sampling", given.light_sampling);
  add("--roulette", given.roulette);
  add("--texture-cache", given.texture_cache);
  add("--isa", arguments.isa);
  add("--tree", given.tree);
  add("--verbose", given.verbose);
  add("--quiet", given.quiet);
}

void add_render(Adder& add, Arguments& arguments, Given& given) {
  add_shared(add, arguments, given);
  add("--output", arguments.outputs);
  add("--spp", given.spp);
  add("--sample-set", given.sample_set);
  add("--samples-range", given.samples_range);
  add("--time", given.time);
  add("--noise-target", given.noise_target);
  add("--adaptive", given.adaptive);
  add("--colour", given.colour);
  add("--energy-compensation", given.compensation);
  add("--seed", given.seed);
  add("--tonemap", given.tone_map);
  add("--exposure", given.exposure);
  add("--aov", given.aov);
  add("--stats", arguments.stats_file);
  add("--trace", arguments.trace_file);
  add("--progress", given.progress);
}

/// The thresholds as text.
struct GivenThresholds {
  std::string each, percent, any;
  std::optional<Thresholds> read(const std::string& word) const {
    if (each.empty() && percent.empty() && any.empty()) return {};
    Thresholds out;
    if (!each.empty()) out.each = number<double>("--" + word, each, each, 0, 1e30);
    if (!percent.empty())
      out.percent = number<double>("--" + word + "percent", percent, percent, 0, 100);
    if (!any.empty()) out.any = number<double>("--hard" + word, any, any, 0, 1e30);
    return out;
  }
};

/// The options of yat diff, as they came.
struct GivenDiff {
  GivenThresholds fail, warn;
  std::string rel_mse, flip;

  void add_to(Adder& add, DiffArguments& arguments) {
    add("--output", arguments.output);
    add("--fail", fail.each);
    add("--failpercent", fail.percent);
    add("--hardfail", fail.any);
    add("--failrelmse", rel_mse);
    add("--failflip", flip);
    add("--warn", warn.each);
    add("--warnpercent", warn.percent);
    add("--hardwarn", warn.any);
  }
  void read(DiffArguments& to) const {
    to.fail = fail.read("fail");
    to.warn = warn.read("warn");
    if (!rel_mse.empty())
      to.fail_rel_mse = number<double>("--failrelmse", rel_mse, rel_mse, 0, 1e30);
    if (!flip.empty()) to.fail_flip = number<double>("--failflip", flip, flip, 0, 1);
  }
};

void read_given(const Given& given, Arguments& to) {
  if (!given.spp.empty())
    to.samples_per_pixel = number<uint32_t>("--spp", given.spp, given.spp, 1, kMostSamples);
  if (!given.samples_range.empty()) {
    const auto [first, end] =
        numbers<uint32_t, 2>("--samples-range", given.samples_range, ',', 0, kMostSamples,
                             "A,B, the first and one past the last");
    if (first >= end)
      throw UsageError(
          fmt::format("--samples-range {}: no sample between them; A must be less than B",
                      given.samples_range));
    if (to.samples_per_pixel || !given.time.empty())
      throw UsageError("--samples-range says which samples to take: leave out --spp and --time");
    if (!given.noise_target.empty())
      throw UsageError(
          "--noise-target finds out which samples it takes, so they are not those of a "
          "--samples-range: leave one of them out");
    to.samples_range = SampleRange{first, end};
  }
  if (!given.time.empty()) {
    to.time_limit = number<double>("--time", given.time, given.time, 0, 1e9);
    if (*to.time_limit == 0) throw UsageError("--time 0: no time to render; give seconds above 0");
  }
  if (!given.noise_target.empty()) {
    to.noise_target =
        number<double>("--noise-target", given.noise_target, given.noise_target, 0, 1e9);
    if (*to.noise_target == 0)
      throw UsageError("--noise-target 0: no picture is without error; give a relMSE above 0");
    if (to.samples_per_pixel == 1u)
      throw UsageError(
          "--noise-target needs 2 samples per pixel to see the error: give --spp 2 or more");
  }
  if (!given.adaptive.empty()) {
    if (!to.noise_target)
      throw UsageError("--adaptive says how --noise-target takes samples: give one");
    to.adaptive = by_name("--adaptive", given.adaptive, kAdaptives);
  }
  if (!given.threads.empty())
    to.threads = number<uint32_t>("--threads", given.threads, given.threads, 1, 4096);
  if (!given.integrator.empty())
    to.integrator = by_name("--integrator", given.integrator, kIntegrators);
  if (!given.max_depth.empty())
    to.max_depth = number<uint32_t>("--max-depth", given.max_depth, given.max_depth, 0, 65535);
  if (!given.sampler.empty()) to.sampler = by_name("--sampler", given.sampler, kSamplers);
  if (!given.sample_set.empty())
    to.sample_set =
        number<uint32_t>("--sample-set", given.sample_set, given.sample_set, 1, kLargestSet);
  if (!given.compat.empty()) to.dialect = by_name("--compat", given.compat, kDialects);
  if (!given.colour.empty()) to.colour = by_name("--colour", given.colour, kColourModes);
  if (!given.seed.empty())
    to.seed =
        number<uint32_t>("--seed", given.seed, given.seed, 0, std::numeric_limits<uint32_t>::max());
  if (!given.resolution.empty()) {
    const auto size =
        numbers<uint32_t, 2>("--resolution", given.resolution, 'x', 1, 65535, "WxH, like 800x600");
    to.width = size[0];
    to.height = size[1];
  }
  if (!given.crop.empty()) {
    const auto crop = numbers<float, 4>("--crop", given.crop, ',', 0.f, 1.f,
                                        "x0,x1,y0,y1, like 0,0.5,0,1 for the left half");
    if (!(crop[0] < crop[1] && crop[2] < crop[3]))
      throw UsageError(
          fmt::format("--crop {}: empty; x0 must be below x1 and y0 below y1", given.crop));
    to.crop = crop;
  }
  if (!given.tree.empty()) to.tree = by_name("--tree", given.tree, kTrees);
  if (!given.instances.empty())
    to.instances = by_name("--instances", given.instances, kInstanceModes);
  if (!given.light_choice.empty())
    to.light_choice = by_name("--light-choice", given.light_choice, kLightChoices);
  if (!given.light_sampling.empty())
    to.light_sampling = by_name("--light-sampling", given.light_sampling, kLightSamplings);
  if (!given.roulette.empty())
    to.roulette_depth = given.roulette == "off" ? kNoRoulette
                                                : number<uint32_t>("--roulette", given.roulette,
                                                                   given.roulette, 0, 65535);
  if (!given.texture_cache.empty())
    to.image_bytes = uint64_t(number<uint32_t>("--texture-cache", given.texture_cache,
                                               given.texture_cache, 1u, 8191u))
                     << 20;
  if (!given.compensation.empty())
    to.compensation = by_name("--energy-compensation", given.compensation, kCompensations);
  if (!given.tone_map.empty()) to.tone_map = by_name("--tonemap", given.tone_map, kToneMaps);
  if (!given.exposure.empty())
    to.exposure_stops = number<float>("--exposure", given.exposure, given.exposure, -100.f, 100.f);
  if (!given.aov.empty()) to.features = parse_features("--aov", given.aov);
  if (!given.progress.empty()) to.progress = by_name("--progress", given.progress, kProgressKinds);
  if (given.verbose && given.quiet) throw UsageError("-v and -q exclude each other");
  to.verbosity = given.quiet     ? Verbosity::kQuiet
                 : given.verbose ? Verbosity::kVerbose
                                 : Verbosity::kNormal;
}

/// Flags as written in help and documents: "-o, --output FILE".
std::string shown_flags(const OptionText& option) {
  const size_t comma = option.flags.find(',');
  std::string flags =
      comma == std::string_view::npos
          ? std::string(option.flags)
          : fmt::format("{}, {}", option.flags.substr(0, comma), option.flags.substr(comma + 1));
  if (!option.value.empty()) flags += fmt::format(" {}", option.value);
  return flags;
}

std::string general_help() {
  return "Usage: yat render SCENE [OPTION...]   render a LuxRender scene (.lxs) to pictures\n"
         "       yat info SCENE [OPTION...]     say what the scene holds and how it would be "
         "rendered\n"
         "       yat diff PICTURE REFERENCE     compare two pictures\n"
         "       yat converge SCENE -o FOLDER   measure error against time, of one or more ways\n"
         "       yat -i SCENE [-o FILE] ...     the same by YART's rules and flags (yat -i -h "
         "lists "
         "them)\n"
         "       yat --version\n"
         "\n"
         "`yat render --help` and the same of the others list the options with their "
         "defaults.\n"
         "Exit codes: 0 done, 1 bad scene or input, 2 bad usage, 3 out of memory, disk or the "
         "like,\n"
         "4 and 5 pictures that differ by yat diff's fail and warn thresholds,\n"
         "130 interrupted (the picture so far is written).\n";
}

std::string help_for(const CLI::App* render, const CLI::App* info, const CLI::App* diff) {
  if (render->parsed())
    return option_help("yat render SCENE [OPTION...]",
                       "Renders a LuxRender scene (.lxs) to pictures.", kRenderOptions);
  if (info->parsed())
    return option_help(
        "yat info SCENE [OPTION...]",
        "Says what the scene holds, which stages and kernels would run, what the tree is "
        "like, and memory.",
        kInfoOptions);
  if (diff->parsed())
    return option_help(
        "yat diff PICTURE REFERENCE [OPTION...]",
        "Compares two pictures of one size: MSE, relMSE, MAPE, PSNR, FLIP, outliers. Exit "
        "code 4 and FAIL, 5 and WARN, or 0 and PASS by the thresholds that are given.",
        kDiffOptions);
  return general_help();
}

/// " (did you mean --spp?)" for the first argument that looks like an option and is none.
std::string option_suggestion(int argc, const char* const* argv,
                              std::span<const OptionText> options) {
  std::vector<std::string_view> names;
  for (const OptionText& option : options) {
    const size_t comma = option.flags.find(',');
    names.push_back(option.flags.substr(comma == std::string_view::npos ? 0 : comma + 1));
  }
  for (int i = 2; i < argc; ++i) {
    std::string_view argument = argv[i];
    argument = argument.substr(0, argument.find('='));
    if (!argument.starts_with("--") ||
        std::find(names.begin(), names.end(), argument) != names.end())
      continue;
    return did_you_mean(argument, names);
  }
  return {};
}

}  // namespace

std::span<const OptionText> render_option_texts() {
  return kRenderOptions;
}
std::span<const OptionText> info_option_texts() {
  return kInfoOptions;
}

std::span<const OptionText> diff_option_texts() {
  return kDiffOptions;
}

std::string option_help(std::string_view usage, std::string_view text,
                        std::span<const OptionText> options) {
  std::string help = fmt::format("Usage: {}\n{}\n\nOptions:\n", usage, text);
  for (const OptionText& option : options) {
    help += fmt::format("  {}\n      {}\n", shown_flags(option), option.text);
    if (!option.fallback.empty()) help += fmt::format("      default: {}\n", option.fallback);
  }
  return help;
}

std::string option_table(std::span<const OptionText> options) {
  std::string table = "| option | default | what it does |\n|---|---|---|\n";
  for (const OptionText& option : options) {
    // A bar inside a table cell must be escaped, in code too.
    std::string flags;
    for (const char letter : shown_flags(option)) {
      if (letter == '|') flags += '\\';
      flags += letter;
    }
    table += fmt::format("| `{}` | {} | {} |\n", flags, option.fallback, option.text);
  }
  return table;
}

std::string_view integrator_name(Integrator integrator) {
  return name_of(integrator, kIntegrators);
}
std::string_view sampler_name(SamplerKind sampler) {
  return name_of(sampler, kSamplers);
}
std::string_view colour_name(ColourMode colour) {
  return name_of(colour, kColourModes);
}
std::string_view light_choice_name(LightChoosing choosing) {
  return name_of(choosing, kLightChoices);
}
std::string_view light_sampling_name(LightSampling ways) {
  return name_of(ways, kLightSamplings);
}
std::string_view dialect_name(Dialect dialect) {
  return name_of(dialect, kDialects);
}
std::string_view tone_map_name(ToneMap tone_map) {
  return name_of(tone_map, kToneMaps);
}

CommandLine parse_command_line(int argc, const char* const* argv) {
  CommandLine line;
  if (is_yart_command_line(argc, argv)) {
    const auto asks_help = [](std::string_view a) { return a == "-h" || a == "--help"; };
    if (std::any_of(argv + 1, argv + argc, asks_help)) {
      line.text = yart_help();
      return line;
    }
    line.command = Command::kYart;
    line.yart = parse_yart_command_line(argc, argv);
    return line;
  }
  if (argc >= 2 && std::string_view(argv[1]) == "converge") {
    line.converge.assign(argv + 2, argv + argc);
    const auto asks_help = [](std::string_view a) { return a == "-h" || a == "--help"; };
    if (std::any_of(line.converge.begin(), line.converge.end(), asks_help))
      line.text = converge_help();
    else
      line.command = Command::kConverge;
    return line;
  }
  Given given;
  CLI::App app("yat");
  app.set_help_flag("-h,--help");
  app.set_version_flag("--version", std::string(kBuildInfo.version));
  app.require_subcommand(1);
  CLI::App* render = app.add_subcommand("render");
  CLI::App* info = app.add_subcommand("info");
  for (CLI::App* command : {render, info}) {
    command->set_help_flag("-h,--help");
    command->add_option("SCENE", line.arguments.scene)->required();
  }
  CLI::App* diff = app.add_subcommand("diff");
  diff->set_help_flag("-h,--help");
  diff->add_option("PICTURE", line.diff.picture)->required();
  diff->add_option("REFERENCE", line.diff.reference)->required();
  GivenDiff given_diff;
  Adder add_to_diff(*diff, kDiffOptions);
  given_diff.add_to(add_to_diff, line.diff);
  Adder add_to_render(*render, kRenderOptions), add_to_info(*info, kInfoOptions);
  add_render(add_to_render, line.arguments, given);
  add_shared(add_to_info, line.arguments, given);

  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    line.text = help_for(render, info, diff);
    return line;
  } catch (const CLI::CallForVersion&) {
    line.text = fmt::format("yat {} ({})\n", kBuildInfo.version, kBuildInfo.commit);
    return line;
  } catch (const CLI::ParseError& error) {
    if (argc < 2)
      throw UsageError(
          "nothing to do: say `yat render SCENE` or `yat info SCENE` (yat --help says more)");
    const auto options = info->parsed()   ? info_option_texts()
                         : diff->parsed() ? diff_option_texts()
                                          : render_option_texts();
    throw UsageError(fmt::format("{}{}; yat {}--help lists what there is", error.what(),
                                 option_suggestion(argc, argv, options),
                                 render->parsed() ? "render "
                                 : info->parsed() ? "info "
                                 : diff->parsed() ? "diff "
                                                  : ""));
  }
  if (diff->parsed()) {
    given_diff.read(line.diff);
    line.command = Command::kDiff;
    return line;
  }
  read_given(given, line.arguments);
  line.command = render->parsed() ? Command::kRender : Command::kInfo;
  return line;
}

}  // namespace yat

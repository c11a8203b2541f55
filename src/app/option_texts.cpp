#include "app/option_texts.h"

#include <fmt/format.h>

namespace yat {

namespace {

// Of both yat render and yat info.
constexpr OptionText kCompat = {"--compat", "luxrender|yart", "luxrender",
                                "whose rules the scene follows: LuxRender's, or those of YART"};
constexpr OptionText kResolution = {"--resolution", "WxH", "the film's",
                                    "size of the full picture in pixels"};
constexpr OptionText kCrop = {"--crop", "x0,x1,y0,y1", "the film's",
                              "part to render, as fractions of width and height"};
constexpr OptionText kInstances = {
    "--instances", "auto|copy|share", "auto",
    "objects placed by ObjectInstance: copied, stored once, or as their size says"};
constexpr OptionText kLightChoice = {
    "--light-choice", "auto|power|tree|uniform|all", "auto",
    "how a lamp is chosen: by power, by a tree that knows distances too, or each alike; all: none "
    "is, all are asked (up to 8); auto: skies that shine evenly are left to chance, both of two "
    "lights asked if one is a sky or a sun and both are of weight, else the tree from four lamps "
    "on, else power, of which sky and sun get at most half"};
constexpr OptionText kLightSampling = {
    "--light-sampling", "mis|lights|bsdf", "mis",
    "how light is found: by asking lamps and by chance, weighted; by asking alone; by chance "
    "alone. To compare and to debug: mis is the least noisy"};
constexpr OptionText kRoulette = {
    "--roulette", "N|off", "1",
    "vertex from which on dim paths end by chance, brighter survivors making up for it; off: "
    "paths go on to --max-depth"};
constexpr OptionText kShadowRoulette = {
    "--shadow-roulette", "SHARE|off", "0.2",
    "shadow rays that may bring less than this share of the picture's level are traced by chance, "
    "those traced making up for it; a pilot of 1024 paths tells the level"};
constexpr OptionText kTextureCache = {
    "--texture-cache", "MB", "2048",
    "most memory for the texels of images; the finest levels are left out beyond it"};
constexpr OptionText kIsa = {"--isa", "NAME", "YAT_ISA, or the best here",
                             "instruction set of the kernels"};
constexpr OptionText kTree = {
    "--tree", "auto|kd", "the scene's",
    "tree over the triangles; auto: the fastest for them, kd: a strict kd-tree; the picture is "
    "the same"};
constexpr OptionText kHelp = {"-h,--help", "", "", "print this"};

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
     "where random numbers come from: sobol, independent, regular, jittered, nrooks, "
     "multijittered, cmj or zsobol"},
    {"--sample-set", "N", "all samples of a pixel",
     "samples that the samplers regular to zsobol spread over a pixel together"},
    kCompat,
    {"--colour", "bands|rgb", "bands; with --compat yart rgb",
     "how colours multiply: bands: as LuxRender's spectra do; rgb: channel by channel"},
    {"--seed", "N", "0", "another seed gives another, independent picture"},
    kResolution,
    kCrop,
    kInstances,
    kLightChoice,
    kLightSampling,
    kRoulette,
    kShadowRoulette,
    kTextureCache,
    {"--energy-compensation", "auto|on|off", "auto",
     "add back what the facets of a rough lobe lose to each other; auto: where the look is not "
     "LuxRender's own (metal2 with --compat yart)"},
    kIsa,
    kTree,
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
    kHelp,
};

constexpr OptionText kInfoOptions[] = {
    kCompat,
    {"--threads", "N", "one per processor", "worker threads for building the tree"},
    {"--integrator", "path|direct", "the scene's", "plan for this integrator"},
    {"--max-depth", "N", "the scene's", "plan for this depth"},
    {"--sampler", "NAME", "the scene's", "plan for this sampler"},
    kResolution,
    kCrop,
    kInstances,
    kLightChoice,
    kLightSampling,
    kRoulette,
    kShadowRoulette,
    kTextureCache,
    kIsa,
    kTree,
    {"-v,--verbose", "", "off", "say more: notes"},
    {"-q,--quiet", "", "off", "no warnings"},
    kHelp,
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
    kHelp,
};

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

}  // namespace yat

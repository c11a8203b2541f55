#include "app/converge_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "app/option_values.h"
#include "app/option_words.h"
#include "app/options.h"
#include "converge/ladder.h"

namespace yat {

namespace {

constexpr uint32_t kMostSamples = uint32_t(1) << 24;  // The reference takes 64 times as many.
constexpr uint32_t kDefaultMost = 256;

constexpr OptionText kConvergeOptions[] = {
    {"-o,--output", "FOLDER", "required",
     "where everything is written; finished runs of the same experiment in it are not repeated"},
    {"--variant", "\"NAME: OPTIONS\"", "one, as the scene says",
     "a way to render the scene, by options of yat render; may be given several times, and each is "
     "compared with the first. With --noise-target it has one point, where the target is reached, "
     "instead of those of the ladder"},
    {"--reference", "FILE", "one is made",
     "picture that errors are measured against: an .exr of the same size, perhaps of another "
     "renderer"},
    {"--make-reference", "", "without --reference",
     "render the reference: 64 times the samples of the highest rung, by other seeds"},
    {"--runs", "N", "16", "runs of every rung and variant, each with a seed of its own"},
    {"--ladder", "LIST", "1,4,16,64,256", "numbers of samples per pixel to measure"},
    {"--spp-max", "N", "256", "instead of a list: 1, 4, 16 and so on up to N"},
    {"--time-per-run", "SECONDS", "no limit",
     "leave out rungs of a variant whose runs would take longer"},
    {"--seed", "N", "0", "another seed gives other runs and another reference"},
    {"--restart", "", "off", "throw away what the folder holds of another experiment"},
    {"--progress", "auto|bar|plain|json|none", "auto",
     "how to report progress on stderr; auto: bar on a terminal, else plain"},
    {"-v,--verbose", "", "off", "say more: notes, every run"},
    {"-q,--quiet", "", "off", "say only what went wrong"},
    {"-h,--help", "", "", "print this"},
};

/// Options of yat render that a variant cannot have: what is sampled and written is said otherwise.
constexpr std::string_view kNotForVariants[] = {
    "--output", "--spp",   "--samples-range", "--time",     "--seed",    "--tonemap", "--exposure",
    "--aov",    "--stats", "--trace",         "--progress", "--verbose", "--quiet",   "--help"};

/// Options that leave the compiled scene as it is. What is not here gets a scene of its own;
/// --light-sampling, for one, decides whether even skies are asked.
constexpr std::string_view kOfThePlan[] = {"--sampler",  "--sample-set",     "--max-depth",
                                           "--threads",  "--roulette",       "--noise-target",
                                           "--adaptive", "--shadow-roulette"};

template <size_t N>
bool among(std::string_view name, const std::string_view (&names)[N]) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

constexpr std::string_view kHelp = "yat converge --help";

/// Own options, and those of yat render.
std::vector<OptionText> all_options() {
  std::vector<OptionText> all(std::begin(kConvergeOptions), std::end(kConvergeOptions));
  const std::span<const OptionText> render = render_option_texts();
  all.insert(all.end(), render.begin(), render.end());
  return all;
}

bool is_own(std::string_view name) {
  return std::any_of(std::begin(kConvergeOptions), std::end(kConvergeOptions),
                     [&](const OptionText& own) { return own.flags.ends_with(name); });
}

void require_for_variants(std::string_view name) {
  if (among(name, kNotForVariants))
    throw UsageError(fmt::format(
        "{}: not with yat converge, which says itself what is sampled and written: see --ladder, "
        "--time-per-run and -o; {} lists what there is",
        name, kHelp));
}

/// The arguments of yat render with these options.
Arguments render_arguments(const std::string& scene, std::span<const GivenOption> options) {
  std::vector<std::string> words = {"yat", "render", scene};
  for (const GivenOption& option : options) {
    words.push_back(option.name);
    if (!option.value.empty()) words.push_back(option.value);
  }
  std::vector<const char*> pointers;
  for (const std::string& word : words) pointers.push_back(word.c_str());
  return parse_command_line(int(pointers.size()), pointers.data()).arguments;
}

ConvergeVariant make_variant(const std::string& scene, std::string name,
                             std::span<const GivenOption> options) {
  ConvergeVariant variant;
  variant.name = std::move(name);
  variant.options = options_text(options);
  std::vector<GivenOption> of_scene;
  for (const GivenOption& option : options)
    if (!among(option.name, kOfThePlan)) of_scene.push_back(option);
  variant.scene_key = options_text(of_scene);
  variant.arguments = render_arguments(scene, options);
  return variant;
}

/// "name: options", or the options alone, which then are the name.
ConvergeVariant read_variant(const std::string& scene, const std::string& text,
                             std::span<const GivenOption> shared) {
  const size_t colon = text.find(':');
  // A colon inside an option's value is none: names come first and are no options.
  const bool named = colon != std::string::npos && !text.starts_with("-");
  std::string name = named ? text.substr(0, colon) : text;
  while (!name.empty() && name.back() == ' ') name.pop_back();
  if (name.empty() || !(named || text.starts_with("-")))
    throw UsageError(fmt::format(
        "--variant \"{}\": write it as \"NAME: OPTIONS\", like \"jittered: --sampler jittered\"",
        text));
  const std::vector<std::string> words = shell_words(text.substr(named ? colon + 1 : 0));
  try {
    const SplitWords split = split_words(words, all_options(), kHelp);
    if (!split.others.empty())
      throw UsageError(fmt::format("\"{}\" belongs to no option; write \"NAME: OPTIONS\"",
                                   split.others.front()));
    for (const GivenOption& option : split.options) {
      if (is_own(option.name))
        throw UsageError(fmt::format("{} is not for one variant: give it outside", option.name));
      require_for_variants(option.name);
    }
    return make_variant(scene, name, laid_over(split.options, shared));
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("--variant \"{}\": {}", name, error.what()));
  }
}

std::vector<uint32_t> read_ladder(const std::string& text) {
  std::vector<uint32_t> ladder;
  std::string_view rest = text;
  while (true) {
    const size_t end = rest.find(',');
    ladder.push_back(number<uint32_t>("--ladder", text, rest.substr(0, end), 1, kMostSamples));
    if (end == std::string_view::npos) break;
    rest = rest.substr(end + 1);
  }
  std::sort(ladder.begin(), ladder.end());
  if (std::adjacent_find(ladder.begin(), ladder.end()) != ladder.end())
    throw UsageError(fmt::format("--ladder {}: a number is there twice; give each once", text));
  return ladder;
}

void add_reference_options(const std::string& scene, std::vector<GivenOption> shared,
                           ConvergeArguments& to) {
  // Of what is known, it converges fastest; its variance is measured, whatever the sampler.
  // It has its number of samples.
  std::erase_if(shared, [](const GivenOption& o) {
    return o.name == "--noise-target" || o.name == "--adaptive";
  });
  if (std::none_of(shared.begin(), shared.end(),
                   [](const GivenOption& o) { return o.name == "--sampler"; }))
    shared = laid_over(std::vector<GivenOption>{{"--sampler", "sobol"}}, shared);
  to.shared = make_variant(scene, "reference", shared);
}

}  // namespace

std::span<const OptionText> converge_option_texts() {
  return kConvergeOptions;
}

std::string converge_help() {
  return option_help("yat converge SCENE -o FOLDER [--variant \"NAME: OPTIONS\"]... [OPTION...]",
                     "Measures error against time: many short runs of every variant at growing "
                     "numbers of samples,\ncompared with a converged reference. Writes a report, "
                     "a record of every run and tables.\nOptions of yat render that say how to "
                     "render (--sampler, --resolution, --threads ...) hold for all variants.",
                     kConvergeOptions);
}

ConvergeArguments parse_converge_arguments(const std::vector<std::string>& words) {
  const SplitWords split = split_words(words, all_options(), kHelp);
  if (split.others.size() != 1)
    throw UsageError(split.others.empty()
                         ? fmt::format("yat converge: which scene? {} shows how", kHelp)
                         : fmt::format("yat converge: \"{}\" is one word too many; {} shows how",
                                       split.others[1], kHelp));
  ConvergeArguments to;
  to.scene = split.others.front();
  std::vector<GivenOption> shared;
  std::vector<std::string> variants;
  std::string ladder, most;
  bool make = false;
  std::vector<std::string> seen;
  for (const GivenOption& option : split.options) {
    const auto& [name, value] = option;
    if (!is_own(name)) require_for_variants(name);
    if (name != "--variant") {
      if (std::find(seen.begin(), seen.end(), name) != seen.end())
        throw UsageError(fmt::format("{}: given twice", name));
      seen.push_back(name);
    }
    if (name == "--output")
      to.folder = value;
    else if (name == "--variant")
      variants.push_back(value);
    else if (name == "--reference")
      to.reference = value;
    else if (name == "--make-reference")
      make = true;
    else if (name == "--runs")
      to.runs = number<uint32_t>(name, value, value, 1, 4096);
    else if (name == "--ladder")
      ladder = value;
    else if (name == "--spp-max")
      most = value;
    else if (name == "--time-per-run")
      to.time_per_run = number<double>(name, value, value, 0, 1e9);
    else if (name == "--seed")
      to.seed = number<uint32_t>(name, value, value, 0, std::numeric_limits<uint32_t>::max());
    else if (name == "--restart")
      to.restart = true;
    else if (name == "--progress")
      to.progress = render_arguments(to.scene, std::vector{option}).progress;
    else if (name == "--verbose" || name == "--quiet")
      to.verbosity = name == "--quiet" ? Verbosity::kQuiet : Verbosity::kVerbose;
    else
      shared.push_back(option);
  }
  if (to.folder.empty()) throw UsageError("yat converge: add -o FOLDER, where the report goes");
  if (!to.reference.empty() && make)
    throw UsageError("--reference and --make-reference exclude each other");
  if (!ladder.empty() && !most.empty())
    throw UsageError("--ladder and --spp-max exclude each other");
  to.ladder =
      !ladder.empty()
          ? read_ladder(ladder)
          : ladder_up_to(most.empty() ? kDefaultMost
                                      : number<uint32_t>("--spp-max", most, most, 1, kMostSamples));
  shared = laid_over(shared, {});
  add_reference_options(to.scene, shared, to);
  if (variants.empty()) to.variants.push_back(make_variant(to.scene, "default", shared));
  for (const std::string& text : variants) {
    to.variants.push_back(read_variant(to.scene, text, shared));
    for (size_t i = 0; i + 1 < to.variants.size(); ++i)
      if (to.variants[i].name == to.variants.back().name)
        throw UsageError(fmt::format("--variant: two are called \"{}\"; give each its name", text));
  }
  for (ConvergeVariant& variant : to.variants) {
    variant.arguments.verbosity = to.verbosity;
    variant.ladder = variant.to_noise() ? std::vector{kTargetRung} : to.ladder;
  }
  to.shared.arguments.verbosity = Verbosity::kQuiet;
  return to;
}

}  // namespace yat

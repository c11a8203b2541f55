#include "app/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <stdexcept>

#include "app/build_info.h"
#include "app/converge_options.h"
#include "app/option_names.h"
#include "app/option_texts.h"
#include "app/option_values.h"
#include "base/error.h"
#include "kernels/strata.h"

namespace yat {

namespace {

// Samples are keyed by 32-bit indices; this leaves room for the next pass in any sum.
constexpr uint32_t kMostSamples = uint32_t(1) << 30;

/// Text of every option as given; read into Arguments once all are known.
struct Given {
  std::string spp, samples_range, time, noise_target, adaptive, threads, integrator, max_depth,
      sampler, sample_set, compat, colour, seed, resolution, crop, instances, light_choice,
      light_sampling, roulette, shadow_roulette, texture_cache, compensation, tree, tone_map,
      exposure, aov, progress;
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
  add("--shadow-roulette", given.shadow_roulette);
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

double shadow_share(const std::string& text) {
  if (text == "off") return kNoShadowRoulette;
  const auto share = number<double>("--shadow-roulette", text, text, 0, 1);
  if (share == 0)
    throw UsageError(fmt::format(
        "--shadow-roulette {}: no shadow ray is below it; give a share above 0, or off", text));
  return share;
}

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
  if (to.sampler == SamplerKind::kZSobol && !given.noise_target.empty())
    throw UsageError(
        "--noise-target tells the error from pixels that are independent of each other, which "
        "those of --sampler zsobol are not: leave one of them out");
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
  if (!given.shadow_roulette.empty()) to.shadow_roulette = shadow_share(given.shadow_roulette);
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
                       "Renders a LuxRender scene (.lxs) to pictures.", render_option_texts());
  if (info->parsed())
    return option_help(
        "yat info SCENE [OPTION...]",
        "Says what the scene holds, which stages and kernels would run, what the tree is "
        "like, and memory.",
        info_option_texts());
  if (diff->parsed())
    return option_help(
        "yat diff PICTURE REFERENCE [OPTION...]",
        "Compares two pictures of one size: MSE, relMSE, MAPE, PSNR, FLIP, outliers. Exit "
        "code 4 and FAIL, 5 and WARN, or 0 and PASS by the thresholds that are given.",
        diff_option_texts());
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
  Adder add_to_diff(*diff, diff_option_texts());
  given_diff.add_to(add_to_diff, line.diff);
  Adder add_to_render(*render, render_option_texts()), add_to_info(*info, info_option_texts());
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

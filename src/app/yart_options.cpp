#include "app/yart_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace yat {

namespace {

enum class Flag {
  kInput,
  kOutput,
  kPathTracer,
  kSamples,
  kTraceDepth,
  kAntialiasing,
  kRayDepth,
  kThreads,
  kBucketSize,
  kTime,
  kBenchmark,
  kWindow,
  kHeartBeat,
  kHelp,
};

struct FlagText {
  Flag flag;
  std::string_view brief, name, value, text;
};

// clang-format off
constexpr FlagText kFlags[] = {
    {Flag::kInput, "i", "input", "FILE", "scene to render"},
    {Flag::kOutput, "o", "output", "FILE", "picture to write: .png, .exr or .jpg; without it nothing is saved"},
    {Flag::kPathTracer, "pathtracer", "pathtracer", "", "all light; without it: direct light, mirrors and glass"},
    {Flag::kSamples, "s", "samples", "N", "paths per pixel of the path tracer (4)"},
    {Flag::kTraceDepth, "tr", "trace-depth", "N", "vertices after which a path ends (10)"},
    {Flag::kAntialiasing, "aa", "antialiasing", "N", "rays per pixel without -pathtracer (4), each with as many shadow rays as the lights' nsamples say"},
    {Flag::kRayDepth, "d", "raydepth", "X", "reflections and refractions without -pathtracer (10)"},
    {Flag::kThreads, "th", "threads", "N", "worker threads (one per processor)"},
    {Flag::kBucketSize, "bs", "bucketsize", "N", "pixels along the edge of a bucket (128)"},
    {Flag::kTime, "t", "time", "", "write render time and number of triangles into the picture"},
    {Flag::kBenchmark, "b", "benchmark", "N", "render N times and print each time, the average and renders per second"},
    {Flag::kWindow, "g", "gui", "", "a window; it comes with a later version: the picture is rendered without one"},
    {Flag::kHeartBeat, "hb", "heart-beat", "", "print a dot per finished bucket; not with -b or -g"},
    {Flag::kHelp, "h", "help", "", "print this"},
};
// clang-format on

std::string shown(const FlagText& flag) {
  return fmt::format("-{}", flag.brief);
}

/// The flag that an argument names, with what follows a "=". YART's names have one dash if they are
/// short and two if they are long; either is taken.
struct Named {
  const FlagText* flag = nullptr;
  std::optional<std::string_view> value;
};
Named flag_of(std::string_view argument) {
  if (argument.size() < 2 || argument[0] != '-') return {};
  std::string_view name = argument.substr(argument[1] == '-' ? 2 : 1);
  Named named;
  if (const size_t equals = name.find('='); equals != std::string_view::npos) {
    named.value = name.substr(equals + 1);
    name = name.substr(0, equals);
  }
  for (const FlagText& flag : kFlags)
    if (name == flag.brief || name == flag.name) named.flag = &flag;
  return named;
}

uint32_t whole_number(const FlagText& flag, std::string_view text, uint32_t most) {
  uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size() || value < 1 ||
      value > most)
    throw Error(
        fmt::format("yat: {} {}: give a whole number from 1 to {}", shown(flag), text, most));
  return value;
}

/// A number above 0, as YART has it, of which whole reflections count: at least one.
uint32_t ray_depth(const FlagText& flag, std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size() || !(value > 0))
    throw Error(fmt::format("yat: {} {}: give a number above 0", shown(flag), text));
  return uint32_t(std::clamp(std::floor(value), 1., 65534.));
}

void remark(YartArguments& to, std::string_view text) {
  to.remarks += fmt::format("{}warning: {}", to.remarks.empty() ? "" : "\n", text);
}

void read(const FlagText& flag, std::string_view value, YartArguments& to) {
  constexpr uint32_t kMostSamples = 1u << 20;
  switch (flag.flag) {
    case Flag::kInput:
      to.scene = value;
      break;
    case Flag::kOutput:
      to.output = value;
      break;
    case Flag::kPathTracer:
      to.path_tracer = true;
      break;
    case Flag::kSamples:
      to.samples = whole_number(flag, value, kMostSamples);
      break;
    case Flag::kTraceDepth:
      to.trace_depth = whole_number(flag, value, 65535);
      break;
    case Flag::kAntialiasing:
      to.antialiasing = whole_number(flag, value, kMostSamples);
      break;
    case Flag::kRayDepth:
      to.ray_depth = ray_depth(flag, value);
      break;
    case Flag::kThreads:
      to.threads = whole_number(flag, value, 4096);
      break;
    case Flag::kBucketSize:
      to.bucket_size = whole_number(flag, value, 65535);
      break;
    case Flag::kTime:
      to.stamp = true;
      break;
    case Flag::kBenchmark:
      to.benchmark = whole_number(flag, value, 1000000);
      break;
    case Flag::kHeartBeat:
      to.heart_beat = true;
      break;
    case Flag::kWindow:
    case Flag::kHelp:
      break;
  }
}

std::string unknown_flag(std::string_view argument) {
  std::vector<std::string> all;
  for (const FlagText& flag : kFlags) {
    all.push_back(fmt::format("-{}", flag.brief));
    all.push_back(fmt::format("--{}", flag.name));
  }
  const std::vector<std::string_view> names(all.begin(), all.end());
  return fmt::format("yat: {}: no such flag of YART's command line{}; yat --help lists them",
                     argument, did_you_mean(argument, names));
}

}  // namespace

bool is_yart_command_line(int argc, const char* const* argv) {
  if (argc < 2 || argv[1][0] != '-') return false;
  for (int i = 1; i < argc; ++i)
    if (const FlagText* flag = flag_of(argv[i]).flag; flag && flag->flag != Flag::kHelp)
      return true;
  return false;
}

YartArguments parse_yart_command_line(int argc, const char* const* argv) {
  YartArguments to;
  bool window = false;
  std::vector<Flag> given;
  const auto is_given = [&](Flag flag) {
    return std::find(given.begin(), given.end(), flag) != given.end();
  };
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    const Named named = flag_of(argument);
    if (!named.flag) {
      if (argument.starts_with('-') && argument.size() > 1) throw Error(unknown_flag(argument));
      remark(to, fmt::format("{} belongs to no flag and is ignored", argument));
      continue;
    }
    const FlagText& flag = *named.flag;
    if (flag.flag == Flag::kHelp) continue;  // asked for before this is called
    if (flag.value.empty() && named.value)
      throw Error(fmt::format("yat: {}: this flag has no value", argument));
    std::string_view value;
    if (!flag.value.empty()) {
      if (named.value)
        value = *named.value;
      else if (i + 1 < argc)
        value = argv[++i];
      if (value.empty())
        throw Error(
            fmt::format("yat: {}: its value is missing: {} {}", argument, shown(flag), flag.value));
    }
    if (is_given(flag.flag))
      throw Error(fmt::format("yat: {} is given twice, leave one out", shown(flag)));
    given.push_back(flag.flag);
    window = window || flag.flag == Flag::kWindow;
    read(flag, value, to);
  }
  if (to.scene.empty()) throw Error("yat: no scene: give -i FILE (yat --help says more)");
  if (window && to.benchmark) throw Error("yat: -g and -b exclude each other");
  if (window && to.output.empty())
    throw Error("yat: -g: the window comes with a later version: give -o FILE to save the picture");
  if (window) remark(to, "-g: the window comes with a later version, the picture goes to -o alone");
  if (to.heart_beat && (window || to.benchmark)) {
    remark(to, fmt::format("-hb does nothing with {}", window ? "-g" : "-b"));
    to.heart_beat = false;
  }
  if (!to.path_tracer)
    for (const auto& [flag, name] :
         {std::pair(Flag::kSamples, "-s"), std::pair(Flag::kTraceDepth, "-tr")})
      if (is_given(flag)) remark(to, fmt::format("{} counts with -pathtracer only", name));
  if (to.path_tracer && is_given(Flag::kAntialiasing))
    remark(to, "-aa does nothing with -pathtracer: -s is its number of paths");
  if (to.path_tracer && to.ray_depth)
    remark(to, "-d does nothing with -pathtracer: -tr is its depth");
  if (to.output.empty()) remark(to, "without -o FILE the picture is not saved");
  return to;
}

std::string yart_help() {
  std::string help =
      "Usage: yat -i SCENE [-o FILE] [FLAG...]   YART's command line, with --compat yart\n\n";
  for (const FlagText& flag : kFlags) {
    std::string flags = fmt::format("-{}", flag.brief);
    if (flag.brief != flag.name) flags += fmt::format(", --{}", flag.name);
    if (!flag.value.empty()) flags += fmt::format(" {}", flag.value);
    help += fmt::format("  {}\n      {}\n", flags, flag.text);
  }
  return help;
}

std::string yart_time(double seconds) {
  const auto ms = uint64_t(std::llround(std::max(seconds, 0.) * 1000));
  if (ms <= 5000) return fmt::format("{}ms", ms);
  const uint64_t hours = ms / 3600000, minutes = ms / 60000 % 60, rest = ms % 60000;
  std::string text;
  if (hours) text += fmt::format("{}h", hours);
  if (hours || minutes) text += fmt::format("{}m", minutes);
  std::string fraction = rest % 1000 ? fmt::format(".{:03}", rest % 1000) : std::string();
  while (!fraction.empty() && fraction.back() == '0') fraction.pop_back();
  return text + fmt::format("{}{}s", rest / 1000, fraction);
}

}  // namespace yat

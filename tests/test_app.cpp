// The parts of the program: command line, passes, progress, reports.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/option_names.h"
#include "app/option_texts.h"
#include "app/options.h"
#include "app/passes.h"
#include "app/progress.h"
#include "app/report.h"
#include "base/error.h"
#include "run_program.h"

namespace yat {
namespace {

CommandLine parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "yat");
  return parse_command_line(int(arguments.size()), arguments.data());
}

std::string usage_error(const std::vector<const char*>& arguments) {
  try {
    parse(arguments);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Options, DefaultsLeaveTheSceneItsSay) {
  const CommandLine line = parse({"render", "scene.lxs"});
  EXPECT_EQ(line.command, Command::kRender);
  EXPECT_EQ(line.arguments.scene, "scene.lxs");
  EXPECT_TRUE(line.arguments.outputs.empty());
  EXPECT_FALSE(line.arguments.samples_per_pixel);
  EXPECT_FALSE(line.arguments.time_limit);
  EXPECT_FALSE(line.arguments.integrator);
  EXPECT_FALSE(line.arguments.max_depth);
  EXPECT_FALSE(line.arguments.crop);
  EXPECT_FALSE(line.arguments.tone_map);
  EXPECT_EQ(line.arguments.tree, TreeChoice::kFromScene);
  EXPECT_FALSE(line.arguments.sampler);
  EXPECT_FALSE(line.arguments.colour);
  EXPECT_EQ(line.arguments.dialect, Dialect::kLuxRender);
  EXPECT_EQ(line.arguments.threads, 0u);
  EXPECT_EQ(line.arguments.progress, ProgressKind::kAuto);
  EXPECT_EQ(line.arguments.verbosity, Verbosity::kNormal);
}

TEST(Options, EveryOptionIsRead) {
  const Arguments a =
      parse({"render",       "a.lxs",      "-o",           "b.png", "--output",  "c.exr",
             "--spp",        "32",         "--time",       "2.5",   "--threads", "3",
             "--integrator", "direct",     "--max-depth",  "7",     "--sampler", "independent",
             "--seed",       "4294967295", "--resolution", "64x48", "--crop",    "0,0.5,0.25,1",
             "--isa",        "sse42",      "--tree",       "kd",    "--tonemap", "reinhard",
             "--exposure",   "-1.5",       "--colour",     "rgb",   "--stats",   "s.json",
             "--trace",      "t.json",     "--progress",   "json",  "-v"})
          .arguments;
  EXPECT_EQ(a.outputs, (std::vector<std::string>{"b.png", "c.exr"}));
  EXPECT_EQ(a.samples_per_pixel, 32u);
  EXPECT_EQ(a.time_limit, 2.5);
  EXPECT_EQ(a.threads, 3u);
  EXPECT_EQ(a.integrator, Integrator::kDirect);
  EXPECT_EQ(a.max_depth, 7u);
  EXPECT_EQ(a.sampler, SamplerKind::kIndependent);
  EXPECT_EQ(a.colour, ColourMode::kRgb);
  EXPECT_EQ(a.seed, 4294967295u);
  EXPECT_EQ(a.width, 64u);
  EXPECT_EQ(a.height, 48u);
  EXPECT_EQ(a.crop, (std::array<float, 4>{0, .5f, .25f, 1}));
  EXPECT_EQ(a.isa, "sse42");
  EXPECT_EQ(a.tree, TreeChoice::kKd);
  EXPECT_EQ(a.tone_map, ToneMap::kReinhard);
  EXPECT_EQ(a.exposure_stops, -1.5f);
  EXPECT_EQ(a.stats_file, "s.json");
  EXPECT_EQ(a.trace_file, "t.json");
  EXPECT_EQ(a.progress, ProgressKind::kJson);
  EXPECT_EQ(a.verbosity, Verbosity::kVerbose);
  const Arguments ways = parse({"render", "a.lxs", "--light-choice", "uniform", "--light-sampling",
                                "bsdf", "--roulette", "off", "--shadow-roulette", ".25"})
                             .arguments;
  EXPECT_EQ(ways.light_choice, LightChoosing::kUniform);
  EXPECT_EQ(ways.light_sampling, LightSampling::kBsdf);
  EXPECT_EQ(ways.roulette_depth, kNoRoulette);
  EXPECT_EQ(ways.shadow_roulette, .25);
  EXPECT_EQ(parse({"render", "a.lxs", "--shadow-roulette", "off"}).arguments.shadow_roulette,
            kNoShadowRoulette);
  EXPECT_EQ(parse({"info", "a.lxs", "--shadow-roulette", "1"}).arguments.shadow_roulette, 1.);
  // What the documents call the default is the default.
  const auto texts = render_option_texts();
  const auto text = std::find_if(texts.begin(), texts.end(), [](const OptionText& option) {
    return option.flags == "--shadow-roulette";
  });
  ASSERT_NE(text, texts.end());
  EXPECT_EQ(text->fallback, shadow_roulette_name(kUsualShadowRoulette));
  EXPECT_EQ(parse({"render", "a.lxs"}).arguments.shadow_roulette, kUsualShadowRoulette);
  EXPECT_EQ(parse({"render", "a.lxs", "--roulette", "0"}).arguments.roulette_depth, 0u);
  EXPECT_EQ(parse({"render", "a.lxs"}).arguments.roulette_depth, TransportOptions{}.roulette_depth);
  const Arguments range = parse({"render", "a.lxs", "--samples-range", "5,9", "-q"}).arguments;
  EXPECT_EQ(range.samples_range->first, 5u);
  EXPECT_EQ(range.samples_range->end, 9u);
  EXPECT_EQ(range.verbosity, Verbosity::kQuiet);
}

TEST(Options, MistakesNameTheOptionAndTheWayOut) {
  EXPECT_EQ(usage_error({"render", "a.lxs", "--spp", "0"}),
            "--spp 0: 0 is not within 1 to 1073741824");
  EXPECT_EQ(usage_error({"render", "a.lxs", "--spp", "many"}),
            "--spp many: \"many\" is not a number that fits here");
  EXPECT_EQ(usage_error({"render", "a.lxs", "--resolution", "800"}),
            "--resolution 800: write it as WxH, like 800x600");
  EXPECT_EQ(usage_error({"render", "a.lxs", "--resolution", "800x600x3"}),
            "--resolution 800x600x3: write it as WxH, like 800x600");
  EXPECT_EQ(usage_error({"render", "a.lxs", "--crop", "0.5,0.5,0,1"}),
            "--crop 0.5,0.5,0,1: empty; x0 must be below x1 and y0 below y1");
  EXPECT_EQ(usage_error({"render", "a.lxs", "--crop", "0,nan,0,1"}),
            "--crop 0,nan,0,1: nan is not within 0 to 1");
  EXPECT_EQ(
      usage_error({"render", "a.lxs", "--tonemap", "reinhart"}),
      "--tonemap reinhart: unknown (did you mean \"reinhard\"?); choose from linear, reinhard, "
      "autolinear, maxwhite, contrast, falsecolors, outofgamut, yart-linear, yart-reinhard");
  EXPECT_EQ(usage_error({"render", "a.lxs", "--time", "0"}),
            "--time 0: no time to render; give seconds above 0");
  EXPECT_EQ(usage_error({"render", "a.lxs", "--samples-range", "4,4"}),
            "--samples-range 4,4: no sample between them; A must be less than B");
  EXPECT_EQ(usage_error({"render", "a.lxs", "--samples-range", "0,4", "--spp", "4"}),
            "--samples-range says which samples to take: leave out --spp and --time");
  EXPECT_EQ(usage_error({"render", "a.lxs", "--noise-target", "1e-2", "--samples-range", "0,4"}),
            "--noise-target finds out which samples it takes, so they are not those of a "
            "--samples-range: leave one of them out");
  EXPECT_EQ(usage_error({"render", "a.lxs", "--adaptive", "on"}),
            "--adaptive says how --noise-target takes samples: give one");
  EXPECT_EQ(usage_error({"render", "a.lxs", "--noise-target", "0"}),
            "--noise-target 0: no picture is without error; give a relMSE above 0");
  EXPECT_EQ(usage_error({"render", "a.lxs", "--noise-target", "1e-2", "--spp", "1"}),
            "--noise-target needs 2 samples per pixel to see the error: give --spp 2 or more");
  EXPECT_EQ(usage_error({"render", "a.lxs", "--noise-target", "1e-2", "--sampler", "zsobol"}),
            "--noise-target tells the error from pixels that are independent of each other, which "
            "those of --sampler zsobol are not: leave one of them out");
  EXPECT_EQ(usage_error({"render", "a.lxs", "-v", "-q"}), "-v and -q exclude each other");
  EXPECT_EQ(usage_error({"render", "a.lxs", "--light-sampling", "both"}),
            "--light-sampling both: unknown; choose from mis, lights, bsdf");
  EXPECT_EQ(usage_error({"render", "a.lxs", "--roulette", "of"}),
            "--roulette of: \"of\" is not a number that fits here");
  EXPECT_EQ(usage_error({"render", "a.lxs", "--shadow-roulette", "of"}),
            "--shadow-roulette of: \"of\" is not a number that fits here");
  EXPECT_EQ(usage_error({"render", "a.lxs", "--shadow-roulette", "30"}),
            "--shadow-roulette 30: 30 is not within 0 to 1");
  EXPECT_EQ(usage_error({"render", "a.lxs", "--shadow-roulette", "nan"}),
            "--shadow-roulette nan: nan is not within 0 to 1");
  EXPECT_EQ(usage_error({"render", "a.lxs", "--shadow-roulette", "0"}),
            "--shadow-roulette 0: no shadow ray is below it; give a share above 0, or off");
  EXPECT_NE(usage_error({"render", "a.lxs", "--thread", "2"}).find("did you mean \"--threads\"?"),
            std::string::npos);
  EXPECT_NE(usage_error({"render"}).find("SCENE"), std::string::npos);
  EXPECT_NE(usage_error({}).find("yat render SCENE"), std::string::npos);
}

TEST(Options, HelpListsEveryOptionWithItsDefault) {
  for (const auto& [command, options] :
       {std::pair("render", render_option_texts()), std::pair("info", info_option_texts()),
        std::pair("diff", diff_option_texts())}) {
    const CommandLine line = parse({command, "--help"});
    EXPECT_EQ(line.command, Command::kHelp);
    for (const OptionText& option : options) {
      const std::string name(option.flags.substr(option.flags.find("--")));
      EXPECT_NE(line.text.find(name), std::string::npos) << name;
      EXPECT_NE(line.text.find(option.text), std::string::npos) << name;
      if (!option.fallback.empty()) {
        EXPECT_NE(line.text.find("default: " + std::string(option.fallback)), std::string::npos)
            << name;
      }
      if (option.flags == "-h,--help") continue;
      // What is in the table is known to the parser: without its value it is not "unexpected".
      std::vector<const char*> arguments = {command, "scene.lxs", name.c_str()};
      EXPECT_EQ(usage_error(arguments).find("not expected"), std::string::npos) << name;
    }
  }
}

TEST(Options, DocumentsHoldTheTablesOfTheProgram) {
  const std::string document = read_whole(YAT_SOURCE_DIR "/docs/command-line.md");
  EXPECT_NE(document.find(option_table(render_option_texts())), std::string::npos)
      << "docs/command-line.md must hold this table:\n"
      << option_table(render_option_texts());
  EXPECT_NE(document.find(option_table(info_option_texts())), std::string::npos)
      << "docs/command-line.md must hold this table:\n"
      << option_table(info_option_texts());
  EXPECT_NE(document.find(option_table(diff_option_texts())), std::string::npos)
      << "docs/command-line.md must hold this table:\n"
      << option_table(diff_option_texts());
  EXPECT_NE(read_whole(YAT_SOURCE_DIR "/README.md").find(option_table(render_option_texts())),
            std::string::npos)
      << "README.md must hold this table:\n"
      << option_table(render_option_texts());
}

TEST(Passes, LimitsComeFromTheCommandLineThenTheScene) {
  FilmSettings film;
  EXPECT_EQ(pass_limits({}, film).samples.end, 64u);
  film.halt_spp = 10;
  film.halt_time = 5;
  EXPECT_EQ(pass_limits({}, film).samples.end, 10u);
  EXPECT_EQ(pass_limits({}, film).time_limit, 5);
  Arguments arguments;
  arguments.time_limit = 60;
  EXPECT_TRUE(pass_limits(arguments, film).unlimited);
  EXPECT_EQ(pass_limits(arguments, film).time_limit, 60);
  arguments.samples_per_pixel = 3;
  EXPECT_FALSE(pass_limits(arguments, film).unlimited);
  EXPECT_EQ(pass_limits(arguments, film).samples.end, 3u);
  film.halt_spp = -1;
  EXPECT_TRUE(pass_limits({}, film).unlimited);
  arguments = {};
  arguments.samples_range = SampleRange{4, 6};
  EXPECT_EQ(pass_limits(arguments, film).samples.first, 4u);
  EXPECT_EQ(pass_limits(arguments, film).noise_target, 0);
  EXPECT_EQ(pass_limits(arguments, film).time_limit, 0);
}

TEST(Passes, ANoiseTargetOutranksTheSceneAndKeepsTheBounds) {
  FilmSettings film;
  film.halt_spp = 10;
  film.halt_time = 5;
  Arguments arguments;
  arguments.noise_target = .01;
  EXPECT_EQ(pass_limits(arguments, film).noise_target, .01);
  EXPECT_TRUE(pass_limits(arguments, film).unlimited);
  EXPECT_EQ(pass_limits(arguments, film).time_limit, 0);
  arguments.samples_per_pixel = 12;
  arguments.time_limit = 3;
  EXPECT_EQ(pass_limits(arguments, film).samples.end, 12u);
  EXPECT_EQ(pass_limits(arguments, film).time_limit, 3);
}

TEST(Passes, SizesArePowersOfTwoThatCoverTheRangeOnce) {
  for (const uint64_t pixels : {1ull, 100ull, 518400ull, 50000000ull})
    for (const uint32_t first : {0u, 5u})
      for (const uint32_t count : {1u, 2u, 3u, 16u, 100u, 1000u}) {
        PassLimits limits;
        limits.samples = {first, first + count};
        uint32_t at = first;
        while (at < limits.samples.end) {
          const uint32_t size = next_pass_size(limits, at, pixels, 1);
          ASSERT_GT(size, 0u);
          ASSERT_LE(size, limits.samples.end - at);
          if (at + size < limits.samples.end) {
            EXPECT_EQ(size & (size - 1), 0u);
          }
          at += size;
        }
        EXPECT_EQ(at, limits.samples.end);
      }
}

TEST(Passes, TheFirstPassIsShortWhereTheTimeIsLimited) {
  PassLimits limits;
  limits.samples = {0, 1u << 30};
  limits.unlimited = true;
  limits.time_limit = 10;
  EXPECT_EQ(next_pass_size(limits, 0, 100, 0), 1u);
  // 8 samples took 4 s: 12 more fit into the 6 s that are left, 8 is a power of two.
  EXPECT_EQ(next_pass_size(limits, 8, 100, 4), 8u);
  // 8 samples took 8 s: 2 fit.
  EXPECT_EQ(next_pass_size(limits, 8, 100, 8), 2u);
  EXPECT_EQ(next_pass_size(limits, 8, 100, 9.99), 1u);
  limits.time_limit = 0;
  limits.samples = {0, 16};
  limits.unlimited = false;
  EXPECT_EQ(next_pass_size(limits, 0, 960 * 540, 0), 16u);
}

TEST(Progress, NumbersAreShort) {
  EXPECT_EQ(short_number(0), "0");
  EXPECT_EQ(short_number(12), "12");
  EXPECT_EQ(short_number(999), "999");
  EXPECT_EQ(short_number(999.6), "1.00 k");
  EXPECT_EQ(short_number(12345), "12.3 k");
  EXPECT_EQ(short_number(8294400), "8.29 M");
  EXPECT_EQ(short_number(999999999), "1.00 G");
  EXPECT_EQ(short_time(3.14), "3.1 s");
  EXPECT_EQ(short_time(59.96), "1 min 00 s");
  EXPECT_EQ(short_time(185), "3 min 05 s");
  EXPECT_EQ(short_time(3725), "1 h 02 min");
}

TEST(Progress, SaysHowFarAndHowLong) {
  ProgressState state;
  state.seconds = 2;
  state.samples_done = 2500000;
  state.samples_total = 10000000;
  state.rays = 20000000;
  EXPECT_DOUBLE_EQ(state.share(), .25);
  EXPECT_DOUBLE_EQ(state.seconds_left(), 6);
  EXPECT_EQ(progress_line(state), " 25 %  2.50 M/10.0 M samples, 10.0 Mrays/s, 6.0 s left");
  EXPECT_EQ(progress_bar(state, 200),
            "[##########" + std::string(30, ' ') +
                "]  25 %  2.50 M/10.0 M samples, 10.0 Mrays/s, 6.0 s left");
  for (uint32_t columns = 1; columns < 120; ++columns)
    EXPECT_LT(progress_bar(state, columns).size(), std::max(columns, 2u));
  state.samples_total = 0;
  state.time_limit = 8;
  EXPECT_DOUBLE_EQ(state.share(), .25);
  EXPECT_DOUBLE_EQ(state.seconds_left(), 6);
  const auto json = nlohmann::json::parse(progress_json(state, "progress"));
  EXPECT_EQ(json["event"], "progress");
  EXPECT_EQ(json["samples_done"], 2500000);
  EXPECT_TRUE(json["samples_total"].is_null());
  EXPECT_EQ(json["rays_per_second"], 10000000);
}

RenderReport report_with_drops() {
  RenderReport report;
  report.scene = "room.lxs";
  report.isa = "avx2";
  report.threads = 2;
  report.film.width = 960;
  report.film.height = 540;
  report.film.crop_x1 = 960;
  report.film.crop_y1 = 540;
  report.transport.seed = 7;
  report.transport.max_depth = 10;
  report.samples = 960 * 540 * 4;
  report.time.render = 2;
  report.totals.stats.paths = report.samples;
  report.totals.stats.camera_rays = report.samples;
  report.totals.stats.bounce_rays = 4000000;
  auto& shade = report.totals.stats.stages[uint32_t(Stage::kShade)];
  shade = {10, 1000, 900, 1000, 5000};
  report.totals.stats.stages[uint32_t(Stage::kIntersect)] = {10, 1000, 800, 1000, 15000};
  report.totals.drops.add(DropCause::kPdf, 13u << 16 | 901u, 3);
  report.totals.trace.push_back({Stage::kShade, 1, 1000, 3000, 64});
  return report;
}

TEST(Report, SummaryTellsTimesRaysLanesAndDrops) {
  const std::string text = summary_text(report_with_drops(), Verbosity::kNormal);
  EXPECT_NE(
      text.find(
          "room.lxs: 960x540, 4 samples per pixel, path, depth 10, sobol, seed 7, avx2, 2 threads"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("2.07 M (1.04 Mpaths/s)"), std::string::npos) << text;
  EXPECT_NE(text.find("6.07 M (3.04 Mrays/s): camera 2.07 M, bounce 4.00 M, shadow 0"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("  25.0 %      5.00   90.0 %    1.00 k"), std::string::npos) << text;
  EXPECT_NE(text.find("dropped 1 contributions that were not finite or negative: pdf 1"),
            std::string::npos)
      << text;
}

TEST(Report, ReplayCropsToTheVeryPixel) {
  for (const uint32_t width : {1u, 3u, 960u, 1921u, 65535u})
    for (const uint32_t x : {0u, 1u, width / 2, width - 1}) {
      if (x >= width) continue;
      RenderReport report = report_with_drops();
      report.film.width = width;
      report.totals.drops = {};
      report.totals.drops.add(DropCause::kPdf, 13u << 16 | x, 3);
      const std::string command = replay_commands(report).at(0);
      // As the command line and the film read it: floats, first = ceil(w x0), end = ceil(w x1).
      const std::string crop = command.substr(command.find("--crop ") + 7);
      const float x0 = std::stof(crop), x1 = std::stof(crop.substr(crop.find(',') + 1));
      EXPECT_EQ(std::ceil(float(width) * x0), float(x)) << command;
      EXPECT_EQ(std::ceil(float(width) * x1), float(x + 1)) << command;
      EXPECT_NE(command.find("--samples-range 3,4"), std::string::npos);
      EXPECT_NE(command.find("--compat luxrender --colour bands --seed 7"), std::string::npos);
      EXPECT_EQ(command.find("--light"), std::string::npos);
    }
}

TEST(Report, ReplayNamesWhatIsNotAsUsual) {
  RenderReport report = report_with_drops();
  report.light_choice = LightChoosing::kTree;
  report.light_sampling = LightSampling::kBsdf;
  report.transport.roulette_depth = kNoRoulette;
  report.shadow_roulette = .3;
  EXPECT_NE(replay_commands(report).at(0).find(" --light-choice tree --light-sampling bsdf "
                                               "--roulette off --shadow-roulette 0.3 "),
            std::string::npos);
  report.transport.roulette_depth = 5;
  EXPECT_NE(replay_commands(report).at(0).find(" --roulette 5 "), std::string::npos);
}

// Read as a command line, it asks for what the render was asked for.
TEST(Report, ReplayIsReadAsTheSameSettings) {
  RenderReport report = report_with_drops();
  report.tree = TreeChoice::kKd;
  report.instances = InstanceMode::kShare;
  report.image_bytes = uint64_t(12) << 20;
  report.compensation = EnergyCompensation::kOn;
  report.light_choice = LightChoosing::kUniform;
  report.light_sampling = LightSampling::kLights;
  report.transport.roulette_depth = 3;
  report.shadow_roulette = .7;
  std::istringstream command(replay_commands(report).at(0));
  const std::vector<std::string> words{std::istream_iterator<std::string>(command), {}};
  std::vector<const char*> argv;
  for (const std::string& word : words) argv.push_back(word.c_str());
  const Arguments read = parse_command_line(int(argv.size()), argv.data()).arguments;
  EXPECT_EQ(read.scene, report.scene);
  EXPECT_EQ(read.tree, report.tree);
  EXPECT_EQ(read.instances, report.instances);
  EXPECT_EQ(read.image_bytes, report.image_bytes);
  EXPECT_EQ(read.compensation, report.compensation);
  EXPECT_EQ(read.light_choice, report.light_choice);
  EXPECT_EQ(read.light_sampling, report.light_sampling);
  EXPECT_EQ(read.roulette_depth, report.transport.roulette_depth);
  EXPECT_EQ(read.shadow_roulette, report.shadow_roulette);
  EXPECT_EQ(read.integrator, report.integrator);
  EXPECT_EQ(read.max_depth, report.transport.max_depth);
  EXPECT_EQ(read.sampler, report.sampler);
  EXPECT_EQ(read.colour, report.colour);
  EXPECT_EQ(read.dialect, report.dialect);
  EXPECT_EQ(read.seed, report.transport.seed);
  EXPECT_EQ(read.isa, report.isa);
}

TEST(Report, StatsAreTheRecordOfABenchmark) {
  const auto json = nlohmann::json::parse(stats_json(report_with_drops()));
  for (const char* key :
       {"scene", "scene_hash", "commit", "version", "build", "machine", "seed", "spp", "resolution",
        "settings", "time", "cpu_time", "peak_rss", "rays", "lanes", "stages", "dropped"})
    EXPECT_TRUE(json.contains(key)) << key;
  // Scripts are written from the document: it names every field.
  const std::string document = read_whole(YAT_SOURCE_DIR "/docs/profiling.md");
  for (const auto& field : json.items())
    EXPECT_NE(document.find("`" + field.key() + "`"), std::string::npos) << field.key();
  EXPECT_EQ(json["spp"], 4);
  EXPECT_EQ(json["rays"]["bounce"], 4000000);
  EXPECT_EQ(json["dropped"]["pdf"], 1);
  EXPECT_DOUBLE_EQ(json["lanes"][std::string(stage_name(Stage::kShade))].get<double>(), .9);
  EXPECT_GT(json["peak_rss"].get<uint64_t>(), 0u);
  EXPECT_GT(json["machine"]["cores"].get<uint32_t>(), 0u);
}

TEST(Report, TraceHoldsAnEventPerSpan) {
  const auto json = nlohmann::json::parse(trace_json(report_with_drops()));
  uint32_t shade = 0;
  for (const auto& event : json["traceEvents"])
    if (event["name"] == std::string(stage_name(Stage::kShade))) {
      ++shade;
      EXPECT_EQ(event["ph"], "X");
      EXPECT_EQ(event["ts"], 1.0);
      EXPECT_EQ(event["dur"], 2.0);
      EXPECT_EQ(event["args"]["rows"], 64);
    }
  EXPECT_EQ(shade, 1u);
}

}  // namespace
}  // namespace yat

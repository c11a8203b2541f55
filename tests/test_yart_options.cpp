// YART's command line as arguments.

#include "app/yart_options.h"

#include <gtest/gtest.h>

#include <vector>

#include "app/options.h"
#include "base/error.h"

namespace yat {
namespace {

YartArguments parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "yat");
  EXPECT_TRUE(is_yart_command_line(int(arguments.size()), arguments.data()));
  return parse_yart_command_line(int(arguments.size()), arguments.data());
}
std::string trouble(const std::vector<const char*>& arguments) {
  try {
    parse(arguments);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(YartOptions, EveryFlagIsRead) {
  const YartArguments a = parse({"-i", "scene.lxs", "-o", "out.png", "-pathtracer", "-s", "100",
                                 "-tr", "7", "-bs", "32", "-th", "2", "-t", "-hb"});
  EXPECT_EQ(a.scene, "scene.lxs");
  EXPECT_EQ(a.output, "out.png");
  EXPECT_TRUE(a.path_tracer);
  EXPECT_EQ(a.samples, 100u);
  EXPECT_EQ(a.trace_depth, 7u);
  EXPECT_EQ(a.bucket_size, 32u);
  EXPECT_EQ(a.threads, 2u);
  EXPECT_TRUE(a.stamp);
  EXPECT_TRUE(a.heart_beat);
  EXPECT_EQ(a.benchmark, 0u);
  EXPECT_EQ(a.remarks, "");
}

TEST(YartOptions, LongNamesAreTheSame) {
  const YartArguments a =
      parse({"--input", "scene.lxs", "--output=out.exr", "--antialiasing", "9", "--raydepth", "2.7",
             "--threads=3", "--bucketsize", "64", "--time", "--benchmark", "5"});
  EXPECT_EQ(a.output, "out.exr");
  EXPECT_FALSE(a.path_tracer);
  EXPECT_EQ(a.antialiasing, 9u);
  EXPECT_EQ(a.ray_depth, 2u);
  EXPECT_EQ(a.threads, 3u);
  EXPECT_EQ(a.bucket_size, 64u);
  EXPECT_TRUE(a.stamp);
  EXPECT_EQ(a.benchmark, 5u);
  const YartArguments b = parse({"--input", "s.lxs", "-pathtracer", "--samples", "3",
                                 "--trace-depth", "4", "--heart-beat", "-o", "x.png"});
  EXPECT_EQ(b.samples, 3u);
  EXPECT_EQ(b.trace_depth, 4u);
  EXPECT_TRUE(b.heart_beat);
}

TEST(YartOptions, WithoutFlagsItIsTheRayTracerWithFourRaysAPixel) {
  const YartArguments a = parse({"-i", "scene.lxs"});
  EXPECT_FALSE(a.path_tracer);
  EXPECT_EQ(a.antialiasing, 4u);
  EXPECT_FALSE(a.ray_depth);
  EXPECT_EQ(a.bucket_size, 128u);
  EXPECT_EQ(a.threads, 0u);
  EXPECT_EQ(a.remarks, "warning: without -o FILE the picture is not saved");
}

TEST(YartOptions, WhatDoesNothingIsRemarkedOn) {
  // YART's README leaves a word behind "-d 4".
  EXPECT_EQ(parse({"-i", "s.lxs", "-o", "o.png", "-d", "4", "4"}).remarks,
            "warning: 4 belongs to no flag and is ignored");
  EXPECT_EQ(parse({"-i", "s.lxs", "-o", "o.png", "-s", "9"}).remarks,
            "warning: -s counts with -pathtracer only");
  EXPECT_EQ(parse({"-i", "s.lxs", "-o", "o.png", "-pathtracer", "-d", "9"}).remarks,
            "warning: -d does nothing with -pathtracer: -tr is its depth");
  EXPECT_EQ(parse({"-i", "s.lxs", "-o", "o.png", "-pathtracer", "-aa", "4"}).remarks,
            "warning: -aa does nothing with -pathtracer: -s is its number of paths");
  const YartArguments quiet = parse({"-i", "s.lxs", "-o", "o.png", "-hb", "-b", "2"});
  EXPECT_FALSE(quiet.heart_beat);
  EXPECT_EQ(quiet.remarks, "warning: -hb does nothing with -b");
  EXPECT_EQ(parse({"-i", "s.lxs", "-o", "o.png", "-g"}).remarks,
            "warning: -g: the window comes with a later version, the picture goes to -o alone");
}

TEST(YartOptions, MistakesNameTheFlag) {
  EXPECT_EQ(trouble({"-o", "out.png"}), "yat: no scene: give -i FILE (yat --help says more)");
  EXPECT_EQ(trouble({"-i", "s.lxs", "-s", "0"}),
            "yat: -s 0: give a whole number from 1 to 1048576");
  EXPECT_EQ(trouble({"-i", "s.lxs", "-th", "two"}),
            "yat: -th two: give a whole number from 1 to 4096");
  EXPECT_EQ(trouble({"-i", "s.lxs", "-d", "-1"}), "yat: -d -1: give a number above 0");
  EXPECT_EQ(trouble({"-i", "s.lxs", "-b"}), "yat: -b: its value is missing: -b N");
  EXPECT_EQ(trouble({"-i", "s.lxs", "-i", "t.lxs"}), "yat: -i is given twice, leave one out");
  EXPECT_EQ(trouble({"-i", "s.lxs", "-g", "-b", "2"}), "yat: -g and -b exclude each other");
  EXPECT_EQ(trouble({"-i", "s.lxs", "-t=3"}), "yat: -t=3: this flag has no value");
  EXPECT_NE(trouble({"-i", "s.lxs", "--sample", "3"}).find("did you mean \"--samples\"?"),
            std::string::npos);
}

TEST(YartOptions, OnlyItsFlagsWithoutACommandMakeItYarts) {
  const auto is = [](std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "yat");
    return is_yart_command_line(int(arguments.size()), arguments.data());
  };
  EXPECT_TRUE(is({"-pathtracer", "-i", "s.lxs"}));
  EXPECT_FALSE(is({"render", "s.lxs", "-o", "out.png"}));
  EXPECT_FALSE(is({"--version"}));
  EXPECT_FALSE(is({"--help"}));
  EXPECT_FALSE(is({}));
  std::vector<const char*> help{"yat", "-i", "s.lxs", "-h"};
  const CommandLine line = parse_command_line(4, help.data());
  EXPECT_EQ(line.command, Command::kHelp);
  for (const char* flag : {"-i, --input", "-pathtracer", "-tr, --trace-depth", "-hb, --heart-beat"})
    EXPECT_NE(line.text.find(flag), std::string::npos) << flag;
}

TEST(YartOptions, TimesAreYarts) {
  EXPECT_EQ(yart_time(1.234), "1234ms");
  EXPECT_EQ(yart_time(5), "5000ms");
  EXPECT_EQ(yart_time(5.001), "5.001s");
  EXPECT_EQ(yart_time(62.345), "1m2.345s");
  EXPECT_EQ(yart_time(60.5), "1m0.5s");
  EXPECT_EQ(yart_time(3603), "1h0m3s");
}

}  // namespace
}  // namespace yat

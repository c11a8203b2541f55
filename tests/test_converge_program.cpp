// yat converge as people run it.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "metrics/image.h"
#include "run_program.h"

namespace yat {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// A square light over a floor.
constexpr std::string_view kScene = R"(LookAt 0 -3 1  0 0 0  0 0 1
Camera "perspective" "float fov" [45]
Film "fleximage" "integer xresolution" [16] "integer yresolution" [12]
SurfaceIntegrator "path" "integer maxdepth" [2]
WorldBegin
AttributeBegin
AreaLightSource "area" "color L" [5 5 5]
Shape "trianglemesh" "integer indices" [0 2 1 0 3 2] "point P" [-1 -1 2  1 -1 2  1 1 2  -1 1 2]
AttributeEnd
Material "matte" "color Kd" [0.5 0.5 0.5]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point P" [-2 -2 0  2 -2 0  2 2 0  -2 2 0]
WorldEnd
)";

class Converge : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = empty_folder("converge_program");
    write_whole(folder_ / "scene.lxs", kScene);
  }
  std::vector<std::string> command(std::vector<std::string> arguments) const {
    std::vector<std::string> words = {YAT_PROGRAM, "converge", "scene.lxs", "--threads", "1"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return words;
  }
  ProgramResult converge(std::vector<std::string> arguments) const {
    return run_program(command(std::move(arguments)), folder_);
  }
  Json report(const char* name = "out") const {
    return Json::parse(read_whole(folder_ / name / "report.json"));
  }
  fs::path folder_;
};

TEST_F(Converge, ComparesVariantsAndGoesOnWhereItWas) {
  const std::vector<std::string> two = {"-o",        "out",
                                        "--ladder",  "4,16",
                                        "--runs",    "4",
                                        "--variant", "independent: --sampler independent",
                                        "--variant", "sobol: --sampler sobol"};
  const ProgramResult first = converge(two);
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_NE(first.out.find("TTUV ratio"), std::string::npos) << first.out;
  const Json all = report();
  ASSERT_EQ(all["runs"].size(), 2 * 2 * 4u);
  // Interleaved within each seed and rung.
  EXPECT_EQ(all["runs"][0]["variant"], "independent");
  EXPECT_EQ(all["runs"][1]["variant"], "sobol");
  EXPECT_EQ(all["runs"][0]["seed"], all["runs"][1]["seed"]);
  EXPECT_NE(all["runs"][0]["seed"], all["runs"][2]["seed"]);
  for (const char* key : {"scene", "scene_hash", "commit", "build", "machine", "seed", "spp",
                          "resolution", "settings", "time", "cpu_time", "peak_rss", "rays", "lanes",
                          "stages", "dropped", "error", "reference", "ttuv"})
    EXPECT_TRUE(all["runs"][0].contains(key)) << key;
  for (const Json& run : all["runs"]) {
    EXPECT_GT(run["error"]["flip"], 0);
    EXPECT_GT(run["time"]["write"], 0);
    // Every path meets floor or lamp at most once; what is sampled shows a light or is skipped.
    const Json& rays = run["rays"];
    EXPECT_EQ(int(rays["shadow"]) + int(rays["skipped_shadow"]),
              run["stages"]["sample_lights"]["items"]);
    EXPECT_GT(rays["skipped_shadow"], 0);
    // A ray of 7 words in, a hit of 4 out.
    EXPECT_EQ(run["stages"]["intersect"]["bytes"], 44 * int(run["stages"]["intersect"]["items"]));
  }
  EXPECT_EQ(all["runs"][0]["reference"]["spp"], 64 * 16);
  EXPECT_GT(all["runs"][0]["time"]["render"], 0);
  // On a smooth picture the sobol sampler needs less, and more so the more samples there are.
  const Json& sobol = all["summary"]["variants"][1];
  EXPECT_LT(sobol["rungs"][1]["mse"]["value"],
            .7 * double(all["summary"]["variants"][0]["rungs"][1]["mse"]["value"]));
  EXPECT_LT(double(sobol["slope"]["value"]), -.6);
  EXPECT_TRUE(fs::exists(folder_ / "out" / "reference.exr"));
  // The page needs nothing from elsewhere.
  const std::string page = read_whole(folder_ / "out" / "report.html");
  EXPECT_NE(page.find("At equal CPU time"), std::string::npos);
  EXPECT_EQ(page.find("src=\"http"), std::string::npos);
  EXPECT_EQ(page.find("<link"), std::string::npos);
  EXPECT_TRUE(read_whole(folder_ / "out" / "error-time.svg").starts_with("<svg xmlns="));

  // Again: nothing is measured, and the same is said. More runs: only those.
  const ProgramResult again = converge(two);
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(again.out, first.out);
  std::vector<std::string> more = two;
  more[5] = "5";
  ASSERT_EQ(converge(more).code, 0);
  const Json longer = report();
  ASSERT_EQ(longer["runs"].size(), 2 * 2 * 5u);
  for (size_t i = 0; i < 16; ++i) EXPECT_EQ(longer["runs"][i], all["runs"][i]);

  // Another experiment does not get into the folder by mistake.
  std::vector<std::string> other = two;
  other[9] = "sobol: --sampler sobol --max-depth 1";
  const ProgramResult refused = converge(other);
  EXPECT_EQ(refused.code, 1);
  EXPECT_NE(refused.err.find("--restart"), std::string::npos) << refused.err;
  other.push_back("--restart");
  EXPECT_EQ(converge(other).code, 0);
  EXPECT_EQ(report()["runs"].size(), 16u);
}

// A noise target decides by itself how many samples it takes: one point beside the ladder.
TEST_F(Converge, NoiseTargetsAreVariants) {
  const std::vector<std::string> words = {"-o",        "out",
                                          "--ladder",  "4,64",
                                          "--runs",    "4",
                                          "--variant", "plain:",
                                          "--variant", "target: --noise-target .02",
                                          "--variant", "weighed: --noise-target .02 --adaptive on"};
  const ProgramResult first = converge(words);
  ASSERT_EQ(first.code, 0) << first.err;
  const Json all = report();
  ASSERT_EQ(all["runs"].size(), 4 * (2 + 1 + 1u));
  std::vector<double> samples;
  for (const Json& run : all["runs"]) {
    EXPECT_EQ(run.contains("noise"), run["variant"] != "plain");
    if (run["variant"] == "plain") continue;
    EXPECT_EQ(run["spp"], 0);
    EXPECT_EQ(run["noise"]["target"], .02);
    EXPECT_EQ(run["noise"]["reached"], true);
    EXPECT_EQ(run["noise"]["adaptive"], run["variant"] == "weighed");
    // What it says of itself is true: its estimate is on the safe side.
    EXPECT_LT(run["error"]["relmse"], .02);
    EXPECT_GT(run["error"]["relmse"], .02 / 20);
    samples.push_back(run["samples_per_pixel"]);
  }
  const Json& target = all["summary"]["variants"][1];
  ASSERT_EQ(target["rungs"].size(), 1u);
  EXPECT_GT(target["rungs"][0]["samples_per_pixel"], 4);
  EXPECT_TRUE(target["slope"]["value"].is_null());
  EXPECT_GT(target["rungs"][0]["ttuv_cpu_ratio"]["value"], 0);
  EXPECT_EQ(target["bias"]["pixels"], 16 * 12);
  // What is there is found again.
  const ProgramResult again = converge(words);
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(again.out, first.out);
  EXPECT_EQ(report()["runs"], all["runs"]);
}

// The picture that is made is the runs' truth: their mean comes to it.
TEST_F(Converge, TheReferenceIsOfOtherSeedsAndKnowsItsVariance) {
  ASSERT_EQ(converge({"-o", "out", "--ladder", "16", "--runs", "8"}).code, 0);
  const Json all = report();
  const Json& v = all["summary"]["variants"][0];
  EXPECT_LT(std::abs(double(v["bias"]["z"])), 4);
  EXPECT_LE(int(v["bias"]["pixels_beyond"]), 1);
  EXPECT_GT(double(all["summary"]["reference_variance"]), 0);
  EXPECT_LT(double(v["rungs"][0]["reference_share"]), .05);

  // The same picture given: the same errors, apart from its rounding to floats.
  const fs::path file = folder_ / "out" / "reference.exr";
  ASSERT_EQ(converge({"-o", "given", "--ladder", "16", "--runs", "8", "--reference", file}).code,
            0);
  const Json given = report("given");
  for (size_t i = 0; i < 8; ++i)
    EXPECT_NEAR(double(given["runs"][i]["error"]["mse"]) / double(all["runs"][i]["error"]["mse"]),
                1, 1e-6);
  EXPECT_NEAR(
      double(given["summary"]["reference_variance"]) / double(all["summary"]["reference_variance"]),
      1, 1e-5);
}

TEST_F(Converge, RefusesReferencesThatAreNone) {
  const std::vector<std::string> base = {"-o", "out", "--ladder", "4", "--runs", "2"};
  const auto with = [&](const char* file) {
    std::vector<std::string> words = base;
    words.insert(words.end(), {"--reference", file});
    return converge(words);
  };
  ProgramResult r = with("none.exr");
  EXPECT_EQ(r.code, 1);
  EXPECT_NE(r.err.find("none.exr: error: cannot be read"), std::string::npos) << r.err;
  ASSERT_EQ(run_program({YAT_PROGRAM, "render", "scene.lxs", "--resolution", "8x8", "-o",
                         "small.exr", "-o", "grey.png", "--spp", "4"},
                        folder_)
                .code,
            0);
  r = with("small.exr");
  EXPECT_EQ(r.code, 1);
  EXPECT_NE(r.err.find("8 x 8 pixels, but the runs have 16 x 12"), std::string::npos) << r.err;
  r = with("grey.png");
  EXPECT_EQ(r.code, 1);
  EXPECT_NE(r.err.find("not radiance"), std::string::npos) << r.err;
  // A run is never its own reference.
  ASSERT_EQ(converge(base).code, 0);
  const std::string seed = std::to_string(uint32_t(report()["runs"][1]["seed"]));
  ASSERT_EQ(run_program(
                {YAT_PROGRAM, "render", "scene.lxs", "--seed", seed, "-o", "run.exr", "--spp", "4"},
                folder_)
                .code,
            0);
  r = with("run.exr");
  EXPECT_EQ(r.code, 1);
  EXPECT_NE(r.err.find("never its own reference"), std::string::npos) << r.err;
}

// A reference without variance says so; rungs between powers of two too.
TEST_F(Converge, SaysWhatIsAssumed) {
  ASSERT_EQ(run_program({YAT_PROGRAM, "render", "scene.lxs", "--seed", "99", "-o", "r.exr", "--spp",
                         "1024"},
                        folder_)
                .code,
            0);
  const ProgramResult r = converge({"-o", "out", "--ladder", "3,16", "--runs", "3", "--reference",
                                    "r.exr", "--sampler", "sobol"});
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_NE(r.out.find("counts as exact"), std::string::npos) << r.out;
  EXPECT_NE(r.err.find("3 samples are no power of two"), std::string::npos) << r.err;
}

// No run of 64 samples fits into a nanosecond; the lowest rung is measured all the same.
TEST_F(Converge, RungsThatTakeTooLongAreLeftOut) {
  const std::vector<std::string> words = {"-o",     "out", "--ladder",       "4,64",
                                          "--runs", "3",   "--time-per-run", "1e-9"};
  ASSERT_EQ(converge(words).code, 0);
  const Json all = report();
  EXPECT_EQ(all["runs"].size(), 3u);
  EXPECT_EQ(all["summary"]["variants"][0]["headline_spp"], 4);
  // The rung that is the highest then is the one that is tested for bias.
  EXPECT_EQ(all["summary"]["variants"][0]["bias"]["pixels"], 16 * 12);
  std::vector<std::string> longer = words;
  longer[7] = "60";
  ASSERT_EQ(converge(longer).code, 0);
  const Json more = report();
  EXPECT_EQ(more["runs"].size(), 6u);
  // Pixels are summed up of the rung that is the highest now.
  const auto kept = [&](const std::string& ending) {
    int files = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / "out"))
      files += entry.path().filename().string().ends_with(ending);
    return files;
  };
  EXPECT_EQ(kept("-4.bin"), 1);
  EXPECT_EQ(kept("-64.bin"), 1);
  EXPECT_EQ(more["summary"]["variants"][0]["bias"]["pixels"], 16 * 12);
}

TEST_F(Converge, AnInterruptKeepsWhatIsFinished) {
  const std::vector<std::string> words = {"-o",  "out",         "--ladder", "4,4096", "--runs",
                                          "200", "--reference", "r.exr",    "-v"};
  ASSERT_EQ(run_program(
                {YAT_PROGRAM, "render", "scene.lxs", "--seed", "99", "-o", "r.exr", "--spp", "256"},
                folder_)
                .code,
            0);
  RunningProgram program(command(words), folder_);
  ASSERT_TRUE(program.wait_for("4096 spp, run 1"));
  program.signal(SIGINT);
  const ProgramResult stopped = program.wait();
  EXPECT_EQ(stopped.code, 130) << stopped.err;
  EXPECT_NE(stopped.err.find("goes on from there"), std::string::npos) << stopped.err;
  const Json all = report();
  EXPECT_GE(all["runs"].size(), 4u);
  EXPECT_LT(all["runs"].size(), 400u);
  // What is there is not measured again.
  std::vector<std::string> rest = words;
  rest[5] = "2";
  ASSERT_EQ(converge(rest).code, 0);
  const Json done = report();
  EXPECT_GE(done["runs"].size(), all["runs"].size());
  for (size_t i = 0; i < all["runs"].size(); ++i) EXPECT_EQ(done["runs"][i], all["runs"][i]);
}

}  // namespace
}  // namespace yat

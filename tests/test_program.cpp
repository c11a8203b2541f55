// The program as people run it: exit codes, messages, files.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "run_program.h"

namespace yat {
namespace {

namespace fs = std::filesystem;

// A square light over a floor, of nothing but the simplest statements.
constexpr std::string_view kScene = R"(LookAt 0 -3 1  0 0 0  0 0 1
Camera "perspective" "float fov" [45]
Film "fleximage" "integer xresolution" [32] "integer yresolution" [24] "string filename" ["tiny"]
SurfaceIntegrator "path" "integer maxdepth" [4]
WorldBegin
AttributeBegin
AreaLightSource "area" "color L" [5 5 5]
Shape "trianglemesh" "integer indices" [0 2 1 0 3 2] "point P" [-1 -1 2  1 -1 2  1 1 2  -1 1 2]
AttributeEnd
Material "matte" "color Kd" [0.5 0.5 0.5]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point P" [-2 -2 0  2 -2 0  2 2 0  -2 2 0]
WorldEnd
)";

class Program : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = empty_folder("program");
    write_whole(folder_ / "scene.lxs", kScene);
  }
  std::vector<std::string> command(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), YAT_PROGRAM);
    return arguments;
  }
  ProgramResult yat(std::vector<std::string> arguments) const {
    return run_program(command(std::move(arguments)), folder_);
  }
  bool has(const char* file) const { return fs::exists(folder_ / file); }

  fs::path folder_;
};

TEST_F(Program, DiffSaysByItsExitCodeWhatDiffers) {
  ASSERT_EQ(yat({"render", "scene.lxs", "--spp", "4", "-o", "a.exr", "-o", "a.png"}).code, 0);
  ASSERT_EQ(yat({"render", "scene.lxs", "--spp", "4", "--seed", "1", "-o", "b.exr"}).code, 0);
  const ProgramResult same = yat({"diff", "a.exr", "a.exr", "--fail", "0"});
  EXPECT_EQ(same.code, 0);
  EXPECT_NE(same.out.find("MSE               0\n"), std::string::npos) << same.out;
  EXPECT_NE(same.out.find("PASS\n"), std::string::npos) << same.out;
  // Without thresholds figures are all there is.
  const ProgramResult shown = yat({"diff", "a.exr", "b.exr"});
  EXPECT_EQ(shown.code, 0);
  EXPECT_EQ(shown.out.find("PASS"), std::string::npos);
  EXPECT_NE(shown.out.find("HDR-FLIP"), std::string::npos) << shown.out;
  EXPECT_EQ(yat({"diff", "a.exr", "b.exr", "--fail", "1e-6"}).code, 4);
  EXPECT_EQ(yat({"diff", "a.exr", "b.exr", "--fail", "1e6"}).code, 0);
  EXPECT_EQ(yat({"diff", "a.exr", "b.exr", "--warn", "1e-6", "--fail", "1e6"}).code, 5);
  EXPECT_EQ(yat({"diff", "a.exr", "b.exr", "--failpercent", "100", "--hardfail", "1e-6"}).code, 4);
  EXPECT_EQ(yat({"diff", "a.exr", "b.exr", "--failrelmse", "1e-9"}).code, 4);
  EXPECT_EQ(yat({"diff", "a.exr", "b.exr", "--failflip", "1"}).code, 0);
  ASSERT_EQ(yat({"diff", "a.exr", "b.exr", "-o", "map.exr"}).code, 0);
  EXPECT_TRUE(has("map.exr"));
  const ProgramResult display = yat({"diff", "a.png", "a.png"});
  EXPECT_NE(display.out.find("display values"), std::string::npos) << display.out;
  EXPECT_EQ(display.out.find("HDR-FLIP"), std::string::npos) << display.out;
  const ProgramResult missing = yat({"diff", "a.exr", "none.exr"});
  EXPECT_EQ(missing.code, 1);
  EXPECT_EQ(missing.err.rfind("none.exr: error: ", 0), 0u) << missing.err;
  EXPECT_EQ(yat({"diff", "a.exr"}).code, 2);
  EXPECT_EQ(yat({"diff", "a.exr", "b.exr", "--fail", "-1"}).code, 2);
}

TEST_F(Program, VersionAndHelpGoToStandardOutput) {
  const ProgramResult version = yat({"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(version.out.rfind("yat " YAT_VERSION " (", 0), 0u) << version.out;
  EXPECT_EQ(version.err, "");
  for (const auto& arguments :
       {std::vector<std::string>{"--help"}, {"render", "--help"}, {"info", "-h"}}) {
    const ProgramResult help = yat(arguments);
    EXPECT_EQ(help.code, 0);
    EXPECT_EQ(help.out.rfind("Usage: yat ", 0), 0u) << help.out;
    EXPECT_EQ(help.err, "");
  }
}

TEST_F(Program, BadUsageIsCodeTwo) {
  EXPECT_EQ(yat({}).code, 2);
  EXPECT_EQ(yat({"paint", "scene.lxs"}).code, 2);
  EXPECT_EQ(yat({"render"}).code, 2);
  const ProgramResult option = yat({"render", "scene.lxs", "--sppp", "4"});
  EXPECT_EQ(option.code, 2);
  EXPECT_NE(option.err.find("did you mean \"--spp\"?"), std::string::npos) << option.err;
  const ProgramResult picture = yat({"render", "scene.lxs", "-o", "picture.gif"});
  EXPECT_EQ(picture.code, 2);
  EXPECT_EQ(picture.err,
            "yat: -o picture.gif: unknown kind of picture; choose .png, .exr or .jpg\n");
  const ProgramResult isa = yat({"render", "scene.lxs", "--isa", "mmx"});
  EXPECT_EQ(isa.code, 2);
  EXPECT_NE(isa.err.find("--isa mmx: no such instruction set in this build; choose from"),
            std::string::npos)
      << isa.err;
}

TEST_F(Program, AMissingSceneIsCodeOneAndNamed) {
  for (const char* verb : {"render", "info"}) {
    const ProgramResult missing = yat({verb, "missing.lxs"});
    EXPECT_EQ(missing.code, 1);
    EXPECT_NE(missing.err.find("missing.lxs"), std::string::npos) << missing.err;
    EXPECT_NE(missing.err.find("error: "), std::string::npos) << missing.err;
    EXPECT_EQ(std::count(missing.err.begin(), missing.err.end(), '\n'), 1) << missing.err;
  }
}

TEST_F(Program, ASyntaxErrorIsCodeOneWithItsPlace) {
  write_whole(folder_ / "bad.lxs",
              "LookAt 0 0 0  0 0 1  0 1 0\nWorldBegin\nShape \"sphere\" \"float radius [1]\n");
  const ProgramResult bad = yat({"render", "bad.lxs"});
  EXPECT_EQ(bad.code, 1);
  EXPECT_NE(bad.err.find("bad.lxs:3:"), std::string::npos) << bad.err;
  EXPECT_NE(bad.err.find(": error: "), std::string::npos) << bad.err;
}

TEST_F(Program, AnEmptySceneMakesNoPicture) {
  write_whole(folder_ / "empty.lxs", "WorldBegin\nWorldEnd\n");
  const ProgramResult empty = yat({"render", "empty.lxs", "-o", "empty.png"});
  EXPECT_EQ(empty.code, 1);
  EXPECT_NE(empty.err.find("error: "), std::string::npos) << empty.err;
  EXPECT_FALSE(has("empty.png"));
}

TEST_F(Program, AnUnwritablePlaceIsCodeThreeBeforeRendering) {
  write_whole(folder_ / "file", "");
  const ProgramResult result = yat({"render", "scene.lxs", "-o", "file/picture.png"});
  EXPECT_EQ(result.code, 3);
  EXPECT_NE(result.err.find("file/picture.png: cannot write: "), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("Mrays"), std::string::npos) << "rendered first: " << result.err;
  EXPECT_EQ(yat({"render", "scene.lxs", "--stats", "file/stats.json"}).code, 3);
}

// A limit on the length of files stands for a full disk: both fail in the middle of a write.
TEST_F(Program, AFullDiskLeavesNoHalfPicture) {
  struct LimitedFiles {
    rlimit before{};
    LimitedFiles() {
      getrlimit(RLIMIT_FSIZE, &before);
      rlimit limited = before;
      limited.rlim_cur = 1200;
      setrlimit(RLIMIT_FSIZE, &limited);
    }
    ~LimitedFiles() { setrlimit(RLIMIT_FSIZE, &before); }
  };
  for (const char* file : {"full.png", "full.exr", "full.jpg"}) {
    write_whole(folder_ / file, "old");
    const ProgramResult result = [&] {
      const LimitedFiles limited;
      return yat({"render", "scene.lxs", "--spp", "1", "-q", "-o", file});
    }();
    EXPECT_EQ(result.code, 3) << file;
    EXPECT_EQ(result.err, std::string("error: ") + file + ": cannot write: File too large\n");
    EXPECT_EQ(read_whole(folder_ / file), "old");
  }
  for (const auto& entry : fs::directory_iterator(folder_))
    EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
}

// A rename onto a device or a pipe would put a file in its place.
TEST_F(Program, SpecialFilesAndLinksStayWhatTheyAre) {
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  const int pipe = open((folder_ / "pipe").c_str(), O_RDWR | O_NONBLOCK);
  ASSERT_GE(pipe, 0);
  const ProgramResult piped =
      yat({"render", "scene.lxs", "--spp", "1", "-q", "-o", "p.png", "--stats", "pipe"});
  EXPECT_EQ(piped.code, 0) << piped.err;
  EXPECT_TRUE(fs::is_fifo(folder_ / "pipe"));
  char first = 0;
  EXPECT_EQ(read(pipe, &first, 1), 1);
  EXPECT_EQ(first, '{');
  close(pipe);
  fs::create_directories(folder_ / "real");
  write_whole(folder_ / "real" / "r.png", "old");
  fs::create_symlink("real/r.png", folder_ / "l.png");
  fs::create_symlink("real/new.png", folder_ / "n.png");
  const ProgramResult linked =
      yat({"render", "scene.lxs", "--spp", "1", "-q", "-o", "l.png", "-o", "n.png"});
  EXPECT_EQ(linked.code, 0) << linked.err;
  EXPECT_TRUE(fs::is_symlink(folder_ / "l.png"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "n.png"));
  EXPECT_GT(fs::file_size(folder_ / "real" / "r.png"), 100u);
  EXPECT_GT(fs::file_size(folder_ / "real" / "new.png"), 100u);
  fs::create_symlink("loop.png", folder_ / "loop.png");
  EXPECT_EQ(yat({"render", "scene.lxs", "-q", "-o", "loop.png"}).code, 3);
}

TEST_F(Program, APictureThatFitsNoMemoryIsCodeThreeAtOnce) {
  const ProgramResult result =
      yat({"render", "scene.lxs", "--resolution", "65535x65535", "-o", "big.exr"});
  EXPECT_EQ(result.code, 3);
  EXPECT_NE(result.err.find("error: out of memory: a picture of 65535 x 65535 pixels needs 429."),
            std::string::npos)
      << result.err;
  EXPECT_NE(result.err.find("use a smaller --resolution"), std::string::npos) << result.err;
}

TEST_F(Program, TooLittleTimeIsNoInterrupt) {
  const ProgramResult result =
      yat({"render", "scene.lxs", "--time", "1e-9", "-o", "t.png", "--progress", "none"});
  EXPECT_EQ(result.code, 3);
  EXPECT_NE(result.err.find("error: the time was up before the first sample"), std::string::npos)
      << result.err;
  EXPECT_FALSE(has("t.png"));
}

TEST_F(Program, LightTooStrongForTheFilmIsCodeOne) {
  std::string scene(kScene);
  scene.replace(scene.find("[5 5 5]"), 7, "[1e30 1e30 1e30] \"float power\" [0]");
  // Looking up into the light: no sample is without it.
  scene.replace(0, scene.find('\n'), "LookAt 0 0 1  0 0 2  0 1 0");
  write_whole(folder_ / "strong.lxs", scene);
  const ProgramResult result = yat({"render", "strong.lxs", "--spp", "1", "-q", "-o", "s.exr"});
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(result.err.rfind("strong.lxs: error: all 768 samples were dropped", 0), 0u)
      << result.err;
  EXPECT_FALSE(has("s.exr"));
}

// A pipe whose reader has gone as standard error: the picture is worth more than the progress.
TEST_F(Program, ALostReaderDoesNotEndARender) {
  const ProgramResult shell = run_program(
      {"/bin/sh", "-c",
       std::string(
           "{ \"$0\" render scene.lxs --spp 4 -o lost.png --progress plain; echo $? > code; "
           "} 2>&1 | true"),
       YAT_PROGRAM},
      folder_);
  EXPECT_EQ(shell.code, 0);
  for (int i = 0; i < 500 && read_whole(folder_ / "code").empty(); ++i) usleep(10000);
  EXPECT_EQ(read_whole(folder_ / "code"), "0\n");
  EXPECT_TRUE(has("lost.png"));
}

TEST_F(Program, WritesEveryPictureAndSaysSo) {
  const ProgramResult result = yat({"render", "scene.lxs", "--spp", "4", "-o", "a.png", "-o",
                                    "b.exr", "-o", "sub/c.jpg", "--progress", "plain"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out, "");
  for (const char* file : {"a.png", "b.exr", "sub/c.jpg"}) {
    EXPECT_TRUE(has(file)) << file;
    EXPECT_NE(result.err.find(std::string("wrote ") + file), std::string::npos) << result.err;
  }
  EXPECT_NE(result.err.find("100 %  3.07 k/3.07 k samples"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("scene.lxs: 32x24, 4 samples per pixel, path, depth 4, sobol, seed 0"),
            std::string::npos)
      << result.err;
  EXPECT_NE(result.err.find("dropped none"), std::string::npos) << result.err;
}

TEST_F(Program, TheFilmNamesThePictureAndQuietSaysNothing) {
  const ProgramResult result = yat({"render", "scene.lxs", "--spp", "1", "-q"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.out + result.err, "");
  EXPECT_TRUE(has("tiny.png"));
}

TEST_F(Program, StatsTraceAndJsonProgressAreJson) {
  const ProgramResult result =
      yat({"render", "scene.lxs", "--spp", "8", "--stats", "stats.json", "--trace", "trace.json",
           "--progress", "json", "-q", "--seed", "3", "--threads", "2"});
  ASSERT_EQ(result.code, 0) << result.err;
  const auto progress = nlohmann::json::parse(result.err.substr(result.err.rfind('{')));
  EXPECT_EQ(progress["event"], "done");
  EXPECT_EQ(progress["samples_done"], 32 * 24 * 8);
  const auto stats = nlohmann::json::parse(read_whole(folder_ / "stats.json"));
  EXPECT_EQ(stats["spp"], 8);
  EXPECT_EQ(stats["seed"], 3);
  EXPECT_EQ(stats["rays"]["camera"], 32 * 24 * 8);
  EXPECT_GT(stats["rays"]["shadow"], 0);
  EXPECT_EQ(stats["machine"]["threads"], 2);
  EXPECT_FALSE(stats["interrupted"]);
  const auto trace = nlohmann::json::parse(read_whole(folder_ / "trace.json"));
  bool intersect = false;
  for (const auto& event : trace["traceEvents"]) intersect |= event["name"] == "intersect";
  EXPECT_TRUE(intersect);
}

TEST_F(Program, CropAndSampleRangeRenderJustThat) {
  const ProgramResult result =
      yat({"render", "scene.lxs", "--resolution", "100x50", "--crop", "0.25,0.75,0,0.5",
           "--samples-range", "5,7", "--stats", "s.json", "-q"});
  ASSERT_EQ(result.code, 0) << result.err;
  const auto stats = nlohmann::json::parse(read_whole(folder_ / "s.json"));
  EXPECT_EQ(stats["resolution"], nlohmann::json({100, 50}));
  EXPECT_EQ(stats["settings"]["crop"], nlohmann::json({25, 75, 0, 25}));
  EXPECT_EQ(stats["samples"], 50 * 25 * 2);
}

TEST_F(Program, TheBoundOfShadowRaysIsThatOfTheWholePicture) {
  const auto bound = [&](std::vector<std::string> more) {
    std::vector<std::string> words = {"render", "scene.lxs", "--resolution", "100x50", "--stats",
                                      "s.json", "-q"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = yat(words);
    EXPECT_EQ(result.code, 0) << result.err;
    const auto stats = nlohmann::json::parse(read_whole(folder_ / "s.json"));
    EXPECT_EQ(stats["time"]["pilot"] > 0, stats["shadow_bound"] > 0);
    EXPECT_LT(stats["time"]["pilot"], stats["time"]["render"]);
    return stats["shadow_bound"].get<double>();
  };
  const double whole = bound({"--spp", "2", "--shadow-roulette", ".25"});
  EXPECT_GT(whole, 0);
  EXPECT_EQ(bound({"--samples-range", "3,4", "--crop", ".5,.51,.5,.52", "--threads", "3",
                   "--shadow-roulette", ".25"}),
            whole);
  EXPECT_EQ(bound({"--noise-target", "1", "--shadow-roulette", ".5"}), 2 * whole);
  EXPECT_EQ(bound({"--spp", "2", "--shadow-roulette", "off"}), 0);
}

TEST_F(Program, TheTimeLimitEndsARenderWithoutEnd) {
  const ProgramResult result =
      yat({"render", "scene.lxs", "--time", "0.3", "-o", "t.png", "--progress", "none"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(has("t.png"));
  EXPECT_NE(result.err.find("time is up: the picture holds "), std::string::npos) << result.err;
}

TEST_F(Program, TheFilmsTimeLimitHoldsWhereNoneIsGiven) {
  std::string text(kScene);
  text.insert(text.find(" \"string filename\""), " \"integer halttime\" [1]");
  write_whole(folder_ / "halt.lxs", text);
  const ProgramResult result = yat({"render", "halt.lxs", "-o", "t.png", "--progress", "none"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(has("t.png"));
  EXPECT_NE(result.err.find("time is up: the picture holds "), std::string::npos) << result.err;
  // The command line's limit outranks it.
  const ProgramResult few =
      yat({"render", "halt.lxs", "--spp", "2", "-o", "s.png", "--progress", "none"});
  EXPECT_EQ(few.code, 0) << few.err;
  EXPECT_EQ(few.err.find("time is up"), std::string::npos) << few.err;
}

TEST_F(Program, InterruptWritesThePictureSoFar) {
  for (const int signal : {SIGINT, SIGTERM}) {
    fs::remove(folder_ / "i.png");
    RunningProgram program(command({"render", "scene.lxs", "--spp", "1000000000", "-o", "i.png",
                                    "--stats", "i.json", "--progress", "json"}),
                           folder_);
    ASSERT_TRUE(program.wait_for("\"event\":\"progress\"")) << program.err_so_far();
    program.signal(signal);
    const ProgramResult result = program.wait();
    EXPECT_EQ(result.code, 130) << result.err;
    EXPECT_NE(result.err.find("interrupted: the picture holds "), std::string::npos) << result.err;
    EXPECT_TRUE(has("i.png"));
    const auto stats = nlohmann::json::parse(read_whole(folder_ / "i.json"));
    EXPECT_TRUE(stats["interrupted"]);
    EXPECT_GT(stats["samples"], 0);
    EXPECT_NE(result.err.find("(" + std::to_string(stats["samples"].get<uint64_t>()) +
                              " samples in 768 pixels)"),
              std::string::npos)
        << result.err;
  }
}

TEST_F(Program, InfoTellsWhatIsThere) {
  const ProgramResult result = yat({"info", "scene.lxs"});
  ASSERT_EQ(result.code, 0) << result.err;
  for (const char* part : {"2 trianglemesh", "4 triangles", "2 matte", "2 triangle", "32x24",
                           "Plan (", "Tree", "Memory [bytes]", "all of the scene"})
    EXPECT_NE(result.out.find(part), std::string::npos) << part << "\n" << result.out;
}

}  // namespace
}  // namespace yat

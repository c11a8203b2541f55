// YART's command line as people run it: what it prints, writes and returns.

#include <OpenImageIO/imagebuf.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "run_program.h"

namespace yat {
namespace {

namespace fs = std::filesystem;

// A floor of Kd .5 straight below a point that does not fall off: each pixel .5 / pi, but for the
// cosine, which is 1 within 1e-4 in this narrow view.
constexpr std::string_view kScene = R"(LookAt 0 0 10  0 0 0  0 1 0
Camera "perspective" "float fov" [1]
Film "fleximage" "integer xresolution" [64] "integer yresolution" [48]
WorldBegin
Material "matte" "color Kd" [0.5 0.5 0.5]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point P" [-2 -2 0  2 -2 0  2 2 0  -2 2 0]
LightSource "point" "point from" [0 0 10] "float power" [0] "float efficacy" [0]
WorldEnd
)";

class YartProgram : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = empty_folder("yart_program");
    write_whole(folder_ / "scene.lxs", kScene);
  }
  ProgramResult yat(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), YAT_PROGRAM);
    return run_program(arguments, folder_);
  }
  OIIO::ImageBuf picture(const char* name) const {
    return OIIO::ImageBuf((folder_ / name).string());
  }
  fs::path folder_;
};

const std::string kTime = "(\\d+ms|(\\d+h)?(\\d+m)?\\d+(\\.\\d+)?s)";

TEST_F(YartProgram, ANormalRunPrintsWhatYartPrinted) {
  const ProgramResult run = yat({"-i", "./scene.lxs", "-o", "out/a.png", "-th", "1", "-aa", "4"});
  EXPECT_EQ(run.code, 0) << run.err;
  const std::regex form("Scene loading time: " + kTime + "\nStarting process at \\d+:\\d\\d\n" +
                        "Render finished!\nPreprocessing time: " + kTime + "\nRender time: " +
                        kTime + "\n-------------------\nTotal time: " + kTime + "\n");
  EXPECT_TRUE(std::regex_match(run.out, form)) << run.out;
  EXPECT_EQ(run.err, "read by YART's rules (--compat yart)\n");
  const OIIO::ImageBuf image = picture("out/a.png");
  ASSERT_TRUE(image.initialized());
  // YART's linear: no exposure. (.5 / pi)^(1 / 2.2) is .4337.
  EXPECT_NEAR(double(image.getchannel(32, 24, 0, 1)), .4337, 1.5 / 255);
}

TEST_F(YartProgram, ABenchmarkPrintsEachRunAndItsSums) {
  const ProgramResult run =
      yat({"-i", "scene.lxs", "-o", "b.png", "-pathtracer", "-s", "1", "-tr", "2", "-b", "3"});
  EXPECT_EQ(run.code, 0) << run.err;
  const std::regex form("Scene loading time: " + kTime + "\nRender 1/3\\.\\.\\. " + kTime +
                        "\nRender 2/3\\.\\.\\. " + kTime + "\nRender 3/3\\.\\.\\. " + kTime +
                        "\nBenchmark finished!\nTotal runs: 3\nAverage time: " + kTime +
                        "\nRenders per second: [0-9.e+]+\nTotal time: " + kTime + "\n");
  EXPECT_TRUE(std::regex_match(run.out, form)) << run.out;
  EXPECT_TRUE(fs::exists(folder_ / "b.png"));
}

TEST_F(YartProgram, AllFlagsTogetherRender) {
  const ProgramResult run =
      yat({"-i", "scene.lxs", "-o",  "all.png", "-pathtracer", "-s", "2",  "-tr", "10", "-aa", "4",
           "-d", "2",         "-bs", "32",      "-th",         "2",  "-t", "-hb", "-b", "3"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("Total runs: 3"), std::string::npos) << run.out;
  EXPECT_EQ(run.out.find(".."), run.out.find("... ")) << "no heart beat: " << run.out;
  for (const char* idle : {"-aa does nothing", "-d does nothing", "-hb does nothing"})
    EXPECT_NE(run.err.find(idle), std::string::npos) << run.err;
  EXPECT_TRUE(fs::exists(folder_ / "all.png"));
}

TEST_F(YartProgram, HeartBeatsAreFinishedBuckets) {
  // 64 x 48 in buckets of 20: 4 x 3.
  for (const char* threads : {"1", "2"}) {
    const ProgramResult run = yat({"-i", "scene.lxs", "-bs", "20", "-hb", "-th", threads});
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.out.find("\n............\nRender finished!"), std::string::npos) << run.out;
  }
}

TEST_F(YartProgram, TheStampIsABarOfThirtyRowsWithTimeAndTriangles) {
  ASSERT_EQ(yat({"-i", "scene.lxs", "-o", "plain.png"}).code, 0);
  const ProgramResult run = yat({"-i", "scene.lxs", "-o", "stamped.png", "-t"});
  ASSERT_EQ(run.code, 0);
  const OIIO::ImageBuf plain = picture("plain.png"), stamped = picture("stamped.png");
  // Above the bar nothing changes; in it, at the left edge, a quarter of the picture and a grey.
  EXPECT_EQ(stamped.getchannel(3, 17, 0, 0), plain.getchannel(3, 17, 0, 0));
  EXPECT_NEAR(stamped.getchannel(3, 18, 0, 0), .25f * plain.getchannel(3, 18, 0, 0) + .0735f,
              2.f / 255);
  const bool no_font = run.err.find("no font found") != std::string::npos;
  float brightest = 0;
  for (int y = 18; y < 48; ++y)
    for (int x = 0; x < 64; ++x) brightest = std::max(brightest, stamped.getchannel(x, y, 0, 1));
  if (no_font)
    EXPECT_NE(run.err.find("Render time: "), std::string::npos);
  else
    EXPECT_GT(brightest, .8f);
}

/// A wall of Kd .5, lit straight on, at the end of a corridor along +y that has mirrors as its
/// sides and glass that bends nothing across it. Looks in the direction (x, y).
std::string corridor_text(double x, double y, int panes) {
  const auto quad = [](const std::string& points) {
    return "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [" + points +
           "]\n";
  };
  const std::string mirror = "Material \"mirror\"\n";
  std::string text = "LookAt 0 0 0  " + std::to_string(x) + " " + std::to_string(y) +
                     " 0  0 0 1\nCamera \"perspective\" \"float fov\" [1]\n"
                     "Film \"fleximage\" \"integer xresolution\" [4] \"integer yresolution\" "
                     "[4]\nWorldBegin\n";
  text += mirror + quad("1 -1 -5  1 20 -5  1 20 5  1 -1 5") + mirror +
          quad("-1 -1 -5  -1 20 -5  -1 20 5  -1 -1 5");
  for (int i = 0; i < panes; ++i) {
    const std::string at = " " + std::to_string(i + 1) + " ";
    text += "Material \"glass\" \"float index\" [1]\n" +
            quad("-1" + at + "-5  1" + at + "-5  1" + at + "5  -1" + at + "5");
  }
  // By YART's rules a point light does not fall off.
  return text + "Material \"matte\" \"color Kd\" [.5 .5 .5]\n" +
         quad("-1 10 -5  1 10 -5  1 10 5  -1 10 5") +
         "LightSource \"point\" \"point from\" [0 9.5 0] \"float power\" [0] \"float efficacy\" "
         "[0]\n"
         "WorldEnd\n";
}

TEST_F(YartProgram, RaysAreReflectedAndRefractedAsOftenAsTheirDepthSays) {
  int pictures = 0;
  const auto seen = [&](const std::string& text, int depth) {
    // A new name each time: OpenImageIO keeps what it has read.
    const std::string name = "c" + std::to_string(pictures++) + ".png";
    write_whole(folder_ / "corridor.lxs", text);
    const ProgramResult run = yat(
        {"-i", "corridor.lxs", "-o", name, "-aa", "1", "-th", "1", "-d", std::to_string(depth)});
    EXPECT_EQ(run.code, 0) << run.err;
    return double(picture(name.c_str()).getchannel(2, 2, 0, 1));
  };
  // (.5 / pi)^(1 / 2.2), where light reaches the wall head-on.
  constexpr double kLit = .4337;
  for (const int turns : {1, 2, 3}) {
    SCOPED_TRACE(turns);
    // To the wall's middle, 10 away, by `turns` mirrors that are 2 apart.
    const std::string mirrors = corridor_text(1, 10. / (2 * turns), 0);
    EXPECT_NEAR(seen(mirrors, turns), kLit, 2. / 255);
    const std::string panes = corridor_text(0, 1, turns);
    EXPECT_NEAR(seen(panes, turns), kLit, 2. / 255);
    if (turns == 1) continue;  // a depth of 0 there is not
    EXPECT_EQ(seen(mirrors, turns - 1), 0);
    EXPECT_EQ(seen(panes, turns - 1), 0);
  }
}

TEST_F(YartProgram, BadInputIsCodeOneAndSaysWhy) {
  const ProgramResult flag = yat({"-i", "scene.lxs", "-s", "none", "-pathtracer"});
  EXPECT_EQ(flag.code, 1);
  EXPECT_EQ(flag.err, "yat: -s none: give a whole number from 1 to 1048576\n");
  const ProgramResult missing = yat({"-i", "nothing.lxs", "-o", "a.png"});
  EXPECT_EQ(missing.code, 1);
  EXPECT_NE(missing.err.find("nothing.lxs"), std::string::npos);
  const ProgramResult kind = yat({"-i", "scene.lxs", "-o", "picture"});
  EXPECT_EQ(kind.code, 1);
  EXPECT_NE(kind.err.find("-o picture: unknown kind of picture"), std::string::npos);
  EXPECT_EQ(kind.out, "");  // before the work
  const ProgramResult window = yat({"-i", "scene.lxs", "-g"});
  EXPECT_EQ(window.code, 1);
  EXPECT_NE(window.err.find("the window comes with a later version"), std::string::npos);
}

}  // namespace
}  // namespace yat

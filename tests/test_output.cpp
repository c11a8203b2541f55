// Picture files: what is written is what is read back, and failures leave nothing behind.

#include "film/output.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "film/tonemap.h"

namespace yat {
namespace {

namespace fs = std::filesystem;

constexpr uint32_t kWidth = 7, kHeight = 5;

class Output : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(YAT_TEST_OUTPUT_DIR) /
              testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    for (uint32_t i = 0; i < kWidth * kHeight * 3; ++i) rgb_.push_back(float(i) * 1.37f - 3);
    settings_.width = 20, settings_.height = 10;
    settings_.crop_x0 = 2, settings_.crop_x1 = 2 + kWidth;
    settings_.crop_y0 = 3, settings_.crop_y1 = 3 + kHeight;
    metadata_ = {"scenes/room.lxs", 0x0123456789abcdefu, 7, 64, 1.5, "avx2", "0.1.0", {}};
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  size_t files() const {
    return size_t(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
  std::vector<float> rgb_;
  FilmSettings settings_;
  PictureMetadata metadata_;
};

TEST_F(Output, ExrKeepsTheFloatsAndSaysWhereTheyComeFrom) {
  const std::string file = path("new/folders/picture.exr");
  write_picture(file, rgb_, kWidth, kHeight, settings_, metadata_);
  const auto in = OIIO::ImageInput::open(file);
  ASSERT_TRUE(in) << OIIO::geterror();
  const OIIO::ImageSpec& spec = in->spec();
  ASSERT_EQ(spec.width, int(kWidth));
  ASSERT_EQ(spec.height, int(kHeight));
  EXPECT_EQ(spec.x, 2);
  EXPECT_EQ(spec.y, 3);
  EXPECT_EQ(spec.full_width, 20);
  EXPECT_EQ(spec.full_height, 10);
  EXPECT_EQ(spec.format, OIIO::TypeDesc::FLOAT);
  std::vector<float> back(rgb_.size());
  ASSERT_TRUE(in->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, back.data()));
  EXPECT_EQ(std::memcmp(back.data(), rgb_.data(), rgb_.size() * sizeof(float)), 0);
  EXPECT_EQ(spec.get_string_attribute("yat:scene"), "scenes/room.lxs");
  EXPECT_EQ(spec.get_string_attribute("yat:scene_hash"), "0123456789abcdef");
  EXPECT_EQ(spec.get_string_attribute("yat:seed"), "7");
  EXPECT_EQ(spec.get_float_attribute("yat:samples_per_pixel"), 64.f);
  EXPECT_EQ(spec.get_float_attribute("yat:render_seconds"), 1.5f);
  EXPECT_EQ(spec.get_string_attribute("yat:isa"), "avx2");
  EXPECT_EQ(spec.get_string_attribute("yat:version"), "0.1.0");
  EXPECT_EQ(spec.get_string_attribute("Software"), "yat 0.1.0");
  const OIIO::ParamValue* xy = spec.find_attribute("chromaticities");
  ASSERT_TRUE(xy);
  EXPECT_FLOAT_EQ(xy->get_float_indexed(0), .64f);
  EXPECT_FLOAT_EQ(xy->get_float_indexed(7), .3290f);
}

TEST_F(Output, PngHoldsTheTruncatedToneMap) {
  const std::string file = path("picture.PNG");
  write_picture(file, rgb_, kWidth, kHeight, settings_, metadata_);
  const auto in = OIIO::ImageInput::open(file);
  ASSERT_TRUE(in) << OIIO::geterror();
  std::vector<uint8_t> back(rgb_.size());
  ASSERT_TRUE(in->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, back.data()));
  const std::vector<float> display = tone_map(rgb_, settings_);
  for (size_t i = 0; i < back.size(); ++i) EXPECT_EQ(back[i], quantise(display[i], 255)) << i;
}

TEST_F(Output, JpegIsNear) {
  const std::vector<float> grey(kWidth * kHeight * 3, 1.f);
  for (const char* name : {"picture.jpg", "picture.jpeg"}) {
    write_picture(path(name), grey, kWidth, kHeight, settings_, metadata_);
    const auto in = OIIO::ImageInput::open(path(name));
    ASSERT_TRUE(in) << OIIO::geterror();
    std::vector<uint8_t> back(grey.size());
    ASSERT_TRUE(in->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, back.data()));
    const std::vector<float> display = tone_map(grey, settings_);
    for (size_t i = 0; i < back.size(); ++i)
      EXPECT_NEAR(back[i], quantise(display[i], 255), 3) << i;
  }
}

TEST_F(Output, ReplacesAnOldFileAndLeavesNoOther) {
  fs::create_directories(folder_);
  std::ofstream(path("picture.exr")) << "old";
  write_picture(path("picture.exr"), rgb_, kWidth, kHeight, settings_, metadata_);
  EXPECT_EQ(files(), 1u);
  EXPECT_TRUE(OIIO::ImageInput::open(path("picture.exr")));
}

TEST_F(Output, AFailureNamesTheFileAndLeavesNothing) {
  // A folder has the picture's name: the rename cannot work.
  fs::create_directories(folder_ / "picture.exr" / "inside");
  try {
    write_picture(path("picture.exr"), rgb_, kWidth, kHeight, settings_, metadata_);
    FAIL() << "no error";
  } catch (const ResourceError& e) {
    EXPECT_EQ(std::string(e.what()),
              "error: " + path("picture.exr") + ": cannot write: Is a directory");
  }
  EXPECT_EQ(files(), 1u);
  // A file stands where a folder is needed.
  std::ofstream(path("file")) << "x";
  EXPECT_THROW(write_picture(path("file/picture.png"), rgb_, kWidth, kHeight, settings_, metadata_),
               ResourceError);
}

TEST_F(Output, KnowsItsExtensions) {
  EXPECT_TRUE(is_picture_name("a/b.exr"));
  EXPECT_TRUE(is_picture_name("b.JPG"));
  EXPECT_FALSE(is_picture_name("b.tif"));
  EXPECT_FALSE(is_picture_name("png"));
  EXPECT_FALSE(is_picture_name(".png")) << "a hidden file without extension";
  EXPECT_THROW(write_picture(path("b.tif"), rgb_, kWidth, kHeight, settings_, metadata_),
               UsageError);
}

// ---- Files as the scene's write_ flags ask -----------------------------------------------------

TEST_F(Output, DeepPngHoldsSixteenBitsAndGreyHasAlphaOne) {
  PictureFile file;
  file.extension = ".png";
  file.deep = true;
  file.channels = PictureFile::Channels::kYA;
  settings_.tone_map = ToneMap::kYartLinear;
  settings_.gamma = 1;
  const std::vector<float> grey(rgb_.size(), .4321f);
  write_picture(path("deep.png"), grey, kWidth, kHeight, settings_, metadata_, {}, &file);
  const auto in = OIIO::ImageInput::open(path("deep.png"));
  ASSERT_TRUE(in) << OIIO::geterror();
  EXPECT_EQ(in->spec().format, OIIO::TypeDesc::UINT16);
  ASSERT_EQ(in->spec().nchannels, 2);
  std::vector<uint16_t> back(size_t(kWidth) * kHeight * 2);
  ASSERT_TRUE(in->read_image(0, 0, 0, 2, OIIO::TypeDesc::UINT16, back.data()));
  EXPECT_NEAR(back[0], .4321 * 65535, 1.5);
  EXPECT_EQ(back[1], 65535);
}

TEST_F(Output, TargaIsWritten) {
  PictureFile file;
  file.extension = ".tga";
  file.channels = PictureFile::Channels::kRgba;
  settings_.tone_map = ToneMap::kYartLinear;
  settings_.gamma = 1;
  const std::vector<float> grey(rgb_.size(), .5f);
  write_picture(path("p.tga"), grey, kWidth, kHeight, settings_, metadata_, {}, &file);
  const auto in = OIIO::ImageInput::open(path("p.tga"));
  ASSERT_TRUE(in) << OIIO::geterror();
  ASSERT_EQ(in->spec().nchannels, 4);
  std::vector<uint8_t> back(size_t(kWidth) * kHeight * 4);
  ASSERT_TRUE(in->read_image(0, 0, 0, 4, OIIO::TypeDesc::UINT8, back.data()));
  EXPECT_EQ(back[0], 128);  // trunc(256 c)
  EXPECT_EQ(back[3], 255);
}

TEST_F(Output, ExrIsToneMappedInHalvesWhereTheSceneSaysSo) {
  PictureFile file;
  file.extension = ".exr";
  file.compression = "piz";
  settings_.tone_map = ToneMap::kYartReinhard;
  const std::vector<float> three(rgb_.size(), 3.f);
  write_picture(path("t.exr"), three, kWidth, kHeight, settings_, metadata_, {}, &file);
  auto in = OIIO::ImageInput::open(path("t.exr"));
  ASSERT_TRUE(in) << OIIO::geterror();
  EXPECT_EQ(in->spec().format, OIIO::TypeDesc::HALF);
  EXPECT_EQ(in->spec().get_string_attribute("compression"), "piz");
  std::vector<float> back(rgb_.size());
  ASSERT_TRUE(in->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, back.data()));
  EXPECT_NEAR(double(back[0]), .75, 1e-3);  // without gamma
  file.tone_mapped = file.half = false;
  write_picture(path("l.exr"), three, kWidth, kHeight, settings_, metadata_, {}, &file);
  in = OIIO::ImageInput::open(path("l.exr"));
  ASSERT_TRUE(in) << OIIO::geterror();
  EXPECT_EQ(in->spec().format, OIIO::TypeDesc::FLOAT);
  ASSERT_TRUE(in->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, back.data()));
  EXPECT_EQ(back[0], 3.f);
}

}  // namespace
}  // namespace yat

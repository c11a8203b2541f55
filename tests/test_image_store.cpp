// Images of textures: formats, sharing, mip levels, the limit of memory.

#include <cmath>

#include "scene/image_store.h"
#include "texture_images.h"

namespace yat {
namespace {

float ramp(int x, int y, int c) {
  return float((x * 16 + y * 5 + c * 40) % 256) / 255;
}

TEST(ImageStore, KeepsTexelsAsTheyAre) {
  ImageStore store;
  std::string problem;
  const uint32_t colour = store.read(
      write_image("store", "colour.png", 7, 5, 3, OIIO::TypeDesc::UINT8, ramp), false, 1, problem);
  const uint32_t alpha = store.read(
      write_image("store", "alpha.png", 7, 5, 4, OIIO::TypeDesc::UINT8, ramp), false, 1, problem);
  const uint32_t grey = store.read(
      write_image("store", "grey.png", 7, 5, 1, OIIO::TypeDesc::UINT8, ramp), false, 1, problem);
  const uint32_t fine = store.read(
      write_image("store", "fine.png", 7, 5, 3, OIIO::TypeDesc::UINT16, ramp), false, 1, problem);
  const uint32_t bright =
      store.read(write_image("store", "bright.exr", 7, 5, 3, OIIO::TypeDesc::HALF,
                             [](int x, int y, int c) { return 100.f * ramp(x, y, c); }),
                 false, 1, problem);
  ASSERT_EQ(problem, "");
  EXPECT_EQ(store.format(colour), TexelFormat::kByte4);
  EXPECT_EQ(store.format(alpha), TexelFormat::kByte4);
  EXPECT_EQ(store.format(grey), TexelFormat::kByte1);
  EXPECT_EQ(store.format(fine), TexelFormat::kFloat4);
  EXPECT_EQ(store.format(bright), TexelFormat::kFloat4);
  EXPECT_NEAR(store.largest(bright), 100 * 196. / 255, .1);

  const uint32_t rows[] = {colour, alpha, grey, fine, bright};
  ImageStore::Place places[5];
  TexelFormat formats[5];
  for (size_t i = 0; i < 5; ++i)
    places[i] = store.place(rows[i]), formats[i] = store.format(rows[i]);
  const Texels texels = store.take();
  for (size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(texels.levels[rows[i] * kTexelLevels], places[i].texels);
    TexelLevel level;
    level.width = places[i].width;
    level.height = places[i].height;
    level.words.assign(texels.words.data() + places[i].texels,
                       texels.words.data() + texels.words.size());
    const float scale = i == 4 ? 100.f : i == 3 ? 1.f : 255.f;
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 7; ++x) {
        const auto texel = read_texel(level, formats[i], uint32_t(x), uint32_t(y));
        for (int c = 0; c < 4; ++c) {
          const float one = i < 3 ? 255.f : 1.f;
          const float expected = c == 3 && i != 1 ? one : scale * ramp(x, y, i == 2 ? 0 : c);
          // A half has 11 bits.
          EXPECT_NEAR(texel[size_t(c)], expected, i == 4 ? .06f : 1e-4f)
              << i << " " << x << " " << y;
        }
      }
  }
}

TEST(ImageStore, OneFileIsReadOnce) {
  ImageStore store;
  std::string problem;
  const std::string file = write_image("store", "once.png", 8, 8, 3, OIIO::TypeDesc::UINT8, ramp);
  const uint32_t row = store.read(file, false, 1, problem);
  EXPECT_EQ(store.read(file, false, 2.2, problem), row);
  const uint32_t mips = store.read(file, true, 2.2, problem);
  EXPECT_NE(mips, row);
  EXPECT_EQ(store.read(file, true, 2.2, problem), mips);
  EXPECT_EQ(store.place(mips).levels, 4u);
  EXPECT_EQ(store.read(file + ".gone", false, 1, problem), kNone);
  EXPECT_NE(problem, "");
}

TEST(ImageStore, LevelsKeepTheMeanOfTheLight) {
  // Stripes of black and white, gamma 2.2: half the light, not half the number.
  std::string problem;
  for (const int width : {8, 13}) {
    const std::string file = write_image("store", "stripes.exr", width, 6, 3, OIIO::TypeDesc::FLOAT,
                                         [](int x, int, int c) {
                                           return c == 2 ? .25f : x % 2 ? 1.f : 0.f;
                                         });
    TexelLevel level;
    ImageStore fresh;
    fresh.read(file, true, 2.2, problem);
    const ImageStore::Place place = fresh.place(0);
    const Texels texels = fresh.take();
    ASSERT_EQ(place.levels, 4u);  // 13 6 3 1
    const uint32_t last = texels.levels[place.levels - 1];
    level.width = level.height = 1;
    level.words.assign(texels.words.data() + last, texels.words.data() + last + 64);
    const auto texel = read_texel(level, TexelFormat::kFloat4, 0, 0);
    const double white = double(width / 2) / width;
    EXPECT_NEAR(std::pow(double(texel[0]), 2.2), white, 1e-5);
    EXPECT_NEAR(texel[2], .25, 1e-6);
  }
}

TEST(ImageStore, LeavesOutTheFinestLevelsOfTheLargest) {
  const std::string large =
                        write_image("store", "large.png", 256, 128, 3, OIIO::TypeDesc::UINT8, ramp),
                    small =
                        write_image("store", "small.png", 64, 64, 3, OIIO::TypeDesc::UINT8, ramp);
  std::string problem;
  ImageStore free;
  free.read(large, false, 2.2, problem);
  EXPECT_EQ(free.left_out(), 0u);
  ImageStore store(60000);  // 131072 and 16384 bytes
  const uint32_t a = store.read(large, false, 2.2, problem),
                 b = store.read(small, true, 2.2, problem);
  EXPECT_EQ(store.left_out(), 1u);
  EXPECT_EQ(store.place(a).width, 128u);
  EXPECT_EQ(store.place(a).height, 64u);
  EXPECT_EQ(store.place(b).width, 64u);
  EXPECT_EQ(store.place(b).levels, 7u);
  EXPECT_EQ(store.place(b).texels, 128u * 64);
  EXPECT_LE(store.take().words.size() * 4, 60000u);
}

TEST(ImageStore, TexelsThatAreNoNumbersAreBlackAndCounted) {
  const std::string file =
      write_image("store", "bad.exr", 4, 4, 3, OIIO::TypeDesc::FLOAT, [](int x, int y, int) {
        return x == 1 && y == 2 ? NAN : x == 3 && y == 3 ? INFINITY : .5f;
      });
  ImageStore store;
  std::string problem;
  const uint32_t row = store.read(file, true, 2.2, problem);
  EXPECT_EQ(store.bad_texels(row), 2u);
  EXPECT_EQ(store.largest(row), 1);  // alpha, which the file has not
}

}  // namespace
}  // namespace yat

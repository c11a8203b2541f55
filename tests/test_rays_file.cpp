// Ray files: what is written is read, and anything else is an error that says so.

#include <gtest/gtest.h>

#include <cstring>

#include "rays_file.h"

namespace yat::bench {
namespace {

Recording small_recording() {
  Recording r{scene_of("room", {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1}), {}};
  r.sets.push_back({"camera", false, {{0, 0, -1, 0, 0, 1, kRayFar}, {0.5f, 0, -1, 0, 0, 1, 7}}});
  r.sets.push_back({"shadow 1", true, {{0, 0, 0.5f, 0.25f, 0, 2, 1}}});
  r.sets.push_back({"diffuse 1", false, {}});
  return r;
}

std::string error_of(std::string_view bytes) {
  try {
    decode_rays(bytes, "test.rays");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

template <class T>
std::string with(std::string bytes, size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
  return bytes;
}

TEST(RaysFile, RoundTrip) {
  const Recording before = small_recording();
  const Recording after = decode_rays(encode_rays(before), "test.rays");
  EXPECT_EQ(after.scene.name, "room");
  EXPECT_EQ(after.scene.corners, before.scene.corners);
  ASSERT_EQ(after.scene.rows.size(), 2u);
  EXPECT_EQ(after.scene.rows.row(1).p0_z, 1);
  ASSERT_EQ(after.sets.size(), 3u);
  for (size_t s = 0; s < 3; ++s) {
    EXPECT_EQ(after.sets[s].name, before.sets[s].name);
    EXPECT_EQ(after.sets[s].shadow, before.sets[s].shadow);
    ASSERT_EQ(after.sets[s].rays.size(), before.sets[s].rays.size());
    for (size_t i = 0; i < after.sets[s].rays.size(); ++i)
      EXPECT_EQ(std::memcmp(&after.sets[s].rays[i], &before.sets[s].rays[i], sizeof(Ray<Value>)),
                0);
  }
}

TEST(RaysFile, BytesAreAsDocumented) {
  const std::string bytes = encode_rays(small_recording());
  EXPECT_EQ(bytes.substr(0, 8), "YATRAYS1");
  EXPECT_EQ(bytes.substr(8, 16), std::string("\3\0\0\0\4\0\0\0\2\0\0\0\0\0\0\0", 16));
  EXPECT_EQ(bytes.substr(24, 4), "room");
  EXPECT_EQ(bytes.size(), 28 + 2 * 36 + 3 * 16 + 6 + 8 + 9 + 3 * 28u);
}

TEST(RaysFile, EveryCutIsAnError) {
  const std::string bytes = encode_rays(small_recording());
  for (size_t size = 0; size < bytes.size(); ++size) {
    const std::string error = error_of(std::string_view(bytes).substr(0, size));
    EXPECT_TRUE(error.starts_with("test.rays: error: ")) << size << ": " << error;
  }
}

TEST(RaysFile, ErrorsSayWhatToDo) {
  const std::string good = encode_rays(small_recording());
  EXPECT_EQ(error_of("ply\n"),
            "test.rays: error: is not a ray file (its first bytes are not \"YATRAYS1\"): make one "
            "with record_rays");
  EXPECT_EQ(error_of(std::string_view(good).substr(0, 20)),
            "test.rays: error: ends within the header (4 bytes more should follow): the file is "
            "cut short, record it again");
  EXPECT_EQ(error_of(good + "x"),
            "test.rays: error: 1 bytes follow the last set: not a ray file, record it again");
  EXPECT_EQ(error_of(with(good, 16, uint64_t(1) << 60)),
            "test.rays: error: says 1152921504606846976 triangles, but is too short for them: the "
            "file is cut short or not a ray file, record it again");
  EXPECT_EQ(error_of(with(good, 8, 0xffffffffu)),
            "test.rays: error: has a header that record_rays does not write: record it again");
  const size_t first_set = 28 + 2 * 36;
  EXPECT_EQ(error_of(with(good, first_set + 4, 2u)),
            "test.rays: error: set 1 of 3 begins with what record_rays does not write: record it "
            "again");
  EXPECT_TRUE(error_of(with(good, first_set + 8, ~uint64_t(0)))
                  .starts_with("test.rays: error: says 18446744073709551615 rays"));
}

TEST(RaysFile, MissingFile) {
  try {
    read_rays("no/such.rays");
    FAIL() << "read";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              "no/such.rays: error: cannot be read (No such file or directory); check the name");
  }
}

}  // namespace
}  // namespace yat::bench

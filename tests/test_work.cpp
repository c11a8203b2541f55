// Every path of a render is listed exactly once, however the work is cut.

#include "wavefront/work.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>

namespace yat {
namespace {

FilmSettings window(uint32_t x0, uint32_t x1, uint32_t y0, uint32_t y1) {
  FilmSettings film;
  film.crop_x0 = x0, film.crop_x1 = x1, film.crop_y0 = y0, film.crop_y1 = y1;
  return film;
}

/// How often each path, a pixel and a sample of it, was given out.
using Paths = std::map<std::pair<uint32_t, uint32_t>, int>;

/// Adds all paths of the list, which are taken at most `most` at a time.
void take_all(WorkList& list, uint32_t most, Paths& seen) {
  std::vector<uint32_t> pixel(most), sample(most);
  while (const WorkUnit* unit = list.claim()) {
    WorkCursor cursor;
    cursor.start(*unit);
    uint64_t paths = 0;
    while (!cursor.empty()) {
      const uint32_t n = cursor.take(most, pixel.data(), sample.data());
      ASSERT_GT(n, 0u);
      paths += n;
      for (uint32_t i = 0; i < n; ++i) ++seen[{pixel[i], sample[i]}];
    }
    ASSERT_EQ(paths, unit->paths());
  }
}

TEST(WorkList, EveryPathOnceWhateverTheCut) {
  const FilmSettings film = window(3, 40, 5, 22);
  for (const uint32_t tile : {0u, 1u, 7u, 8u, 64u, 100000u})
    for (const uint32_t workers : {1u, 2u, 7u})
      for (const uint32_t take : {1u, 13u, 5000u}) {
        WorkList list(film, 2, 7, tile, workers);
        Paths seen;
        ASSERT_NO_FATAL_FAILURE(take_all(list, take, seen));
        ASSERT_EQ(seen.size(), 37u * 17 * 5) << tile << ' ' << workers << ' ' << take;
        for (const auto& [path, times] : seen) {
          ASSERT_EQ(times, 1);
          ASSERT_TRUE((path.first & 0xffff) >= 3 && (path.first & 0xffff) < 40 &&
                      path.first >> 16 >= 5 && path.first >> 16 < 22 && path.second >= 2 &&
                      path.second < 7);
        }
      }
}

TEST(WorkList, AMapGivesEveryBlockItsOwnSamples) {
  const FilmSettings film = window(3, 40, 5, 22);
  SampleMap map(film);
  ASSERT_EQ(map.columns, 5u);
  ASSERT_EQ(map.rows, 3u);
  uint64_t all = 0;
  for (uint32_t i = 0; i < 15; ++i) map.blocks[i] = {10 + i % 3, 10 + i % 3 + i % 4};
  for (uint32_t y = 5; y < 22; ++y)
    for (uint32_t x = 3; x < 40; ++x) all += ((y - 5) / 8 * 5 + (x - 3) / 8) % 4;
  for (const uint32_t tile : {0u, 1u, 20u, 64u})
    for (const uint32_t workers : {1u, 7u})
      for (const uint32_t take : {1u, 13u, 5000u}) {
        WorkList list(film, map, tile, workers);
        EXPECT_FALSE(list.shares_pixels());
        Paths seen;
        ASSERT_NO_FATAL_FAILURE(take_all(list, take, seen));
        ASSERT_EQ(seen.size(), all);
        for (const auto& [path, times] : seen) {
          ASSERT_EQ(times, 1);
          const uint32_t block = ((path.first >> 16) - 5) / 8 * 5 + ((path.first & 0xffff) - 3) / 8;
          ASSERT_GE(path.second, map.blocks[block].first);
          ASSERT_LT(path.second, map.blocks[block].end);
        }
      }
}

TEST(WorkList, SmallPicturesKeepEveryWorkerBusy) {
  // One pixel can be shared by ranges of samples only.
  const WorkList pixel(window(0, 1, 0, 1), 0, 1000, 0, 4);
  EXPECT_GE(pixel.units().size(), 16u);
  EXPECT_TRUE(pixel.shares_pixels());
  // One worker needs no split, a large picture has tiles enough.
  EXPECT_FALSE(WorkList(window(0, 1, 0, 1), 0, 1000, 0, 1).shares_pixels());
  const WorkList large(window(0, 960, 0, 540), 0, 16, 0, 2);
  EXPECT_FALSE(large.shares_pixels());
  EXPECT_GE(large.units().size(), 32u);
}

TEST(WorkList, NothingToDoIsNoUnit) {
  WorkList none(window(0, 9, 0, 9), 5, 5, 0, 2);
  EXPECT_EQ(none.claim(), nullptr);
}

}  // namespace
}  // namespace yat

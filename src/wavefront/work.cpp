#include "wavefront/work.h"

#include <algorithm>

namespace yat {

namespace {

constexpr uint32_t kBlock = kWorkBlock;
/// Pixels of a block are listed by such quarters: the 16 rays of a sub-beam (traverse_tile.h).
constexpr uint32_t kQuarter = 4;
/// Keeps coordinates beyond the picture's edge within 32 bits.
constexpr uint32_t kLargestTile = 65536;
/// Enough units that the last ones to finish are a small part of a render.
constexpr uint32_t kUnitsPerWorker = 16;
/// Without a need, a unit is no longer than this: some 50 ms of work.
constexpr uint64_t kPathsPerUnit = uint64_t(1) << 17;

uint64_t tiles_of(uint32_t width, uint32_t height, uint32_t tile) {
  return uint64_t((width + tile - 1) / tile) * ((height + tile - 1) / tile);
}

uint32_t choose_tile(uint32_t width, uint32_t height, uint32_t samples, uint32_t workers) {
  uint32_t tile = 64;
  while (tile > kBlock && (tiles_of(width, height, tile) < uint64_t(kUnitsPerWorker) * workers ||
                           uint64_t(tile) * tile * samples > kPathsPerUnit))
    tile /= 2;
  return tile;
}

}  // namespace

uint64_t WorkUnit::paths() const {
  if (!map) return uint64_t(x1 - x0) * (y1 - y0) * (end_sample - first_sample);
  uint64_t sum = 0;
  for (uint32_t y = y0; y < y1; y += kBlock)
    for (uint32_t x = x0; x < x1; x += kBlock) {
      const SampleMap::Range range = map->at_pixel(x, y);
      sum +=
          uint64_t(std::min(kBlock, x1 - x)) * std::min(kBlock, y1 - y) * (range.end - range.first);
    }
  return sum;
}

WorkList::WorkList(const FilmSettings& film, uint32_t first_sample, uint32_t end_sample,
                   uint32_t tile_size, uint32_t workers) {
  const uint32_t width = film.crop_width(), height = film.crop_height();
  const uint32_t samples = end_sample > first_sample ? end_sample - first_sample : 0;
  if (!width || !height || !samples) return;
  const uint32_t tile =
      tile_size ? std::min(tile_size, kLargestTile) : choose_tile(width, height, samples, workers);
  const uint64_t tiles = tiles_of(width, height, tile);
  // Units per tile. One worker needs no split; films of one's own are for small pictures.
  const uint64_t enough = uint64_t(kUnitsPerWorker) * workers / 4;
  const uint32_t splits = workers == 1 || tiles >= enough
                              ? 1
                              : uint32_t(std::min<uint64_t>(samples, (enough + tiles - 1) / tiles));
  splits_ = splits;
  shares_pixels_ = splits > 1;
  uint32_t number = 0;
  units_.reserve(tiles * splits);
  for (uint32_t y = film.crop_y0; y < film.crop_y1; y += tile)
    for (uint32_t x = film.crop_x0; x < film.crop_x1; x += tile, ++number)
      for (uint32_t split = 0; split < splits; ++split)
        units_.push_back({x, y, std::min(x + tile, film.crop_x1), std::min(y + tile, film.crop_y1),
                          first_sample + uint32_t(uint64_t(samples) * split / splits),
                          first_sample + uint32_t(uint64_t(samples) * (split + 1) / splits),
                          number});
}

WorkList::WorkList(const FilmSettings& film, const SampleMap& map, uint32_t tile_size,
                   uint32_t workers) {
  const uint32_t width = film.crop_width(), height = film.crop_height();
  if (!width || !height) return;
  uint64_t samples = 0;
  for (const SampleMap::Range& range : map.blocks) samples += range.end - range.first;
  const auto mean = uint32_t((samples + map.blocks.size() - 1) / map.blocks.size());
  const uint32_t wanted =
      tile_size ? std::min(tile_size, kLargestTile) : choose_tile(width, height, mean, workers);
  const uint32_t tile = (wanted + kBlock - 1) / kBlock * kBlock;
  uint32_t number = 0;
  for (uint32_t y = film.crop_y0; y < film.crop_y1; y += tile)
    for (uint32_t x = film.crop_x0; x < film.crop_x1; x += tile, ++number)
      units_.push_back({x, y, std::min(x + tile, film.crop_x1), std::min(y + tile, film.crop_y1), 0,
                        0, number, &map});
}

void WorkCursor::start(const WorkUnit& unit) {
  pixels_.clear();
  blocks_.clear();
  for (uint32_t y = unit.y0; y < unit.y1; y += kBlock)
    for (uint32_t x = unit.x0; x < unit.x1; x += kBlock) {
      const SampleMap::Range samples = unit.map
                                           ? unit.map->at_pixel(x, y)
                                           : SampleMap::Range{unit.first_sample, unit.end_sample};
      if (samples.first >= samples.end) continue;
      const auto first = uint32_t(pixels_.size());
      for (uint32_t quarter = 0; quarter < 4; ++quarter) {
        const uint32_t qx = x + quarter % 2 * kQuarter, qy = y + quarter / 2 * kQuarter;
        for (uint32_t j = qy; j < std::min(qy + kQuarter, unit.y1); ++j)
          for (uint32_t i = qx; i < std::min(qx + kQuarter, unit.x1); ++i)
            pixels_.push_back(j << 16 | i);
      }
      blocks_.push_back({first, uint32_t(pixels_.size()), samples.first, samples.end});
    }
  block_ = 0;
  place_ = 0;
}

uint32_t WorkCursor::take(uint32_t wanted, uint32_t* pixel, uint32_t* sample) {
  uint32_t taken = 0;
  while (taken < wanted && !empty()) {
    Block& block = blocks_[block_];
    const uint32_t first = block.pixel + place_;
    const uint32_t run = std::min(wanted - taken, block.end_pixel - first);
    std::copy_n(pixels_.data() + first, run, pixel + taken);
    std::fill_n(sample + taken, run, block.sample);
    taken += run;
    place_ += run;
    if (first + run < block.end_pixel) continue;
    place_ = 0;
    if (++block.sample == block.end_sample) ++block_;
  }
  return taken;
}

}  // namespace yat

#pragma once
// What there is to do: the paths of a picture, cut into units that workers claim one at a time.
//
// A unit is a tile of pixels and a range of samples. Within it, paths are listed by 8 x 8 pixel
// block, then sample, then pixel (by quarters of the block), so that the camera rays of a batch lie
// close together: 64 in a row go through the tree as one beam (kernels/traverse_tile.h).

#include <atomic>
#include <cstdint>
#include <vector>

#include "film/settings.h"
#include "soa/columns.h"
#include "soa/records.h"

namespace yat {

/// Pixels along the edge of a block.
inline constexpr uint32_t kWorkBlock = 8;

/// Samples of every block of the crop window, instead of one range for all. Blocks are counted from
/// the window's corner, row by row; those at the right and lower edge may have fewer pixels.
struct SampleMap {
  struct Range {
    uint32_t first = 0, end = 0;
  };
  /// One empty range per block.
  explicit SampleMap(const FilmSettings& film)
      : x0(film.crop_x0),
        y0(film.crop_y0),
        columns((film.crop_width() + kWorkBlock - 1) / kWorkBlock),
        rows((film.crop_height() + kWorkBlock - 1) / kWorkBlock),
        blocks(size_t(columns) * rows) {}
  const Range& at_pixel(uint32_t x, uint32_t y) const {
    return blocks[size_t((y - y0) / kWorkBlock) * columns + (x - x0) / kWorkBlock];
  }

  uint32_t x0, y0;
  uint32_t columns, rows;
  std::vector<Range> blocks;
};

/// Pixels of the full image, ends exclusive.
struct WorkUnit {
  uint32_t x0, y0, x1, y1;
  uint32_t first_sample, end_sample;
  uint32_t tile;                   ///< its number among the tiles
  const SampleMap* map = nullptr;  ///< says the samples, if there is one
  uint64_t paths() const;
};

/// The units of a render, and which of them are taken.
class WorkList {
 public:
  /// Splits the crop window into tiles of tile_size (0: chosen from the amount of work) and, where
  /// there are fewer tiles than `workers` can share evenly, each tile into ranges of samples.
  WorkList(const FilmSettings& film, uint32_t first_sample, uint32_t end_sample, uint32_t tile_size,
           uint32_t workers);
  /// The same with the samples of `map`, which must outlive the list. Tiles are whole blocks and
  /// not split.
  WorkList(const FilmSettings& film, const SampleMap& map, uint32_t tile_size, uint32_t workers);

  /// The next unit, or nullptr. From any thread.
  const WorkUnit* claim() {
    const size_t i = next_.fetch_add(1, std::memory_order_relaxed);
    return i < units_.size() ? &units_[i] : nullptr;
  }
  const std::vector<WorkUnit>& units() const { return units_; }
  /// Units of each tile.
  uint32_t splits() const { return splits_; }
  /// Whether two units have pixels in common: then each worker needs a film of its own.
  bool shares_pixels() const { return shares_pixels_; }

 private:
  std::vector<WorkUnit> units_;
  std::atomic<size_t> next_{0};
  bool shares_pixels_ = false;
  uint32_t splits_ = 1;
};

/// Lists the paths of a unit.
class WorkCursor {
 public:
  void start(const WorkUnit& unit);
  bool empty() const { return block_ == blocks_.size(); }
  /// Writes pixel (y << 16 | x) and sample of up to `wanted` paths, and returns how many.
  uint32_t take(uint32_t wanted, uint32_t* pixel, uint32_t* sample);

 private:
  struct Block {
    uint32_t pixel;  ///< its first, in pixels_
    uint32_t end_pixel;
    uint32_t sample, end_sample;  ///< `sample`: the next
  };
  std::vector<uint32_t> pixels_;  ///< of the tile, block by block
  std::vector<Block> blocks_;
  size_t block_ = 0;
  uint32_t place_ = 0;  ///< in the block
};

}  // namespace yat

#pragma once
// What one worker writes into feature pictures while its paths go their way. Plain loops: they run
// for a few rows per path, and only where features are asked for.
//
// Parts of the light. A path's slot is a row of SampleSum. With direct or indirect light wanted
// there are two rows per path: what the path brings up to its second vertex goes to its own row,
// then it is moved to the row `batch rows` further on, which collects the rest. Kernels know
// nothing of it.

#include <cstdint>

#include "film/features.h"
#include "kernels/table.h"
#include "scene/compile.h"
#include "soa/columns.h"

namespace yat {

class FeatureRecorder {
 public:
  /// films may be null: nothing is recorded. rows: of the batch.
  FeatureRecorder(const Scene& scene, FeatureFilm* film, uint32_t rows);

  bool active() const { return film_ != nullptr; }
  /// Rows of SampleSum per path.
  static uint32_t sums_per_path(const FeatureFilm* film) {
    return film && (film->has(Feature::kDirect) || film->has(Feature::kIndirect)) ? 2 : 1;
  }

  /// Paths that start in these slots.
  void start(const SampleSum<Column>& sums, const uint32_t* slots, uint32_t n);
  /// Surfaces of a bin that scatters: those that are their paths' first.
  /// Row i counts weight[i] times, and is row order[i] of the batch in `instance`; both are null
  /// for what is no instance.
  void record_surfaces(const Surface<ConstColumn>& surfaces, const PathState<ConstColumn>& paths,
                       const float* weight, const uint32_t* order, const uint32_t* instance,
                       const SampleSum<Column>& sums, uint32_t n);
  /// Moves paths that are about to be scattered again to the row of indirect light.
  void turn_indirect(const uint32_t* depth, uint32_t* slots, uint32_t n) const;
  /// Paths as they go on from a first surface: rows [first, end) of what a shade kernel wrote.
  void record_albedo(const PathState<Column>& paths, const SampleSum<Column>& sums, uint32_t first,
                     uint32_t end);
  /// The path's own row, of either of its rows.
  uint32_t own_row(uint32_t slot) const { return slot < rows_ ? slot : slot - rows_; }
  /// Bands of all light of an ended path; slot is its own row.
  ColourTriple<float> light(const SampleSum<Column>& sums, uint32_t slot) const {
    if (!split_) return {sums.r[slot], sums.g[slot], sums.b[slot]};
    const uint32_t rest = slot + rows_;
    return {sums.r[slot] + sums.r[rest], sums.g[slot] + sums.g[rest], sums.b[slot] + sums.b[rest]};
  }
  void record_light(const SampleSum<Column>& sums, uint32_t slot, const ColourTriple<float>& rgb);

 private:
  enum Seen : uint8_t { kNothing, kSurface, kAlbedo };
  /// Of a primitive row; of a triangle of an object, if `instance` is a row and not kNone.
  SurfaceIds ids_of(uint32_t prim, uint32_t instance) const;
  ColourTriple<float> film_colour(const SampleSum<Column>& sums, uint32_t row) const {
    return rgb_of<float>({sums.r[row], sums.g[row], sums.b[row]}, scene_.colour.film);
  }

  const Scene& scene_;
  FeatureFilm* film_;
  uint32_t rows_;
  bool split_;                  ///< two rows per path
  AlignedArray<uint8_t> seen_;  ///< by slot: how much of the first surface is recorded
};

}  // namespace yat

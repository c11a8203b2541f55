#pragma once
// Renders a range of samples of every pixel into a film: tiles in parallel, each tile's paths in
// wavefronts (batch.h, schedule.cpp).

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/parallel.h"
#include "base/stats.h"
#include "film/features.h"
#include "film/film.h"
#include "wavefront/plan.h"
#include "wavefront/work.h"

namespace yat {

struct RenderOptions {
  uint32_t first_sample = 0, end_sample = 16;  ///< sample indices [first, end) of every pixel
  const SampleMap* samples = nullptr;  ///< instead of these, a range for each block of pixels
  uint32_t batch_rows = 0;             ///< paths in flight per worker; 0: the measured default
  uint32_t tile_size = 0;              ///< pixels along a tile's edge; 0: the measured default
  bool trace = false;                  ///< record TraceSpans
  FeatureFilm* features = nullptr;     ///< feature pictures to add to, of the film's size, or none
  const std::atomic<bool>* stop =
      nullptr;  ///< set: start no new path, finish those under way, return
  /// Called from workers (one at a time) after each tile with the paths done so far.
  std::function<void(uint64_t paths_done, const RenderStats& so_far)> progress;
  /// Called from workers (one at a time) for each tile about when its samples are done: when a
  /// worker has no more paths of the next one to start, or none under way.
  std::function<void()> tile_done;
};

struct RenderResult {
  RenderStats stats;
  DropLog drops;
  std::vector<TraceSpan> trace;
  uint64_t scratch_bytes = 0;  ///< work memory of all workers
  bool stopped = false;        ///< by `stop`, before the range was done
};

/// Adds the samples to `film`, whose size is the crop window's. The film's bits depend on the
/// scene, the plan and the sample range alone (invariant 3).
RenderResult render(const Scene& scene, const Plan& plan, const RenderOptions& options,
                    ThreadPool& pool, Film& film);

}  // namespace yat

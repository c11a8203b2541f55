#pragma once
// One worker's loop (docs/architecture.md, "One ray"): turn after turn, every path under way goes
// on by one vertex, and paths that end make room for new ones.

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/stats.h"
#include "base/ticks.h"
#include "film/film.h"
#include "wavefront/batch.h"
#include "wavefront/feature_recorder.h"
#include "wavefront/plan.h"
#include "wavefront/work.h"

namespace yat {

/// Charges time to stages: each tick of a worker belongs to the stage last entered.
class StageClock {
 public:
  explicit StageClock(bool trace) : trace_(trace), last_(ticks()) {}
  /// Ends the stage under way, and begins `stage` which will see `rows`.
  void enter(Stage stage, uint64_t rows = 0) {
    const uint64_t now = ticks();
    spent_[uint32_t(stage_)] += now - last_;
    if (trace_ && stage_ != Stage::kSchedule && now != last_)
      spans_.push_back({stage_, 0, last_, now, rows_});
    stage_ = stage;
    rows_ = rows;
    last_ = now;
  }
  /// Ticks of each stage since the last call.
  std::array<uint64_t, kStages> take() {
    enter(stage_, rows_);
    return std::exchange(spent_, {});
  }
  /// Spans so far; times are ticks, not nanoseconds.
  std::vector<TraceSpan>& spans() { return spans_; }

 private:
  bool trace_;
  Stage stage_ = Stage::kSchedule;
  uint64_t rows_ = 0, last_;
  std::array<uint64_t, kStages> spent_{};
  std::vector<TraceSpan> spans_;
};

/// What a worker adds up. Not shared: the render collects it now and then.
struct WorkerCount {
  RenderStats stats;  ///< without nanoseconds and drops
  DropLog drops;
};

/// Paths that are started together: the camera rays of a block of pixels.
inline constexpr uint32_t kBeamPaths = 64;

class Worker {
 public:
  /// film, features: where ended paths go; rows of pixels that no other worker touches at the same
  /// time. features may be null.
  Worker(const Scene& scene, const Plan& plan, uint32_t batch_rows, bool trace, Film& film,
         FeatureFilm* features);

  /// Rows that new paths may take: whole beams of camera rays.
  uint32_t free_rows() const {
    const uint32_t whole = batch_.rows < kBeamPaths ? batch_.rows : kBeamPaths;
    return batch_.free_count / whole * whole;
  }
  /// Paths under way.
  uint32_t under_way() const { return count_; }
  /// Paths that start from now on go to the film as if its pixel (0, 0) were (x, y) of the picture,
  /// modulo 2^32. At first that is the corner of the crop window.
  void place_film(uint32_t x, uint32_t y) {
    film_x0_ = x;
    film_y0_ = y;
  }
  /// Starts up to free_rows() paths of `work`.
  void generate(WorkCursor& work);
  /// Takes every path under way one vertex further, and adds those that end to the film.
  void turn();

  StageClock& clock() { return clock_; }
  WorkerCount& counted() { return counted_; }
  size_t bytes() const { return batch_.bytes(); }

 private:
  void intersect();
  void sort();
  void environment();
  void shade();
  /// Dense rows of one material.
  struct ChunkRows {
    Surface<ConstColumn> surfaces;
    Surface<Column> bendable;  ///< the same, for bump maps
    PathState<ConstColumn> paths;
    Tangent<ConstColumn> tangents;  ///< null columns where no material needs them
    Coat<ConstColumn> coats;        ///< null columns where nothing lies over the material
    uint32_t* slots;                ///< those of `paths`, to be changed
    /// With which feature pictures count the rows, of paths that nothing has scattered yet: their
    /// throughput, without what a choice between parts of one solid surface has made of it.
    const float* seen_weight;
    GeometryKind geometry;
    const uint32_t* order;     ///< rows of the hits; for instances only
    const uint32_t* instance;  ///< of all hits; null: not of shared objects
    uint32_t n;
  };
  void shade_bin(const BinPlan& bin, uint32_t begin, uint32_t end);
  /// The material's table, or what its textures make for these rows (until the next call).
  ParameterView parameters_of(const ShadePlan& plan, const ChunkRows& rows);
  void shade_rows(const ShadePlan& plan, const ChunkRows& rows);
  /// u: per row, decides between the children.
  void shade_split(const ShadePlan& plan, const ChunkRows& rows, const float* u, uint32_t level);
  /// Samples a light of a group for each row.
  LightSample<ConstColumn> sample_lights(const ShadePlan& plan, const ChunkRows& rows,
                                         const Randoms<ConstColumn>& drawn, uint32_t number);
  void draw(Dimension dimension, const PathState<ConstColumn>& paths, float* first, float* second,
            uint32_t n);
  /// Tests shadow rays, and adds those that are free to their samples.
  void shadow(const ShadowRay<ConstColumn>& rays, uint32_t n);
  // veils.cpp
  /// Adds what reaches its light of the shadow rays that are free so far.
  void walk_veils(const ShadowRay<ConstColumn>& rays, uint32_t shadow_rays);
  void intersect_veils(uint32_t side, uint32_t n);
  uint32_t pass_veil(const BinPlan& bin, uint32_t side, uint32_t begin, uint32_t end,
                     uint32_t count);
  /// Adds to VeilRows::r, g, b what surfaces of this material let pass of `weight`.
  void add_passing(const ShadePlan& plan, GeometryKind geometry, const Surface<Column>& surfaces,
                   bool turned, const float* weight, uint32_t n, uint32_t level);
  void accumulate();
  /// Paths that have ended, by their rows of SampleSum, to the film.
  void flush(const uint32_t* rows, uint32_t n);
  void count(Stage stage, uint64_t rows);
  void count(Stage stage, uint64_t rows, LaneCount lanes);

  const Scene& scene_;
  const SceneView view_;
  std::vector<SceneView> light_views_;  ///< of each group of lights
  const Plan& plan_;
  const KernelTable& kernels_;
  Film& film_;
  uint32_t film_x0_, film_y0_;  ///< place of its first pixel in the picture
  Batch batch_;
  FeatureRecorder features_;
  StageClock clock_;
  WorkerCount counted_;
  uint32_t current_ = 0;  ///< which of the two pairs holds the paths under way
  uint32_t count_ = 0;    ///< rows in it
  uint32_t fresh_ = 0;    ///< the last of them: camera rays, 64 in a row close together
  uint32_t bin_begin_[kMaxBins + 1] = {};
  ShadeOutput out_;                       ///< shadow rays: of the last light
  std::vector<uint32_t> further_shadow_;  ///< shadow rays of each light before the last
};

}  // namespace yat

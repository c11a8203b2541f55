#pragma once
// Runs passes of one render after each other, counts what they did and shows how far it is.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "app/progress.h"
#include "film/halves.h"
#include "wavefront/render.h"

namespace yat {

class Ticker;

/// What all passes did together.
struct RenderTotals {
  RenderStats stats;
  DropLog drops;
  std::vector<TraceSpan> trace;
  uint64_t scratch_bytes = 0;
  double seconds = 0;
  double pilot_seconds = 0;  ///< of these: what it took to find shadow_bound
  float shadow_bound = 0;    ///< see TransportOptions
  uint32_t passes = 0;
  bool timed_out = false;
  double noise_target = 0;             ///< relMSE; 0: none
  bool adaptive = false;               ///< blocks of pixels got samples by their noise
  std::optional<NoiseEstimate> noise;  ///< of the picture, where a target was given

  bool noise_reached() const { return noise && noise->high() <= noise_target; }
};

/// What every pass of a render has in common.
struct PassContext {
  const Scene& scene;
  const Plan& plan;
  ThreadPool& pool;
  Progress& progress;
  std::atomic<bool>& stop;  ///< set from outside, or at the time limit
  double time_limit = 0;    ///< [s]; 0: none
  bool trace = false;
};

/// Progress is shown about ten times a second from when it is made until finish(). Where shadow
/// rays play roulette their bound is found first, once for all passes.
class PassRunner {
 public:
  explicit PassRunner(const PassContext& context);
  ~PassRunner();
  PassRunner(const PassRunner&) = delete;
  PassRunner& operator=(const PassRunner&) = delete;

  /// Renders what `options` says (samples and features; the rest is filled in) into `film`. Returns
  /// whether all of it is there: false after a stop.
  bool run(RenderOptions options, Film& film);
  /// Paths that all passes will have, as far as known; 0: nobody knows.
  void expect(uint64_t paths);
  double seconds() const;
  /// Whether it is time to stop; sets `stop` if that is because of the time limit.
  bool over();
  /// Stops showing progress.
  RenderTotals finish();

 private:
  ProgressState state();

  const PassContext context_;
  Plan plan_;  ///< the context's, with the bound of shadow rays
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  RenderTotals totals_;
  std::atomic<bool> timed_out_{false};
  std::mutex mutex_;  ///< of what the ticker reads:
  uint64_t paths_now_ = 0, rays_now_ = 0, expected_ = 0;
  std::unique_ptr<Ticker> ticker_;
};

}  // namespace yat

#include "app/passes.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace yat {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Calls f about ten times a second on a thread of its own, until it goes.
class Ticker {
 public:
  explicit Ticker(std::function<void()> f)
      : thread_([this, f = std::move(f)] {
          std::unique_lock lock(mutex_);
          while (!wake_.wait_for(lock, std::chrono::milliseconds(100), [this] { return done_; }))
            f();
        }) {}
  ~Ticker() {
    {
      const std::lock_guard lock(mutex_);
      done_ = true;
    }
    wake_.notify_one();
    thread_.join();
  }
  Ticker(const Ticker&) = delete;
  Ticker& operator=(const Ticker&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false;
  std::thread thread_;
};

constexpr uint32_t kDefaultSamples = 64;
constexpr uint32_t kLastSample = uint32_t(1) << 30;
constexpr uint64_t kFirstPassSamples = uint64_t(1) << 23;

uint64_t rays_of(const RenderStats& stats) {
  return stats.camera_rays + stats.bounce_rays + stats.shadow_rays;
}

void add_drops(const DropLog& from, DropLog& to) {
  for (uint32_t cause = 0; cause < kDropCauses; ++cause) to.count[cause] += from.count[cause];
  for (uint32_t i = 0; i < from.kept && to.kept < DropLog::kKept; ++i)
    to.entry[to.kept++] = from.entry[i];
}

}  // namespace

PassLimits pass_limits(const Arguments& arguments, const FilmSettings& film) {
  PassLimits limits;
  if (arguments.samples_range) {
    limits.samples = *arguments.samples_range;
    return limits;
  }
  // The command line outranks the scene as a whole: `--time 60` is not cut short by a haltspp.
  const bool from_scene = !arguments.samples_per_pixel && !arguments.time_limit;
  const uint32_t halt_spp = from_scene && film.halt_spp > 0 ? uint32_t(film.halt_spp) : 0;
  const double halt_time = from_scene && film.halt_time > 0 ? film.halt_time : 0;
  limits.time_limit = arguments.time_limit.value_or(halt_time);
  if (arguments.samples_per_pixel) {
    limits.samples.end = *arguments.samples_per_pixel;
  } else if (halt_spp) {
    limits.samples.end = halt_spp;
  } else if (limits.time_limit > 0) {
    limits.samples.end = kLastSample;
    limits.unlimited = true;
  } else {
    limits.samples.end = kDefaultSamples;
  }
  return limits;
}

uint32_t next_pass_size(const PassLimits& limits, uint32_t first, uint64_t pixels, double seconds) {
  const uint32_t left = limits.samples.end - first;
  const uint32_t done = first - limits.samples.first;
  uint64_t size = 1;
  if (done > 0) {
    size = std::bit_floor(uint64_t(done));
    if (limits.time_limit > 0 && seconds > 0) {
      const double fits = std::max(0., limits.time_limit - seconds) * double(done) / seconds;
      size = std::min(size, std::bit_floor(std::max<uint64_t>(1, uint64_t(std::min(fits, 1e9)))));
    }
  } else if (limits.time_limit == 0) {
    size = std::bit_floor(std::max<uint64_t>(1, kFirstPassSamples / std::max<uint64_t>(1, pixels)));
  }
  return uint32_t(std::min<uint64_t>(size, left));
}

RenderTotals render_passes(const Scene& scene, const Plan& plan, const PassLimits& limits,
                           bool trace, ThreadPool& pool, Film& film, FeatureFilm* features,
                           Progress& progress, std::atomic<bool>& stop) {
  RenderTotals totals;
  const uint64_t pixels = uint64_t(film.width()) * film.height();
  const Clock::time_point start = Clock::now();

  // Written by the workers, read by the ticker.
  std::mutex mutex;
  uint64_t paths_now = 0, rays_now = 0;
  const auto state = [&] {
    ProgressState now;
    now.seconds = seconds_since(start);
    now.time_limit = limits.time_limit;
    if (!limits.unlimited)
      now.samples_total = uint64_t(limits.samples.end - limits.samples.first) * pixels;
    const std::lock_guard lock(mutex);
    now.samples_done = paths_now;
    now.rays = rays_now;
    return now;
  };
  std::atomic<bool> timed_out{false};
  {
    const Ticker ticker([&] {
      const ProgressState now = state();
      if (limits.time_limit > 0 && now.seconds >= limits.time_limit && !stop.exchange(true))
        timed_out = true;
      progress.show(now);
    });
    uint32_t first = limits.samples.first;
    while (first < limits.samples.end && !stop) {
      const double begin = seconds_since(start);
      if (limits.time_limit > 0 && begin >= limits.time_limit) {
        timed_out = true;
        break;
      }
      const uint32_t size = next_pass_size(limits, first, pixels, begin);
      RenderOptions options;
      options.first_sample = first;
      options.end_sample = first + size;
      options.trace = trace;
      options.features = features;
      options.stop = &stop;
      const uint64_t paths_before = totals.stats.paths, rays_before = rays_of(totals.stats);
      options.progress = [&](uint64_t paths, const RenderStats& so_far) {
        const std::lock_guard lock(mutex);
        paths_now = paths_before + paths;
        rays_now = rays_before + rays_of(so_far);
      };
      RenderResult result = render(scene, plan, options, pool, film);
      totals.stats.merge(result.stats);
      add_drops(result.drops, totals.drops);
      const auto offset = uint64_t(begin * 1e9);
      for (TraceSpan& span : result.trace) {
        span.begin_ns += offset;
        span.end_ns += offset;
        totals.trace.push_back(span);
      }
      totals.scratch_bytes = std::max(totals.scratch_bytes, result.scratch_bytes);
      ++totals.passes;
      first += size;
      {
        const std::lock_guard lock(mutex);
        paths_now = totals.stats.paths;
        rays_now = rays_of(totals.stats);
      }
      if (result.stopped) break;
    }
  }
  totals.seconds = seconds_since(start);
  totals.timed_out = timed_out;
  progress.finish(state());
  return totals;
}

}  // namespace yat

#include "app/pass_runner.h"

#include <algorithm>
#include <condition_variable>
#include <thread>

#include "wavefront/pilot.h"

namespace yat {

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

namespace {

uint64_t rays_of(const RenderStats& stats) {
  return stats.camera_rays + stats.bounce_rays + stats.shadow_rays;
}

void add_drops(const DropLog& from, DropLog& to) {
  for (uint32_t cause = 0; cause < kDropCauses; ++cause) to.count[cause] += from.count[cause];
  for (uint32_t i = 0; i < from.kept && to.kept < DropLog::kKept; ++i)
    to.entry[to.kept++] = from.entry[i];
}

}  // namespace

PassRunner::PassRunner(const PassContext& context) : context_(context), plan_(context.plan) {
  ticker_ = std::make_unique<Ticker>([this] {
    over();
    context_.progress.show(state());
  });
  if (plan_.shadow_roulette == kNoShadowRoulette) return;
  const double begin = seconds();
  set_shadow_bound(context_.scene, plan_);
  totals_.pilot_seconds = seconds() - begin;
  totals_.shadow_bound = plan_.transport.shadow_bound;
}

PassRunner::~PassRunner() = default;

double PassRunner::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

bool PassRunner::over() {
  if (context_.time_limit > 0 && seconds() >= context_.time_limit && !context_.stop.exchange(true))
    timed_out_ = true;
  return context_.stop;
}

void PassRunner::expect(uint64_t paths) {
  const std::lock_guard lock(mutex_);
  expected_ = paths;
}

ProgressState PassRunner::state() {
  ProgressState now;
  now.seconds = seconds();
  now.time_limit = context_.time_limit;
  const std::lock_guard lock(mutex_);
  now.samples_total = expected_;
  now.samples_done = paths_now_;
  now.rays = rays_now_;
  return now;
}

bool PassRunner::run(RenderOptions options, Film& film) {
  const double begin = seconds();
  const uint64_t paths_before = totals_.stats.paths, rays_before = rays_of(totals_.stats);
  options.trace = context_.trace;
  options.stop = &context_.stop;
  options.progress = [&](uint64_t paths, const RenderStats& so_far) {
    const std::lock_guard lock(mutex_);
    paths_now_ = paths_before + paths;
    rays_now_ = rays_before + rays_of(so_far);
  };
  RenderResult result = render(context_.scene, plan_, options, context_.pool, film);
  totals_.stats.merge(result.stats);
  add_drops(result.drops, totals_.drops);
  const auto offset = uint64_t(begin * 1e9);
  for (TraceSpan& span : result.trace) {
    span.begin_ns += offset;
    span.end_ns += offset;
    totals_.trace.push_back(span);
  }
  totals_.scratch_bytes = std::max(totals_.scratch_bytes, result.scratch_bytes);
  ++totals_.passes;
  const std::lock_guard lock(mutex_);
  paths_now_ = totals_.stats.paths;
  rays_now_ = rays_of(totals_.stats);
  return !result.stopped;
}

RenderTotals PassRunner::finish() {
  ticker_.reset();
  totals_.seconds = seconds();
  totals_.timed_out = timed_out_;
  context_.progress.finish(state());
  return std::move(totals_);
}

}  // namespace yat

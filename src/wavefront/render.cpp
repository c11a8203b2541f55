#include "wavefront/render.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>

#include "base/ticks.h"
#include "wavefront/schedule.h"
#include "wavefront/work.h"

namespace yat {

namespace {

/// Paths under way per worker, as measured (docs/decisions.md, "Rows of a batch"): as many as fill
/// traversal's streams while the batch stays near the processor.
constexpr uint32_t kBatchRows = 8192;

/// What the workers share: the units, and the sums of what they counted.
struct Shared {
  Shared(const Scene& the_scene, const Plan& the_plan, const RenderOptions& the_options,
         uint32_t workers, Film& the_film)
      : scene(the_scene),
        plan(the_plan),
        options(the_options),
        film(the_film),
        work(options.samples ? WorkList(scene.film, *options.samples, options.tile_size, workers)
                             : WorkList(scene.film, options.first_sample, options.end_sample,
                                        options.tile_size, workers)),
        batch_rows(padded_rows(options.batch_rows ? options.batch_rows : kBatchRows)) {
    if (options.tile_done) units_left.resize(work.units().size() / work.splits(), work.splits());
  }

  const Scene& scene;
  const Plan& plan;
  const RenderOptions& options;
  Film& film;
  WorkList work;
  uint32_t batch_rows;
  TickScale scale;
  std::mutex mutex;  ///< guards what follows, and film where units share pixels
  RenderResult result;
  std::vector<uint32_t> units_left;  ///< of each tile; empty if nobody asks

  bool stop_wanted() const { return options.stop && options.stop->load(std::memory_order_relaxed); }
};

void merge_drops(DropLog& to, const DropLog& from) {
  for (uint32_t i = 0; i < kDropCauses; ++i) to.count[i] += from.count[i];
  for (uint32_t i = 0; i < from.kept && to.kept < DropLog::kKept; ++i)
    to.entry[to.kept++] = from.entry[i];
}

/// Moves what the worker has counted into the shared sums. Holds the mutex.
void collect(Shared& shared, Worker& worker) {
  WorkerCount& counted = worker.counted();
  const std::array<uint64_t, kStages> spent = worker.clock().take();
  const double scale = shared.scale.nanoseconds_per_tick();
  for (uint32_t i = 0; i < kStages; ++i)
    counted.stats.stages[i].nanoseconds = uint64_t(double(spent[i]) * scale);
  static_assert(kDropCauses <= std::tuple_size_v<decltype(RenderStats::dropped)>);
  std::copy_n(counted.drops.count, kDropCauses, counted.stats.dropped.begin());
  shared.result.stats.merge(counted.stats);
  merge_drops(shared.result.drops, counted.drops);
  counted = {};
}

/// The unit's paths are done, or nearly. Holds the mutex.
void unit_done(Shared& shared, const WorkUnit* unit) {
  if (unit && shared.options.tile_done && --shared.units_left[unit->tile] == 0)
    shared.options.tile_done();
}

/// One worker: claims units until there are none, and keeps its batch full meanwhile.
void run_worker(Shared& shared, uint32_t index) {
  if (shared.stop_wanted()) return;
  const WorkUnit* unit = shared.work.claim();
  if (!unit) return;
  // Where units share pixels every worker adds to a film of its own, merged at the end: the sums
  // are exact, so the picture is the same.
  std::optional<Film> own_film;
  std::optional<FeatureFilm> own_features;
  FeatureFilm* const features = shared.options.features;
  if (shared.work.shares_pixels()) {
    own_film.emplace(shared.film.width(), shared.film.height());
    if (features) own_features.emplace(shared.film.width(), shared.film.height(), features->set());
  }
  Worker worker(shared.scene, shared.plan, shared.batch_rows, shared.options.trace,
                own_film ? *own_film : shared.film, own_features ? &*own_features : features);
  WorkCursor cursor;
  cursor.start(*unit);
  const WorkUnit* ending = nullptr;  // has no path left to start; the last are under way
  for (;;) {
    // New paths come from the next unit as soon as this one has none left, while the last paths of
    // this one are still under way: batches run dry once in a render, not once in a tile.
    while (unit && worker.free_rows()) {
      if (shared.stop_wanted()) {
        if (!cursor.empty()) {
          const std::lock_guard lock(shared.mutex);
          shared.result.stopped = true;
        }
        unit = nullptr;
        break;
      }
      if (cursor.empty()) {
        {
          const std::lock_guard lock(shared.mutex);
          collect(shared, worker);
          if (shared.options.progress)
            shared.options.progress(shared.result.stats.paths, shared.result.stats);
          unit_done(shared, ending);
          ending = unit;
        }
        unit = shared.work.claim();
        if (unit) cursor.start(*unit);
      } else {
        worker.generate(cursor);
      }
    }
    if (!worker.under_way()) break;
    worker.turn();
  }

  const std::lock_guard lock(shared.mutex);
  collect(shared, worker);
  if (shared.options.progress)
    shared.options.progress(shared.result.stats.paths, shared.result.stats);
  unit_done(shared, ending);
  if (own_film) shared.film.merge(*own_film);
  if (own_features) features->merge(*own_features);
  shared.result.scratch_bytes += worker.bytes() + (own_film ? own_film->bytes() : 0);
  for (TraceSpan& span : worker.clock().spans()) {
    span.worker = index;
    shared.result.trace.push_back(span);
  }
}

}  // namespace

RenderResult render(const Scene& scene, const Plan& plan, const RenderOptions& options,
                    ThreadPool& pool, Film& film) {
  if (film.width() != scene.film.crop_width() || film.height() != scene.film.crop_height())
    throw std::invalid_argument("render: the film is not of the crop window's size");
  const uint32_t workers = pool.threads();
  Shared shared(scene, plan, options, workers, film);
  pool.for_each(workers, [&](uint32_t index, uint32_t) { run_worker(shared, index); });
  // A worker that never claimed a unit leaves units behind; so does one that stopped.
  shared.result.stopped = shared.result.stopped || shared.work.claim() != nullptr;

  const double scale = shared.scale.nanoseconds_per_tick();
  const uint64_t start = shared.scale.start_ticks();
  const auto nanoseconds = [&](uint64_t t) {
    return t > start ? uint64_t(double(t - start) * scale) : 0;
  };
  for (TraceSpan& span : shared.result.trace) {
    span.begin_ns = nanoseconds(span.begin_ns);
    span.end_ns = nanoseconds(span.end_ns);
  }
  return std::move(shared.result);
}

}  // namespace yat

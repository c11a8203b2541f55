#pragma once
// The only include of oneTBB (with parallel.cpp): pools of a fixed number of workers each.

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <cstdint>
#include <thread>
#include <utility>

#include "base/fork_join.h"

namespace yat {

/// Lets oneTBB have as many workers as the largest living pool asks for: by itself it starts one
/// per processor. Of several controls oneTBB obeys the lowest, so all pools share one, and what
/// limits a pool is its arena alone.
class WorkerLimit {
 public:
  explicit WorkerLimit(uint32_t threads);
  ~WorkerLimit();
  WorkerLimit(const WorkerLimit&) = delete;
  WorkerLimit& operator=(const WorkerLimit&) = delete;

 private:
  uint32_t threads_;
};

/// Runs work on `threads` workers, whatever other pools there are. Results must not depend on which
/// worker does what.
class ThreadPool {
 public:
  /// threads = 0: one per processor that this process may use.
  explicit ThreadPool(uint32_t threads = 0)
      : threads_(threads ? threads : default_threads()), limit_(threads_), arena_(int(threads_)) {}

  uint32_t threads() const { return threads_; }

  /// Calls f(index, worker) for every index in [0, count), in any order; worker in [0, threads()).
  template <class F>
  void for_each(uint32_t count, F&& f) {
    auto piece = [&](const tbb::blocked_range<uint32_t>& range) {
      const auto worker = uint32_t(tbb::this_task_arena::current_thread_index());
      for (uint32_t i = range.begin(); i != range.end(); ++i) f(i, worker);
    };
    const ForkedBody body(piece);
    const ForkJoin job;
    arena_.execute([&] {
      tbb::parallel_for(tbb::blocked_range<uint32_t>(0, count, 1), body, tbb::simple_partitioner());
    });
  }

  /// Runs f in the pool; parallel_invoke and parallel_for inside it use its workers.
  template <class F>
  auto run(F&& f) {
    return arena_.execute(std::forward<F>(f));
  }

  static uint32_t default_threads() { return uint32_t(tbb::this_task_arena::max_concurrency()); }

 private:
  uint32_t threads_;
  WorkerLimit limit_;
  tbb::task_arena arena_;
};

/// Both, perhaps at the same time. Inside ThreadPool::run.
template <class F, class G>
void parallel_invoke(F&& f, G&& g) {
  const ForkedBody first(f);
  const ForkedBody second(g);
  const ForkJoin job;
  tbb::parallel_invoke(first, second);
}

/// Which worker this is, in [0, threads()) of its pool. Inside ThreadPool::run.
inline uint32_t worker_index() {
  return uint32_t(tbb::this_task_arena::current_thread_index());
}

/// f(begin, end) over pieces of [0, count) of at least `grain`. Inside ThreadPool::run. The pieces
/// depend on the machine: results must not.
template <class F>
void parallel_ranges(uint32_t count, uint32_t grain, F&& f) {
  auto piece = [&](const tbb::blocked_range<uint32_t>& r) { f(r.begin(), r.end()); };
  const ForkedBody body(piece);
  const ForkJoin job;
  tbb::parallel_for(tbb::blocked_range<uint32_t>(0, count, grain), body);
}

}  // namespace yat

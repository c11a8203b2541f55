#include "base/parallel.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <set>

namespace yat {

namespace {

struct Wishes {
  std::mutex mutex;
  std::multiset<uint32_t> threads;  ///< of the living pools
  std::unique_ptr<tbb::global_control> control;

  /// Holds the mutex. The new control comes before the old one goes: between them the lower of both
  /// counts, never oneTBB's default.
  void apply() {
    if (threads.empty()) {
      control.reset();
      return;
    }
    const size_t most = std::max<size_t>(*threads.rbegin(), ThreadPool::default_threads());
    control =
        std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, most);
  }
};

Wishes& wishes() {
  static Wishes all;
  return all;
}

}  // namespace

WorkerLimit::WorkerLimit(uint32_t threads) : threads_(threads) {
  Wishes& all = wishes();
  const std::lock_guard lock(all.mutex);
  all.threads.insert(threads_);
  all.apply();
}

WorkerLimit::~WorkerLimit() {
  Wishes& all = wishes();
  const std::lock_guard lock(all.mutex);
  all.threads.erase(all.threads.find(threads_));
  all.apply();
}

}  // namespace yat

// Thread pools: as many workers as asked for, whatever the machine and other pools have.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <thread>

#include "base/parallel.h"

namespace yat {
namespace {

/// Workers that are at work at the same time. Tasks wait for each other, so that none can take the
/// work of another; the limit only keeps a failure from hanging.
uint32_t workers_at_once(ThreadPool& pool, uint32_t tasks) {
  std::atomic<uint32_t> inside{0};
  std::mutex mutex;
  std::set<uint32_t> slots;
  pool.for_each(tasks, [&](uint32_t, uint32_t worker) {
    {
      const std::lock_guard lock(mutex);
      slots.insert(worker);
    }
    ++inside;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
    while (inside < tasks && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  });
  EXPECT_LT(*slots.rbegin(), pool.threads());
  return uint32_t(slots.size());
}

TEST(ThreadPool, GivesAsManyWorkersAsAskedFor) {
  for (const uint32_t threads : {1u, 2u, 3u, 7u, 16u}) {
    ThreadPool pool(threads);
    EXPECT_EQ(pool.threads(), threads);
    EXPECT_EQ(workers_at_once(pool, threads), threads);
  }
}

TEST(ThreadPool, PoolsDoNotLimitEachOther) {
  ThreadPool one(1);
  ThreadPool seven(7);
  {
    ThreadPool two(2);
    EXPECT_EQ(workers_at_once(seven, 7), 7u);
    EXPECT_EQ(workers_at_once(two, 2), 2u);
    EXPECT_EQ(workers_at_once(one, 1), 1u);
  }
  EXPECT_EQ(workers_at_once(seven, 7), 7u);
}

TEST(ThreadPool, WorkerNumbersStayBelowItsOwnCount) {
  ThreadPool many(16);
  ThreadPool few(3);
  std::atomic<uint32_t> beyond{0};
  few.for_each(2000, [&](uint32_t, uint32_t worker) { beyond += worker >= 3; });
  EXPECT_EQ(beyond, 0u);
}

}  // namespace
}  // namespace yat

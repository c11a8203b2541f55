#include "thread_control.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "measure.h"

namespace yat::bench {
namespace {

/// Independent multiply-adds, about 20 ms of them. The answer is returned so that they are done.
float arithmetic() {
  float a[64];
  for (int k = 0; k < 64; ++k) a[k] = 1.f + float(k) * 1e-3f;
  for (int i = 0; i < 3000000; ++i)
    for (float& x : a) x = x * .9999999f + 1e-7f;
  float sum = 0;
  for (const float x : a) sum += x;
  return sum;
}

double seconds_on(uint32_t threads) {
  std::atomic<uint32_t> ready{0};
  std::atomic<float> kept{0};
  std::vector<double> seconds(threads);
  const auto work = [&](uint32_t worker) {
    ++ready;
    while (ready < threads) std::this_thread::yield();
    const double start = wall_seconds();
    kept = arithmetic();
    seconds[worker] = wall_seconds() - start;
  };
  std::vector<std::thread> others;
  for (uint32_t worker = 1; worker < threads; ++worker) others.emplace_back(work, worker);
  work(0);
  for (std::thread& other : others) other.join();
  return *std::max_element(seconds.begin(), seconds.end()) / threads;
}

}  // namespace

double registers_gain(uint32_t threads) {
  std::vector<double> gains;
  for (int round = 0; round < 9; ++round) gains.push_back(seconds_on(1) / seconds_on(threads));
  return median(gains);
}

}  // namespace yat::bench

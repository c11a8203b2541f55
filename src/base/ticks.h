#pragma once
// The processor's constant-rate counter: cheap enough (some 20 cycles) to be read around every
// stage of every chunk, which the system's clock is not.

#include <chrono>
#include <cstdint>

#if defined(__x86_64__)
#include <x86intrin.h>
#endif

namespace yat {

inline uint64_t ticks() {
#if defined(__x86_64__)
  return __rdtsc();
#elif defined(__aarch64__)
  uint64_t now;
  asm volatile("mrs %0, cntvct_el0" : "=r"(now));
  return now;
#else
  return uint64_t(std::chrono::steady_clock::now().time_since_epoch().count());
#endif
}

/// Turns ticks into nanoseconds by comparing both clocks from its construction on.
class TickScale {
 public:
  TickScale() : start_ticks_(ticks()), start_(std::chrono::steady_clock::now()) {}
  uint64_t start_ticks() const { return start_ticks_; }
  /// Nanoseconds per tick, from the time that has passed since construction.
  double nanoseconds_per_tick() const {
    const double passed =
        std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start_).count();
    const uint64_t passed_ticks = ticks() - start_ticks_;
    return passed_ticks ? passed / double(passed_ticks) : 0;
  }

 private:
  uint64_t start_ticks_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace yat

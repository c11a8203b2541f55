#pragma once
// Processor time of this thread: what a kernel costs, also on a machine that others use.

#include <ctime>

namespace yat::bench {

inline double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

}  // namespace yat::bench

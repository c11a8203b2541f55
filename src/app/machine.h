#pragma once
// The machine that runs this, and what this process has used of it.

#include <cstdint>
#include <string>

namespace yat {

struct Machine {
  std::string cpu;            ///< model name, or the architecture where there is none
  uint32_t processors = 0;    ///< that the system has
  uint64_t memory_bytes = 0;  ///< of main memory
  double clock_mhz = 0;       ///< of the first processor now; 0: not known
  std::string governor;       ///< of its clock (Linux cpufreq), empty where there is none
};

Machine this_machine();

/// User and system time of all threads so far [s].
double cpu_seconds();
/// Memory that this process may still take without swapping, by the system and by the limits of its
/// control group [bytes]; 0: not known.
uint64_t available_memory_bytes();
/// Most memory held at once so far [bytes].
uint64_t peak_memory_bytes();

}  // namespace yat

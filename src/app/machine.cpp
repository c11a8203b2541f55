#include "app/machine.h"

#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>

namespace yat {

namespace {
double seconds_of(const timeval& time) {
  return double(time.tv_sec) + double(time.tv_usec) * 1e-6;
}
}  // namespace

Machine this_machine() {
  Machine machine;
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const size_t colon = line.find(": ");
    if (colon == std::string::npos) continue;
    if (line.starts_with("model name") && machine.cpu.empty()) machine.cpu = line.substr(colon + 2);
    if (line.starts_with("cpu MHz") && machine.clock_mhz == 0)
      machine.clock_mhz = std::strtod(line.c_str() + colon + 2, nullptr);
  }
  if (utsname name{}; machine.cpu.empty() && uname(&name) == 0) machine.cpu = name.machine;
  std::ifstream("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor") >> machine.governor;
  machine.processors = uint32_t(std::max(0l, sysconf(_SC_NPROCESSORS_ONLN)));
  machine.memory_bytes = uint64_t(std::max(0l, sysconf(_SC_PHYS_PAGES))) *
                         uint64_t(std::max(0l, sysconf(_SC_PAGE_SIZE)));
  return machine;
}

double cpu_seconds() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
}

uint64_t available_memory_bytes() {
  uint64_t available = 0;
  std::ifstream info("/proc/meminfo");
  for (std::string line; std::getline(info, line);) {
    constexpr std::string_view kKey = "MemAvailable:";
    if (!line.starts_with(kKey)) continue;
    available = std::strtoull(line.c_str() + kKey.size(), nullptr, 10) * 1024;
    break;
  }
  // Control group of a container, version 2; "max" reads as no number.
  uint64_t limit = 0, used = 0;
  if (std::ifstream("/sys/fs/cgroup/memory.max") >> limit &&
      std::ifstream("/sys/fs/cgroup/memory.current") >> used) {
    const uint64_t left = limit > used ? limit - used : 1;
    available = available ? std::min(available, left) : left;
  }
  return available;
}

uint64_t peak_memory_bytes() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return uint64_t(usage.ru_maxrss) * 1024;
}

}  // namespace yat

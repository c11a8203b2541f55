#include "measure.h"

#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fstream>
#include <string_view>

#include "app/build_info.h"
#include "app/machine.h"
#include "base/error.h"
#include "base/whole_file.h"

namespace yat::bench {
namespace {

double seconds_of(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

/// A field of /proc/self/status [bytes].
uint64_t status_bytes(std::string_view key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(key)) return std::strtoull(line.c_str() + key.size(), nullptr, 10) * 1024;
  return 0;
}

}  // namespace

double thread_seconds() {
  return seconds_of(CLOCK_THREAD_CPUTIME_ID);
}
double process_seconds() {
  return seconds_of(CLOCK_PROCESS_CPUTIME_ID);
}
double wall_seconds() {
  return seconds_of(CLOCK_MONOTONIC);
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const size_t middle = values.size() / 2;
  return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

double geometric_mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += std::log(value);
  return values.empty() ? 0 : std::exp(sum / double(values.size()));
}

uint64_t resident_bytes() {
  return status_bytes("VmRSS:");
}
uint64_t peak_resident_bytes() {
  return status_bytes("VmHWM:");
}

bool reset_peak_bytes() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
  std::ofstream file("/proc/self/clear_refs");
  file << "5";
  return bool(file.flush());
}

Json origin(const std::string& program) {
  const Machine machine = this_machine();
  const std::time_t now = std::time(nullptr);
  char date[32] = {};
  std::strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
  return {
      {"program", program},
      {"date", date},
      {"commit", kBuildInfo.commit},
      {"compiler", kBuildInfo.compiler},
      {"flags", kBuildInfo.flags},
      {"machine",
       {{"cpu", machine.cpu}, {"cores", machine.processors}, {"memory", machine.memory_bytes}}}};
}

void write_json(const std::string& file, const Json& json) {
  write_whole_file(file, json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

int run_program(const char* name, int (*run)(int, char**), int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const UsageError& error) {
    fmt::print(stderr, "{}: {}\n", name, error.what());
    return 2;
  } catch (const ResourceError& error) {
    fmt::print(stderr, "{}: {}\n", name, error.what());
    return 3;
  } catch (const Error& error) {
    fmt::print(stderr, "{}\n", error.what());  // The message names the file.
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", name, error.what());
  }
  return 1;
}

}  // namespace yat::bench

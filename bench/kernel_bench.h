#pragma once
// How a kernel is timed: rows a call, manual time around the call alone, so that inputs that the
// kernel changes can be put back untimed.

#include <benchmark/benchmark.h>

#include <chrono>
#include <cstdint>
#include <string>

#include "kernels/dispatch.h"

namespace yat::bench {

/// Shares of rows with work to do [percent].
inline constexpr uint32_t kShares[] = {100, 75, 50, 25};

/// Whether row i is among the `percent` active rows. Spread evenly and without a pattern that a
/// lane count divides (a hash of the row).
inline bool is_active(uint32_t i, uint32_t percent) {
  const uint32_t hash = (i ^ (i >> 7)) * 2654435761u;
  return (hash >> 8) % 100 < percent;
}

/// Times `call`, after an untimed `prepare`, until the benchmark has enough. Rows are the rows
/// handed to the kernel, active or not.
template <class Prepare, class Call>
void time_rows(benchmark::State& state, uint32_t rows, Prepare&& prepare, Call&& call) {
  for (auto _ : state) {
    prepare();
    const auto begin = std::chrono::steady_clock::now();
    call();
    benchmark::ClobberMemory();
    const auto end = std::chrono::steady_clock::now();
    state.SetIterationTime(std::chrono::duration<double>(end - begin).count());
  }
  using benchmark::Counter;
  // Google Benchmark prints an inverted rate in seconds with its own prefix: "1.5n" is 1.5 ns.
  state.counters["s/row"] =
      Counter(double(rows), Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["rows/s"] = Counter(double(rows), Counter::kIsIterationInvariantRate);
}
template <class Call>
void time_rows(benchmark::State& state, uint32_t rows, Call&& call) {
  time_rows(state, rows, [] {}, std::forward<Call>(call));
}

/// The share of lanes that had work, where the kernel counted them.
inline void show_lanes(benchmark::State& state, const KernelTable& table, const LaneCount& lanes) {
  if (lanes.steps)
    state.counters["lanes"] = double(lanes.rows) / (double(lanes.steps) * table.lanes);
}

/// Registers "kernel/isa" or "kernel/isa/active:75".
template <class F>
void add_benchmark(const std::string& kernel, const KernelTable& table, F f) {
  benchmark::RegisterBenchmark((kernel + "/" + table.isa).c_str(), std::move(f))->UseManualTime();
}
template <class F>
void add_share_benchmarks(const std::string& kernel, const KernelTable& table, F f) {
  for (const uint32_t share : kShares)
    benchmark::RegisterBenchmark(
        (kernel + "/" + table.isa + "/active:" + std::to_string(share)).c_str(),
        [f, share](benchmark::State& state) { f(state, share); })
        ->UseManualTime();
}

/// A copy of rays in which only a share is alive: the others have no length.
Table<Ray> with_share(const Table<Ray>& rays, uint32_t n, uint32_t share);
Table<ShadowRay> with_share(const Table<ShadowRay>& rays, uint32_t n, uint32_t share);

/// A table entry that is null is a finding: it is counted, shown as an error in the results, and
/// the program ends with 1.
void add_missing(const std::string& kernel, const KernelTable& table);
uint32_t missing_entries();

/// Stops a benchmark whose inputs could not be recorded.
inline void no_rows(benchmark::State& state) {
  state.SkipWithError(
      "no rows recorded: a kernel that comes before is missing, or the scene has none");
}

void add_traversal_benchmarks(const KernelTable& table);
void add_instance_benchmarks(const KernelTable& table);
void add_shading_benchmarks(const KernelTable& table);
void add_bsdf_benchmarks(const KernelTable& table);
void add_film_benchmarks();

}  // namespace yat::bench

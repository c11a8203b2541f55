// bench_kernels: every entry of every kernel table that runs here, on recorded columns. Options are
// Google Benchmark's; for example
//   bench_kernels --benchmark_filter='intersect_closest/.*avx2' --benchmark_out=results.json

#include <cstdio>

#include "kernel_bench.h"

namespace yat::bench {

namespace {
uint32_t missing = 0;
}

void add_missing(const std::string& kernel, const KernelTable& table) {
  ++missing;
  std::fprintf(stderr, "missing: %s in the table of %s\n", kernel.c_str(), table.isa);
  add_benchmark(kernel, table, [](benchmark::State& state) {
    state.SkipWithError("missing in the kernel table");
  });
}

uint32_t missing_entries() {
  return missing;
}

}  // namespace yat::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  for (const yat::IsaEntry& isa : yat::built_isas()) {
    if (!isa.here) {
      std::fprintf(stderr, "not measured: this machine does not run %s\n", isa.name);
      continue;
    }
    const yat::KernelTable& table = *isa.table();
    yat::bench::add_traversal_benchmarks(table);
    yat::bench::add_instance_benchmarks(table);
    yat::bench::add_shading_benchmarks(table);
    yat::bench::add_bsdf_benchmarks(table);
  }
  yat::bench::add_film_benchmarks();
  benchmark::RunSpecifiedBenchmarks();
  if (yat::bench::missing_entries()) {
    std::fprintf(stderr, "%u entries of the kernel tables are missing\n",
                 yat::bench::missing_entries());
    return 1;
  }
  return 0;
}

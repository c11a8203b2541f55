#pragma once
// The table of bench_traversal: kernels and Embree's variants over the same rays, in turn.

#include <memory>
#include <string>
#include <vector>

#include "measure.h"
#include "record_scene.h"
#include "traced_set.h"

namespace yat::bench {

struct TableOptions {
  std::vector<std::string> isas;     ///< empty: the one that YAT_ISA or the machine chooses
  std::vector<std::string> trees;    ///< "auto", "kd"
  std::vector<uint32_t> streams;     ///< rows; 0: by kind of ray
  std::vector<std::string> kernels;  ///< of trace_kernel_names()
  std::vector<uint32_t> threads;     ///< beside 1
  uint32_t repetitions = 7;
  double seconds = 60;  ///< after three rounds, start no other once a set has taken this long
  bool embree = true;
};

/// A scene, its rays, and the trees and kernels to trace them by. Does not move: configs point to
/// trees.
struct Prepared {
  BenchScene scene;
  std::vector<RaySet> sets;
  std::vector<std::unique_ptr<Tree>> trees;
  std::vector<Config> configs;
};

/// Builds the trees; records the sets from the scene's viewpoint if there are none. The rays are
/// always recorded by the best kernels that run here, so that they are the same for all tables.
std::unique_ptr<Prepared> prepare(Recording recording, uint32_t resolution,
                                  const TableOptions& options);

/// The best that run here, whatever YAT_ISA says.
const KernelTable& best_kernels();

/// Prints one scene's table and returns it for the report. `wrong` counts answers of yat that are
/// wrong or were not looked at.
Json run_table(const Prepared& prepared, const TableOptions& options, uint64_t& wrong);

/// The geometric mean of the path-mix ratios of all scenes, per config, from what run_table
/// returned.
void print_summary(const Json& scenes);

}  // namespace yat::bench

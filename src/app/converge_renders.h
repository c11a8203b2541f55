#pragma once
// The scenes of an experiment, compiled once for all variants that can share them, and a run.

#include <atomic>
#include <map>
#include <memory>
#include <string>

#include "app/converge_options.h"
#include "app/load.h"
#include "app/passes.h"
#include "converge/ladder.h"
#include "metrics/image.h"

namespace yat {

/// What one run gave.
struct RunResult {
  Image image;
  RenderTotals totals;     ///< .seconds: wall time of rendering alone
  double cpu_seconds = 0;  ///< of all threads meanwhile
  double samples_per_pixel = 0;
  uint64_t film_bytes = 0;
};

/// One variant's scene, kernels and workers.
struct ConvergeScene {
  Loaded loaded;
  const KernelTable* kernels = nullptr;
  uint64_t bytes = 0;
};

class ConvergeRenders {
 public:
  /// Reads and compiles what the variants need. What is to be said of a scene is said once. Throws
  /// Error, also if pictures of two variants would have different sizes.
  ConvergeRenders(const ConvergeArguments& arguments, Console& console);

  const ConvergeScene& scene(const ConvergeVariant& variant) const {
    return *scenes_.at(variant.scene_key);
  }
  Plan plan(const ConvergeVariant& variant, uint32_t spp, uint32_t seed) const;
  uint32_t threads(const ConvergeVariant& variant) const { return pool(variant).threads(); }

  /// spp: of the variant's ladder, or others; a variant with a noise target takes what that needs.
  /// Throws Error if all samples were dropped. Not complete if `stop` was set meanwhile.
  RunResult run(const ConvergeVariant& variant, uint32_t spp, uint32_t seed, Progress& progress,
                std::atomic<bool>& stop) const;

 private:
  ThreadPool& pool(const ConvergeVariant& variant) const;
  std::map<std::string, std::unique_ptr<ConvergeScene>> scenes_;  ///< by scene_key
  std::map<uint32_t, std::unique_ptr<ThreadPool>> pools_;         ///< by --threads
};

}  // namespace yat

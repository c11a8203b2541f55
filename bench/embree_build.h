#pragma once
// Embree's build of the same triangles.

#include <cstdint>
#include <memory>
#include <string>

#include "bench_scenes.h"

namespace yat::bench {

enum class EmbreeQuality { kMedium, kHigh };

/// "medium", "high".
const char* embree_quality_name(EmbreeQuality quality);
/// "3.13.5".
std::string embree_version();

/// Builds one scene's tree again and again on `threads` threads. While it lives, oneTBB runs no
/// more than that in the whole process.
class EmbreeBuilder {
 public:
  EmbreeBuilder(const BenchScene& scene, uint32_t threads);
  ~EmbreeBuilder();

  /// Of the commit: [s] that passed, [s] of processor time of all threads, and by Embree's memory
  /// monitor the bytes it then held and the most while building.
  struct Result {
    double wall = 0, cpu = 0;
    uint64_t bytes = 0, peak_bytes = 0;
  };
  Result build(EmbreeQuality quality);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace yat::bench

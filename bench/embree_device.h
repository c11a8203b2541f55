#pragma once
// Embree 3 or 4 as the benchmarks use it; only files that are built with Embree include this.

#if YAT_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "embree_build.h"

namespace yat::bench {

/// A device of `threads` threads, and the memory that Embree says it holds.
class EmbreeDevice {
 public:
  explicit EmbreeDevice(uint32_t threads);
  ~EmbreeDevice();
  EmbreeDevice(const EmbreeDevice&) = delete;
  EmbreeDevice& operator=(const EmbreeDevice&) = delete;

  RTCDevice handle() const { return handle_; }
  int64_t bytes() const { return bytes_; }
  int64_t peak_bytes() const { return peak_; }
  void reset_peak() { peak_ = bytes_.load(); }

 private:
  static bool on_memory(void* self, ssize_t bytes, bool post);
  std::atomic<int64_t> bytes_{0}, peak_{0};
  RTCDevice handle_;
};

/// The triangles in the form that Embree reads in place: it copies what it needs into its tree, and
/// what its memory monitor counts is the tree and the work of building it.
struct EmbreeMesh {
  std::vector<float> vertices;  ///< 3 per triangle corner, and padding for a 16-byte load
  std::vector<uint32_t> indices;
  explicit EmbreeMesh(const BenchScene& scene);
};

/// A committed scene. Release it before the device and the mesh.
RTCScene make_embree_scene(const EmbreeDevice& device, const EmbreeMesh& mesh,
                           EmbreeQuality quality);

}  // namespace yat::bench

#pragma once
// A set's rays in columns, traced by one kernel over one tree in streams.

#include <cstdint>
#include <string>
#include <vector>

#include "kernels/table.h"
#include "ray_sets.h"
#include "scene/tree_build.h"

namespace yat::bench {

/// A way to trace rays; the functions are as in KernelTable.
struct TraceKernel {
  using Closest = LaneCount (*)(const TreeView&, const Ray<ConstColumn>&, const Hit<Column>&,
                                uint32_t n, const Scratch&) noexcept;
  using Shadow = LaneCount (*)(const TreeView&, const ShadowRay<ConstColumn>&, uint32_t* occluded,
                               uint32_t n, const Scratch&) noexcept;
  std::string name;
  size_t (*scratch_bytes)(const TreeView&, uint32_t max_rays) noexcept;
  Closest camera;  ///< for the camera's rays, of which 64 in a row lie close together
  Closest closest;
  Shadow shadow;
};

/// "render": as a render traces, camera rays in tiles and the others in streams; "stream": all in
/// streams; "scalar": plain code over the same tree.
std::vector<TraceKernel> trace_kernels(const KernelTable& table);
/// Their names, in that order.
std::vector<std::string> trace_kernel_names();

/// What is measured: a kernel of an instruction set over a kind of tree, in streams of so many
/// rows.
struct Config {
  const KernelTable* table = nullptr;
  TraceKernel kernel;
  std::string tree_kind;  ///< "auto" or "kd"
  const Tree* tree = nullptr;
  uint32_t stream = 0;  ///< rows; 0: as suits the set, stream_rows()
  std::string name() const;
};

/// Rows of a stream by kind of ray: longer lists for rays that go all ways.
uint32_t stream_rows(const RaySet& set);

/// Time of one trace of a whole set [s].
struct TraceTime {
  double cpu = 0;   ///< processor time, of all threads
  double wall = 0;  ///< time that passed
  LaneCount lanes;
};

class TracedSet {
 public:
  TracedSet(const Config& config, const RaySet& set);

  /// All rays on this thread.
  TraceTime trace();
  /// All rays on each of `threads` threads at once, each with memory of its own as the workers of a
  /// render have, again and again for at least 20 ms after a pass that fills the caches; times are
  /// those of one pass divided by the threads, that is for one set.
  TraceTime trace_on(uint32_t threads);

  /// Answers of the first thread's last trace. A shadow ray: prim = 0 where it is stopped, else
  /// kNone.
  Hit<Value> hit(uint32_t row) const;
  uint32_t rows() const { return n_; }

 private:
  /// What one thread writes to.
  struct Answers {
    explicit Answers(const TracedSet& set);
    Table<Hit> hits;
    AlignedArray<uint32_t> occluded;
    AlignedArray<std::byte> scratch;
  };
  LaneCount trace_stream(uint32_t first, Answers& to);
  TraceTime trace_from(uint32_t first_stream, Answers& to);

  Config config_;
  bool shadow_, camera_;
  uint32_t n_, stream_;
  Table<Ray> rays_;
  Table<ShadowRay> shadow_rays_;
  std::vector<Answers> answers_;  ///< one per thread
};

}  // namespace yat::bench

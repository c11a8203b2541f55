#include "traced_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "measure.h"
#include "scalar_trace.h"

namespace yat::bench {

std::vector<TraceKernel> trace_kernels(const KernelTable& table) {
  const auto scratch = table.traversal_scratch_bytes;
  const auto closest = table.intersect_closest;
  const auto shadow = table.intersect_shadow[0];
  return {{"render", scratch, table.intersect_tiles, closest, shadow},
          {"stream", scratch, closest, closest, shadow},
          {"scalar", scalar_scratch_bytes, scalar_closest, scalar_closest, scalar_shadow}};
}

std::vector<std::string> trace_kernel_names() {
  return {"render", "stream", "scalar"};
}

std::string Config::name() const {
  return fmt::format("{}/{}/{}{}", table->isa, kernel.name, tree_kind,
                     stream ? fmt::format("/{}", stream) : std::string());
}

uint32_t stream_rows(const RaySet& set) {
  if (set.shadow || set.camera()) return 8192;
  return set.name == "mirror" || set.name == "diffuse 1" ? 32768 : 65536;
}

TracedSet::TracedSet(const Config& config, const RaySet& set)
    : config_(config),
      shadow_(set.shadow),
      camera_(set.camera()),
      n_(uint32_t(set.rays.size())),
      stream_(config.stream ? config.stream : stream_rows(set)) {
  scratch_.emplace_back(config.kernel.scratch_bytes(config.tree->view, stream_));
  if (shadow_) {
    shadow_rays_.resize(n_);
    occluded_.resize(n_);
    for (uint32_t i = 0; i < n_; ++i) {
      const Ray<Value>& r = set.rays[i];
      shadow_rays_.set(i, {r.org_x, r.org_y, r.org_z, r.dir_x, r.dir_y, r.dir_z, 0, 0, 0, i});
    }
  } else {
    rays_.resize(n_);
    hits_.resize(n_);
    for (uint32_t i = 0; i < n_; ++i) rays_.set(i, set.rays[i]);
  }
}

LaneCount TracedSet::trace_stream(uint32_t first, const Scratch& scratch) {
  const uint32_t rows = std::min(stream_, n_ - first);
  const TreeView& tree = config_.tree->view;
  if (shadow_)
    return config_.kernel.shadow(tree, columns_from(shadow_rays_.view(), first),
                                 occluded_.data() + first, rows, scratch);
  const auto closest = camera_ ? config_.kernel.camera : config_.kernel.closest;
  return closest(tree, columns_from(rays_.view(), first), columns_from(hits_.columns(), first),
                 rows, scratch);
}

TraceTime TracedSet::trace() {
  TraceTime time;
  const double wall = wall_seconds(), cpu = thread_seconds();
  for (uint32_t first = 0; first < n_; first += stream_) {
    const LaneCount count = trace_stream(first, {scratch_[0].data(), scratch_[0].size()});
    time.lanes.rows += count.rows;
    time.lanes.steps += count.steps;
  }
  time.cpu = thread_seconds() - cpu;
  time.wall = wall_seconds() - wall;
  return time;
}

TraceTime TracedSet::trace_on(uint32_t threads) {
  while (scratch_.size() < threads)
    scratch_.emplace_back(config_.kernel.scratch_bytes(config_.tree->view, stream_));
  // Output columns of neighbouring streams must not share padding: a stream is a multiple of
  // kRowPad rows, so that they do not.
  std::atomic<uint32_t> next{0}, ready{0};
  std::vector<TraceTime> times(threads);
  const auto work = [&](uint32_t worker) {
    ++ready;
    while (ready < threads) std::this_thread::yield();
    const double wall = wall_seconds(), cpu = thread_seconds();
    for (;;) {
      const uint32_t first = next.fetch_add(stream_);
      if (first >= n_) break;
      const LaneCount count =
          trace_stream(first, {scratch_[worker].data(), scratch_[worker].size()});
      times[worker].lanes.rows += count.rows;
      times[worker].lanes.steps += count.steps;
    }
    times[worker].cpu = thread_seconds() - cpu;
    times[worker].wall = wall_seconds() - wall;
  };
  std::vector<std::thread> others;
  for (uint32_t worker = 1; worker < threads; ++worker) others.emplace_back(work, worker);
  work(0);
  for (std::thread& other : others) other.join();
  TraceTime all;
  for (const TraceTime& time : times) {
    all.cpu += time.cpu;
    all.wall = std::max(all.wall, time.wall);
    all.lanes.rows += time.lanes.rows;
    all.lanes.steps += time.lanes.steps;
  }
  return all;
}

Hit<Value> TracedSet::hit(uint32_t row) const {
  if (shadow_) return {0, 0, 0, occluded_[row] ? 0 : kNone};
  return hits_.row(row);
}

}  // namespace yat::bench

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
  if (shadow_) {
    shadow_rays_.resize(n_);
    for (uint32_t i = 0; i < n_; ++i) {
      const Ray<Value>& r = set.rays[i];
      shadow_rays_.set(i, {r.org_x, r.org_y, r.org_z, r.dir_x, r.dir_y, r.dir_z, 0, 0, 0, i});
    }
  } else {
    rays_.resize(n_);
    for (uint32_t i = 0; i < n_; ++i) rays_.set(i, set.rays[i]);
  }
  answers_.emplace_back(*this);
}

TracedSet::Answers::Answers(const TracedSet& set)
    : scratch(set.config_.kernel.scratch_bytes(set.config_.tree->view, set.stream_)) {
  if (set.shadow_)
    occluded.resize(set.n_);
  else
    hits.resize(set.n_);
}

LaneCount TracedSet::trace_stream(uint32_t first, Answers& to) {
  const uint32_t rows = std::min(stream_, n_ - first);
  const TreeView& tree = config_.tree->view;
  const Scratch scratch{to.scratch.data(), to.scratch.size()};
  if (shadow_)
    return config_.kernel.shadow(tree, columns_from(shadow_rays_.view(), first),
                                 to.occluded.data() + first, rows, scratch);
  const auto closest = camera_ ? config_.kernel.camera : config_.kernel.closest;
  return closest(tree, columns_from(rays_.view(), first), columns_from(to.hits.columns(), first),
                 rows, scratch);
}

TraceTime TracedSet::trace_from(uint32_t first_stream, Answers& to) {
  TraceTime time;
  const uint32_t streams = (n_ + stream_ - 1) / stream_;
  const double wall = wall_seconds(), cpu = thread_seconds();
  for (uint32_t s = 0; s < streams; ++s) {
    const LaneCount count = trace_stream((first_stream + s) % streams * stream_, to);
    time.lanes.rows += count.rows;
    time.lanes.steps += count.steps;
  }
  time.cpu = thread_seconds() - cpu;
  time.wall = wall_seconds() - wall;
  return time;
}

TraceTime TracedSet::trace() {
  return trace_from(0, answers_[0]);
}

TraceTime TracedSet::trace_on(uint32_t threads) {
  // A thread that has just begun has its rays and nodes in no cache of its own, and a few
  // milliseconds of work would measure that.
  constexpr double kSeconds = .02;
  while (answers_.size() < threads) answers_.emplace_back(*this);
  std::atomic<uint32_t> ready{0};
  std::vector<TraceTime> times(threads);
  const uint32_t streams = (n_ + stream_ - 1) / stream_;
  const uint32_t passes = 1 + uint32_t(kSeconds / std::max(trace().wall, 1e-6));
  const auto work = [&](uint32_t worker) {
    // Each begins elsewhere, so that they do not run through the same nodes side by side.
    const uint32_t first = streams * worker / threads;
    trace_from(first, answers_[worker]);
    ++ready;
    while (ready < threads) std::this_thread::yield();
    for (uint32_t pass = 0; pass < passes; ++pass) {
      const TraceTime time = trace_from(first, answers_[worker]);
      times[worker].cpu += time.cpu / passes;
      times[worker].wall += time.wall / passes;
      times[worker].lanes = time.lanes;
    }
  };
  std::vector<std::thread> others;
  for (uint32_t worker = 1; worker < threads; ++worker) others.emplace_back(work, worker);
  work(0);
  for (std::thread& other : others) other.join();
  TraceTime all;
  for (const TraceTime& time : times) {
    all.cpu += time.cpu / threads;
    all.wall = std::max(all.wall, time.wall / threads);
    all.lanes.rows += time.lanes.rows;
    all.lanes.steps += time.lanes.steps;
  }
  return all;
}

Hit<Value> TracedSet::hit(uint32_t row) const {
  if (shadow_) return {0, 0, 0, answers_[0].occluded[row] ? 0 : kNone};
  return answers_[0].hits.row(row);
}

}  // namespace yat::bench

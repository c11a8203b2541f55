#include "traversal_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "base/error.h"
#include "judge.h"
#include "kernels/dispatch.h"
#include "thread_control.h"
#if defined(YAT_WITH_EMBREE)
#include "embree_trace.h"
#endif

namespace yat::bench {
namespace {

/// Times of one program's way to trace one set.
struct Timing {
  std::vector<double> seconds;  ///< one per repetition: processor time on one thread
  double middle() const { return median(seconds); }
};

struct OurTiming : Timing {
  LaneCount lanes;
  struct OnThreads {
    uint32_t threads;
    std::vector<double> cpu, wall;
  };
  OnThreads one{1, {}, {}};  ///< measured as `more` are
  std::vector<OnThreads> more;
  double gain(const OnThreads& by) const { return median(one.wall) / median(by.wall); }
};

struct TheirTiming : Timing {
  std::string variant, quality;
};

TreeOptions tree_options(const KernelTable& table, const std::string& kind) {
  return {std::max(4u, table.lanes), kind == "kd"};
}

void print_tree(const BenchScene& scene, const Config& config) {
  const TreeStatistics& s = config.tree->statistics;
  std::printf(
      "\n%s, tree %s of blocks of %u: %llu triangles, build %.3f s, %llu nodes, %llu leaves, %llu "
      "blocks (%.0f %% full), %.2f references per triangle, depth %u, SAH %.2f, %.1f MB\n",
      scene.name.c_str(), config.tree_kind.c_str(), config.tree->view.block_width,
      static_cast<unsigned long long>(s.triangles), s.build_seconds,
      static_cast<unsigned long long>(s.nodes), static_cast<unsigned long long>(s.leaves),
      static_cast<unsigned long long>(s.blocks), 100 * s.block_fill,
      double(s.references) / double(s.triangles), s.max_depth, s.sah_cost,
      double(config.tree->bytes()) / 1e6);
}

std::vector<Hit<Value>> answers(const TracedSet& set) {
  std::vector<Hit<Value>> out(set.rows());
  for (uint32_t i = 0; i < set.rows(); ++i) out[i] = set.hit(i);
  return out;
}

Json json_of(const Differences& d) {
  return {{"ties", d.ties},
          {"rounding", d.rounding},
          {"hit_miss", d.hit_miss},
          {"yat_t_off", d.yat_t_off},
          {"other_t_off", d.other_t_off},
          {"yat_wrong", d.yat_wrong},
          {"other_wrong", d.other_wrong},
          {"unjudged", d.unjudged}};
}

Json json_of(const Config& config, const OurTiming& t, double rays) {
  Json json = {{"config", config.name()},      {"isa", config.table->isa},
               {"kernel", config.kernel.name}, {"tree", config.tree_kind},
               {"stream", config.stream},      {"seconds", t.seconds},
               {"seconds_median", t.middle()}, {"mrays", rays / t.middle() * 1e-6}};
  if (t.lanes.steps)
    json["lanes"] = double(t.lanes.rows) / (double(t.lanes.steps) * config.table->lanes);
  for (const OurTiming::OnThreads& more : t.more)
    json["threads"].push_back(
        {{"threads", more.threads},
         {"wall", more.wall},
         {"one_thread_wall", t.one.wall},
         {"scaling", t.gain(more)},
         {"scaling_cpu", more.threads * median(t.one.cpu) / median(more.cpu)}});
  return json;
}

/// Loud, because such a row must not be: which rays, with all digits.
void shout(const BenchScene& scene, const RaySet& set, const std::string& config,
           const Differences& d, const std::vector<Hit<Value>>& ours,
           const std::vector<Hit<Value>>& theirs) {
  std::printf("*** %s, %s, %s: yat wrong on %llu rays, Embree on %llu, %llu not looked at\n",
              scene.name.c_str(), set.name.c_str(), config.c_str(),
              static_cast<unsigned long long>(d.yat_wrong),
              static_cast<unsigned long long>(d.other_wrong),
              static_cast<unsigned long long>(d.unjudged));
  for (const uint32_t row : d.wrong_rows) {
    const Ray<Value>& r = set.rays[row];
    const auto text = [](const Hit<Value>& hit) {
      return hit.prim == kNone ? std::string("nothing")
                               : fmt::format("triangle {} at {:.9g}", hit.prim, hit.t);
    };
    std::printf("***   row %u: from (%.9g %.9g %.9g) along (%.9g %.9g %.9g): yat %s, Embree %s\n",
                row, double(r.org_x), double(r.org_y), double(r.org_z), double(r.dir_x),
                double(r.dir_y), double(r.dir_z), text(ours[row]).c_str(),
                text(theirs[row]).c_str());
  }
}

/// All repetitions of one set: every config, then every variant of Embree, then the next round.
class SetRow {
 public:
  SetRow(const Prepared& prepared, const RaySet& set) : prepared_(prepared), set_(set) {
    for (const Config& config : prepared.configs) {
      traced_.push_back(std::make_unique<TracedSet>(config, set));
      ours_.emplace_back();
    }
  }

  void time_ours(size_t c, const TableOptions& options) {
    // The rest of the round has emptied the caches; a variant of Embree comes after another over
    // the same tree.
    traced_[c]->trace();
    const TraceTime time = traced_[c]->trace();
    ours_[c].seconds.push_back(time.cpu);
    ours_[c].lanes = time.lanes;
    const auto measure = [&](OurTiming::OnThreads& to) {
      const TraceTime on = traced_[c]->trace_on(to.threads);
      to.cpu.push_back(on.cpu);
      to.wall.push_back(on.wall);
    };
    size_t next = 0;
    for (const uint32_t threads : options.threads) {
      if (threads < 2) continue;
      if (ours_[c].more.size() == next) ours_[c].more.push_back({threads, {}, {}});
      if (next == 0) measure(ours_[c].one);
      measure(ours_[c].more[next++]);
    }
  }

#if defined(YAT_WITH_EMBREE)
  void time_embree(const EmbreeScene& scene, EmbreeQuality quality) {
    const std::vector<std::string> variants = EmbreeScene::variants();
    scene.trace(0, set_, their_hits_);  // As above.
    for (uint32_t v = 0; v < variants.size(); ++v) {
      const std::string name = embree_quality_name(quality);
      auto it = std::find_if(theirs_.begin(), theirs_.end(), [&](const TheirTiming& t) {
        return t.variant == variants[v] && t.quality == name;
      });
      if (it == theirs_.end()) it = theirs_.insert(it, {{}, variants[v], name});
      it->seconds.push_back(scene.trace(v, set_, their_hits_));
    }
  }
  void compare_with(const EmbreeScene& scene) { scene.trace(0, set_, their_hits_); }
#endif

  /// Null without Embree.
  const TheirTiming* best() const {
    return least([](const TheirTiming&) { return true; });
  }
  const TheirTiming* best_single() const {
    return least([](const TheirTiming& t) { return t.variant == "1"; });
  }

  Json print(uint64_t& wrong) const {
    const double n = double(set_.rays.size());
    Json json = {{"set", set_.name}, {"rays", set_.rays.size()}, {"shadow", set_.shadow}};
    for (size_t c = 0; c < ours_.size(); ++c) {
      const Config& config = prepared_.configs[c];
      Json mine = json_of(config, ours_[c], n);
      const std::string lanes =
          mine.contains("lanes") ? fmt::format("{:.0f}%", 100 * double(mine["lanes"])) : "";
      fmt::print("{:<10} {:>8.0f}  {:<22} {:7.2f} {:7.1f} {:>6}", c ? "" : set_.name, n,
                 config.name(), n / ours_[c].middle() * 1e-6, ours_[c].middle() / n * 1e9, lanes);
      for (const OurTiming::OnThreads& more : ours_[c].more)
        std::printf("  %ux: %.2f", more.threads, ours_[c].gain(more));
      if (const TheirTiming* const theirs = best()) {
        const std::vector<Hit<Value>> hits = answers(*traced_[c]);
        const Differences d = compare(prepared_.scene, set_, hits, their_hits_);
        fmt::print("  {:7.2f} {:<23} {:5.2f}  {} ties, {} rounding, {} hit/miss{}{}",
                   n / theirs->middle() * 1e-6,
                   fmt::format("({}, {})", theirs->variant, theirs->quality),
                   theirs->middle() / ours_[c].middle(), d.ties, d.rounding, d.hit_miss,
                   d.yat_t_off ? fmt::format(", {} t off", d.yat_t_off) : "",
                   d.yat_wrong + d.other_wrong + d.unjudged ? "  ***" : "");
        mine["ratio"] = theirs->middle() / ours_[c].middle();
        mine["ratio_to_single"] = best_single()->middle() / ours_[c].middle();
        mine["differences"] = json_of(d);
        wrong += d.yat_wrong + d.unjudged;
        std::printf("\n");
        if (d.yat_wrong + d.other_wrong + d.unjudged)
          shout(prepared_.scene, set_, config.name(), d, hits, their_hits_);
      } else {
        std::printf("\n");
      }
      json["yat"].push_back(std::move(mine));
    }
    if (const TheirTiming* const theirs = best())
      json["embree_best"] = {{"variant", theirs->variant},
                             {"quality", theirs->quality},
                             {"seconds_median", theirs->middle()},
                             {"mrays", n / theirs->middle() * 1e-6}};
    for (const TheirTiming& t : theirs_)
      json["embree"].push_back({{"variant", t.variant},
                                {"quality", t.quality},
                                {"seconds", t.seconds},
                                {"seconds_median", t.middle()}});
    std::fflush(stdout);
    return json;
  }

  double our_seconds(size_t c) const { return ours_[c].middle(); }
  size_t configs() const { return ours_.size(); }

 private:
  template <class Wanted>
  const TheirTiming* least(Wanted&& wanted) const {
    const TheirTiming* best = nullptr;
    for (const TheirTiming& t : theirs_)
      if (wanted(t) && (!best || t.middle() < best->middle())) best = &t;
    return best;
  }

  const Prepared& prepared_;
  const RaySet& set_;
  std::vector<std::unique_ptr<TracedSet>> traced_;
  std::vector<OurTiming> ours_;
  std::vector<TheirTiming> theirs_;
  std::vector<Hit<Value>> their_hits_;
};

/// Total time of all sets but mirror, ours and theirs.
struct Mix {
  double ours = 0, best = 0, single = 0;
};

}  // namespace

const KernelTable& best_kernels() {
  const KernelTable* best = nullptr;
  for (const IsaEntry& entry : built_isas())
    if (entry.here) best = entry.table();
  if (!best) throw Error("no kernels of this build run on this machine");
  return *best;
}

std::unique_ptr<Prepared> prepare(Recording recording, uint32_t resolution,
                                  const TableOptions& options) {
  auto out = std::make_unique<Prepared>();
  out->scene = std::move(recording.scene);
  out->sets = std::move(recording.sets);
  ThreadPool pool;
  const auto tree_of = [&](const KernelTable& table, const std::string& kind) {
    return std::make_unique<Tree>(
        build_tree(out->scene.rows.view(), {}, tree_options(table, kind), pool));
  };
  if (out->sets.empty()) {
    const KernelTable& best = best_kernels();
    out->sets = record_rays(out->scene, best, tree_of(best, "auto")->view, resolution, resolution);
  }
  std::vector<std::string> isas = options.isas;
  if (isas.empty()) isas.push_back(select_kernels().isa);
  for (const std::string& isa : isas) {
    const KernelTable& table = select_kernels(isa);
    for (const std::string& kind : options.trees) {
      out->trees.push_back(tree_of(table, kind));
      for (const TraceKernel& kernel : trace_kernels(table)) {
        if (!options.kernels.empty() && std::find(options.kernels.begin(), options.kernels.end(),
                                                  kernel.name) == options.kernels.end())
          continue;
        for (const uint32_t stream : options.streams)
          out->configs.push_back({&table, kernel, kind, out->trees.back().get(), stream});
      }
    }
  }
  return out;
}

Json run_table(const Prepared& prepared, const TableOptions& options, uint64_t& wrong) {
  Json json = {{"scene", prepared.scene.name},
               {"triangles", prepared.scene.triangles()},
               {"trees", Json::array()},
               {"rows", Json::array()}};
  const Tree* last = nullptr;
  for (const Config& config : prepared.configs) {
    if (config.tree == last) continue;
    last = config.tree;
    print_tree(prepared.scene, config);
    const TreeStatistics& s = config.tree->statistics;
    json["trees"].push_back({{"isa", config.table->isa},
                             {"kind", config.tree_kind},
                             {"build_seconds", s.build_seconds},
                             {"references", s.references},
                             {"sah_cost", s.sah_cost},
                             {"block_fill", s.block_fill},
                             {"bytes", config.tree->bytes()}});
  }
  std::printf("%-10s %8s  %-22s %7s %7s %6s", "rays", "n", "yat", "Mrays/s", "ns/ray", "lanes");
#if defined(YAT_WITH_EMBREE)
  std::unique_ptr<EmbreeScene> embree[2];
  if (options.embree) {
    embree[0] = std::make_unique<EmbreeScene>(prepared.scene, EmbreeQuality::kMedium);
    embree[1] = std::make_unique<EmbreeScene>(prepared.scene, EmbreeQuality::kHigh);
    std::printf("  Embree's best, ratio, differences");
  }
#endif
  std::printf("\n");
  std::vector<Mix> mix(prepared.configs.size());
  for (const RaySet& set : prepared.sets) {
    SetRow row(prepared, set);
    const double start = wall_seconds();
    for (uint32_t round = 0; round < options.repetitions; ++round) {
      if (round >= 3 && wall_seconds() - start > options.seconds) break;
      for (size_t c = 0; c < row.configs(); ++c) row.time_ours(c, options);
#if defined(YAT_WITH_EMBREE)
      if (options.embree) {
        row.time_embree(*embree[0], EmbreeQuality::kMedium);
        row.time_embree(*embree[1], EmbreeQuality::kHigh);
      }
#endif
    }
#if defined(YAT_WITH_EMBREE)
    if (options.embree) row.compare_with(*embree[0]);
#endif
    json["rows"].push_back(row.print(wrong));
    if (set.name == "mirror") continue;
    for (size_t c = 0; c < mix.size(); ++c) {
      mix[c].ours += row.our_seconds(c);
      if (const Timing* t = row.best()) mix[c].best += t->middle();
      if (const Timing* t = row.best_single()) mix[c].single += t->middle();
    }
  }
  for (const uint32_t threads : options.threads) {
    if (threads < 2) continue;
    const double gain = registers_gain(threads);
    std::printf("control              registers only         %ux: %.2f\n", threads, gain);
    json["thread_control"].push_back({{"threads", threads}, {"scaling", gain}});
  }
  for (size_t c = 0; c < mix.size(); ++c) {
    Json entry = {{"config", prepared.configs[c].name()}, {"seconds", mix[c].ours}};
    std::printf("path mix             %-22s %7.1f ms", prepared.configs[c].name().c_str(),
                mix[c].ours * 1e3);
    if (mix[c].best > 0) {
      entry["ratio"] = mix[c].best / mix[c].ours;
      entry["ratio_to_single"] = mix[c].single / mix[c].ours;
      std::printf("  %.2f of Embree's best, %.2f of its single rays", mix[c].best / mix[c].ours,
                  mix[c].single / mix[c].ours);
    }
    std::printf("\n");
    json["path_mix"].push_back(std::move(entry));
  }
  std::fflush(stdout);
  return json;
}

void print_summary(const Json& scenes) {
  std::map<std::string, std::vector<double>> ratios;
  for (const Json& scene : scenes)
    for (const Json& mix : scene["path_mix"])
      if (mix.contains("ratio")) ratios[mix["config"]].push_back(mix["ratio"]);
  for (const auto& [config, values] : ratios)
    std::printf("\n%s: geometric mean of the path mix over %zu scenes: %.2f of Embree's best\n",
                config.c_str(), values.size(), geometric_mean(values));
}

}  // namespace yat::bench

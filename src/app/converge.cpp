#include "app/converge.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "app/build_info.h"
#include "app/converge_record.h"
#include "app/converge_renders.h"
#include "app/converge_report.h"
#include "app/interrupt.h"
#include "converge/folder.h"
#include "converge/hash.h"
#include "converge/ladder.h"
#include "film/output.h"

namespace yat {

namespace {

using Json = nlohmann::ordered_json;

/// Progress of all runs together: each run's own is added to what was done before it.
class ExperimentProgress : public Progress {
 public:
  ExperimentProgress(Console& console, ProgressKind kind) : Progress(console, kind) {}
  void show(const ProgressState& run) override { Progress::show(whole(run)); }
  /// The end of a run.
  void finish(const ProgressState& run) override {
    const ProgressState now = whole(run);
    done_ = now.samples_done;
    rays_ = now.rays;
    Progress::show(now);
  }
  /// samples: left to do.
  void expect(uint64_t samples) { total_ = done_ + samples; }
  void end() {
    total_ = done_;
    Progress::finish(whole({}));
  }

 private:
  ProgressState whole(const ProgressState& run) const {
    ProgressState all;
    all.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    all.samples_done = done_ + run.samples_done;
    all.samples_total = std::max(total_, all.samples_done);
    all.rays = rays_ + run.rays;
    return all;
  }
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  uint64_t done_ = 0, total_ = 0, rays_ = 0;
};

/// The reference that is given, if one is: of this size and none of the runs.
std::optional<Reference> given_reference(const ConvergeArguments& arguments,
                                         const ConvergeRenders& renders) {
  if (arguments.reference.empty()) return {};
  Reference given = read_reference(arguments.reference);
  const Scene& scene = renders.scene(arguments.variants.front()).loaded.scene;
  const uint32_t width = scene.film.crop_width(), height = scene.film.crop_height();
  if (given.image.width != width || given.image.height != height)
    throw Error(
        fmt::format("{}: error: {} x {} pixels, but the runs have {} x {}: give --resolution (and "
                    "--crop) to suit",
                    given.path, given.image.width, given.image.height, width, height));
  if (!given.seed || given.scene_hash != scene.hash) return given;
  for (const ConvergeVariant& variant : arguments.variants)
    for (const uint32_t spp : variant.ladder)
      for (uint32_t run = 0; run < arguments.runs; ++run)
        if (run_seed(arguments.seed, spp, run) == *given.seed)
          throw Error(fmt::format(
              "{}: error: rendered with seed {}, as run {} of {}: a run is never its own "
              "reference: give another --seed",
              given.path, *given.seed, run,
              spp == kTargetRung ? variant.name : fmt::format("{} spp", spp)));
  return given;
}

/// One experiment under way.
class ConvergeRun {
 public:
  ConvergeRun(const ConvergeArguments& arguments, Console& console)
      : arguments_(arguments),
        console_(console),
        renders_(arguments, console),
        given_(given_reference(arguments, renders_)),
        folder_(arguments.folder, experiment_header(arguments, renders_, given_),
                arguments.restart),
        progress_(console, kind_of(arguments)) {
    const FilmSettings& film = renders_.scene(arguments.variants.front()).loaded.scene.film;
    width_ = film.crop_width();
    height_ = film.crop_height();
    require_same_options();
    warn_of_sobol();
    moments_.resize(arguments.variants.size());
  }

  ExitCode go();

 private:
  static ProgressKind kind_of(const ConvergeArguments& arguments) {
    return arguments.verbosity == Verbosity::kQuiet && arguments.progress == ProgressKind::kAuto
               ? ProgressKind::kSilent
               : arguments.progress;
  }
  std::string moments_name(size_t variant, uint32_t spp) const {
    return fmt::format("{:016x}-{}", fnv1a_of(arguments_.variants[variant].name), spp);
  }
  PixelMoments& moments_of(size_t variant, uint32_t spp);
  std::vector<PixelMoments> highest_moments();

  void require_same_options() const;
  void warn_of_sobol() const;

  /// Of the variant and rung: whether it is measured (see --time-per-run), known once the rung
  /// below has its first run.
  bool included(const ConvergeVariant& variant, size_t rung) const;
  uint64_t samples_left() const;
  PictureMetadata metadata_of(const ConvergeVariant& variant, uint32_t seed,
                              double samples_per_pixel) const;
  bool make_reference(std::atomic<bool>& stop);
  double write_last(const RunResult& result, const ConvergeVariant& variant, uint32_t spp,
                    uint32_t run) const;
  void warm_up(std::atomic<bool>& stop);
  void measure(size_t variant, size_t rung, uint32_t run, std::atomic<bool>& stop);
  void measure_all(std::atomic<bool>& stop);

  const ConvergeArguments& arguments_;
  Console& console_;
  ConvergeRenders renders_;
  std::optional<Reference> given_;
  ConvergeFolder folder_;
  ExperimentProgress progress_;
  Reference reference_;
  bool have_reference_ = false;
  uint32_t width_ = 0, height_ = 0;
  struct RungMoments {
    uint32_t spp = kNoRung;
    PixelMoments moments;
  };
  std::vector<RungMoments> moments_;  ///< per variant, of the rung that was added to last
};

void ConvergeRun::require_same_options() const {
  for (const RunRecord& record : folder_.runs())
    for (const ConvergeVariant& variant : arguments_.variants) {
      if (variant.name != record.variant) continue;
      const Json details = Json::parse(record.details);
      const auto was = details.at("settings").at("options").get<std::string>();
      if (was != variant.options)
        throw Error(fmt::format(
            "{}: error: the folder holds runs of variant \"{}\" with the options \"{}\", which now "
            "has \"{}\": give it another name, or --restart to throw all runs away",
            folder_.file("runs.jsonl"), variant.name, was, variant.options));
    }
}

void ConvergeRun::warn_of_sobol() const {
  const std::vector<uint32_t> odd = not_powers_of_two(arguments_.ladder);
  if (odd.empty()) return;
  for (const ConvergeVariant& variant : arguments_.variants) {
    if (variant.to_noise()) continue;
    const SamplerKind sampler = renders_.plan(variant, odd.front(), 0).sampler;
    if (sampler == SamplerKind::kSobol || sampler == SamplerKind::kZSobol)
      console_.line(fmt::format(
          "warning: {}: {} samples are no power of two, and between those the error of the {} "
          "sampler is up to twice as large: give --ladder powers of two",
          variant.name, fmt::join(odd, ", "), sampler_kind_name(sampler)));
  }
}

bool ConvergeRun::included(const ConvergeVariant& variant, size_t rung) const {
  if (arguments_.time_per_run <= 0 || rung == 0) return true;
  const uint32_t spp = variant.ladder[rung], below = variant.ladder[rung - 1];
  if (folder_.find(variant.name, spp, 0)) return true;
  const RunRecord* const before = folder_.find(variant.name, below, 0);
  return before && before->seconds * double(spp) / double(below) <= arguments_.time_per_run;
}

PixelMoments& ConvergeRun::moments_of(size_t variant, uint32_t spp) {
  RungMoments& rung = moments_[variant];
  if (rung.spp != spp) rung = {spp, folder_.moments(moments_name(variant, spp), width_, height_)};
  return rung.moments;
}

std::vector<PixelMoments> ConvergeRun::highest_moments() {
  std::vector<PixelMoments> all;
  for (size_t v = 0; v < arguments_.variants.size(); ++v) {
    uint32_t highest = 0;
    for (const uint32_t spp : arguments_.variants[v].ladder)
      if (folder_.find(arguments_.variants[v].name, spp, 0)) highest = spp;
    all.push_back(moments_of(v, highest));
  }
  return all;
}

uint64_t ConvergeRun::samples_left() const {
  double samples = 0;
  for (const ConvergeVariant& variant : arguments_.variants)
    for (size_t rung = 0; rung < variant.ladder.size(); ++rung) {
      const uint32_t spp = variant.ladder[rung];
      const bool may_be =
          included(variant, rung) || !folder_.find(variant.name, variant.ladder[rung - 1], 0);
      // What a target takes is known when it has been reached once.
      const RunRecord* const before = folder_.find(variant.name, spp, 0);
      const double each = spp != kTargetRung ? spp
                          : before           ? before->samples_per_pixel
                                             : arguments_.ladder.back();
      for (uint32_t run = 0; may_be && run < arguments_.runs; ++run)
        if (!folder_.find(variant.name, spp, run)) samples += each;
    }
  return uint64_t(samples * width_ * height_);
}

/// Part by part, each kept as it ends. False if stopped.
bool ConvergeRun::make_reference(std::atomic<bool>& stop) {
  const uint32_t part = arguments_.ladder.back() * (kReferenceFactor / kReferenceParts);
  PixelMoments parts = folder_.moments("reference", width_, height_);
  while (parts.count() < kReferenceParts && !stop) {
    progress_.expect(samples_left() +
                     uint64_t(kReferenceParts - parts.count()) * part * width_ * height_);
    const RunResult result = renders_.run(
        arguments_.shared, part, reference_seed(arguments_.seed, parts.count()), progress_, stop);
    if (stop) break;
    parts.add(result.image);
    folder_.keep("reference", parts);
  }
  if (parts.count() < kReferenceParts) return false;
  reference_ = reference_of(parts, part);
  reference_.path = folder_.file("reference.exr");

  // As --aov variance,sample_count: of a sample, so that their quotient is that of the mean.
  PictureLayer variance{"variance.R,variance.G,variance.B", {}}, count{"sample_count", {}};
  for (const double v : reference_.variance)
    variance.values.push_back(float(v * reference_.samples_per_pixel));
  count.values.assign(size_t(width_) * height_, float(reference_.samples_per_pixel));
  const PictureLayer layers[] = {std::move(variance), std::move(count)};
  write_picture(reference_.path, reference_.image.rgb, width_, height_,
                renders_.scene(arguments_.shared).loaded.scene.film,
                metadata_of(arguments_.shared, reference_seed(arguments_.seed, 0),
                            reference_.samples_per_pixel),
                layers);
  reference_.hash = read_reference(reference_.path).hash;
  return true;
}

PictureMetadata ConvergeRun::metadata_of(const ConvergeVariant& variant, uint32_t seed,
                                         double samples_per_pixel) const {
  const ConvergeScene& scene = renders_.scene(variant);
  PictureMetadata metadata;
  metadata.scene = arguments_.scene;
  metadata.scene_hash = scene.loaded.scene.hash;
  metadata.seed = seed;
  metadata.samples_per_pixel = samples_per_pixel;
  metadata.isa = scene.kernels->isa;
  metadata.version = kBuildInfo.version;
  return metadata;
}

/// Writes the picture of a run, over that of the run before. Returns the time that it took [s].
double ConvergeRun::write_last(const RunResult& result, const ConvergeVariant& variant,
                               uint32_t spp, uint32_t run) const {
  Stopwatch watch;
  write_picture(
      folder_.file("last.exr"), result.image.rgb, width_, height_,
      renders_.scene(variant).loaded.scene.film,
      metadata_of(variant, run_seed(arguments_.seed, spp, run), result.samples_per_pixel));
  return watch.lap();
}

/// One run of each variant that nobody looks at: caches, pages and clocks.
void ConvergeRun::warm_up(std::atomic<bool>& stop) {
  Progress silent(console_, ProgressKind::kSilent);
  for (const ConvergeVariant& variant : arguments_.variants)
    if (!stop)
      renders_.run(variant, variant.ladder.front(), run_seed(arguments_.seed, kNoRung, 0), silent,
                   stop);
}

void ConvergeRun::measure(size_t v, size_t rung, uint32_t run, std::atomic<bool>& stop) {
  const ConvergeVariant& variant = arguments_.variants[v];
  const uint32_t spp = variant.ladder[rung];
  progress_.expect(samples_left());
  const RunResult result =
      renders_.run(variant, spp, run_seed(arguments_.seed, spp, run), progress_, stop);
  if (stop) return;
  const RunRecord record = record_of_run(arguments_, renders_, variant, spp, run, result,
                                         write_last(result, variant, spp, run), reference_);
  // Before the record: should this be the last thing that is done, the run is repeated, with the
  // same picture, and not added again.
  const bool highest =
      rung + 1 == variant.ladder.size() ||
      (arguments_.time_per_run > 0 && !folder_.find(variant.name, variant.ladder[rung + 1], 0) &&
       record.seconds * double(variant.ladder[rung + 1]) / double(spp) > arguments_.time_per_run);
  if (PixelMoments* const sums = highest ? &moments_of(v, spp) : nullptr;
      sums && sums->count() == run) {
    sums->add(result.image);
    folder_.keep(moments_name(v, spp), *sums);
  }
  folder_.add(record);
  if (arguments_.verbosity == Verbosity::kVerbose)
    console_.line(fmt::format("{}, {:.6g} spp, run {}: {:.4g} s, {:.4g} CPU s, MSE {:.4g}",
                              variant.name, record.samples_per_pixel, run, record.seconds,
                              record.cpu_seconds, record.error.mse));
}

void ConvergeRun::measure_all(std::atomic<bool>& stop) {
  size_t rungs = 0;
  for (const ConvergeVariant& variant : arguments_.variants)
    rungs = std::max(rungs, variant.ladder.size());
  for (uint32_t run = 0; run < arguments_.runs; ++run)
    for (size_t rung = 0; rung < rungs; ++rung)
      for (size_t v = 0; v < arguments_.variants.size() && !stop; ++v) {
        const ConvergeVariant& variant = arguments_.variants[v];
        if (rung < variant.ladder.size() && included(variant, rung) &&
            !folder_.find(variant.name, variant.ladder[rung], run))
          measure(v, rung, run, stop);
      }
}

ExitCode ConvergeRun::go() {
  bool interrupted = false;
  {
    InterruptGuard guard;
    std::atomic<bool>& stop = guard.stop();
    if (given_) {
      reference_ = *given_;
      have_reference_ = true;
    } else {
      have_reference_ = make_reference(stop);
    }
    if (!stop && samples_left() > 0) {
      warm_up(stop);
      measure_all(stop);
    }
    progress_.end();
    if (have_reference_)
      write_report({arguments_, renders_, folder_, experiment_header(arguments_, renders_, given_),
                    reference_, highest_moments()},
                   console_, stop);
    interrupted = guard.interrupted();
  }
  if (interrupted)
    console_.line(fmt::format(
        "interrupted: {} runs are finished and kept in {}; the same command goes on from there",
        folder_.runs().size(), folder_.path()));
  return interrupted ? ExitCode::kInterrupted : ExitCode::kDone;
}

}  // namespace

ExitCode converge(const ConvergeArguments& arguments, Console& console) {
  return ConvergeRun(arguments, console).go();
}

}  // namespace yat

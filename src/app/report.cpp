#include "app/report.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/build_info.h"
#include "app/machine.h"
#include "app/option_names.h"
#include "kernels/strata.h"

namespace yat {

std::string_view drop_cause_name(DropCause cause) {
  switch (cause) {
    case DropCause::kBsdf:
      return "bsdf";
    case DropCause::kPdf:
      return "pdf";
    case DropCause::kLight:
      return "light";
    case DropCause::kTexture:
      return "texture";
    case DropCause::kCamera:
      return "camera";
    case DropCause::kCrossings:
      return "crossings";
    case DropCause::kOther:
    case DropCause::kCount:
      break;
  }
  return "other";
}

namespace {

double per_second(uint64_t count, double seconds) {
  return seconds > 0 ? double(count) / seconds : 0;
}

std::string first_line(const RenderReport& report) {
  std::string crop;
  if (report.film.crop_width() != report.film.width ||
      report.film.crop_height() != report.film.height)
    crop = fmt::format(" (crop {}x{})", report.film.crop_width(), report.film.crop_height());
  return fmt::format(
      "{}: {}x{}{}, {:.6g} samples per pixel, {}, depth {}, {}, seed {}, {}, {} thread{}\n",
      report.scene, report.film.width, report.film.height, crop, report.samples_per_pixel(),
      name_of(report.integrator, kIntegrators), report.transport.max_depth,
      name_of(report.sampler, kSamplers), report.transport.seed, report.isa, report.threads,
      report.threads == 1 ? "" : "s");
}

/// One row for each stage that ran: where the time went and how full the lanes were.
std::string stage_table(const RenderStats& stats, Verbosity verbosity) {
  uint64_t all = 0;
  for (const StageCount& stage : stats.stages) all += stage.nanoseconds;
  std::string table =
      fmt::format("  {:<18}{:>8}{:>10}{:>9}{:>10}", "stage", "share", "ns/row", "lanes", "rows");
  if (verbosity == Verbosity::kVerbose) table += fmt::format("{:>10}", "calls");
  table += '\n';
  for (uint32_t i = 0; i < kStages; ++i) {
    const StageCount& stage = stats.stages[i];
    if (stage.calls == 0 && stage.nanoseconds == 0) continue;
    table += fmt::format("  {:<18}{:>6.1f} %", stage_name(Stage(i)),
                         all ? 100. * double(stage.nanoseconds) / double(all) : 0.);
    table += stage.rows ? fmt::format("{:>10.2f}", double(stage.nanoseconds) / double(stage.rows))
                        : fmt::format("{:>10}", "-");
    table += stage.lanes_total ? fmt::format("{:>7.1f} %", 100. * double(stage.lanes_active) /
                                                               double(stage.lanes_total))
                               : fmt::format("{:>9}", "-");
    table += fmt::format("{:>10}", short_number(double(stage.rows)));
    if (verbosity == Verbosity::kVerbose)
      table += fmt::format("{:>10}", short_number(double(stage.calls)));
    table += '\n';
  }
  return table;
}

std::string drop_lines(const RenderReport& report) {
  uint64_t all = 0;
  std::string causes;
  for (uint32_t cause = 0; cause < kDropCauses; ++cause) {
    const uint64_t count = report.totals.drops.count[cause];
    all += count;
    if (count)
      causes += fmt::format("{}{} {}", causes.empty() ? "" : ", ",
                            drop_cause_name(DropCause(cause)), count);
  }
  if (all == 0) return "  dropped none\n";
  std::string text =
      fmt::format("  dropped {} contributions that were not finite or negative: {}\n", all, causes);
  for (const std::string& command : replay_commands(report))
    text += fmt::format("    again: {}\n", command);
  return text;
}

/// "relMSE 0.0098 (95 %: 0.0095 to 0.0100), epsilon 2.1e-05: target 0.01 reached".
std::string noise_line(const RenderTotals& totals) {
  if (totals.noise_target == 0) return {};
  if (!totals.noise)
    return fmt::format("  error   not known: both halves of the picture need a sample\n");
  return fmt::format(
      "  error   relMSE {:.3g} (95 %: {:.3g} to {:.3g}), epsilon {:.3g}: target {:g} {}{}\n",
      totals.noise->rel_mse, totals.noise->low(), totals.noise->high(), totals.noise->epsilon,
      totals.noise_target, totals.noise_reached() ? "reached" : "not reached",
      totals.adaptive ? ", adaptive" : "");
}

}  // namespace

std::string summary_text(const RenderReport& report, Verbosity verbosity) {
  const RenderStats& stats = report.totals.stats;
  const PhaseTimes& time = report.time;
  const uint64_t rays = stats.camera_rays + stats.bounce_rays + stats.shadow_rays;
  std::string text = first_line(report);
  text += fmt::format("  time    read {:.3f} s, build {:.3f} s, render {:.3f} s, write {:.3f} s\n",
                      time.read, time.build, time.render, time.write);
  text += noise_line(report.totals);
  text += fmt::format("  paths   {} ({:.2f} Mpaths/s)\n", short_number(double(stats.paths)),
                      per_second(stats.paths, time.render) * 1e-6);
  text +=
      fmt::format("  rays    {} ({:.2f} Mrays/s): camera {}, bounce {}, shadow {}\n",
                  short_number(double(rays)), per_second(rays, time.render) * 1e-6,
                  short_number(double(stats.camera_rays)), short_number(double(stats.bounce_rays)),
                  short_number(double(stats.shadow_rays)));
  text += stage_table(stats, verbosity);
  text += drop_lines(report);
  if (verbosity == Verbosity::kVerbose) {
    constexpr double kMega = 1024. * 1024.;
    text += fmt::format(
        "  memory  scene {:.1f} MB, film {:.1f} MB, work {:.1f} MB, peak of the process {:.1f} "
        "MB\n",
        double(report.scene_bytes) / kMega, double(report.film_bytes) / kMega,
        double(report.totals.scratch_bytes) / kMega, double(peak_memory_bytes()) / kMega);
    text +=
        fmt::format("  passes  {}; processor time {:.2f} s\n", report.totals.passes, cpu_seconds());
    text += fmt::format("  yat {} ({}), {}, {}\n", kBuildInfo.version, kBuildInfo.commit,
                        kBuildInfo.compiler, kBuildInfo.build_type);
  }
  if (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

namespace {

/// " --light-sampling bsdf": what else decides about the scene and the ways of paths, where it is
/// not as usual.
std::string unusual_options(const RenderReport& report) {
  std::string text;
  if (report.light_choice != LightChoosing::kAuto)
    text += fmt::format(" --light-choice {}", name_of(report.light_choice, kLightChoices));
  if (report.light_sampling != LightSampling::kBoth)
    text += fmt::format(" --light-sampling {}", name_of(report.light_sampling, kLightSamplings));
  if (report.transport.roulette_depth != TransportOptions{}.roulette_depth)
    text += report.transport.roulette_depth == kNoRoulette
                ? " --roulette off"
                : fmt::format(" --roulette {}", report.transport.roulette_depth);
  if (report.shadow_roulette != kUsualShadowRoulette)
    text += " --shadow-roulette " + shadow_roulette_name(report.shadow_roulette);
  if (report.tree != TreeChoice::kFromScene)
    text += fmt::format(" --tree {}", name_of(report.tree, kTrees));
  if (report.instances != InstanceMode::kAuto)
    text += fmt::format(" --instances {}", name_of(report.instances, kInstanceModes));
  if (report.image_bytes != ImageStore::kDefaultLimit)
    text += fmt::format(" --texture-cache {}", report.image_bytes >> 20);
  if (report.compensation != EnergyCompensation::kAuto)
    text += fmt::format(" --energy-compensation {}", name_of(report.compensation, kCompensations));
  return text;
}

}  // namespace

std::vector<std::string> replay_commands(const RenderReport& report) {
  std::vector<std::string> commands;
  const DropLog& drops = report.totals.drops;
  for (uint32_t i = 0; i < std::min(drops.kept, DropLog::kKept); ++i) {
    const uint32_t x = drops.entry[i].pixel & 0xffffu, y = drops.entry[i].pixel >> 16;
    // The crop's first pixel is ceil(width * x0): half a pixel before it is safe from rounding.
    const double width = report.film.width, height = report.film.height;
    commands.push_back(fmt::format(
        "yat render {} --resolution {}x{} --crop {:.9g},{:.9g},{:.9g},{:.9g} --samples-range {},{} "
        "--integrator {} --max-depth {} --sampler {}{}{} --compat {} --colour {} --seed {} --isa "
        "{}",
        report.scene, report.film.width, report.film.height, std::max(0., (x - .5) / width),
        std::min(1., (x + .5) / width), std::max(0., (y - .5) / height),
        std::min(1., (y + .5) / height), drops.entry[i].sample, drops.entry[i].sample + 1,
        name_of(report.integrator, kIntegrators), report.transport.max_depth,
        name_of(report.sampler, kSamplers),
        has_sets(report.sampler) ? fmt::format(" --sample-set {}", report.sample_set)
                                 : std::string(),
        unusual_options(report), name_of(report.dialect, kDialects),
        name_of(report.colour, kColourModes), report.transport.seed, report.isa));
  }
  return commands;
}

}  // namespace yat

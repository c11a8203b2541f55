#include "app/converge_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/build_info.h"
#include "app/machine.h"
#include "base/whole_file.h"
#include "converge/ladder.h"
#include "converge/report_html.h"
#include "converge/summary_json.h"
#include "converge/summary_text.h"

namespace yat {

namespace {

using Json = nlohmann::ordered_json;

ConvergeSummary summary_of(const FinishedRuns& runs) {
  Experiment experiment;
  for (const ConvergeVariant& variant : runs.arguments.variants)
    experiment.variants.push_back(variant.name);
  for (const ConvergeVariant& variant : runs.arguments.variants)
    experiment.ladder.insert(experiment.ladder.end(), variant.ladder.begin(), variant.ladder.end());
  std::sort(experiment.ladder.begin(), experiment.ladder.end());
  experiment.ladder.erase(std::unique(experiment.ladder.begin(), experiment.ladder.end()),
                          experiment.ladder.end());
  experiment.runs = runs.folder.runs();
  experiment.reference = &runs.reference;
  for (const PixelMoments& moments : runs.moments) experiment.moments.push_back(&moments);
  return summarize(experiment);
}

constexpr double kAboutEqual = .75;

/// One picture of each variant with as many samples as fit into the least time that any of them
/// took at the rung that all have. By CPU time: others may use the machine. A noise target takes
/// the time that it takes: its variant is shown if that is about the same.
std::vector<EqualTimePicture> equal_time_pictures(const FinishedRuns& runs,
                                                  const ConvergeSummary& summary, Console& console,
                                                  std::atomic<bool>& stop) {
  double budget = INFINITY;
  for (const VariantSummary& v : summary.variants)
    budget = std::min(budget, v.rungs[v.headline].cpu_seconds);
  Progress silent(console, ProgressKind::kSilent);
  std::vector<EqualTimePicture> pictures;
  for (const VariantSummary& v : summary.variants) {
    const RungSummary& rung = v.rungs[v.headline];
    const auto variant =
        std::find_if(runs.arguments.variants.begin(), runs.arguments.variants.end(),
                     [&](const ConvergeVariant& a) { return a.name == v.name; });
    const double share = rung.cpu_seconds > 0 ? budget / rung.cpu_seconds : 1;
    if (variant->to_noise() && share < kAboutEqual) continue;
    const auto spp = uint32_t(std::max(1., std::round(rung.spp * share)));
    // A seed that no run has.
    const RunResult result =
        runs.renders.run(*variant, spp, run_seed(runs.arguments.seed, kNoRung, 1), silent, stop);
    if (stop) return {};
    pictures.push_back({v.name, result.image, result.samples_per_pixel, result.cpu_seconds});
  }
  return pictures;
}

std::vector<std::pair<std::string, std::string>> facts_of(const FinishedRuns& runs) {
  const ConvergeArguments& arguments = runs.arguments;
  const ConvergeScene& scene = runs.renders.scene(arguments.variants.front());
  const FilmSettings& film = scene.loaded.scene.film;
  const Machine machine = this_machine();
  const Reference& reference = runs.reference;
  std::string made = arguments.reference.empty() ? "made" : arguments.reference;
  if (reference.samples_per_pixel > 0)
    made += fmt::format(", {:.6g} spp", reference.samples_per_pixel);
  if (arguments.reference.empty())
    made += fmt::format(" by other seeds ({})", arguments.shared.options);
  return {
      {"scene", fmt::format("{}, hash {:016x}", arguments.scene, scene.loaded.scene.hash)},
      {"pixels", fmt::format("{} x {} of {} x {}", film.crop_width(), film.crop_height(),
                             film.width, film.height)},
      {"runs", fmt::format("{} of every variant and rung, in turn; --seed {}", arguments.runs,
                           arguments.seed)},
      {"reference", made},
      {"machine",
       fmt::format("{}, {} processors, {:.1f} GB{}{}", machine.cpu, machine.processors,
                   double(machine.memory_bytes) * 1e-9,
                   machine.clock_mhz > 0 ? fmt::format(", {:.0f} MHz now", machine.clock_mhz) : "",
                   machine.governor.empty() ? "" : ", governor " + machine.governor)},
      {"program", fmt::format("yat {} ({}), {}, {}, {}, kernels {}", kBuildInfo.version,
                              kBuildInfo.commit, kBuildInfo.compiler, kBuildInfo.build_type,
                              kBuildInfo.flags, scene.kernels->isa)},
      {"peak memory", fmt::format("{:.1f} MB of the whole process, all variants together",
                                  double(peak_memory_bytes()) * 1e-6)}};
}

}  // namespace

void write_report(const FinishedRuns& runs, Console& console, std::atomic<bool>& stop) {
  const ConvergeSummary summary = summary_of(runs);
  print(converge_tables(summary));

  Json records = Json::array();
  for (const RunRecord& record : runs.folder.runs()) records.push_back(record_json(record));
  const Json all = {
      {"experiment", runs.header}, {"summary", summary_json(summary)}, {"runs", records}};
  write_whole_file(runs.folder.file("report.json"),
                   all.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");

  ReportPage page;
  page.scene = runs.arguments.scene;
  page.facts = facts_of(runs);
  for (const ConvergeVariant& variant : runs.arguments.variants)
    page.variants.emplace_back(variant.name, variant.options);
  page.summary = &summary;
  page.reference = &runs.reference;
  if (!stop && !summary.variants.empty())
    page.pictures = equal_time_pictures(runs, summary, console, stop);
  write_whole_file(runs.folder.file("report.html"), report_html(page));
  write_whole_file(runs.folder.file("error-time.svg"), svg_plot(error_over_time(summary)));
  write_whole_file(runs.folder.file("error-cpu-time.svg"), svg_plot(error_over_cpu_time(summary)));
  write_whole_file(runs.folder.file("error-samples.svg"), svg_plot(error_over_samples(summary)));
}

}  // namespace yat

#include "converge/summary_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "converge/ladder.h"

namespace yat {

namespace {

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.3g}", value) : "-";
}

/// Rows of cells as lines, columns as wide as their widest cell; the first column is left-aligned.
std::string aligned(const std::vector<std::vector<std::string>>& rows) {
  std::vector<size_t> width;
  for (const auto& row : rows) {
    width.resize(std::max(width.size(), row.size()));
    for (size_t c = 0; c < row.size(); ++c) width[c] = std::max(width[c], row[c].size());
  }
  std::string text;
  for (const auto& row : rows) {
    for (size_t c = 0; c < row.size(); ++c)
      text += c == 0 ? fmt::format("{:<{}}", row[c], width[c])
                     : fmt::format("  {:>{}}", row[c], width[c]);
    text += '\n';
  }
  return text;
}

std::string bias_text(const VariantSummary& v) {
  std::string text = std::isfinite(v.bias_error)
                         ? fmt::format("{:+.3f} % +- {:.3f} % (z {:+.1f})", 100 * v.bias,
                                       100 * v.bias_error, v.bias_z())
                         : fmt::format("{:+.3f} %", 100 * v.bias);
  if (v.bias_test)
    text += fmt::format("; {} of {} pixels beyond chance; floor of the MSE {:.3g}",
                        v.bias_test->beyond, v.bias_test->pixels, v.bias_test->floor);
  return text;
}

}  // namespace

std::string seconds_text(double seconds) {
  if (!std::isfinite(seconds)) return "-";
  if (seconds < 120) return fmt::format("{:.3g} s", seconds);
  if (seconds < 7200) return fmt::format("{} min {:02} s", int(seconds) / 60, int(seconds) % 60);
  return seconds < 360000 ? fmt::format("{:.3g} h", seconds / 3600)
                          : fmt::format("{:.3g} days", seconds / 86400);
}

std::string samples_text(const RungSummary& rung) {
  return rung.spp == kTargetRung ? fmt::format("~{:.4g}", rung.samples) : std::to_string(rung.spp);
}

std::string measured_text(const Measured& m) {
  if (!std::isfinite(m.value)) return "-";
  if (!m.interval.known()) return number(m.value);
  return fmt::format("{} [{}, {}]", number(m.value), number(m.interval.low),
                     number(m.interval.high));
}

std::string time_text(const TimeToError& time) {
  const char* const mark = time.extrapolated && std::isfinite(time.seconds) ? "~" : "";
  return fmt::format("{}{}", mark, seconds_text(time.seconds));
}

std::string converge_tables(const ConvergeSummary& summary) {
  if (summary.variants.empty()) return "no run is finished\n";
  std::vector<std::vector<std::string>> table = {
      {"variant", "spp", "runs", "RMSE", "relMSE", "seconds", "CPU s", "TTUV", "TTUV, CPU"}};
  for (const VariantSummary& v : summary.variants)
    for (const RungSummary& r : v.rungs)
      table.push_back({v.name, samples_text(r), std::to_string(r.runs),
                       number(std::sqrt(r.mse.value)), number(r.rel_mse.value), number(r.seconds),
                       number(r.cpu_seconds), measured_text(r.ttuv), number(r.ttuv_cpu.value)});
  std::string text = aligned(table);

  const VariantSummary& first = summary.variants.front();
  text += fmt::format(
      "\nAt {} spp; ratio: of TTUV to the first variant's, below 1 is less time to the same error; "
      "[95 % interval]; ~ extrapolated\n",
      samples_text(first.rungs[first.headline]));
  table = {{"variant", "TTUV ratio", "by CPU time", "relMSE x CPU", "slope", "to relMSE 1e-2",
            "to 1e-3", "outliers", "trimmed"}};
  for (const VariantSummary& v : summary.variants) {
    const RungSummary& r = v.rungs[v.headline];
    table.push_back({v.name, measured_text(r.ttuv_ratio), measured_text(r.ttuv_cpu_ratio),
                     measured_text(r.rel_cpu_ratio), measured_text(v.slope),
                     time_text(v.to_rel_mse[0]), time_text(v.to_rel_mse[1]), number(r.outliers),
                     r.unreliable ? "unreliable" : number(r.rel_mse_trimmed)});
  }
  text += aligned(table) + "\nMean of the runs against the reference, at the highest rung:\n";
  for (const VariantSummary& v : summary.variants)
    text += fmt::format("{}: {}\n", v.name, bias_text(v));
  for (const std::string& warning : summary.warnings) text += fmt::format("warning: {}\n", warning);
  return text;
}

}  // namespace yat

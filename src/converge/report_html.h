#pragma once
// The report as one page that needs nothing else: plots, tables, pictures.

#include <string>
#include <utility>
#include <vector>

#include "converge/plot_svg.h"
#include "converge/summary.h"

namespace yat {

/// A picture of a variant that took as long as those of the others.
struct EqualTimePicture {
  std::string variant;
  Image image;
  double samples_per_pixel = 0, cpu_seconds = 0;
};

struct ReportPage {
  std::string scene;
  std::vector<std::pair<std::string, std::string>> facts;     ///< name and value, in their order
  std::vector<std::pair<std::string, std::string>> variants;  ///< name and options
  const ConvergeSummary* summary = nullptr;
  const Reference* reference = nullptr;
  std::vector<EqualTimePicture> pictures;  ///< may be none
};

/// RMSE over wall time, CPU time and samples, with 95 % intervals.
Plot error_over_time(const ConvergeSummary& summary);
Plot error_over_cpu_time(const ConvergeSummary& summary);
Plot error_over_samples(const ConvergeSummary& summary);

std::string report_html(const ReportPage& page);

}  // namespace yat

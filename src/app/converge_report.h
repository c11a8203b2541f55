#pragma once
// From finished runs to tables, report.json and report.html.

#include <atomic>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/console.h"
#include "app/converge_renders.h"
#include "converge/folder.h"
#include "converge/reference.h"

namespace yat {

struct FinishedRuns {
  const ConvergeArguments& arguments;
  const ConvergeRenders& renders;
  const ConvergeFolder& folder;
  nlohmann::ordered_json header;  ///< of the experiment
  const Reference& reference;
  std::vector<PixelMoments> moments;  ///< per variant, of its highest rung
};

/// Prints the tables and writes report.json, report.html and the plots into the folder. Renders one
/// picture more of every variant, of equal time, unless `stop` is set.
void write_report(const FinishedRuns& runs, Console& console, std::atomic<bool>& stop);

}  // namespace yat

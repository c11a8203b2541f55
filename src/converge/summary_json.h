#pragma once

#include <nlohmann/json_fwd.hpp>

#include "converge/summary.h"

namespace yat {

/// The summary as JSON; numbers that are not finite are null, intervals pairs [low, high].
nlohmann::ordered_json summary_json(const ConvergeSummary& summary);

}  // namespace yat

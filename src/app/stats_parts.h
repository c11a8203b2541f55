#pragma once
// Parts that all records of renders have, as JSON.

#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "base/stats.h"

namespace yat {

/// Occupied lanes by stage; stages that ran: time [s], items, calls.
nlohmann::ordered_json lanes_json(const RenderStats& stats);
nlohmann::ordered_json stages_json(const RenderStats& stats);
/// Compiler, flags, kernels; the processor and how much of it is used.
nlohmann::ordered_json build_json(std::string_view isa, uint32_t lanes);
nlohmann::ordered_json machine_json(uint32_t threads);

}  // namespace yat

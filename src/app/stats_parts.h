#pragma once
// Parts that all records of renders have, as JSON.

#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "app/pass_runner.h"

namespace yat {

/// Rays by kind. skipped_shadow: points of lights that were sampled, but bring nothing or lost
/// their roulette, so that no ray was traced.
nlohmann::ordered_json rays_json(const RenderStats& stats);
/// Occupied lanes by stage; stages that ran: time [s], items, bytes (of the columns that the items
/// take, see stage_row_bytes()), calls.
nlohmann::ordered_json lanes_json(const RenderStats& stats);
nlohmann::ordered_json stages_json(const RenderStats& stats);
/// Of a render to a noise target: what its own estimate said at the end.
nlohmann::ordered_json noise_json(const RenderTotals& totals);
/// Compiler, flags, kernels; the processor and how much of it is used.
nlohmann::ordered_json build_json(std::string_view isa, uint32_t lanes);
nlohmann::ordered_json machine_json(uint32_t threads);

}  // namespace yat

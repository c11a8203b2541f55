#pragma once
// What a run of `yat converge` leaves on record.

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "app/converge_renders.h"
#include "converge/record.h"
#include "converge/reference.h"

namespace yat {

/// What must be the same for runs to be compared: scene, options, program, machine, reference.
/// reference_spp: of one that is made; 0: `reference` was given.
nlohmann::ordered_json experiment_header(const ConvergeArguments& arguments,
                                         const ConvergeRenders& renders,
                                         const std::optional<Reference>& given);

/// The record of a run that is done. write_seconds: what it took to write its picture.
RunRecord record_of_run(const ConvergeArguments& arguments, const ConvergeRenders& renders,
                        const ConvergeVariant& variant, uint32_t spp, uint32_t run,
                        const RunResult& result, double write_seconds, const Reference& reference);

/// Samples per pixel of a reference that is made, and in how many parts of independent seeds.
inline constexpr uint32_t kReferenceFactor = 64, kReferenceParts = 8;

}  // namespace yat

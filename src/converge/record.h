#pragma once
// One run: what was rendered, how long it took, and how far it is from the reference.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "metrics/metrics.h"

namespace yat {

struct RunRecord {
  std::string variant;
  uint32_t spp = 0;                ///< the rung, or kTargetRung
  uint32_t run = 0, seed = 0;      ///< run: from 0
  double samples_per_pixel = 0;    ///< that the picture holds
  double seconds = 0;              ///< wall time of rendering alone
  double cpu_seconds = 0;          ///< of all threads, of rendering alone
  ImageError error;                ///< as measured: the reference's variance is still in it
  std::optional<double> hdr_flip;  ///< mean over pixels
  /// The rest of the record as the text of a JSON object: scene, build, machine, settings, times,
  /// rays, lanes, stages, drops, noise, reference.
  std::string details;
};

/// The record as one JSON object (docs/accuracy.md): the details with variant, run, seed, spp,
/// time.render, cpu_time, error and ttuv put in. Numbers that are not finite are null.
nlohmann::ordered_json record_json(const RunRecord& record);

/// Back from such an object. Throws Error saying what is missing.
RunRecord record_of(const nlohmann::ordered_json& object);

/// The record as a line of runs.csv, and the first line. Names are quoted; no newline at the end.
std::string_view csv_header();
std::string csv_line(const RunRecord& record);

}  // namespace yat

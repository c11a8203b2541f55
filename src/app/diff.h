#pragma once
// yat diff: two pictures compared in figures, with thresholds for scripts.

#include <optional>
#include <string>

#include "metrics/metrics.h"

namespace yat {

struct DiffArguments {
  std::string picture, reference;
  std::string output;  ///< map of the visible difference; empty: none
  std::optional<Thresholds> fail, warn;
  std::optional<double> fail_rel_mse, fail_flip;
};

enum class DiffVerdict { kWithin, kWarned, kFailed };

struct DiffResult {
  DiffVerdict verdict = DiffVerdict::kWithin;
  std::string text;  ///< the figures, a line each
};

/// Reads both pictures, compares them and writes the map: FLIP per pixel, of radiance where the
/// reference holds radiance. Throws Error if a picture cannot be read or the sizes differ,
/// ResourceError if the map cannot be written.
DiffResult diff(const DiffArguments& arguments);

}  // namespace yat

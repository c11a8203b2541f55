#pragma once
// What came out, as a table and as JSON.

#include <nlohmann/json.hpp>

#include "accuracy/case.h"
#include "accuracy/runs.h"

namespace yat::accuracy {

/// Radiances are computed in single precision: a value is not better than this share of itself,
/// however little the runs differ (16 roundings of 2^-24).
inline constexpr double kRounding = 1e-6;

struct Limits {
  double sigma = 3;     ///< |computed - expected|, in standard errors
  double error = 1e-3;  ///< standard error, in expected values
};

struct Outcome {
  const Case* c = nullptr;
  Known known;
  Measured measured;
  /// (computed - expected) over the root of the squared sum of the standard errors and kRounding of
  /// the expected value.
  double sigma() const;
  double relative_error() const;
  bool within(const Limits& limits) const;
};

void print_header();
void print_row(const Outcome& outcome, const Limits& limits);
/// Counts, the largest deviation, and what chance would give: p is the probability that the largest
/// of so many deviations is no smaller.
void print_summary(const std::vector<Outcome>& outcomes, const Limits& limits);
/// The table in Markdown, and what is missing below it.
std::string markdown(const std::vector<Outcome>& outcomes, const std::vector<Missing>& missing,
                     const Limits& limits);
nlohmann::ordered_json json_row(const Outcome& outcome, const Limits& limits);

}  // namespace yat::accuracy

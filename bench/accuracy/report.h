#pragma once
// What came out, as a table and as JSON.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

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
  /// How often chance brings a deviation of so many standard errors or more, either way: by
  /// Student's distribution, as the errors come from few runs, with the degrees of freedom of Welch
  /// and Satterthwaite.
  double chance_of(double deviation) const;
  bool within(const Limits& limits) const;
};

/// A case, and the same again where chance may have put it outside.
struct Verdict {
  Outcome first;
  std::optional<Outcome> again;  ///< other random numbers, kRepeatedRuns times as many runs
  /// The standard error is small enough, and what lay outside was not confirmed.
  bool good(const Limits& limits) const;
};
/// A bias that was just outside at first is then twice as many standard errors away.
inline constexpr uint32_t kRepeatedRuns = 4;

void print_header();
void print_row(const Verdict& verdict, const Limits& limits);
/// Counts; how many chance puts outside; the least probable deviation, and how often the least
/// probable of so many is no likelier.
void print_summary(const std::vector<Verdict>& verdicts, const Limits& limits);
/// The table in Markdown, and what is missing below it.
std::string markdown(const std::vector<Verdict>& verdicts, const std::vector<Missing>& missing,
                     const Limits& limits);
nlohmann::ordered_json json_row(const Verdict& verdict, const Limits& limits);

}  // namespace yat::accuracy

#pragma once
// What all runs together say of each variant: error and time by rung, efficiency, slope, bias.
//
// TTUV, time to unit variance, is MSE x time: of an unbiased method the same at any number of
// independent samples, and its ratio between two methods is the time that they need to the same
// error.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "converge/bias_test.h"
#include "converge/record.h"
#include "converge/reference.h"
#include "converge/statistics.h"

namespace yat {

/// A figure of the runs and its 95 % interval (bootstrap over runs).
struct Measured {
  double value = 0;
  Interval interval;
};

/// One variant at one number of samples, or at its noise target. Errors are means over runs, less
/// the reference's variance where that is above 1 % of them; times are medians.
struct RungSummary {
  uint32_t spp = 0, runs = 0;  ///< spp: see RunRecord
  double samples = 0;          ///< per pixel, mean over runs
  Measured mse, rel_mse;
  double mse_measured = 0;     ///< the reference's variance still in it
  double reference_share = 0;  ///< of mse_measured that is the reference's variance
  double rel_mse_trimmed = 0, rel_mse_untrimmed = 0;  ///< both as measured
  double mape = 0;
  std::optional<double> hdr_flip;
  double outliers = 0;  ///< pixels per run
  double seconds = 0, fastest = 0, seconds_deviation = 0, cpu_seconds = 0;
  Measured ttuv, ttuv_cpu;  ///< by wall and by CPU time
  /// To the first variant's, from the same seeds. Where either is at a noise target, to the first
  /// variant's rung of the nearest number of samples, whose seeds are others.
  Measured ttuv_ratio, ttuv_cpu_ratio;
  /// relMSE x CPU time, ratio to the first variant's: what the ratio of TTUV is without the rule of
  /// bright pixels.
  Measured rel_cpu_ratio;
  /// Trimmed and untrimmed relMSE differ by more than 2x: rare bright pixels make the error, and
  /// nothing that is said of it can be relied on.
  bool unreliable = false;
};

struct VariantSummary {
  std::string name;
  std::vector<RungSummary> rungs;  ///< those with runs, by ascending spp
  /// Index of the highest rung that all variants have that have rungs; else the noise target.
  size_t headline = 0;
  Measured slope;                         ///< of log RMSE over log spp, rungs from 4 samples on
  std::array<TimeToError, 2> to_rel_mse;  ///< to kTargets, wall time [s]
  /// (mean of runs - reference) / reference, of the whole picture at the highest rung, and its
  /// standard error from the runs and the reference.
  double bias = 0, bias_error = 0;
  std::optional<BiasTest> bias_test;  ///< at the highest rung
  double first_pixel = 0;             ///< read + build [s]
  double memory_bytes = 0;            ///< scene, film and work

  double bias_z() const { return bias / bias_error; }
  const RungSummary& top() const { return rungs.back(); }
};
inline constexpr std::array<double, 2> kTargets = {1e-2, 1e-3};  ///< relMSE

struct Experiment {
  std::vector<std::string> variants;
  std::vector<uint32_t> ladder;  ///< all rungs, ascending
  std::span<const RunRecord> runs;
  const Reference* reference = nullptr;
  /// Per variant: the pixels of its highest rung, or of none.
  std::vector<const PixelMoments*> moments;
};

struct ConvergeSummary {
  std::vector<VariantSummary> variants;  ///< those with runs
  double reference_variance = 0;         ///< mean over pixels and channels; 0: not known
  bool reference_variance_known = false;
  std::vector<std::string> warnings;  ///< whole sentences
};

/// Runs of a rung count as far as they are there without a gap from 0 on.
ConvergeSummary summarize(const Experiment& experiment);

}  // namespace yat

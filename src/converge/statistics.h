#pragma once
// What is said of many short runs: means, intervals, slopes, times to an error.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace yat {

/// A 95 % interval; both ends NaN where there are too few runs to tell.
struct Interval {
  double low, high;
  Interval();
  Interval(double low_end, double high_end) : low(low_end), high(high_end) {}
  bool known() const { return low <= high; }
  /// Whether it is known and `value` lies outside.
  bool excludes(double value) const { return known() && (value < low || value > high); }
};

/// NaN of nothing.
double mean_of(std::span<const double> values);
double median_of(std::span<const double> values);
/// Of a sample (n - 1); NaN of fewer than two values.
double deviation_of(std::span<const double> values);

/// A figure computed from some of the runs: rows of indices in [0, runs), perhaps several times the
/// same.
using RunStatistic = std::function<double(std::span<const uint32_t> runs)>;

/// Percentile bootstrap over runs (Efron 1979): the middle 95 % of the statistic over 2000 draws of
/// `runs` runs with repetition. The draws are the same in every call with the same number of runs.
/// Figures of several variants or rungs are to be computed from the same draw, so that what runs
/// share cancels out. Draws whose figure is not finite are left out; above 5 % of them, or with
/// fewer than two runs, the interval is unknown.
Interval bootstrap_interval(uint32_t runs, const RunStatistic& statistic);

/// Least squares slope of log y over log x; points that are not above 0 are left out. NaN of fewer
/// than two points.
double log_slope(std::span<const double> x, std::span<const double> y);

/// When a curve of error over time comes down to a target.
struct TimeToError {
  double seconds;             ///< NaN: the error does not fall
  bool extrapolated = false;  ///< beyond the curve's ends, along its nearest segment
  TimeToError();
};
/// Along straight lines between the points on log-log axes. seconds: ascending, above 0; errors
/// that are not above 0 are left out with their point.
TimeToError time_to_error(std::span<const double> seconds, std::span<const double> errors,
                          double target);

}  // namespace yat

#include "converge/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "converge/ladder.h"

namespace yat {

namespace {

constexpr double kSubtractFrom = .01;  // Share of the reference's variance in an error.
constexpr double kLargeShare = .2;
constexpr uint32_t kSlopeFrom = 4;  // Samples; below, most pixels see no light at all.
constexpr double kFlatSlope = -.48;
constexpr double kUnreliable = 2;
constexpr double kBiasZ = 3;
constexpr double kBiasShare = .0025;  // Of pixels; Mitsuba's tests accept as many.

/// The runs of a rung as columns, in the order of their seeds.
struct Runs {
  uint32_t spp = 0;
  std::vector<double> mse, rel_mse, trimmed, mape, seconds, cpu_seconds, outliers, bias, samples;
  std::vector<double> hdr_flip;
  double epsilon = 0;
  uint32_t count() const { return uint32_t(mse.size()); }
};

Runs runs_of(const Experiment& experiment, const std::string& variant, uint32_t spp) {
  std::vector<const RunRecord*> found;
  for (const RunRecord& r : experiment.runs)
    if (r.spp == spp && r.variant == variant) found.push_back(&r);
  std::sort(found.begin(), found.end(),
            [](const RunRecord* a, const RunRecord* b) { return a->run < b->run; });
  Runs runs;
  runs.spp = spp;
  for (const RunRecord* r : found) {
    if (r->run != runs.count()) break;
    runs.mse.push_back(r->error.mse);
    runs.rel_mse.push_back(r->error.rel_mse);
    runs.trimmed.push_back(r->error.rel_mse_trimmed);
    runs.mape.push_back(r->error.mape);
    runs.seconds.push_back(r->seconds);
    runs.cpu_seconds.push_back(r->cpu_seconds);
    runs.outliers.push_back(double(r->error.outliers));
    runs.bias.push_back(r->error.bias);
    runs.samples.push_back(r->samples_per_pixel);
    if (r->hdr_flip) runs.hdr_flip.push_back(*r->hdr_flip);
    runs.epsilon = r->error.epsilon;
  }
  return runs;
}

std::vector<double> drawn(const std::vector<double>& values, std::span<const uint32_t> runs) {
  std::vector<double> out(runs.size());
  for (size_t i = 0; i < runs.size(); ++i) out[i] = values[runs[i]];
  return out;
}

/// The statistic of all runs and its interval.
Measured measure(uint32_t runs, const RunStatistic& statistic) {
  std::vector<uint32_t> all(runs);
  for (uint32_t i = 0; i < runs; ++i) all[i] = i;
  return {statistic(all), bootstrap_interval(runs, statistic)};
}

/// The reference's part of the error `measured` that is to be taken off.
double part_to_subtract(double measured, double variance) {
  return variance > kSubtractFrom * measured ? variance : 0;
}

double subtracted(const Runs& r, const ConvergeSummary& all) {
  return part_to_subtract(mean_of(r.mse), all.reference_variance);
}

double ttuv_of(const Runs& r, const std::vector<double>& seconds, double off,
               std::span<const uint32_t> draw) {
  return (mean_of(drawn(r.mse, draw)) - off) * median_of(drawn(seconds, draw));
}

/// The same of relMSE.
double rel_variance_off(const Runs& r, const Reference& reference) {
  return part_to_subtract(mean_of(r.rel_mse), mean_relative_variance(reference, r.epsilon));
}

RungSummary summarize_rung(const Runs& r, const Runs& first, const Reference& reference,
                           const ConvergeSummary& all) {
  RungSummary s;
  s.spp = r.spp;
  s.runs = r.count();
  s.samples = mean_of(r.samples);
  s.mse_measured = mean_of(r.mse);
  s.reference_share = all.reference_variance / s.mse_measured;
  const double off = subtracted(r, all), off_first = subtracted(first, all);
  const double rel_off = rel_variance_off(r, reference);
  const auto mean_less = [](const std::vector<double>& values, double less) {
    return [&values, less](std::span<const uint32_t> draw) {
      return mean_of(drawn(values, draw)) - less;
    };
  };
  s.mse = measure(s.runs, mean_less(r.mse, off));
  s.rel_mse = measure(s.runs, mean_less(r.rel_mse, rel_off));
  s.rel_mse_untrimmed = mean_of(r.rel_mse);
  s.rel_mse_trimmed = mean_of(r.trimmed);
  s.unreliable = s.rel_mse_untrimmed > kUnreliable * s.rel_mse_trimmed;
  s.mape = mean_of(r.mape);
  if (!r.hdr_flip.empty()) s.hdr_flip = mean_of(r.hdr_flip);
  s.outliers = mean_of(r.outliers);
  s.seconds = median_of(r.seconds);
  s.fastest = *std::min_element(r.seconds.begin(), r.seconds.end());
  s.seconds_deviation = deviation_of(r.seconds);
  s.cpu_seconds = median_of(r.cpu_seconds);

  const auto efficiency = [&](std::vector<double> Runs::* seconds, Measured& ttuv,
                              Measured& ratio) {
    ttuv = measure(
        s.runs, [&](std::span<const uint32_t> draw) { return ttuv_of(r, r.*seconds, off, draw); });
    const uint32_t pairs = std::min(s.runs, first.count());
    if (pairs > 0)
      ratio = measure(pairs, [&](std::span<const uint32_t> draw) {
        return ttuv_of(r, r.*seconds, off, draw) / ttuv_of(first, first.*seconds, off_first, draw);
      });
  };
  efficiency(&Runs::seconds, s.ttuv, s.ttuv_ratio);
  efficiency(&Runs::cpu_seconds, s.ttuv_cpu, s.ttuv_cpu_ratio);
  if (const uint32_t pairs = std::min(s.runs, first.count()); pairs > 0) {
    const double rel_off_first = rel_variance_off(first, reference);
    const auto product = [](const Runs& of, double less, std::span<const uint32_t> draw) {
      return (mean_of(drawn(of.rel_mse, draw)) - less) * median_of(drawn(of.cpu_seconds, draw));
    };
    s.rel_cpu_ratio = measure(pairs, [&](std::span<const uint32_t> draw) {
      return product(r, rel_off, draw) / product(first, rel_off_first, draw);
    });
  }
  return s;
}

/// Of log RMSE over log spp, all rungs drawn together.
Measured slope_of(const std::vector<Runs>& rungs, const ConvergeSummary& all) {
  std::vector<const Runs*> used;
  std::vector<double> spp;
  uint32_t runs = UINT32_MAX;
  for (const Runs& r : rungs)
    if (r.spp >= kSlopeFrom) {
      used.push_back(&r);
      spp.push_back(r.spp);
      runs = std::min(runs, r.count());
    }
  if (used.size() < 2) return {std::numeric_limits<double>::quiet_NaN(), {}};
  return measure(runs, [&](std::span<const uint32_t> draw) {
    std::vector<double> rmse;
    for (const Runs* r : used) {
      const double mse = mean_of(drawn(r->mse, draw)) - subtracted(*r, all);
      rmse.push_back(mse > 0 ? std::sqrt(mse) : 0);
    }
    return log_slope(spp, rmse);
  });
}

/// What is not measured by errors, from the record of a run.
void add_costs(const Experiment& experiment, VariantSummary& s) {
  for (const RunRecord& r : experiment.runs) {
    if (r.variant != s.name) continue;
    const auto details = nlohmann::json::parse(r.details, nullptr, false);
    if (!details.is_object()) continue;
    s.first_pixel = details.value(nlohmann::json::json_pointer("/time/first_pixel"), 0.);
    double bytes = 0;
    for (const char* part : {"/memory/scene", "/memory/film", "/memory/work"})
      bytes += details.value(nlohmann::json::json_pointer(part), 0.);
    s.memory_bytes = std::max(s.memory_bytes, bytes);
  }
}

/// What of the first variant a rung is compared with: the same rung; where a noise target decides
/// about samples, the one with the nearest number of them.
const Runs* counterpart(const Runs& r, const std::vector<Runs>& first) {
  const Runs* best = nullptr;
  double least = INFINITY;
  for (const Runs& f : first) {
    const bool same = f.spp == r.spp;
    if (!same && f.spp != kTargetRung && r.spp != kTargetRung) continue;
    const double apart = same ? -1 : std::fabs(std::log(mean_of(f.samples) / mean_of(r.samples)));
    if (apart < least) {
      least = apart;
      best = &f;
    }
  }
  return best;
}

VariantSummary summarize_variant(const Experiment& experiment, const std::string& name,
                                 const std::vector<Runs>& rungs, const std::vector<Runs>& first,
                                 const PixelMoments* moments, const ConvergeSummary& all) {
  VariantSummary s;
  s.name = name;
  std::vector<double> seconds, rel_mse;
  for (const Runs& r : rungs) {
    const Runs* const measure = counterpart(r, first);
    s.rungs.push_back(summarize_rung(r, measure ? *measure : Runs(), *experiment.reference, all));
    seconds.push_back(s.rungs.back().seconds);
    rel_mse.push_back(s.rungs.back().rel_mse.value);
  }
  s.slope = slope_of(rungs, all);
  for (size_t i = 0; i < kTargets.size(); ++i)
    s.to_rel_mse[i] = time_to_error(seconds, rel_mse, kTargets[i]);

  const Runs& top = rungs.back();
  s.bias = mean_of(top.bias);
  // Relative to the mean of the reference, of which epsilon is a hundredth of the square.
  const double level = std::sqrt(top.epsilon * 100);
  const double of_reference =
      all.reference_variance / double(experiment.reference->image.pixels()) / 3 / (level * level);
  const double deviation = deviation_of(top.bias);
  // The channels of a pixel vary together: at most 3 times as much as if they did not.
  s.bias_error = std::sqrt(deviation * deviation / top.count() + 3 * of_reference);
  if (moments && moments->count() >= 2) s.bias_test = test_bias(*moments, *experiment.reference);
  add_costs(experiment, s);
  return s;
}

void add_warnings(ConvergeSummary& all) {
  const auto warn = [&](std::string text) { all.warnings.push_back(std::move(text)); };
  if (!all.reference_variance_known)
    warn(
        "The reference does not say its variance: it counts as exact. If it is not, errors are too "
        "large by its variance and slopes too flat; \"floor\" is an estimate of it that assumes "
        "that no variant is biased.");
  for (const VariantSummary& v : all.variants) {
    const RungSummary& top = v.top();
    if (top.reference_share > kLargeShare)
      warn(fmt::format(
          "{}: {:.0f} % of the MSE at {:.6g} spp is the reference's own variance: it is "
          "subtracted, but the rest is uncertain. Take a reference of more samples.",
          v.name, 100 * top.reference_share, top.samples));
    if (!(top.mse.value > 0))
      warn(fmt::format("{}: the MSE at {:.6g} spp is not above the reference's variance.", v.name,
                       top.samples));
    if (top.unreliable)
      warn(fmt::format(
          "{}: unreliable: relMSE at {:.6g} spp is {:.3g}, but {:.3g} without the worst "
          "0.1 % of pixels: rare bright samples make the error.",
          v.name, top.samples, top.rel_mse_untrimmed, top.rel_mse_trimmed));
    // Where the interval reaches down to it, chance may have made it flat.
    if (v.slope.interval.known() ? v.slope.interval.low > kFlatSlope : v.slope.value > kFlatSlope)
      warn(
          fmt::format("{}: the slope {:.3f} is flatter than {}: bias, a heavy tail or a reference "
                      "that is not converged.",
                      v.name, v.slope.value, kFlatSlope));
    if (std::abs(v.bias_z()) > kBiasZ)
      warn(
          fmt::format("{}: the mean of its runs differs from the reference by {:+.3g} %, {:.1f} "
                      "standard errors.",
                      v.name, 100 * v.bias, v.bias_z()));
    if (v.bias_test && v.bias_test->share() > kBiasShare)
      warn(
          fmt::format("{}: {:.2g} % of the pixels differ from the reference by more than chance "
                      "(above {:.2g} %).",
                      v.name, 100 * v.bias_test->share(), 100 * kBiasShare));
  }
}

}  // namespace

ConvergeSummary summarize(const Experiment& experiment) {
  ConvergeSummary all;
  all.reference_variance = mean_variance(*experiment.reference);
  all.reference_variance_known = !experiment.reference->variance.empty();
  std::vector<Runs> first;
  for (size_t i = 0; i < experiment.variants.size(); ++i) {
    std::vector<Runs> rungs;
    for (const uint32_t spp : experiment.ladder)
      if (Runs r = runs_of(experiment, experiment.variants[i], spp); r.count())
        rungs.push_back(std::move(r));
    if (i == 0) first = rungs;
    if (rungs.empty()) continue;
    all.variants.push_back(
        summarize_variant(experiment, experiment.variants[i], rungs, first,
                          i < experiment.moments.size() ? experiment.moments[i] : nullptr, all));
  }
  // Variants are compared where all of them have been; a noise target is the only rung there.
  uint32_t common = UINT32_MAX;
  for (const VariantSummary& v : all.variants)
    if (v.top().spp != kTargetRung) common = std::min(common, v.top().spp);
  for (VariantSummary& v : all.variants)
    while (v.headline + 1 < v.rungs.size() && v.rungs[v.headline + 1].spp <= common) ++v.headline;
  add_warnings(all);
  return all;
}

}  // namespace yat

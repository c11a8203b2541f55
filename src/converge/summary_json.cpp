#include "converge/summary_json.h"

#include <nlohmann/json.hpp>

namespace yat {

namespace {

using Json = nlohmann::ordered_json;

Json measured(const Measured& m) {
  return {{"value", m.value}, {"ci95", {m.interval.low, m.interval.high}}};
}

Json rung_json(const RungSummary& r) {
  return {
      {"spp", r.spp},
      {"samples_per_pixel", r.samples},
      {"runs", r.runs},
      {"mse", measured(r.mse)},
      {"mse_measured", r.mse_measured},
      {"reference_share", r.reference_share},
      {"relmse", measured(r.rel_mse)},
      {"relmse_untrimmed", r.rel_mse_untrimmed},
      {"relmse_trimmed", r.rel_mse_trimmed},
      {"unreliable", r.unreliable},
      {"mape", r.mape},
      {"flip", r.hdr_flip ? Json(*r.hdr_flip) : Json()},
      {"outliers", r.outliers},
      {"seconds", {{"median", r.seconds}, {"min", r.fastest}, {"deviation", r.seconds_deviation}}},
      {"cpu_seconds", r.cpu_seconds},
      {"ttuv", measured(r.ttuv)},
      {"ttuv_cpu", measured(r.ttuv_cpu)},
      {"ttuv_ratio", measured(r.ttuv_ratio)},
      {"ttuv_cpu_ratio", measured(r.ttuv_cpu_ratio)},
      {"relmse_cpu_ratio", measured(r.rel_cpu_ratio)}};
}

Json variant_json(const VariantSummary& v) {
  Json rungs = Json::array();
  for (const RungSummary& r : v.rungs) rungs.push_back(rung_json(r));
  Json times = Json::array();
  for (size_t i = 0; i < kTargets.size(); ++i)
    times.push_back({{"relmse", kTargets[i]},
                     {"seconds", v.to_rel_mse[i].seconds},
                     {"extrapolated", v.to_rel_mse[i].extrapolated}});
  Json bias = {{"difference", v.bias}, {"standard_error", v.bias_error}, {"z", v.bias_z()}};
  if (v.bias_test) {
    bias["pixels"] = v.bias_test->pixels;
    bias["pixels_beyond"] = v.bias_test->beyond;
    bias["floor"] = v.bias_test->floor;
  }
  return {{"name", v.name},
          {"slope", measured(v.slope)},
          {"headline_spp", v.rungs[v.headline].spp},
          {"time_to", times},
          {"bias", bias},
          {"first_pixel", v.first_pixel},
          {"memory", v.memory_bytes},
          {"rungs", rungs}};
}

}  // namespace

Json summary_json(const ConvergeSummary& summary) {
  Json variants = Json::array();
  for (const VariantSummary& v : summary.variants) variants.push_back(variant_json(v));
  return {{"reference_variance",
           summary.reference_variance_known ? Json(summary.reference_variance) : Json()},
          {"variants", variants},
          {"warnings", summary.warnings}};
}

}  // namespace yat

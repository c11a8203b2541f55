// The record of --stats.

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/build_info.h"
#include "app/machine.h"
#include "app/option_names.h"
#include "app/report.h"
#include "app/stats_parts.h"
#include "wavefront/stages.h"

namespace yat {

namespace {
using Json = nlohmann::ordered_json;
}

Json rays_json(const RenderStats& stats) {
  const uint64_t sampled = stats.stages[uint32_t(Stage::kLightSample)].rows;
  return {{"camera", stats.camera_rays},
          {"bounce", stats.bounce_rays},
          {"shadow", stats.shadow_rays},
          {"skipped_shadow", sampled - std::min(sampled, stats.shadow_rays)}};
}

Json lanes_json(const RenderStats& stats) {
  Json lanes = Json::object();
  for (uint32_t i = 0; i < kStages; ++i) {
    const StageCount& stage = stats.stages[i];
    if (stage.lanes_total)
      lanes[std::string(stage_name(Stage(i)))] =
          double(stage.lanes_active) / double(stage.lanes_total);
  }
  return lanes;
}

Json stages_json(const RenderStats& stats) {
  Json stages = Json::object();
  for (uint32_t i = 0; i < kStages; ++i) {
    const StageCount& stage = stats.stages[i];
    if (stage.calls == 0 && stage.nanoseconds == 0) continue;
    stages[std::string(stage_name(Stage(i)))] = {{"time", double(stage.nanoseconds) * 1e-9},
                                                 {"items", stage.rows},
                                                 {"bytes", stage.rows * stage_row_bytes(Stage(i))},
                                                 {"calls", stage.calls}};
  }
  return stages;
}

Json noise_json(const RenderTotals& totals) {
  const NoiseEstimate& noise = *totals.noise;
  return {{"target", totals.noise_target}, {"reached", totals.noise_reached()},
          {"relmse", noise.rel_mse},       {"relmse_interval", {noise.low(), noise.high()}},
          {"epsilon", noise.epsilon},      {"mse", noise.mse},
          {"adaptive", totals.adaptive}};
}

Json build_json(std::string_view isa, uint32_t lanes) {
  return {{"compiler", kBuildInfo.compiler},
          {"type", kBuildInfo.build_type},
          {"flags", kBuildInfo.flags},
          {"isa", isa},
          {"lanes", lanes}};
}

Json machine_json(uint32_t threads) {
  const Machine machine = this_machine();
  return {{"cpu", machine.cpu},
          {"cores", machine.processors},
          {"threads", threads},
          {"clock_mhz", machine.clock_mhz > 0 ? Json(machine.clock_mhz) : Json()},
          {"governor", machine.governor.empty() ? Json() : Json(machine.governor)},
          {"memory", machine.memory_bytes}};
}

namespace {

Json dropped_of(const RenderReport& report) {
  Json dropped = Json::object();
  for (uint32_t cause = 0; cause < kDropCauses; ++cause)
    dropped[std::string(drop_cause_name(DropCause(cause)))] = report.totals.drops.count[cause];
  dropped["replay"] = replay_commands(report);
  return dropped;
}

}  // namespace

std::string stats_json(const RenderReport& report) {
  const RenderStats& stats = report.totals.stats;
  Json record;
  record["scene"] = report.scene;
  record["scene_hash"] = fmt::format("{:016x}", report.scene_hash);
  record["version"] = kBuildInfo.version;
  record["commit"] = kBuildInfo.commit;
  record["build"] = build_json(report.isa, report.lanes);
  record["machine"] = machine_json(report.threads);
  record["seed"] = report.transport.seed;
  record["spp"] = report.samples_per_pixel();
  record["resolution"] = {report.film.width, report.film.height};
  record["settings"] = {
      {"crop",
       {report.film.crop_x0, report.film.crop_x1, report.film.crop_y0, report.film.crop_y1}},
      {"integrator", name_of(report.integrator, kIntegrators)},
      {"max_depth", report.transport.max_depth},
      {"sampler", name_of(report.sampler, kSamplers)},
      {"light_choice", name_of(report.light_choice, kLightChoices)},
      {"light_sampling", name_of(report.light_sampling, kLightSamplings)},
      {"roulette", report.transport.roulette_depth == kNoRoulette
                       ? Json(nullptr)
                       : Json(report.transport.roulette_depth)},
      {"shadow_roulette",
       report.shadow_roulette == kNoShadowRoulette ? Json(nullptr) : Json(report.shadow_roulette)},
      {"colour", name_of(report.colour, kColourModes)},
      {"tonemap", name_of(report.film.tone_map, kToneMaps)},
      {"exposure", report.film.exposure_stops},
      {"outputs", report.outputs}};
  record["time"] = {
      {"read", report.time.read},     {"build", report.time.build},
      {"render", report.time.render}, {"pilot", report.totals.pilot_seconds},
      {"write", report.time.write},   {"first_pixel", report.time.read + report.time.build}};
  record["cpu_time"] = cpu_seconds();
  record["peak_rss"] = peak_memory_bytes();
  record["memory"] = {{"scene", report.scene_bytes},
                      {"film", report.film_bytes},
                      {"work", report.totals.scratch_bytes}};
  record["samples"] = report.samples;
  record["paths"] = stats.paths;
  record["passes"] = report.totals.passes;
  record["shadow_bound"] = report.totals.shadow_bound;
  record["interrupted"] = report.interrupted;
  record["timed_out"] = report.totals.timed_out;
  if (report.totals.noise) record["noise"] = noise_json(report.totals);
  record["rays"] = rays_json(stats);
  record["lanes"] = lanes_json(stats);
  record["stages"] = stages_json(stats);
  record["dropped"] = dropped_of(report);
  // A file name need not be UTF-8; JSON must be.
  return record.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace yat

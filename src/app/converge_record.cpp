#include "app/converge_record.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/build_info.h"
#include "app/machine.h"
#include "app/option_names.h"
#include "app/stats_parts.h"
#include "converge/hash.h"
#include "converge/ladder.h"
#include "metrics/flip.h"

namespace yat {

namespace {

using Json = nlohmann::ordered_json;

/// The commit, or of a program that was built from none the program itself.
std::string program_identity() {
  std::string identity(kBuildInfo.commit);
  if (!identity.ends_with('+') && identity != "unknown") return identity;
  return fmt::format("{} {:016x}", identity, fnv1a_of_file("/proc/self/exe"));
}

Json settings_of(const ConvergeRenders& renders, const ConvergeVariant& variant, const Plan& plan) {
  const Loaded& loaded = renders.scene(variant).loaded;
  const FilmSettings& film = loaded.scene.film;
  return {{"options", variant.options},
          {"crop", {film.crop_x0, film.crop_x1, film.crop_y0, film.crop_y1}},
          {"integrator", name_of(loaded.integrator, kIntegrators)},
          {"max_depth", plan.transport.max_depth},
          {"sampler", name_of(plan.sampler, kSamplers)},
          {"sample_set", plan.set_columns * plan.set_rows},
          {"light_tree", plan.light_tree},
          {"light_sampling", name_of(plan.light_sampling, kLightSamplings)},
          {"roulette", plan.transport.roulette_depth == kNoRoulette
                           ? Json("off")
                           : Json(plan.transport.roulette_depth)},
          {"shadow_roulette", shadow_roulette_name(plan.shadow_roulette)},
          {"colour", name_of(colour_mode(variant.arguments), kColourModes)},
          {"compat", name_of(variant.arguments.dialect, kDialects)}};
}

Json dropped_of(const RenderTotals& totals) {
  Json dropped = Json::object();
  for (uint32_t cause = 0; cause < kDropCauses; ++cause)
    dropped[std::string(drop_cause_name(DropCause(cause)))] = totals.drops.count[cause];
  return dropped;
}

}  // namespace

Json experiment_header(const ConvergeArguments& arguments, const ConvergeRenders& renders,
                       const std::optional<Reference>& given) {
  const ConvergeScene& first = renders.scene(arguments.variants.front());
  const FilmSettings& film = first.loaded.scene.film;
  const Machine machine = this_machine();
  Json reference;
  if (given)
    reference = {{"hash", fmt::format("{:016x}", given->hash)}};
  else
    reference = {{"options", arguments.shared.options},
                 {"spp", uint64_t(arguments.ladder.back()) * kReferenceFactor}};
  return {{"yat_converge", 1},
          {"scene_hash", fmt::format("{:016x}", first.loaded.scene.hash)},
          {"program", program_identity()},
          {"isa", first.kernels->isa},
          {"machine", fmt::format("{}, {} processors", machine.cpu, machine.processors)},
          {"resolution", {film.width, film.height}},
          {"pixels", {film.crop_width(), film.crop_height()}},
          {"seed", arguments.seed},
          {"reference", reference}};
}

RunRecord record_of_run(const ConvergeArguments& arguments, const ConvergeRenders& renders,
                        const ConvergeVariant& variant, uint32_t spp, uint32_t run,
                        const RunResult& result, double write_seconds, const Reference& reference) {
  RunRecord record;
  record.variant = variant.name;
  record.spp = spp;
  record.run = run;
  record.seed = run_seed(arguments.seed, spp, run);
  record.samples_per_pixel = result.samples_per_pixel;
  record.seconds = result.totals.seconds;
  record.cpu_seconds = result.cpu_seconds;
  record.error = image_error(result.image, reference.image);
  record.hdr_flip = hdr_flip(result.image, reference.image).mean;

  const ConvergeScene& scene = renders.scene(variant);
  const Plan plan = renders.plan(variant, spp, record.seed);
  const PhaseTimes& time = scene.loaded.time;
  const RenderStats& stats = result.totals.stats;
  Json details = {
      {"scene", arguments.scene},
      {"scene_hash", fmt::format("{:016x}", scene.loaded.scene.hash)},
      {"version", kBuildInfo.version},
      {"commit", kBuildInfo.commit},
      {"build", build_json(scene.kernels->isa, scene.kernels->lanes)},
      {"machine", machine_json(renders.threads(variant))},
      {"resolution", {scene.loaded.scene.film.width, scene.loaded.scene.film.height}},
      {"settings", settings_of(renders, variant, plan)},
      {"time",
       {{"read", time.read},
        {"build", time.build},
        {"render", record.seconds},
        {"pilot", result.totals.pilot_seconds},
        {"write", write_seconds},
        {"first_pixel", time.read + time.build}}},
      {"peak_rss", peak_memory_bytes()},
      {"memory",
       {{"scene", scene.bytes},
        {"film", result.film_bytes},
        {"work", result.totals.scratch_bytes}}},
      {"shadow_bound", result.totals.shadow_bound},
      {"rays", rays_json(stats)},
      {"lanes", lanes_json(stats)},
      {"stages", stages_json(stats)},
      {"dropped", dropped_of(result.totals)},
      {"reference",
       {{"hash", fmt::format("{:016x}", reference.hash)},
        {"spp", reference.samples_per_pixel},
        {"variance", reference.variance.empty() ? Json() : Json(mean_variance(reference))}}}};
  if (result.totals.noise) details["noise"] = noise_json(result.totals);
  record.details = details.dump(-1, ' ', false, Json::error_handler_t::replace);
  return record;
}

}  // namespace yat

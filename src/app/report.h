#pragma once
// What a render did, for people (text), for scripts (--stats) and for timelines (--trace).

#include <cstdint>
#include <string>
#include <vector>

#include "app/arguments.h"
#include "app/passes.h"

namespace yat {

/// Wall time of the phases [s].
struct PhaseTimes {
  double read = 0, build = 0, render = 0, write = 0;
};

/// Everything that the reports tell of.
struct RenderReport {
  std::string scene;  ///< as given on the command line
  uint64_t scene_hash = 0;
  FilmSettings film;
  Integrator integrator = Integrator::kPath;
  SamplerKind sampler = SamplerKind::kSobol;
  uint32_t sample_set = 64;  ///< of stratified samplers
  ColourMode colour = ColourMode::kBands;
  Dialect dialect = Dialect::kLuxRender;
  TransportOptions transport;
  LightSampling light_sampling = LightSampling::kBoth;
  double shadow_roulette = kUsualShadowRoulette;  ///< as asked for, see PlanOptions
  LightChoosing light_choice = LightChoosing::kAuto;
  TreeChoice tree = TreeChoice::kFromScene;
  InstanceMode instances = InstanceMode::kAuto;
  uint64_t image_bytes = ImageStore::kDefaultLimit;  ///< most memory for texels
  EnergyCompensation compensation = EnergyCompensation::kAuto;
  std::string isa;
  uint32_t lanes = 0, threads = 0;
  PhaseTimes time;
  RenderTotals totals;
  uint64_t samples = 0;  ///< in the film, over all pixels
  bool interrupted = false;
  uint64_t scene_bytes = 0, film_bytes = 0;
  std::vector<std::string> outputs;

  uint64_t pixels() const { return uint64_t(film.crop_width()) * film.crop_height(); }
  double samples_per_pixel() const { return pixels() ? double(samples) / double(pixels()) : 0; }
};

/// The summary at the end of a render, lines without a last newline.
std::string summary_text(const RenderReport& report, Verbosity verbosity);

/// Command lines that render again just the dropped paths that were kept, one each.
std::vector<std::string> replay_commands(const RenderReport& report);

/// The record of --stats, one JSON object.
std::string stats_json(const RenderReport& report);

/// The phases and the stages of every worker as Chrome trace events ("Trace Event Format", JSON
/// object form; times in microseconds). The stages' clock starts where the render phase does.
std::string trace_json(const RenderReport& report);

std::string_view drop_cause_name(DropCause cause);

}  // namespace yat

#pragma once
// What yat render and yat info were asked for.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "film/features.h"
#include "film/settings.h"
#include "scene/colour_model.h"
#include "scene/compile.h"
#include "wavefront/plan.h"

namespace yat {

enum class ProgressKind { kAuto, kBar, kPlain, kJson, kSilent };
enum class Verbosity { kQuiet, kNormal, kVerbose };

/// Whether blocks of pixels get samples by their noise; kAuto: where that pays.
enum class Adaptive { kAuto, kOn, kOff };

/// Half-open range of sample indices of every pixel.
struct SampleRange {
  uint32_t first = 0, end = 0;
};

/// What was asked for. An empty optional: as the scene says.
struct Arguments {
  std::string scene;
  std::vector<std::string> outputs;
  std::optional<uint32_t> samples_per_pixel;
  std::optional<SampleRange> samples_range;
  std::optional<double> time_limit;    ///< of rendering [s]
  std::optional<double> noise_target;  ///< relMSE at which to stop
  Adaptive adaptive = Adaptive::kOff;  ///< with a noise target
  uint32_t threads = 0;                ///< 0: one per processor
  std::optional<Integrator> integrator;
  std::optional<uint32_t> max_depth;
  std::optional<SamplerKind> sampler;
  std::optional<uint32_t> sample_set;
  std::optional<ColourMode> colour;  ///< empty: as the dialect says
  Dialect dialect = Dialect::kLuxRender;
  uint32_t seed = 0;
  uint32_t width = 0, height = 0;            ///< 0: as the film says [pixels]
  std::optional<std::array<float, 4>> crop;  ///< fractions x0 x1 y0 y1
  TreeChoice tree = TreeChoice::kFromScene;
  InstanceMode instances = InstanceMode::kAuto;
  LightChoosing light_choice = LightChoosing::kAuto;
  LightSampling light_sampling = LightSampling::kBoth;
  uint32_t roulette_depth = TransportOptions{}.roulette_depth;
  double shadow_roulette = kUsualShadowRoulette;     ///< see PlanOptions
  uint64_t image_bytes = ImageStore::kDefaultLimit;  ///< --texture-cache
  EnergyCompensation compensation = EnergyCompensation::kAuto;
  std::string isa;
  std::optional<ToneMap> tone_map;
  float exposure_stops = 0;
  FeatureSet features = 0;
  std::string stats_file, trace_file;
  ProgressKind progress = ProgressKind::kAuto;
  Verbosity verbosity = Verbosity::kNormal;
};

}  // namespace yat

#pragma once
// A number that is known, and the renders that should give it.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "kernels/table.h"
#include "scene/compile.h"
#include "scene/dialect.h"
#include "wavefront/plan.h"

namespace yat::accuracy {

/// One render, of which a multiple of the picture's mean counts.
struct Probe {
  std::string scene;       ///< scene text (.lxs); every pixel of it counts the same
  uint32_t max_depth = 1;  ///< as PlanOptions::max_depth
  double factor = 1;       ///< value per mean radiance of the picture
  bool indirect = false;   ///< count light only that was scattered more than once
  Dialect dialect = Dialect::kLuxRender;
  EnergyCompensation compensation = EnergyCompensation::kAuto;
  LightSampling light_sampling = LightSampling::kBoth;
  uint32_t width = 0, height = 0;  ///< as CompileOptions has them
  float crop[4] = {0, 1, 0, 1};
};

struct Effort {
  uint32_t runs = 32;            ///< independent runs (seeds) that the standard error comes from
  uint32_t seed = 0;             ///< another one gives all cases other random numbers
  double target = 3e-4;          ///< standard error to plan for, of the expected value
  double limit = 1e-3;           ///< standard error above which runs are added
  uint32_t most = 8;             ///< times `runs`, at most, where they are
  double scale = 1;              ///< times the samples that this takes
  uint32_t least_spp = 2048;     ///< per run: rare paths have to be among the samples at all
  uint32_t most_spp = 1u << 20;  ///< the standard error stays larger where that is not enough
};

/// What renders.
struct Machine {
  const KernelTable& kernels;
  ThreadPool& pool;
  Effort effort;
};

/// What is expected, and how well that is known itself (0 for a formula or quadrature).
struct Known {
  double value = 0;
  double error = 0;   ///< standard error, or what single precision takes in a way that is known
  uint32_t runs = 0;  ///< that the error comes from; 0: it comes from none
};

struct Case {
  std::string name;           ///< "lights.square.centre": family first
  std::string what;           ///< for people, in one line
  std::vector<Probe> probes;  ///< the computed value is the sum over them
  std::function<Known(const Machine&)> expected;
  std::optional<double> published;     ///< the same number in print, to as many digits as there
  std::function<void()> prepare = {};  ///< called before the first render: makes files
  double effort = 1;   ///< standard error to plan for, times that of others: 2 where it is dear
  bool extra = false;  ///< like others; only on demand
};

/// A number of the method note or of CIE 171 that cannot be had from yat, and why.
struct Missing {
  std::string name, reason;
};

/// A case whose value is a constant or a closed form that costs nothing.
inline std::function<Known(const Machine&)> known(double value) {
  return [value](const Machine&) { return Known{value}; };
}

// The families, in the order of the report.
void add_light_cases(std::vector<Case>& cases);
void add_room_cases(std::vector<Case>& cases);
void add_glass_cases(std::vector<Case>& cases);
void add_lobe_cases(std::vector<Case>& cases, std::vector<Missing>& missing);
void add_cie_lamp_cases(std::vector<Case>& cases, std::vector<Missing>& missing);
void add_cie_sky_cases(std::vector<Case>& cases, std::vector<Missing>& missing);
void add_veach_cases(std::vector<Case>& cases);

}  // namespace yat::accuracy

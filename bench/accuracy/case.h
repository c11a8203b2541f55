#pragma once
// A number that is known, and the renders that should give it.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scene/compile.h"
#include "scene/dialect.h"

namespace yat::accuracy {

/// One render, of which a multiple of the picture's mean counts.
struct Probe {
  std::string scene;       ///< scene text (.lxs); every pixel of it counts the same
  uint32_t max_depth = 1;  ///< as PlanOptions::max_depth
  double factor = 1;       ///< value per mean radiance of the picture
  bool indirect = false;   ///< count light only that was scattered more than once
  Dialect dialect = Dialect::kLuxRender;
  EnergyCompensation compensation = EnergyCompensation::kAuto;
};

/// What is expected, and how well that is known itself (0 for a formula or quadrature).
struct Known {
  double value = 0;
  double error = 0;  ///< standard error, or what single precision takes in a way that is known
};

struct Case {
  std::string name;           ///< "lights.square.centre": family first
  std::string what;           ///< for people, in one line
  std::vector<Probe> probes;  ///< the computed value is the sum over them
  std::function<Known()> expected;
  std::optional<double> published;     ///< the same number in print, to as many digits as there
  std::function<void()> prepare = {};  ///< called before the first render: makes files
  double effort = 1;   ///< standard error to plan for, times that of others: > 1 where it is dear
  bool extra = false;  ///< like others; only on demand
};

/// A number of the method note or of CIE 171 that cannot be had from yat, and why.
struct Missing {
  std::string name, reason;
};

/// A case whose value is a constant or a closed form that costs nothing.
inline std::function<Known()> known(double value) {
  return [value] { return Known{value, 0}; };
}

// The families, in the order of the report.
void add_light_cases(std::vector<Case>& cases);
void add_room_cases(std::vector<Case>& cases);
void add_glass_cases(std::vector<Case>& cases);
void add_lobe_cases(std::vector<Case>& cases, std::vector<Missing>& missing);
void add_cie_lamp_cases(std::vector<Case>& cases, std::vector<Missing>& missing);
void add_cie_sky_cases(std::vector<Case>& cases, std::vector<Missing>& missing);

}  // namespace yat::accuracy

#pragma once
// Renders the probes of a case until its value is known well enough.

#include <cstdint>

#include "accuracy/case.h"

namespace yat::accuracy {

struct Measured {
  double value = 0;
  double error = 0;      ///< standard error of the value, from the spread of the runs
  uint64_t samples = 0;  ///< paths behind the value
  uint32_t spp = 0;      ///< per run and pixel
  double seconds = 0;    ///< processor time, planning included
};

/// Takes the mean of `runs` renders with seeds of their own, of 2^k samples per pixel each. How
/// many that is says a pilot with other seeds, which does not count: a stop by what has been seen
/// would be biased. Throws Error where a scene is not understood to the last word.
Measured measure(const Case& c, double expected, const Machine& machine);

/// The same value by plain code: the scalar reference in double precision (wavefront/reference.h),
/// with seeds of its own.
Known by_reference(const Probe& probe, double target, const Machine& machine);
/// The same value by another estimator, with seeds of its own.
Known by_render(const Probe& probe, double target, const Machine& machine);

}  // namespace yat::accuracy

#pragma once
// Renders the probes of a case until its value is known well enough.

#include <cstdint>

#include "accuracy/case.h"

namespace yat::accuracy {

struct Measured {
  double value = 0;
  double error = 0;      ///< standard error of the value, from the spread of the runs
  uint32_t runs = 0;     ///< independent ones
  uint64_t samples = 0;  ///< paths behind the value
  uint32_t spp = 0;      ///< per run and pixel
  double seconds = 0;    ///< processor time, planning included
};

/// Takes the mean of `runs` renders with seeds of their own, of 2^k samples per pixel each. How
/// many that is says a pilot with other seeds, which does not count: a stop by the values that have
/// been seen would be biased. While the standard error is above Effort::limit of what is expected,
/// that is hypot(error, expected.error), as many runs are added as there are, up to `most` times
/// `runs`. This stop looks at the spread of the runs alone. Means of thousands of paths are normal,
/// and the mean and the spread of normal numbers are independent, so it takes nothing
/// from what it stops at. Each case has random numbers of its own. Throws Error where a scene is
/// not understood to the last word.
Measured measure(const Case& c, const Known& expected, const Machine& machine);

/// The same value by plain code: the scalar reference in double precision (wavefront/reference.h).
/// name: the case that it is for.
Known by_reference(const std::string& name, const Probe& probe, double target,
                   const Machine& machine);
/// The same value by another estimator.
Known by_render(const std::string& name, const Probe& probe, double target, const Machine& machine);

}  // namespace yat::accuracy

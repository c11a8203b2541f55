#pragma once
// Renders the probes of a case until its value is known well enough.

#include <cstdint>

#include "accuracy/case.h"
#include "base/parallel.h"
#include "kernels/table.h"

namespace yat::accuracy {

struct Effort {
  uint32_t runs = 32;            ///< independent runs (seeds) that the standard error comes from
  uint32_t seed = 0;             ///< of the first run
  double target = 3e-4;          ///< standard error to plan for, of the expected value
  double scale = 1;              ///< times the samples that this takes
  uint32_t least_spp = 2048;     ///< per run: rare paths have to be among the samples at all
  uint32_t most_spp = 1u << 20;  ///< the standard error stays larger where that is not enough
};

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
Measured measure(const Case& c, double expected, const KernelTable& kernels, ThreadPool& pool,
                 const Effort& effort);

}  // namespace yat::accuracy

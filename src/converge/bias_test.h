#pragma once
// Whether the runs' mean is the reference: what tells bias from noise.

#include <cstdint>

#include "converge/pixel_moments.h"
#include "converge/reference.h"

namespace yat {

struct BiasTest {
  uint32_t runs = 0;
  /// Pixels whose mean luminance differs by more than chance lets any of all pixels differ in 1 %
  /// of experiments (Welch's test, correction of Sidak 1967). A pixel that few of its samples light
  /// may show none of them, and no spread then: each has that of its tile of 8 x 8 pixels at least.
  /// Pixels of tiles without any spread count if they differ by more than rounding.
  uint64_t pixels = 0, beyond = 0;
  /// Mean over pixels and channels of (mean of runs - r)^2 less its expectation from the runs'
  /// spread: squared bias and the reference's own variance. Not above noise where it is below 0.
  double floor;
  double share() const { return pixels ? double(beyond) / double(pixels) : 0; }
};

/// runs: pictures of one number of samples and independent seeds. A reference whose variance is not
/// known counts as exact. With few samples a pixel's values are not normally distributed, and the
/// test then finds more pixels than differ: judge it at the highest rung. Throws
/// std::invalid_argument if the sizes differ.
BiasTest test_bias(const PixelMoments& runs, const Reference& reference);

}  // namespace yat

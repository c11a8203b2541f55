#pragma once
// How far a picture is from a reference, in the metrics of Monte Carlo rendering.
//
// Trimmed and median figures hide rare bright pixels, so they stand beside the others and never
// alone: where MSE and trimmed MSE differ much, the picture has fireflies.

#include <cstdint>
#include <span>
#include <vector>

#include "metrics/image.h"

namespace yat {

/// x: the picture, r: the reference; means over all pixels and channels whose numbers are finite in
/// both, accumulated in double.
struct ImageError {
  double mean = 0;             ///< mean of r
  double epsilon = 0;          ///< .01 mean(r)^2, of relMSE; of a black reference .01
  double mse = 0;              ///< mean (x - r)^2
  double rel_mse = 0;          ///< mean (x - r)^2 / (r^2 + epsilon)
  double rel_mse_trimmed = 0;  ///< without the .1 % of pixels where it is largest
  double mape = 0;             ///< mean |x - r| / (|r| + .01 mean(r))
  double bias = 0;             ///< mean (x - r) / mean(r)
  double peak = 1;             ///< of PSNR: 1 for display values, else the largest r
  double psnr = 0;             ///< 10 log10(peak^2 / MSE) [dB]; infinite if MSE is 0
  double largest = 0;          ///< |x - r|
  uint32_t x = 0, y = 0;       ///< where
  uint32_t channel = 0;        ///< of it: 0 R, 1 G, 2 B
  uint64_t outliers = 0;       ///< pixels brighter than r by more than 20 deviations
  uint64_t not_finite = 0;     ///< pixels left out
};

/// Throws Error if the sizes differ or no pixel is finite in both. The deviation that outliers are
/// counted by is 1.4826 times the median over pixels of |x - r| / sqrt(r^2 + epsilon), in
/// luminance: what a normal distribution has, and rare samples cannot move it.
ImageError image_error(const Image& picture, const Image& reference);

/// Thresholds for the pixels of two pictures, in linear light as Image holds them. The words are
/// those of OpenImageIO's `idiff`.
struct Thresholds {
  double each = 0;     ///< largest difference of any channel that is let pass
  double percent = 0;  ///< of the pixels may go beyond `each`
  double any = 1e30;   ///< beyond it one pixel suffices
};

/// Pixels beyond a threshold. One that is not finite in either picture is beyond all.
struct PixelCount {
  uint64_t beyond_each = 0, beyond_any = 0;
  bool fails(const Thresholds& t, size_t pixels) const {
    return beyond_any > 0 || double(beyond_each) > t.percent / 100 * double(pixels);
  }
};
/// Throws Error if the sizes differ.
PixelCount count_beyond(const Image& picture, const Image& reference, const Thresholds& t);

}  // namespace yat

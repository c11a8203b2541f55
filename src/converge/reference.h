#pragma once
// The picture that errors are measured against, and how well it is known itself.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "converge/pixel_moments.h"
#include "metrics/image.h"

namespace yat {

struct Reference {
  Image image;
  /// Of the pixel's mean, per channel; empty: not known, taken as 0.
  std::vector<double> variance;
  uint32_t degrees = 0;  ///< of freedom of `variance`; 0: many
  std::string path;
  uint64_t hash = 0;                         ///< FNV-1a of the file
  double samples_per_pixel = 0;              ///< 0: the file does not say
  std::optional<uint64_t> seed, scene_hash;  ///< as a picture of yat says
};

/// Reads a picture. Its variance is known if it holds the channels variance.R .G .B (of a sample)
/// and sample_count, as `yat render --aov variance,sample_count` and make_reference() write them.
/// Throws Error if it cannot be read, is not of radiance, or holds numbers that are not finite.
Reference read_reference(const std::string& path);

/// Of several parts of independent seeds: the mean, and its variance from what the parts differ by,
/// which is right for any sampler. part_samples: per pixel, of each part. Throws
/// std::invalid_argument with fewer than two parts.
Reference reference_of(const PixelMoments& parts, uint32_t part_samples);

/// Mean of the variance over pixels and channels: what the reference adds to the MSE of every
/// picture that is independent of it. relative: of each divided by r^2 + epsilon, as in relMSE.
double mean_variance(const Reference& reference);
double mean_relative_variance(const Reference& reference, double epsilon);

}  // namespace yat

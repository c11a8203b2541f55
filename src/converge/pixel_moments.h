#pragma once
// Mean and spread of every pixel over pictures of independent seeds.

#include <string>
#include <string_view>
#include <vector>

#include "metrics/image.h"

namespace yat {

class PixelMoments {
 public:
  PixelMoments() = default;
  PixelMoments(uint32_t width, uint32_t height);

  /// Adds a picture (Welford 1962: no cancellation). Throws std::invalid_argument if its size is
  /// another.
  void add(const Image& picture);
  uint32_t count() const { return count_; }
  uint32_t width() const { return width_; }
  uint32_t height() const { return height_; }

  /// Per channel, width * height * 3, row by row.
  const std::vector<double>& mean() const { return mean_; }
  /// Unbiased variance of one picture, per channel; 0 with fewer than two.
  std::vector<double> variance() const;
  Image mean_image() const;

  /// Everything as bytes of this machine, and back: false (and nothing changed) if the bytes are
  /// not of such a picture of this size.
  std::string bytes() const;
  bool restore(std::string_view bytes);

 private:
  uint32_t width_ = 0, height_ = 0, count_ = 0;
  std::vector<double> mean_, squares_;  ///< sum of squared distances from the mean
};

}  // namespace yat

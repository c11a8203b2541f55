#pragma once
// Pictures for eyes: what was rendered and where it is wrong, whole and in crops.

#include <cstdint>
#include <string>
#include <vector>

#include "metrics/image.h"

namespace yat {

/// A part of a picture [pixels], and how many of them along an edge are shown as one.
struct Region {
  uint32_t x = 0, y = 0, width = 0, height = 0;
  uint32_t shrink = 1;
  uint32_t shown_width() const { return width / shrink; }
  uint32_t shown_height() const { return height / shrink; }
};
/// The whole picture, at most some 480 pixels wide.
Region whole_of(const Image& picture);

/// How radiance and errors are shown: the same for all pictures of a report.
struct Showing {
  double white = 1;           ///< luminance that becomes white: the reference's 98 % quantile
  double largest = 1;         ///< relative error at the end of the colour scale
  std::vector<Region> crops;  ///< where errors are largest, and where they are as usual
};

/// Chosen by the reference and pictures of its size that are compared with it, at least one. The
/// colour scale ends where 99 % of the first picture's errors lie below.
Showing choose_showing(const Image& reference, const std::vector<Image>& pictures);

/// |x - r| / sqrt(r^2 + epsilon) per pixel, of luminance; epsilon as in relMSE. Of pictures of one
/// size.
std::vector<float> relative_errors(const Image& picture, const Image& reference);

/// A part of the picture in linear light up to white, then sRGB's curve (IEC 61966-2-1), as a PNG
/// in a data: URI.
std::string picture_uri(const Image& picture, const Region& part, const Showing& showing);
/// The same of relative errors, by colour from black (none) over violet and orange to white.
std::string error_uri(const std::vector<float>& errors, uint32_t picture_width, const Region& part,
                      const Showing& showing);

}  // namespace yat

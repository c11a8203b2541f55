#pragma once
// FLIP: the difference that a viewer sees who flips between two pictures on a screen.
//
// Source: Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild, "FLIP: A Difference
// Evaluator for Alternating Images", 2020 (display values); Andersson, Nilsson, Shirley,
// Akenine-Moeller, "Visualizing Errors in Rendered High Dynamic Range Images", 2021 (radiance).

#include <vector>

#include "metrics/image.h"

namespace yat {

/// A screen .7 m wide with 3840 pixels at .7 m, as in the paper.
inline constexpr double kPixelsPerDegree = .7 * 3840 / .7 * 3.14159265358979323846 / 180;

struct FlipMap {
  std::vector<float> values;  ///< per pixel, 0 (the same) to 1
  double mean = 0;
  uint32_t exposures = 1;  ///< HDR: how many were looked at
  double first_stop = 0, last_stop = 0;
};

/// Of display pictures: linear values are clamped to 0..1. Throws Error if the sizes differ or no
/// pixel is there.
FlipMap flip(const Image& picture, const Image& reference,
             double pixels_per_degree = kPixelsPerDegree);

/// Of radiance: the largest FLIP per pixel over a range of exposures in steps of about one stop,
/// from where the reference's brightest pixel is nearly white to where its median is (2021,
/// section 3), through the ACES curve (fit of Narkowicz 2015). Values that are not finite count as
/// 0, negative ones too. A reference without light is compared as it is.
FlipMap hdr_flip(const Image& picture, const Image& reference,
                 double pixels_per_degree = kPixelsPerDegree);

}  // namespace yat

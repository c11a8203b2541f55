#pragma once
// A picture as two half pictures of disjoint, independent samples. Their difference tells the error
// of their mean, whatever the sampler: samples of a stratified set depend on each other, so that
// their own variance says too much; two sets do not.
//
// A and B: the halves' means of a pixel, of n_A and n_B samples. The picture is s A + (1 - s) B,
// its variance estimated by s (1 - s) (A - B)^2, which is exact in expectation
//
//   for s = n_A / (n_A + n_B) where the variance of a half falls with 1 / n (and for any law where
//   n_A = n_B): Weigh::kByCount, the mean of all samples;
//   for s = 1 / 2 always, as Var(A / 2 + B / 2) = E (A - B)^2 / 4: Weigh::kEqually. This is the one
//   for numbers of samples that were decided by what samples were like (wavefront/allocation.h):
//   n_A is then known given B, and n_B given A, but n_A / (n_A + n_B) knows both, and would bring
//   back the bias that keeping them apart avoids.

#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "film/film.h"

namespace yat {

enum class Weigh { kByCount, kEqually };

/// Error of a picture, estimated from its halves.
///
/// relMSE is mean (x - r)^2 / (r^2 + epsilon) with epsilon = .01 mean(r)^2, as `yat diff` prints it
/// (metrics/metrics.h). The true r under the fraction is not known, and the pixel's own mean x
/// would not do: a bright stray sample moves it along with the error, and would hide itself. In its
/// place stands x where x is confirmed by the darker half of the pixel or by the median of the
/// pixel and its eight neighbours, else the brighter of these two:
///
///   min(x, max(median, min(A, B))).
///
/// Against the true r (CornellBox, Sponza, dragon, LuxTime at 160 x 120 pixels, 64 to 256 samples)
/// that says 0 to 8 % too much; by own means it would be up to 80 % too little. Of pictures with
/// relMSE above .1 it may say half too much.
///
/// Pixels are independent (each sample belongs to one pixel), so the standard error comes from the
/// scatter of the pixels' terms: half the squared difference of neighbours in a row, whose errors
/// are alike. Rare bright samples that no pixel has met yet are in neither number.
struct NoiseEstimate {
  double mean = 0;     ///< of the picture, over pixels and channels
  double epsilon = 0;  ///< of relMSE; of a black picture .01
  double mse = 0;      ///< unbiased
  double rel_mse = 0;
  double rel_mse_se = 0;  ///< standard error of rel_mse
  uint64_t pixels = 0;    ///< that have samples in both halves: the others are left out

  /// Ends of the interval that holds the true value with 95 %.
  double low() const {
    return rel_mse > kQuantile * rel_mse_se ? rel_mse - kQuantile * rel_mse_se : 0;
  }
  double high() const { return rel_mse + kQuantile * rel_mse_se; }
  static constexpr double kQuantile = 1.959964;
};

/// width * height * 3 values of the picture that the halves make, linear Rec.709. A pixel with
/// samples in one half only has that half's mean; without any it is 0. Throws
/// std::invalid_argument when the sizes differ.
std::vector<float> resolve_halves(const Film& a, const Film& b, Weigh weigh);

/// The same bits for any pool. Two pixels in a row at least, else the standard error is 0. Throws
/// std::invalid_argument when the sizes differ.
NoiseEstimate estimate_noise(const Film& a, const Film& b, Weigh weigh, ThreadPool& pool);

/// Relative variance of the picture (the terms of relMSE) per block of edge x edge pixels, row by
/// row: means over the block's pixels that have samples in both halves, 0 if there is none.
std::vector<double> block_noise(const Film& a, const Film& b, Weigh weigh, uint32_t edge,
                                ThreadPool& pool);

}  // namespace yat

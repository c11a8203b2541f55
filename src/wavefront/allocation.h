#pragma once
// How many samples each block of pixels gets, so that all samples together bring relMSE down most.
//
// With n samples in block b its pixels' relative variance is v_b / n, and the mean over blocks is
// least for a given number of samples where n is proportional to sqrt(v_b) (Neyman 1934). v_b comes
// from a pilot of few samples. Costs per sample are taken as equal: to weigh them they would have
// to be known without a clock, or the picture would depend on it (invariant 3).
//
// Without bias. There are two half pictures. The number of samples n of half A is a function of B's
// pilot alone, and that of B a function of A's pilot alone. Given B's pilot, n is a constant, A is
// the mean of n samples, and E(A | pilot of B) = mu, hence E A = mu; so for B; and the picture is
// A / 2 + B / 2. Had A's own pilot decided, n would be large where the pilot happened to be noisy,
// which is where it met rare bright samples; these would then be diluted by many, and kept where
// there were none: E A < mu. (Weights n_A / (n_A + n_B) would do the same by the back door.)
// The halves are then not quite uncorrelated: with c = Cov(A's pilot mean, n_0 / n_B) of the n_0
// samples of a pilot, Cov(A, B) is c^2, the square of what the bias would have been, and the
// estimated variance (A - B)^2 / 4 is too small by c^2.

#include <cstdint>
#include <vector>

#include "wavefront/work.h"

namespace yat {

/// Weights of the blocks, of mean 1: square roots of `variance`, made smooth.
///
/// variance: relative variance of a sample per block, columns * rows of them, row by row, estimated
/// from a pilot. Such estimates are noisy, most of all where light is rare: each becomes the mean
/// of its 3 x 3 neighbourhood by weights 1 2 1, and gets 1 % of the picture's mean besides. So
/// neighbouring blocks do not differ so much that their edges would be seen. No weight is above 8:
/// more would hang on a single sample. Without any variance all weights are 1.
std::vector<double> sample_weights(const std::vector<double>& variance, uint32_t columns,
                                   uint32_t rows);

/// How many times as many samples would be needed for the same mean of `variance` were all blocks
/// sampled alike, instead of by these weights: mean(v) mean(w) / mean(v / w). To be asked with the
/// variance that another pilot found than the one that the weights are from: else it praises
/// weights that follow the accidents of their own pilot, and these are most of it where light is
/// rare.
double gain_of(const std::vector<double>& weights, const std::vector<double>& variance);

/// The number next to x >= 1 (by ratio) among 1, 2, 3, 4, 6, 8, 12, 16, 24, ...: powers of two and
/// those half way between, of which the sobol sampler makes good sets. At most 2^29.
uint32_t nice_count(double x);

/// Samples of every pixel of each block: nice_count(scale * weight), at least `least`.
std::vector<uint32_t> sample_counts(const std::vector<double>& weights, double scale,
                                    uint32_t least);

/// The largest scale with which both halves together have at most `most` samples in the picture.
/// weights: of both halves; pixels: of each block. The scale is found to 1 part in 10^6; it is 0
/// where even `least` is too much.
double scale_for(const std::vector<double> (&weights)[2], const std::vector<uint32_t>& pixels,
                 uint32_t least, uint64_t most);

/// Samples of the picture with so many per pixel of each block.
uint64_t total_samples(const std::vector<uint32_t>& counts, const std::vector<uint32_t>& pixels);

}  // namespace yat

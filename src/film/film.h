#pragma once
// The film: exact sums of samples per pixel. Adding is associative to the bit (128-bit fixed
// point), so threads, tile order and merged sample ranges cannot change the picture (invariant 3).

#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "film/settings.h"

namespace yat {

/// 128-bit fixed point with 64 fractional bits: holds sums up to 9.2e18 in steps of 5.4e-20.
__extension__ typedef __int128 Fixed;

/// Largest magnitude of a channel that a sample may bring [W/m2/sr]: 2^23 samples of it still fit.
inline constexpr float kLargestSample = 0x1p40f;

/// The Fixed nearest to x. Exact for |x| >= 2^-41 and for 0 (a float has 24 bits); below that
/// rounded to the nearest step of 2^-64, ties to even, so the error is at most 2.8e-20. Magnitudes
/// of 2^62 and more, infinities included, become +-2^62; a NaN becomes 0.
inline Fixed to_fixed(float x) noexcept;
/// The double nearest to x.
double from_fixed(Fixed x) noexcept;

/// to_fixed() of what has no exact answer: below 2^-41, from 2^62 on, and no numbers.
Fixed to_fixed_at_ends(float x) noexcept;

// Here, because every path ends with three of them.
inline Fixed to_fixed(float x) noexcept {
  const uint32_t bits = std::bit_cast<uint32_t>(x);
  // |x| = mantissa * 2^(shift - 64).
  constexpr uint32_t kLeast = 127 - 41, kTooLarge = 127 + 62;  // exponents as they are stored
  const uint32_t shift = (bits >> 23 & 0xff) - kLeast;
  if (shift >= kTooLarge - kLeast) return bits << 1 ? to_fixed_at_ends(x) : 0;
  const Fixed magnitude = Fixed((bits & 0x7fffff) | 0x800000) << shift;
  return bits >> 31 ? -magnitude : magnitude;
}

/// One cache line.
struct alignas(64) FilmPixel {
  Fixed r = 0, g = 0, b = 0;  ///< sums of linear Rec.709 radiance, filter sign included
  uint64_t samples = 0;

  /// Adds one sample if every channel is finite and at most kLargestSample in magnitude; says
  /// whether it did. A refused sample is not counted: the mean stays that of the others.
  bool add(float sample_r, float sample_g, float sample_b) noexcept {
    // A comparison with a NaN is false.
    if (!(std::fabs(sample_r) <= kLargestSample && std::fabs(sample_g) <= kLargestSample &&
          std::fabs(sample_b) <= kLargestSample))
      return false;
    r += to_fixed(sample_r);
    g += to_fixed(sample_g);
    b += to_fixed(sample_b);
    ++samples;
    return true;
  }
  void merge(const FilmPixel& other) noexcept {
    r += other.r;
    g += other.g;
    b += other.b;
    samples += other.samples;
  }
};
static_assert(sizeof(FilmPixel) == 64);

class Film {
 public:
  Film(uint32_t width, uint32_t height);
  uint32_t width() const { return width_; }
  uint32_t height() const { return height_; }
  FilmPixel& at(uint32_t x, uint32_t y) { return pixels_[size_t(y) * width_ + x]; }
  const FilmPixel& at(uint32_t x, uint32_t y) const { return pixels_[size_t(y) * width_ + x]; }
  FilmPixel* data() { return pixels_.data(); }
  const FilmPixel* data() const { return pixels_.data(); }
  /// Adds the other film's sums. Throws std::invalid_argument when the sizes differ.
  void merge(const Film& other);
  uint64_t total_samples() const;
  /// width * height * 3 means, linear Rec.709; 0 where a pixel has no sample.
  std::vector<float> resolve() const;
  size_t bytes() const { return pixels_.size() * sizeof(FilmPixel); }

 private:
  uint32_t width_, height_;
  std::vector<FilmPixel> pixels_;
};

}  // namespace yat

#pragma once
// The film: exact sums of samples per pixel. Adding is associative to the bit (128-bit fixed
// point), so threads, tile order and merged sample ranges cannot change the picture (invariant 3).

#include <cstdint>
#include <vector>

#include "film/settings.h"

namespace yat {

/// 128-bit fixed point with 64 fractional bits: holds sums up to 9e18 in steps of 5.4e-20.
__extension__ typedef __int128 Fixed;

/// Nearest Fixed to a finite float with |x| < 2^62 (else clamped: the caller counts it).
Fixed to_fixed(float x) noexcept;
double from_fixed(Fixed x) noexcept;

struct FilmPixel {
  Fixed r = 0, g = 0, b = 0;  ///< sums of linear Rec.709 radiance, filter sign included
  uint64_t samples = 0;
};

class Film {
 public:
  Film(uint32_t width, uint32_t height);
  uint32_t width() const { return width_; }
  uint32_t height() const { return height_; }
  FilmPixel& at(uint32_t x, uint32_t y) { return pixels_[size_t(y) * width_ + x]; }
  const FilmPixel& at(uint32_t x, uint32_t y) const { return pixels_[size_t(y) * width_ + x]; }
  FilmPixel* data() { return pixels_.data(); }
  const FilmPixel* data() const { return pixels_.data(); }
  /// Adds the other film's sums; sizes must agree.
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

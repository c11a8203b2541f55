#include "film/film.h"

#include <bit>
#include <stdexcept>

namespace yat {

namespace {
constexpr int kFractionBits = 64;
constexpr int kMantissaBits = 23;
constexpr int kExponentBias = 127;
}  // namespace

Fixed to_fixed_at_ends(float x) noexcept {
  const uint32_t bits = std::bit_cast<uint32_t>(x);
  const bool negative = bits >> 31;
  const int exponent = int(bits >> kMantissaBits & 0xff);
  const uint32_t fraction = bits & 0x7fffff;
  if (exponent >= kExponentBias + 62) {
    if (exponent == 0xff && fraction) return 0;
    const Fixed limit = Fixed(1) << (62 + kFractionBits);
    return negative ? -limit : limit;
  }
  // |x| = mantissa * 2^(shift - 64); denormals have no hidden bit and the exponent of the smallest
  // normal number.
  const uint64_t mantissa = exponent ? fraction | 0x800000u : fraction;
  const int shift = (exponent ? exponent : 1) - kExponentBias - kMantissaBits + kFractionBits;
  if (shift <= -26) return 0;  // below half a step
  const uint64_t half = uint64_t(1) << (-shift - 1);
  const uint64_t odd = mantissa >> -shift & 1;
  const auto magnitude = Fixed((mantissa + half - 1 + odd) >> -shift);
  return negative ? -magnitude : magnitude;
}

double from_fixed(Fixed x) noexcept {
  return double(x) * 0x1p-64;  // exact: a power of two, and nothing is that small
}

Film::Film(uint32_t width, uint32_t height)
    : width_(width), height_(height), pixels_(size_t(width) * height) {}

void Film::merge(const Film& other) {
  if (other.width_ != width_ || other.height_ != height_)
    throw std::invalid_argument("Film::merge: the films differ in size");
  for (size_t i = 0; i < pixels_.size(); ++i) pixels_[i].merge(other.pixels_[i]);
}

uint64_t Film::total_samples() const {
  uint64_t total = 0;
  for (const FilmPixel& pixel : pixels_) total += pixel.samples;
  return total;
}

std::vector<float> Film::resolve() const {
  std::vector<float> rgb(pixels_.size() * 3);
  for (size_t i = 0; i < pixels_.size(); ++i) {
    const FilmPixel& pixel = pixels_[i];
    if (!pixel.samples) continue;
    const double n = double(pixel.samples);
    rgb[3 * i] = float(from_fixed(pixel.r) / n);
    rgb[3 * i + 1] = float(from_fixed(pixel.g) / n);
    rgb[3 * i + 2] = float(from_fixed(pixel.b) / n);
  }
  return rgb;
}

}  // namespace yat

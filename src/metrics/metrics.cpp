#include "metrics/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace yat {
namespace {

constexpr double kTrimmed = 1e-3;
constexpr double kOutlier = 20;

void require_same_size(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height)
    throw Error(fmt::format("error: the pictures are {}x{} and {}x{} pixels: give two of one size",
                            a.width, a.height, b.width, b.height));
}

bool is_finite(const float* p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

double luminance(const float* p) {
  return 0.2126 * double(p[0]) + 0.7152 * double(p[1]) + 0.0722 * double(p[2]);
}

}  // namespace

ImageError image_error(const Image& picture, const Image& reference) {
  require_same_size(picture, reference);
  const size_t pixels = reference.pixels();
  const float* const xs = picture.rgb.data();
  const float* const rs = reference.rgb.data();
  ImageError e;
  double largest_reference = 0;
  size_t used = 0;
  for (size_t p = 0; p < pixels; ++p) {
    if (!is_finite(xs + 3 * p) || !is_finite(rs + 3 * p)) {
      ++e.not_finite;
      continue;
    }
    ++used;
    for (size_t c = 0; c < 3; ++c) {
      e.mean += double(rs[3 * p + c]);
      largest_reference = std::max(largest_reference, double(rs[3 * p + c]));
    }
  }
  if (used == 0) throw Error("error: no pixel is finite in both pictures");
  const double n = 3 * double(used);
  e.mean /= n;
  // A black reference leaves nothing to be relative to: then errors are as in a picture of mean 1.
  const double level = e.mean != 0 ? e.mean : 1;
  e.epsilon = .01 * level * level;
  const double shift = .01 * std::abs(level);
  e.peak = reference.scene_referred && largest_reference > 0 ? largest_reference : 1;

  std::vector<double> relative;   // Of each pixel: sum over its channels.
  std::vector<double> deviation;  // Of each pixel: of the luminance, signed.
  relative.reserve(used);
  deviation.reserve(used);
  for (size_t p = 0; p < pixels; ++p) {
    const float *const x = xs + 3 * p, *const r = rs + 3 * p;
    if (!is_finite(x) || !is_finite(r)) continue;
    double sum = 0;
    for (size_t c = 0; c < 3; ++c) {
      const double value = double(r[c]), d = double(x[c]) - value;
      e.mse += d * d;
      e.bias += d;
      e.mape += std::abs(d) / (std::abs(value) + shift);
      sum += d * d / (value * value + e.epsilon);
      if (std::abs(d) > e.largest) {
        e.largest = std::abs(d);
        e.x = uint32_t(p % reference.width);
        e.y = uint32_t(p / reference.width);
        e.channel = uint32_t(c);
      }
    }
    relative.push_back(sum);
    e.rel_mse += sum;
    const double light = luminance(r);
    deviation.push_back((luminance(x) - light) / std::sqrt(light * light + e.epsilon));
  }
  e.mse /= n;
  e.rel_mse /= n;
  e.mape /= n;
  e.bias = e.mean != 0 ? e.bias / n / e.mean : 0;
  e.psnr = e.mse > 0 ? 10 * std::log10(e.peak * e.peak / e.mse)
                     : std::numeric_limits<double>::infinity();

  const auto dropped = size_t(std::ceil(kTrimmed * double(used)));
  const auto kept = relative.end() - std::ptrdiff_t(std::min(dropped, used - 1));
  std::nth_element(relative.begin(), kept - 1, relative.end());
  for (auto it = relative.begin(); it != kept; ++it) e.rel_mse_trimmed += *it;
  e.rel_mse_trimmed /= 3 * double(kept - relative.begin());

  std::vector<double> size(deviation.size());
  std::transform(deviation.begin(), deviation.end(), size.begin(),
                 [](double d) { return std::abs(d); });
  const auto middle = size.begin() + std::ptrdiff_t(size.size() / 2);
  std::nth_element(size.begin(), middle, size.end());
  const double limit = kOutlier * 1.4826 * *middle;
  e.outliers = uint64_t(
      std::count_if(deviation.begin(), deviation.end(), [&](double d) { return d > limit; }));
  return e;
}

PixelCount count_beyond(const Image& picture, const Image& reference, const Thresholds& t) {
  require_same_size(picture, reference);
  PixelCount count;
  for (size_t p = 0; p < reference.pixels(); ++p) {
    const float *const x = picture.rgb.data() + 3 * p, *const r = reference.rgb.data() + 3 * p;
    double d = 0;
    for (size_t c = 0; c < 3; ++c) d = std::max(d, std::abs(double(x[c]) - double(r[c])));
    const bool broken = !is_finite(x) || !is_finite(r);
    count.beyond_each += broken || d > t.each;
    count.beyond_any += broken || d > t.any;
  }
  return count;
}

}  // namespace yat

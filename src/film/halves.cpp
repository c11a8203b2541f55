#include "film/halves.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace yat {

namespace {

void require_same_size(const Film& a, const Film& b) {
  if (a.width() != b.width() || a.height() != b.height())
    throw std::invalid_argument("halves: the films differ in size");
}

/// Share of A in a pixel that has samples.
double share_of(const FilmPixel& a, const FilmPixel& b, Weigh weigh) {
  if (!a.samples || !b.samples) return a.samples ? 1 : 0;
  if (weigh == Weigh::kEqually) return .5;
  return double(a.samples) / double(a.samples + b.samples);
}

double mean_of(Fixed sum, uint64_t samples) {
  return samples ? from_fixed(sum) / double(samples) : 0;
}

/// Means of one pixel's half, as floats.
void means_of(const FilmPixel& pixel, float* rgb) {
  rgb[0] = float(mean_of(pixel.r, pixel.samples));
  rgb[1] = float(mean_of(pixel.g, pixel.samples));
  rgb[2] = float(mean_of(pixel.b, pixel.samples));
}

/// What stands for the true value of pixel (x, y), which has samples in both halves: see
/// NoiseEstimate. At the edges the picture goes on with its last pixels.
void robust_values(const std::vector<float>& rgb, const Film& a, const Film& b, uint32_t x,
                   uint32_t y, float* out) {
  const uint32_t width = a.width(), height = a.height();
  const uint32_t rows[3] = {y ? y - 1 : 0, y, std::min(y + 1, height - 1)};
  const uint32_t columns[3] = {x ? x - 1 : 0, x, std::min(x + 1, width - 1)};
  float own[2][3];
  means_of(a.at(x, y), own[0]);
  means_of(b.at(x, y), own[1]);
  for (uint32_t c = 0; c < 3; ++c) {
    float v[9];
    for (uint32_t i = 0; i < 9; ++i)
      v[i] = rgb[(size_t(rows[i / 3]) * width + columns[i % 3]) * 3 + c];
    const float whole = v[4];
    std::nth_element(v, v + 4, v + 9);
    out[c] = std::min(whole, std::max(v[4], std::min(own[0][c], own[1][c])));
  }
}

struct RowSums {
  double variance = 0, relative = 0;  ///< over pixels and channels
  double scatter = 0;                 ///< over pairs: half the squared difference of their terms
  uint64_t pairs = 0;
};

RowSums sums_of_row(const Film& a, const Film& b, Weigh weigh, const std::vector<float>& rgb,
                    double epsilon, uint32_t y) {
  RowSums sums;
  double before = 0;
  bool has_before = false;
  for (uint32_t x = 0; x < a.width(); ++x) {
    const FilmPixel &p = a.at(x, y), &q = b.at(x, y);
    if (!p.samples || !q.samples) {
      has_before = false;
      continue;
    }
    const double s = share_of(p, q, weigh);
    const Fixed halves[3][2] = {{p.r, q.r}, {p.g, q.g}, {p.b, q.b}};
    float middle[3];
    robust_values(rgb, a, b, x, y, middle);
    double term = 0;
    for (size_t c = 0; c < 3; ++c) {
      const double d = mean_of(halves[c][0], p.samples) - mean_of(halves[c][1], q.samples);
      const double variance = s * (1 - s) * d * d, r = double(middle[c]);
      sums.variance += variance;
      term += variance / (r * r + epsilon);
    }
    sums.relative += term;
    // Pairs have no pixel in common.
    if (has_before) {
      sums.scatter += .5 * (term - before) * (term - before);
      ++sums.pairs;
    }
    before = term;
    has_before = !has_before;
  }
  return sums;
}

}  // namespace

std::vector<float> resolve_halves(const Film& a, const Film& b, Weigh weigh) {
  require_same_size(a, b);
  const size_t pixels = size_t(a.width()) * a.height();
  std::vector<float> rgb(pixels * 3);
  for (size_t i = 0; i < pixels; ++i) {
    const FilmPixel &p = a.data()[i], &q = b.data()[i];
    const Fixed sums[3][2] = {{p.r, q.r}, {p.g, q.g}, {p.b, q.b}};
    const uint64_t n = p.samples + q.samples;
    if (!n) continue;
    for (size_t c = 0; c < 3; ++c) {
      if (weigh == Weigh::kEqually && p.samples && q.samples)
        rgb[3 * i + c] =
            float(.5 * (mean_of(sums[c][0], p.samples) + mean_of(sums[c][1], q.samples)));
      else
        rgb[3 * i + c] = float(mean_of(sums[c][0] + sums[c][1], n));
    }
  }
  return rgb;
}

NoiseEstimate estimate_noise(const Film& a, const Film& b, Weigh weigh, ThreadPool& pool) {
  const std::vector<float> rgb = resolve_halves(a, b, weigh);
  NoiseEstimate e;
  for (size_t i = 0; i < rgb.size() / 3; ++i) {
    if (!a.data()[i].samples || !b.data()[i].samples) continue;
    ++e.pixels;
    for (size_t c = 0; c < 3; ++c) e.mean += double(rgb[3 * i + c]);
  }
  if (!e.pixels) return e;
  const double n = double(e.pixels);
  e.mean /= 3 * n;
  const double level = e.mean != 0 ? e.mean : 1;
  e.epsilon = .01 * level * level;
  // Sums per row, added up in order: workers change no bit.
  std::vector<RowSums> rows(a.height());
  pool.for_each(a.height(), [&](uint32_t y, uint32_t) {
    rows[y] = sums_of_row(a, b, weigh, rgb, e.epsilon, y);
  });
  RowSums all;
  for (const RowSums& row : rows) {
    all.variance += row.variance;
    all.relative += row.relative;
    all.scatter += row.scatter;
    all.pairs += row.pairs;
  }
  e.mse = all.variance / (3 * n);
  e.rel_mse = all.relative / (3 * n);
  if (all.pairs) e.rel_mse_se = std::sqrt(all.scatter / double(all.pairs) / n) / 3;
  return e;
}

}  // namespace yat

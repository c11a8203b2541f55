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

/// Means of a film's pixels, 0 where there is no sample: width * height * 3.
using Means = std::vector<float>;

void sort2(float& a, float& b) {
  const float least = std::min(a, b);
  b = std::max(a, b);
  a = least;
}

/// The median of nine by 19 exchanges (Paeth 1990).
float median9(float* v) {
  sort2(v[1], v[2]), sort2(v[4], v[5]), sort2(v[7], v[8]);
  sort2(v[0], v[1]), sort2(v[3], v[4]), sort2(v[6], v[7]);
  sort2(v[1], v[2]), sort2(v[4], v[5]), sort2(v[7], v[8]);
  sort2(v[0], v[3]), sort2(v[5], v[8]), sort2(v[4], v[7]);
  sort2(v[3], v[6]), sort2(v[1], v[4]), sort2(v[2], v[5]);
  sort2(v[4], v[7]), sort2(v[4], v[2]), sort2(v[6], v[4]);
  sort2(v[4], v[2]);
  return v[4];
}

/// Sums over the channels of one pixel.
struct PixelNoise {
  double variance = 0, relative = 0;
};

/// Two halves, the picture they make, and its mean level.
struct Halves {
  Halves(const Film& a_film, const Film& b_film, Weigh how)
      : a(a_film),
        b(b_film),
        weigh(how),
        mean_a(a.resolve()),
        mean_b(b.resolve()),
        rgb(resolve_halves(a, b, weigh)) {
    for (size_t i = 0; i < rgb.size() / 3; ++i) {
      if (!a.data()[i].samples || !b.data()[i].samples) continue;
      ++pixels;
      for (size_t c = 0; c < 3; ++c) mean += double(rgb[3 * i + c]);
    }
    if (pixels) mean /= 3 * double(pixels);
    const double level = mean != 0 ? mean : 1;
    epsilon = .01 * level * level;
  }
  bool known(uint32_t x, uint32_t y) const { return a.at(x, y).samples && b.at(x, y).samples; }
  /// What stands for the true value of channel c: see NoiseEstimate. At the edges the picture goes
  /// on with its last pixels.
  float robust_value(uint32_t x, uint32_t y, size_t c) const {
    const size_t width = a.width();
    const size_t rows[3] = {y ? y - 1 : 0, y, std::min(y + 1, a.height() - 1)};
    const size_t columns[3] = {x ? x - 1 : 0, x, std::min(x + 1, a.width() - 1)};
    float v[9];
    for (size_t i = 0; i < 9; ++i) v[i] = rgb[(rows[i / 3] * width + columns[i % 3]) * 3 + c];
    const size_t own = (y * width + x) * 3 + c;
    return std::min(rgb[own], std::max(median9(v), std::min(mean_a[own], mean_b[own])));
  }
  /// Of a pixel that is known.
  PixelNoise noise_of(uint32_t x, uint32_t y) const {
    const double s = share_of(a.at(x, y), b.at(x, y), weigh);
    PixelNoise noise;
    for (size_t c = 0; c < 3; ++c) {
      const size_t i = (size_t(y) * a.width() + x) * 3 + c;
      const double d = double(mean_a[i]) - double(mean_b[i]), r = double(robust_value(x, y, c));
      const double variance = s * (1 - s) * d * d;
      noise.variance += variance;
      noise.relative += variance / (r * r + epsilon);
    }
    return noise;
  }

  const Film &a, &b;
  const Weigh weigh;
  const Means mean_a, mean_b, rgb;
  uint64_t pixels = 0;  ///< that are known
  double mean = 0, epsilon = 0;
};

struct RowSums {
  PixelNoise noise;    ///< over the pixels
  double scatter = 0;  ///< over pairs: half the squared difference of their terms
  uint64_t pairs = 0;
};

RowSums sums_of_row(const Halves& halves, uint32_t y) {
  RowSums sums;
  double before = 0;
  bool has_before = false;
  for (uint32_t x = 0; x < halves.a.width(); ++x) {
    if (!halves.known(x, y)) {
      has_before = false;
      continue;
    }
    const PixelNoise noise = halves.noise_of(x, y);
    sums.noise.variance += noise.variance;
    sums.noise.relative += noise.relative;
    // Pairs have no pixel in common.
    if (has_before) {
      sums.scatter += .5 * (noise.relative - before) * (noise.relative - before);
      ++sums.pairs;
    }
    before = noise.relative;
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
  const Halves halves(a, b, weigh);
  NoiseEstimate e;
  e.pixels = halves.pixels;
  if (!e.pixels) return e;
  e.mean = halves.mean;
  e.epsilon = halves.epsilon;
  // Sums per row, added up in order: workers change no bit.
  std::vector<RowSums> rows(a.height());
  pool.for_each(a.height(), [&](uint32_t y, uint32_t) { rows[y] = sums_of_row(halves, y); });
  RowSums all;
  for (const RowSums& row : rows) {
    all.noise.variance += row.noise.variance;
    all.noise.relative += row.noise.relative;
    all.scatter += row.scatter;
    all.pairs += row.pairs;
  }
  const double n = double(e.pixels);
  e.mse = all.noise.variance / (3 * n);
  e.rel_mse = all.noise.relative / (3 * n);
  if (all.pairs) e.rel_mse_se = std::sqrt(all.scatter / double(all.pairs) / n) / 3;
  return e;
}

std::vector<double> block_noise(const Film& a, const Film& b, Weigh weigh, uint32_t edge,
                                ThreadPool& pool) {
  const Halves halves(a, b, weigh);
  const uint32_t width = a.width(), height = a.height();
  const uint32_t columns = (width + edge - 1) / edge, rows = (height + edge - 1) / edge;
  std::vector<double> blocks(size_t(columns) * rows);
  pool.for_each(rows, [&](uint32_t row, uint32_t) {
    for (uint32_t column = 0; column < columns; ++column) {
      double sum = 0;
      uint32_t known = 0;
      for (uint32_t y = row * edge; y < std::min((row + 1) * edge, height); ++y)
        for (uint32_t x = column * edge; x < std::min((column + 1) * edge, width); ++x) {
          if (!halves.known(x, y)) continue;
          ++known;
          sum += halves.noise_of(x, y).relative;
        }
      if (known) blocks[size_t(row) * columns + column] = sum / (3. * known);
    }
  });
  return blocks;
}

}  // namespace yat

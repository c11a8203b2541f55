#pragma once
// Pictures seen from afar: a Gaussian over pixels, whose rows and columns join at their ends. And
// how much less the error of some is than that of others.

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "significance.h"

namespace yat {

/// One value a pixel, row by row. `sigma` in pixels, up to 3; the weights sum to 1.
inline std::vector<double> blurred(const std::vector<double>& picture, int width, double sigma) {
  constexpr int kReach = 12;
  const int height = int(picture.size()) / width;
  std::array<double, 2 * kReach + 1> weight{};
  double sum = 0;
  for (int i = -kReach; i <= kReach; ++i)
    sum += weight[size_t(i + kReach)] = std::exp(-i * i / (2 * sigma * sigma));
  const auto along = [&](const std::vector<double>& in, int dx, int dy) {
    std::vector<double> out(in.size());
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int i = -kReach; i <= kReach; ++i) {
          const int from_x = (x + i * dx + kReach * width) % width;
          const int from_y = (y + i * dy + kReach * height) % height;
          out[size_t(y * width + x)] +=
              weight[size_t(i + kReach)] / sum * in[size_t(from_y * width + from_x)];
        }
    return out;
  };
  return along(along(picture, 1, 0), 0, 1);
}

inline double mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v * v;
  return sum / double(values.size());
}

/// How many times less b is than a in the geometric mean, at least, with a confidence of 99.9 %
/// (Student's test of the logarithms' differences, which are independent).
inline double surely_times_less(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> logs;
  for (size_t i = 0; i < a.size(); ++i) logs.push_back(std::log(a[i] / b[i]));
  const Moments m = moments_of(logs);
  double low = 0, high = 20;  // errors of the mean
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (student_two_sided(middle, m.count - 1) > .002 ? low : high) = middle;
  }
  return std::exp(m.mean - high * std::sqrt(m.squared_error()));
}

}  // namespace yat

#include "converge/error_pictures.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "converge/html.h"

namespace yat {

namespace {

constexpr uint32_t kCrop = 48;  // Pixels along an edge; shown four times as large.
constexpr double kEpsilon = .01;

double luminance(const float* p) {
  return .2126 * double(p[0]) + .7152 * double(p[1]) + .0722 * double(p[2]);
}

double quantile(std::vector<double> values, double q) {
  const auto at = values.begin() + std::ptrdiff_t(q * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

uint8_t to_srgb(double v) {
  v = std::clamp(v, 0., 1.);
  v = v <= .0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - .055;
  return uint8_t(std::lround(255 * v));
}

/// Colours of growing lightness between five corners.
void colour_of(double share, uint8_t* rgb) {
  constexpr double kCorners[5][3] = {
      {0, 0, 4}, {86, 15, 110}, {187, 55, 84}, {249, 142, 9}, {252, 255, 240}};
  const double place = std::clamp(share, 0., 1.) * 4;
  const auto i = std::min<size_t>(3, size_t(place));
  const double t = place - double(i);
  for (size_t c = 0; c < 3; ++c)
    rgb[c] = uint8_t(std::lround(kCorners[i][c] + t * (kCorners[i + 1][c] - kCorners[i][c])));
}

/// Calls f(x, y) for the first pixel of each block that is shown, row by row.
template <class F>
void for_each_shown(const Region& part, const F& f) {
  for (uint32_t y = 0; y < part.shown_height(); ++y)
    for (uint32_t x = 0; x < part.shown_width(); ++x)
      f(part.x + x * part.shrink, part.y + y * part.shrink);
}

template <class F>
double mean_of_block(const Region& part, uint32_t x, uint32_t y, const F& value) {
  double sum = 0;
  for (uint32_t j = y; j < y + part.shrink; ++j)
    for (uint32_t i = x; i < x + part.shrink; ++i) sum += value(i, j);
  return sum / (double(part.shrink) * part.shrink);
}

/// Where the mean squared error of a crop is largest, and where it is that of half of them.
std::vector<Region> choose_crops(const std::vector<double>& squares, uint32_t width,
                                 uint32_t height) {
  const uint32_t w = std::min(kCrop, width), h = std::min(kCrop, height);
  std::vector<std::pair<double, Region>> all;
  for (uint32_t y = 0; y + h <= height; y += std::max(1u, h / 2))
    for (uint32_t x = 0; x + w <= width; x += std::max(1u, w / 2)) {
      double sum = 0;
      for (uint32_t j = y; j < y + h; ++j)
        for (uint32_t i = x; i < x + w; ++i) sum += squares[size_t(j) * width + i];
      all.push_back({sum, {x, y, w, h}});
    }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Region> crops = {all.front().second};
  if (all.size() > 1) crops.push_back(all[all.size() / 2].second);
  return crops;
}

}  // namespace

std::vector<float> relative_errors(const Image& picture, const Image& reference) {
  const double mean = std::accumulate(reference.rgb.begin(), reference.rgb.end(), 0.) /
                      double(reference.rgb.size());
  const double epsilon = mean != 0 ? kEpsilon * mean * mean : kEpsilon;
  std::vector<float> errors(reference.pixels());
  for (size_t p = 0; p < errors.size(); ++p) {
    const double r = luminance(&reference.rgb[3 * p]), x = luminance(&picture.rgb[3 * p]);
    errors[p] = float(std::abs(x - r) / std::sqrt(r * r + epsilon));
  }
  return errors;
}

Showing choose_showing(const Image& reference, const std::vector<Image>& pictures) {
  Showing showing;
  std::vector<double> light(reference.pixels());
  for (size_t p = 0; p < light.size(); ++p) light[p] = luminance(&reference.rgb[3 * p]);
  const double white = quantile(light, .98);
  const double brightest = *std::max_element(light.begin(), light.end());
  showing.white = white > 0 ? white : brightest > 0 ? brightest : 1;

  std::vector<double> squares(reference.pixels());
  for (size_t i = 0; i < pictures.size(); ++i) {
    const std::vector<float> errors = relative_errors(pictures[i], reference);
    for (size_t p = 0; p < errors.size(); ++p)
      squares[p] += std::isfinite(errors[p]) ? double(errors[p]) * double(errors[p]) : 0;
    if (i > 0) continue;
    const double most = quantile({errors.begin(), errors.end()}, .99);
    showing.largest = most > 0 ? most : 1;
  }
  showing.crops = choose_crops(squares, reference.width, reference.height);
  return showing;
}

Region whole_of(const Image& picture) {
  constexpr uint32_t kMost = 480;
  const uint32_t shrink = std::max(1u, (picture.width + kMost - 1) / kMost);
  return {0, 0, picture.width, picture.height, std::min(shrink, picture.height)};
}

std::string picture_uri(const Image& picture, const Region& part, const Showing& showing) {
  std::vector<uint8_t> rgb;
  rgb.reserve(size_t(part.shown_width()) * part.shown_height() * 3);
  for_each_shown(part, [&](uint32_t x, uint32_t y) {
    for (size_t c = 0; c < 3; ++c)
      rgb.push_back(to_srgb(
          mean_of_block(part, x, y,
                        [&](uint32_t i, uint32_t j) {
                          return double(picture.rgb[3 * (size_t(j) * picture.width + i) + c]);
                        }) /
          showing.white));
  });
  return png_uri(rgb, part.shown_width(), part.shown_height());
}

std::string error_uri(const std::vector<float>& errors, uint32_t picture_width, const Region& part,
                      const Showing& showing) {
  std::vector<uint8_t> rgb(size_t(part.shown_width()) * part.shown_height() * 3);
  uint8_t* to = rgb.data();
  for_each_shown(part, [&](uint32_t x, uint32_t y) {
    const double error = mean_of_block(part, x, y, [&](uint32_t i, uint32_t j) {
      return double(errors[size_t(j) * picture_width + i]);
    });
    colour_of(error / showing.largest, to);
    to += 3;
  });
  return png_uri(rgb, part.shown_width(), part.shown_height());
}

}  // namespace yat

#include "film/falsecolors.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace yat {

namespace {

using Stop = std::array<double, 3>;
constexpr Stop kStd[] = {{0, 0, 1}, {0, 1, 1}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}};
constexpr Stop kLmk[] = {{0, 0, 0}, {.5, 0, .5}, {0, 0, 1}, {0, 1, 0},
                         {1, 1, 0}, {1, 0, 0},   {1, 1, 1}};
constexpr Stop kRed[] = {{0, 0, 0}, {1, 0, 0}};
constexpr Stop kWhite[] = {{0, 0, 0}, {1, 1, 1}};
constexpr Stop kYellow[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
constexpr Stop kSpeos[] = {{0, 0, .5}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0},
                           {1, 1, 0},  {1, 0, 0}, {.5, 0, 0}};

std::span<const Stop> stops_of(FalseColorScale scale) {
  switch (scale) {
    case FalseColorScale::kStd:
      return kStd;
    case FalseColorScale::kLmk:
      return kLmk;
    case FalseColorScale::kRed:
      return kRed;
    case FalseColorScale::kWhite:
      return kWhite;
    case FalseColorScale::kYellow:
      return kYellow;
    case FalseColorScale::kSpeos:
      break;
  }
  return kSpeos;
}

}  // namespace

double false_color_place(double luminance, double least, double most, FalseColorMethod method) {
  if (!(most > least)) return 0;
  const double share = std::clamp((luminance - least) / (most - least), 0., 1.);
  switch (method) {
    case FalseColorMethod::kLinear:
      break;
    case FalseColorMethod::kLog:
      return std::log10(1 + 9 * share);
    case FalseColorMethod::kLog3:
      return std::log10(1 + 999 * share) / 3;
  }
  return share;
}

std::array<double, 3> false_color(double place, FalseColorScale scale) {
  const std::span<const Stop> stops = stops_of(scale);
  const double at = std::clamp(place, 0., 1.) * double(stops.size() - 1);
  const size_t i = std::min(size_t(at), stops.size() - 2);
  Stop color;
  for (size_t k = 0; k < 3; ++k)
    color[k] = stops[i][k] + (at - double(i)) * (stops[i + 1][k] - stops[i][k]);
  return color;
}

}  // namespace yat

#pragma once
// Luminance as colour: the tone map "falsecolors" (lxs 4.3).

#include <array>

#include "film/settings.h"

namespace yat {

/// Place on the scale, in [0, 1], of a luminance; 0 where most <= least.
double false_color_place(double luminance, double least, double most, FalseColorMethod method);

/// Display colour (not to be gamma-encoded) at a place of the scale: between a few colours,
/// linearly.
///   std     blue, cyan, green, yellow, red      lmk     black, violet, blue, green, yellow, red,
///   white red     black to red                        white   black to white yellow  black, red,
///   yellow                  speos   dark blue, blue, cyan, green, yellow, red, dark red
/// The names are LuxRender's, whose tables are finer; the order of colours is the same.
std::array<double, 3> false_color(double place, FalseColorScale scale);

}  // namespace yat

#pragma once
// Curves on log-log axes as SVG.

#include <string>
#include <vector>

namespace yat {

struct PlotPoint {
  double x, y;
  double low, high;  ///< ends of the error bar; NaN: none
};
struct PlotSeries {
  std::string name;
  std::vector<PlotPoint> points;  ///< those with x or y not above 0 are left out
};
struct Plot {
  std::string title, x_label, y_label;
  std::vector<PlotSeries> series;  ///< at most kPlotStyles look different
  std::vector<double> x_ticks;     ///< where to label the x axis; empty: at round numbers
  /// A dashed line of this slope through the first series' first point, to compare with; 0: none.
  double guide_slope = 0;
};
inline constexpr size_t kPlotStyles = 8;

/// A whole <svg> element, which can stand in a page or, with the XML namespace that it names, be a
/// file. Text and axes have the colour of the text around them; as a file they follow the reader's
/// light or dark scheme. A plot without a point says so.
std::string svg_plot(const Plot& plot);

/// The marker of a series alone, as an inline <svg> element of some 14 pixels: for tables.
std::string svg_marker(size_t series);

}  // namespace yat

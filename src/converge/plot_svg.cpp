#include "converge/plot_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "converge/html.h"

namespace yat {

namespace {

constexpr double kWidth = 640, kHeight = 420;
constexpr double kLeft = 78, kRight = 14, kTop = 34, kBottom = 52, kLegendLine = 19;

// Okabe and Ito's colours (2008), told apart by all eyes, a little darkened or lightened where they
// would vanish on white or black; markers tell them apart on paper too.
constexpr const char* kColours[kPlotStyles] = {"#0a78c2", "#d95f02", "#0a9a6c", "#c35b9a",
                                               "#c98a00", "#3fa7dd", "#8a6fd1", "#7d7d7d"};

/// A marker around (x, y): circle, square, diamond, triangle, each filled or open.
std::string marker(size_t series, double x, double y) {
  const char* const colour = kColours[series % kPlotStyles];
  const char* const fill = series % kPlotStyles < 4 ? colour : "none";
  const std::string paint =
      fmt::format("fill=\"{}\" stroke=\"{}\" stroke-width=\"1.6\"", fill, colour);
  switch (series % 4) {
    case 0:
      return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" {}/>", x, y, paint);
    case 1:
      return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"7.6\" height=\"7.6\" {}/>",
                         x - 3.8, y - 3.8, paint);
    case 2:
      return fmt::format("<path d=\"M{:.1f} {:.1f}l5 5l-5 5l-5 -5z\" {}/>", x, y - 5, paint);
    default:
      return fmt::format("<path d=\"M{:.1f} {:.1f}l5 8.6l-10 0z\" {}/>", x, y - 5.5, paint);
  }
}

std::string text(double x, double y, const char* anchor, const std::string& words,
                 const char* more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" {}>{}</text>\n", x, y,
                     anchor, more, escaped_html(words));
}

/// From a decade's part to a decade's part that hold all values.
struct Axis {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  double first_pixel = 0, last_pixel = 0;

  void hold(double value) {
    if (!(value > 0) || !std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  bool empty() const { return !(high > 0); }
  /// Some room on both sides.
  void widen() {
    const double room = std::pow(std::max(high / low, 1.5), .05);
    low /= room;
    high *= room;
  }
  double pixel(double value) const {
    return first_pixel + (last_pixel - first_pixel) * std::log(value / low) / std::log(high / low);
  }
};

struct Tick {
  double value;
  bool labelled;
};

/// Powers of 10, or of 10 with 2 and 5 between them where there are few.
std::vector<Tick> ticks_of(const Axis& axis) {
  const double decades = std::log10(axis.high / axis.low);
  const int every = std::max(1, int(decades / 8));
  std::vector<Tick> ticks;
  for (int e = int(std::floor(std::log10(axis.low))); e <= int(std::ceil(std::log10(axis.high)));
       ++e)
    for (int m = 1; m < 10; ++m) {
      const double value = m * std::pow(10., e);
      if (value < axis.low || value > axis.high) continue;
      const bool between = decades < 1 || (decades < 2.5 && (m == 2 || m == 5));
      ticks.push_back({value, (m == 1 && e % every == 0) || between});
    }
  return ticks;
}

std::string tick_label(double value) {
  return value >= .01 && value < 1e5 ? fmt::format("{:.6g}", value) : fmt::format("{:.0e}", value);
}

std::string axes(const Plot& plot, const Axis& x, const Axis& y) {
  std::string out;
  std::vector<Tick> x_ticks;
  for (const double value : plot.x_ticks) x_ticks.push_back({value, true});
  for (const Tick& tick : x_ticks.empty() ? ticks_of(x) : x_ticks) {
    const double at = x.pixel(tick.value);
    out += fmt::format("<path d=\"M{0:.1f} {1:.1f}V{2:.1f}\" class=\"{3}\"/>\n", at, y.first_pixel,
                       y.last_pixel, tick.labelled ? "grid" : "fine");
    if (tick.labelled) out += text(at, y.first_pixel + 17, "middle", tick_label(tick.value));
  }
  for (const Tick& tick : ticks_of(y)) {
    const double at = y.pixel(tick.value);
    out += fmt::format("<path d=\"M{0:.1f} {1:.1f}H{2:.1f}\" class=\"{3}\"/>\n", x.first_pixel, at,
                       x.last_pixel, tick.labelled ? "grid" : "fine");
    if (tick.labelled) out += text(x.first_pixel - 7, at + 4, "end", tick_label(tick.value));
  }
  out += fmt::format("<path d=\"M{:.1f} {:.1f}V{:.1f}H{:.1f}\" class=\"axis\"/>\n", x.first_pixel,
                     y.last_pixel, y.first_pixel, x.last_pixel);
  out += text((x.first_pixel + x.last_pixel) / 2, y.first_pixel + 40, "middle", plot.x_label);
  const double middle = (y.first_pixel + y.last_pixel) / 2;
  out += text(18, middle, "middle", plot.y_label,
              fmt::format("transform=\"rotate(-90 18 {:.1f})\"", middle).c_str());
  return out;
}

std::string curve(const PlotSeries& series, size_t index, const Axis& x, const Axis& y) {
  const char* const colour = kColours[index % kPlotStyles];
  std::string line, bars, markers;
  for (const PlotPoint& p : series.points) {
    if (!(p.x > 0 && p.y > 0 && std::isfinite(p.y))) continue;
    const double px = x.pixel(p.x), py = y.pixel(p.y);
    line += fmt::format("{}{:.1f} {:.1f}", line.empty() ? "M" : "L", px, py);
    if (p.high > p.low && p.high > 0) {
      const double top = y.pixel(p.high), bottom = y.pixel(std::max(p.low, y.low));
      bars += fmt::format("M{0:.1f} {1:.1f}V{2:.1f}M{3:.1f} {1:.1f}h7M{3:.1f} {2:.1f}h7", px,
                          bottom, top, px - 3.5);
    }
    markers += marker(index, px, py);
  }
  return fmt::format(
      "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"/>\n"
      "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.2\"/>\n{}\n",
      line.empty() ? "M0 0" : line, colour, bars.empty() ? "M0 0" : bars, colour, markers);
}

/// The guide through the first point, as far as it is in the frame.
std::string guide(const Plot& plot, const Axis& x, const Axis& y) {
  if (plot.guide_slope == 0) return {};
  for (const PlotPoint& p : plot.series.front().points) {
    if (!(p.x > 0 && p.y > 0)) continue;
    const auto at = [&](double value) { return p.y * std::pow(value / p.x, plot.guide_slope); };
    double end = x.high;
    if (at(end) < y.low) end = p.x * std::pow(y.low / p.y, 1 / plot.guide_slope);
    return fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" class=\"guide\"/>\n", x.pixel(p.x),
                       y.pixel(p.y), x.pixel(end), y.pixel(at(end)));
  }
  return {};
}

}  // namespace

std::string svg_marker(size_t series) {
  return fmt::format(
      "<svg width=\"14\" height=\"14\" viewBox=\"0 0 14 14\" aria-hidden=\"true\">{}</svg>",
      marker(series, 7, 7));
}

std::string svg_plot(const Plot& plot) {
  const size_t lines = plot.series.size() + (plot.guide_slope != 0);
  const double height = kHeight + kLegendLine * double(lines);
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" viewBox=\"0 0 {0} {1}\" "
      "width=\"{0}\" height=\"{1}\" role=\"img\" aria-label=\"{2}\">\n"
      "<style>.plot{{font:13px sans-serif;color:#222}}"
      "@media(prefers-color-scheme:dark){{.plot{{color:#ddd}}}}"
      ".plot text{{fill:currentColor}}.plot path.axis,.plot path.grid,.plot path.fine,"
      ".plot path.guide{{stroke:currentColor;fill:none}}"
      ".plot path.grid{{opacity:.22}}.plot path.fine{{opacity:.09}}"
      ".plot path.guide{{stroke-dasharray:5 4;opacity:.6}}</style>\n",
      kWidth, height, escaped_html(plot.title));
  out += text(kWidth / 2, 20, "middle", plot.title, "font-weight=\"bold\"");

  Axis x, y;
  for (const PlotSeries& series : plot.series)
    for (const PlotPoint& p : series.points) {
      if (!(p.x > 0 && p.y > 0)) continue;
      x.hold(p.x);
      for (const double value : {p.y, p.low, p.high}) y.hold(value);
    }
  if (x.empty() || y.empty())
    return out + text(kWidth / 2, kHeight / 2, "middle", "no run is finished") + "</svg>\n";
  x.widen();
  y.widen();
  x.first_pixel = kLeft;
  x.last_pixel = kWidth - kRight;
  y.first_pixel = kHeight - kBottom;
  y.last_pixel = kTop;
  out += axes(plot, x, y);
  out += guide(plot, x, y);
  for (size_t i = 0; i < plot.series.size(); ++i) out += curve(plot.series[i], i, x, y);
  double line = kHeight + 8;
  for (size_t i = 0; i < plot.series.size(); ++i, line += kLegendLine)
    out += marker(i, kLeft + 10, line - 4) + text(kLeft + 26, line, "start", plot.series[i].name);
  if (plot.guide_slope != 0)
    out += fmt::format("<path d=\"M{:.1f} {:.1f}h20\" class=\"guide\"/>", kLeft, line - 4) +
           text(kLeft + 26, line, "start", fmt::format("slope {:g}", plot.guide_slope));
  return out + "</svg>\n";
}

}  // namespace yat

#include "converge/report_html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "converge/error_pictures.h"
#include "converge/html.h"
#include "converge/ladder.h"
#include "converge/summary_text.h"

namespace yat {

namespace {

constexpr std::string_view kStyle = R"(
:root{color-scheme:light dark;--line:#8884;--soft:#8881}
body{font:15px/1.5 system-ui,sans-serif;max-width:1320px;margin:2em auto;padding:0 1em}
h1{font-size:1.5em}h2{font-size:1.15em;margin-top:2em}
table{border-collapse:collapse;font-variant-numeric:tabular-nums}
th,td{padding:.25em .7em;border-bottom:1px solid var(--line);text-align:right;white-space:nowrap}
th:first-child,td:first-child{text-align:left}thead th{background:var(--soft)}
.facts td{text-align:left;white-space:normal}.scroll{overflow-x:auto}
.plots{display:flex;flex-wrap:wrap;gap:1em}.plot{max-width:100%;height:auto}
.warn{border-left:4px solid #d95f02;padding:.1em 1em;background:var(--soft)}
.pictures td{text-align:center;vertical-align:top}.pictures img{image-rendering:pixelated}
small{opacity:.75}svg{vertical-align:-2px}
)";

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.3g}", value) : "-";
}

std::string percent(double share) {
  return std::isfinite(share) ? fmt::format("{:.2g} %", 100 * share) : "-";
}

std::string bytes_text(double bytes) {
  return bytes >= 1e9 ? fmt::format("{:.2f} GB", bytes * 1e-9)
                      : fmt::format("{:.1f} MB", bytes * 1e-6);
}

/// Cells hold HTML.
std::string table(const std::vector<std::string>& head,
                  const std::vector<std::vector<std::string>>& rows, const char* kind = "") {
  std::string out = fmt::format("<div class=\"scroll\"><table class=\"{}\">", kind);
  if (!head.empty()) {
    out += "<thead><tr>";
    for (const std::string& cell : head) out += "<th>" + cell + "</th>";
    out += "</tr></thead>";
  }
  out += "<tbody>\n";
  for (const auto& row : rows) {
    out += "<tr>";
    for (const std::string& cell : row) out += "<td>" + cell + "</td>";
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string name_cell(const ConvergeSummary& summary, const VariantSummary& v) {
  return fmt::format("{} {}", svg_marker(size_t(&v - summary.variants.data())),
                     escaped_html(v.name));
}

PlotPoint point_of(double x, const RungSummary& r) {
  return {x, std::sqrt(r.mse.value), std::sqrt(std::max(0., r.mse.interval.low)),
          std::sqrt(r.mse.interval.high)};
}

template <class X>
Plot error_plot(const ConvergeSummary& summary, const X& x) {
  Plot plot;
  plot.y_label = "RMSE";
  for (const VariantSummary& v : summary.variants) {
    PlotSeries series{v.name, {}};
    for (const RungSummary& r : v.rungs) series.points.push_back(point_of(x(r), r));
    plot.series.push_back(std::move(series));
  }
  return plot;
}

/// What a ratio says for sure.
std::string verdict(const Measured& ratio) {
  if (!ratio.interval.excludes(1)) return "no difference shown";
  return ratio.value < 1 ? fmt::format("{:.3g} x better", 1 / ratio.value)
                         : fmt::format("{:.3g} x worse", ratio.value);
}

std::string headline_table(const ConvergeSummary& s) {
  std::vector<std::vector<std::string>> rows;
  for (const VariantSummary& v : s.variants) {
    const RungSummary& r = v.rungs[v.headline];
    const bool first = &v == s.variants.data();
    rows.push_back(
        {name_cell(s, v), measured_text(r.ttuv), measured_text(r.ttuv_ratio),
         measured_text(r.ttuv_cpu), measured_text(r.ttuv_cpu_ratio), measured_text(r.rel_cpu_ratio),
         first          ? "the measure"
         : r.unreliable ? "unreliable"
                        : verdict(r.ttuv_cpu_ratio),
         measured_text(v.slope), time_text(v.to_rel_mse[0]), time_text(v.to_rel_mse[1])});
  }
  return table({"variant", "TTUV", "ratio", "TTUV, CPU time", "ratio", "relMSE x CPU time, ratio",
                "by CPU time", "slope", "to relMSE 1e-2", "to relMSE 1e-3"},
               rows);
}

std::string rung_table(const ConvergeSummary& s) {
  std::vector<std::vector<std::string>> rows;
  for (const VariantSummary& v : s.variants)
    for (const RungSummary& r : v.rungs)
      rows.push_back(
          {name_cell(s, v), samples_text(r), std::to_string(r.runs), measured_text(r.mse),
           measured_text(r.rel_mse),
           number(r.rel_mse_trimmed) + (r.unreliable ? " (unreliable)" : ""), number(r.mape),
           r.hdr_flip ? number(*r.hdr_flip) : "-", number(r.outliers), percent(r.reference_share),
           fmt::format("{} <small>min {}, &sigma; {}</small>", number(r.seconds), number(r.fastest),
                       number(r.seconds_deviation)),
           number(r.cpu_seconds), number(r.ttuv.value), measured_text(r.ttuv_cpu_ratio)});
  return table({"variant", "spp", "runs", "MSE", "relMSE", "trimmed", "MAPE", "HDR-FLIP",
                "outliers", "reference", "seconds", "CPU s", "TTUV", "ratio, CPU"},
               rows);
}

std::string bias_table(const ConvergeSummary& s) {
  std::vector<std::vector<std::string>> rows;
  for (const VariantSummary& v : s.variants) {
    std::vector<std::string> row = {
        name_cell(s, v), fmt::format("{:+.4f} %", 100 * v.bias),
        std::isfinite(v.bias_error) ? fmt::format("{:.4f} %", 100 * v.bias_error) : "-",
        std::isfinite(v.bias_z()) ? fmt::format("{:+.2f}", v.bias_z()) : "-"};
    if (v.bias_test) {
      row.push_back(fmt::format("{} of {}", v.bias_test->beyond, v.bias_test->pixels));
      row.push_back(fmt::format("{} ({} of the MSE)", number(v.bias_test->floor),
                                percent(v.bias_test->floor / v.top().mse_measured)));
    }
    rows.push_back(std::move(row));
  }
  return table({"variant", "mean difference", "standard error", "z", "pixels beyond chance",
                "floor of the MSE"},
               rows);
}

std::string cost_table(const ConvergeSummary& s) {
  std::vector<std::vector<std::string>> rows;
  for (const VariantSummary& v : s.variants)
    rows.push_back({name_cell(s, v), seconds_text(v.first_pixel), bytes_text(v.memory_bytes)});
  return table({"variant", "time to first pixel (read + build)", "scene, film and work memory"},
               rows);
}

std::string image_tag(const std::string& uri, const Region& part, const std::string& words) {
  // Small pictures are shown with pixels that can be seen.
  const uint32_t zoom = std::max(1u, 192 / std::max(part.shown_width(), 1u));
  return fmt::format("<img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"{}\">", uri,
                     part.shown_width() * zoom, part.shown_height() * zoom, escaped_html(words));
}

std::string picture_table(const ReportPage& page) {
  const Image& reference = page.reference->image;
  std::vector<Image> images;
  for (const EqualTimePicture& p : page.pictures) images.push_back(p.image);
  const Showing showing = choose_showing(reference, images);
  std::vector<Region> parts = {whole_of(reference)};
  parts.insert(parts.end(), showing.crops.begin(), showing.crops.end());

  std::vector<std::string> row = {"reference"};
  for (const Region& part : parts) {
    row.push_back(image_tag(picture_uri(reference, part, showing), part, "reference"));
    row.push_back("");
  }
  std::vector<std::vector<std::string>> rows = {row};
  for (const EqualTimePicture& p : page.pictures) {
    const std::vector<float> errors = relative_errors(p.image, reference);
    const ImageError error = image_error(p.image, reference);
    row = {fmt::format("{}<br><small>{:.4g} spp, {}<br>relMSE {:.3g}</small>",
                       escaped_html(p.variant), p.samples_per_pixel, seconds_text(p.cpu_seconds),
                       error.rel_mse)};
    for (const Region& part : parts) {
      row.push_back(image_tag(picture_uri(p.image, part, showing), part, p.variant));
      row.push_back(image_tag(error_uri(errors, reference.width, part, showing), part,
                              p.variant + ", errors"));
    }
    rows.push_back(std::move(row));
  }
  std::vector<std::string> head = {"", "picture", "errors"};
  for (size_t i = 0; i < showing.crops.size(); ++i) {
    const Region& c = showing.crops[i];
    head.push_back(fmt::format("{} <small>({}, {})</small>",
                               i == 0 ? "largest errors" : "usual errors", c.x, c.y));
    head.push_back("errors");
  }
  return fmt::format(
             "<h2>At equal CPU time</h2>\n<p>Illustration only: one run each. Radiance up to "
             "{:.3g}, sRGB; errors |x - r| / sqrt(r&sup2; + &epsilon;) of luminance from black (0) "
             "to white ({:.3g}).</p>\n",
             showing.white, showing.largest) +
         table(head, rows, "pictures");
}

}  // namespace

Plot error_over_time(const ConvergeSummary& summary) {
  Plot plot = error_plot(summary, [](const RungSummary& r) { return r.seconds; });
  plot.title = "Error against time";
  plot.x_label = "wall time of rendering [s]";
  return plot;
}

Plot error_over_cpu_time(const ConvergeSummary& summary) {
  Plot plot = error_plot(summary, [](const RungSummary& r) { return r.cpu_seconds; });
  plot.title = "Error against CPU time";
  plot.x_label = "CPU time of rendering, all threads together [s]";
  return plot;
}

Plot error_over_samples(const ConvergeSummary& summary) {
  Plot plot = error_plot(summary, [](const RungSummary& r) { return r.samples; });
  plot.title = "Error against samples";
  plot.x_label = "samples per pixel";
  plot.guide_slope = -.5;
  for (const VariantSummary& v : summary.variants)
    for (const RungSummary& r : v.rungs)
      if (r.spp != kTargetRung &&
          std::find(plot.x_ticks.begin(), plot.x_ticks.end(), double(r.spp)) == plot.x_ticks.end())
        plot.x_ticks.push_back(r.spp);
  return plot;
}

std::string report_html(const ReportPage& page) {
  const ConvergeSummary& s = *page.summary;
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n<title>{0}</title>\n"
      "<style>{1}</style></head>\n<body>\n<h1>Error against time: {0}</h1>\n",
      escaped_html(page.scene), kStyle);
  if (s.variants.empty()) return out + "<p>No run is finished.</p></body></html>\n";
  for (const std::string& warning : s.warnings)
    out += fmt::format("<p class=\"warn\">{}</p>\n", escaped_html(warning));

  const VariantSummary& first = s.variants.front();
  out += fmt::format(
      "<h2>Efficiency at {} samples per pixel</h2>\n{}"
      "<p>TTUV: MSE &times; time of rendering, less is better; ratio to the first variant, which "
      "is the ratio of times to equal error; [95 % interval, bootstrap over runs]; times with ~ "
      "are extrapolated. MSE is ruled by bright pixels, relMSE is not. On a machine that others "
      "use too, go by CPU time.</p>\n",
      samples_text(first.rungs[first.headline]), headline_table(s));
  out += "<div class=\"plots\">\n" + svg_plot(error_over_time(s)) +
         svg_plot(error_over_cpu_time(s)) + svg_plot(error_over_samples(s)) + "</div>\n";
  if (!page.pictures.empty()) out += picture_table(page);
  out += "<h2>Bias: mean of all runs at the highest rung against the reference</h2>\n" +
         bias_table(s) +
         "<p>Floor: what of the MSE the spread of the runs does not explain: squared bias and the "
         "reference's own variance.</p>\n";
  out +=
      "<h2>All rungs</h2>\n" + rung_table(s) +
      "<p>MSE and relMSE: means over runs, the reference's variance subtracted where it is above "
      "1 %; reference: its share of the MSE. Trimmed: relMSE without the worst 0.1 % of "
      "pixels. Outliers: pixels per run that are brighter than the reference by more than 20 "
      "deviations. ~: a noise target decided how many samples; the mean.</p>\n";
  out += "<h2>Costs</h2>\n" + cost_table(s);

  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, value] : page.facts)
    rows.push_back({escaped_html(name), escaped_html(value)});
  for (const auto& [name, options] : page.variants)
    rows.push_back(
        {"variant " + escaped_html(name),
         "<code>" + escaped_html(options.empty() ? "(as the scene says)" : options) + "</code>"});
  out += "<h2>What was measured</h2>\n" + table({}, rows, "facts");
  return out + "</body></html>\n";
}

}  // namespace yat

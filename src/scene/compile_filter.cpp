// PixelFilter -> tables for importance sampling (lxs 4.5).
//
// A product of positive functions (triangle, gaussian, blackmanharris) is drawn from the quantiles
// of its two factors, computed from 8192 cells: 512 pieces of equal weight each.
//
// Any other filter is taken as constant in each of kFilterBins^2 cells, with the cell's mean as
// value. The mean comes from 4 x 4 Gauss-Legendre points a cell, exact for polynomials up to degree
// 7 in x and in y; kinks (triangle, the rim of Mitchell) cost less than 1e-4 of the whole. A sample
// is drawn with probability |F| / sum |F| and weighted by sign(F) sum |F| / sum F, so that the
// expected picture is the filtered one (for the filter constant in each cell) and constant stays
// constant.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "scene/compile_parts.h"

namespace yat {

namespace {

constexpr double kPi = std::numbers::pi;

double mitchell(double t, double b, double c) {
  t = std::abs(t);
  if (t >= 2) return 0;
  if (t > 1)
    return ((-b - 6 * c) * t * t * t + (6 * b + 30 * c) * t * t + (-12 * b - 48 * c) * t +
            (8 * b + 24 * c)) /
           6;
  return ((12 - 9 * b - 6 * c) * t * t * t + (-18 + 12 * b + 6 * c) * t * t + (6 - 2 * b)) / 6;
}

double sinc(double x) {
  const double a = kPi * x;
  return std::abs(a) < 1e-5 ? 1 : std::sin(a) / a;
}

double blackman_harris(double n) {
  if (n < 0 || n > 1) return 0;
  const double a = 2 * kPi * n;
  return .35875 - .48829 * std::cos(a) + .14128 * std::cos(2 * a) - .01168 * std::cos(3 * a);
}

double catmull_rom(double x) {
  x = std::abs(x);
  if (x >= 2) return 0;
  if (x < 1) return (3 * x * x * x - 5 * x * x + 2) / 2;
  return (-x * x * x + 5 * x * x - 8 * x + 4) / 2;
}

using Kernel = std::function<double(double x, double y)>;

/// The filter of the statement: its kernel and its support. `box` needs no tables.
struct Filter {
  Kernel kernel;
  double radius_x = .5, radius_y = .5;
  FilterKind kind = FilterKind::kTable;
};

double width(Parameters& p, std::string_view name, float fallback) {
  const float value = p.number(name, fallback);
  if (value > 0 && value < 1e4f) return double(value);
  p.diagnostics().warning(p.loc(name), fmt::format("\"{}\" of {} is {}, but must be above 0: {} is "
                                                   "used",
                                                   name, p.what(), value, fallback));
  return double(fallback);
}

Filter mitchell_filter(Parameters& p) {
  double xw = width(p, "xwidth", 2), yw = width(p, "ywidth", 2);
  const double b = double(p.number("B", 1.f / 3)), c = double(p.number("C", 1.f / 3));
  const bool supersample = p.flag("supersample", false);
  if (supersample) xw *= 5. / 3, yw *= 5. / 3;
  const double a0 = (76 - 16 * b + 8 * c) / 81, a1 = (1 - a0) / 2;
  return {[=](double x, double y) {
            const double t = 2 * std::hypot(x / xw, y / yw);
            if (t >= 2) return 0.;
            if (!supersample) return mitchell(t, b, c);
            const double u = t / 2 / .6;
            return a0 * mitchell(2 * u, b, c) + a1 * mitchell(2 * u - 4. / 3, b, c) +
                   a1 * mitchell(2 * u + 4. / 3, b, c);
          },
          xw, yw};
}

Filter make_filter(Parameters& p) {
  const std::string& type = p.plugin().type;
  if (type == "box") {
    const double xw = width(p, "xwidth", .5f), yw = width(p, "ywidth", .5f);
    return {{}, xw, yw, FilterKind::kBox};
  }
  if (type == "triangle") {
    const double xw = width(p, "xwidth", 2), yw = width(p, "ywidth", 2);
    return {[=](double x, double y) {
              return std::max(0., xw - std::abs(x)) * std::max(0., yw - std::abs(y));
            },
            xw, yw, FilterKind::kProduct};
  }
  if (type == "gaussian") {
    const double xw = width(p, "xwidth", 2), yw = width(p, "ywidth", 2);
    const double alpha = double(p.number("alpha", 2));
    const auto g = [alpha](double x, double w) {
      return std::max(0., std::exp(-alpha * x * x) - std::exp(-alpha * w * w));
    };
    return {[=](double x, double y) { return g(x, xw) * g(y, yw); }, xw, yw, FilterKind::kProduct};
  }
  if (type == "mitchell") return mitchell_filter(p);
  if (type == "sinc") {
    const double xw = width(p, "xwidth", 4), yw = width(p, "ywidth", 4);
    const double tau = double(p.number("tau", 3));
    return {[=](double x, double y) {
              return sinc(x / xw) * sinc(tau * x / xw) * sinc(y / yw) * sinc(tau * y / yw);
            },
            xw, yw};
  }
  if (type == "blackmanharris") {
    const double xw = width(p, "xwidth", 4), yw = width(p, "ywidth", 4);
    return {[=](double x, double y) {
              return blackman_harris(.5 + x / xw) * blackman_harris(.5 + y / yw);
            },
            xw / 2, yw / 2, FilterKind::kProduct};
  }
  if (type == "catmullrom") {
    p.accept({"xwidth", "ywidth"});
    return {[](double x, double y) { return catmull_rom(x) * catmull_rom(y); }, 2, 2};
  }
  p.diagnostics().error(p.plugin().loc,
                        fmt::format("unknown filter \"{}\"{}: \"mitchell\" is used", type,
                                    did_you_mean(type, {"box", "triangle", "gaussian", "mitchell",
                                                        "sinc", "blackmanharris", "catmullrom"})));
  p.accept_all();
  static const Plugin kMitchell{"mitchell", {}, {}};
  Parameters defaults(kMitchell, "filter \"mitchell\"", p.diagnostics());
  return mitchell_filter(defaults);
}

constexpr uint32_t kN = kFilterBins;

/// Integral over each cell, rows over y, in units of the cell's area.
std::vector<double> integrate_cells(const Filter& filter) {
  // Gauss-Legendre nodes and weights on [-1, 1].
  constexpr double kNode[4] = {-.8611363115940526, -.3399810435848563, .3399810435848563,
                               .8611363115940526};
  constexpr double kWeight[4] = {.3478548451374538, .6521451548625461, .6521451548625461,
                                 .3478548451374538};
  std::vector<double> cells(kN * kN);
  for (uint32_t j = 0; j < kN; ++j)
    for (uint32_t i = 0; i < kN; ++i) {
      double sum = 0;
      for (uint32_t b = 0; b < 4; ++b)
        for (uint32_t a = 0; a < 4; ++a) {
          const double x = (2 * (i + .5 + .5 * kNode[a]) / kN - 1) * filter.radius_x;
          const double y = (2 * (j + .5 + .5 * kNode[b]) / kN - 1) * filter.radius_y;
          sum += .25 * kWeight[a] * kWeight[b] * filter.kernel(x, y);
        }
      cells[j * kN + i] = sum;
    }
  return cells;
}

/// n + 1 cumulative values, first 0 and last 1; uniform where there is nothing to choose by.
void write_cdf(const double* mass, uint32_t n, float* cdf) {
  double total = 0;
  for (uint32_t i = 0; i < n; ++i) total += mass[i];
  double sum = 0;
  for (uint32_t i = 0; i < n; ++i) {
    cdf[i] = float(total > 0 ? sum / total : double(i) / n);
    sum += mass[i];
  }
  cdf[n] = 1;
}

/// Quantiles of f(t) on [-1, 1], kFilterQuantiles + 1 of them; empty if f integrates to nothing.
std::vector<float> write_quantiles(const std::function<double(double)>& f) {
  constexpr uint32_t kCells = 8192;
  std::vector<double> below(kCells + 1, 0.);
  for (uint32_t i = 0; i < kCells; ++i)
    below[i + 1] = below[i] + std::max(0., f(2 * (i + .5) / kCells - 1));
  const double total = below[kCells];
  if (!(total > 0) || !std::isfinite(total)) return {};
  std::vector<float> quantiles(kFilterQuantiles + 1);
  uint32_t cell = 0;
  for (uint32_t k = 0; k <= kFilterQuantiles; ++k) {
    const double wanted = total * k / kFilterQuantiles;
    while (cell + 1 < kCells && below[cell + 1] < wanted) ++cell;
    const double mass = below[cell + 1] - below[cell];
    const double inside = mass > 0 ? std::clamp((wanted - below[cell]) / mass, 0., 1.) : 0.;
    quantiles[k] = float(2 * (cell + inside) / kCells - 1);
  }
  return quantiles;
}

/// Fills the tables of a filter that is no product of positive functions. False if the filter does
/// not integrate to anything positive.
bool write_cells(const Filter& filter, FilterTables& tables) {
  std::vector<double> cells = integrate_cells(filter);
  double sum = 0, sum_abs = 0;
  for (double f : cells) sum += f, sum_abs += std::abs(f);
  if (!(sum > 1e-3 * sum_abs) || !std::isfinite(sum_abs)) return false;
  tables.marginal.resize(kN + 1);
  tables.conditional.resize(kN * (kN + 1));
  tables.sign.resize(kN * kN);
  std::vector<double> rows(kN, 0.);
  for (uint32_t k = 0; k < kN * kN; ++k) {
    tables.sign[k] = float((cells[k] < 0 ? -sum_abs : sum_abs) / sum);
    cells[k] = std::abs(cells[k]);
    rows[k / kN] += cells[k];
  }
  write_cdf(rows.data(), kN, tables.marginal.data());
  for (uint32_t j = 0; j < kN; ++j)
    write_cdf(&cells[j * kN], kN, &tables.conditional[j * (kN + 1)]);
  return true;
}

bool write_product(const Filter& filter, FilterTables& tables) {
  tables.quantile_x =
      write_quantiles([&](double t) { return filter.kernel(t * filter.radius_x, 0); });
  tables.quantile_y =
      write_quantiles([&](double t) { return filter.kernel(0, t * filter.radius_y); });
  return !tables.quantile_x.empty() && !tables.quantile_y.empty();
}

}  // namespace

FilterTables compile_filter(const std::optional<Plugin>& plugin, Diagnostics& diagnostics) {
  static const Plugin kDefault{"mitchell", {}, {}};
  const Plugin& used = plugin ? *plugin : kDefault;
  Parameters p(used, "filter \"" + used.type + "\"", diagnostics);
  Filter filter = make_filter(p);
  p.report_unused();

  FilterTables tables;
  const bool usable = filter.kind == FilterKind::kBox       ? true
                      : filter.kind == FilterKind::kProduct ? write_product(filter, tables)
                                                            : write_cells(filter, tables);
  // A filter that integrates to nothing (odd B and C, alpha 0) would divide by nothing.
  if (!usable) {
    diagnostics.warning(used.loc, fmt::format("{} does not integrate to anything positive: a box "
                                              "of its size is used",
                                              p.what()));
    filter.kind = FilterKind::kBox;
  }
  tables.radius_x = float(filter.radius_x);
  tables.radius_y = float(filter.radius_y);
  tables.kind = filter.kind;
  return tables;
}

}  // namespace yat

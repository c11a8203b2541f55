#include "accuracy/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace yat::accuracy {

double Outcome::sigma() const {
  if (known.value == 0 && measured.value == 0) return 0;
  const double rounding = kRounding * known.value;
  return (measured.value - known.value) /
         std::sqrt(measured.error * measured.error + known.error * known.error +
                   rounding * rounding);
}
double Outcome::relative_error() const {
  const double error = std::hypot(measured.error, known.error);
  return error == 0 ? 0 : error / std::fabs(known.value);
}
bool Outcome::within(const Limits& limits) const {
  // A NaN is not within.
  return std::fabs(sigma()) <= limits.sigma && relative_error() <= limits.error;
}

void print_header() {
  fmt::print("{:34} {:>12} {:>12} {:>9} {:>6} {:>10} {:>6}  {}\n", "case", "computed", "expected",
             "s.e. %", "sigma", "samples", "s", "in print");
}

void print_row(const Outcome& o, const Limits& limits) {
  std::string printed;
  if (o.c->published)
    printed =
        fmt::format("{} ({:+.2f} %)", *o.c->published, 100 * (*o.c->published / o.known.value - 1));
  fmt::print("{:34} {:12.8f} {:12.8f} {:9.5f} {:6.2f} {:10} {:6.2f}  {}{}\n", o.c->name,
             o.measured.value, o.known.value, 100 * o.relative_error(), o.sigma(),
             o.measured.samples, o.measured.seconds, printed, o.within(limits) ? "" : "  ***");
  std::fflush(stdout);
}

void print_summary(const std::vector<Outcome>& outcomes, const Limits& limits) {
  size_t within = 0;
  double worst = 0, worst_error = 0, seconds = 0;
  for (const Outcome& o : outcomes) {
    within += o.within(limits);
    worst = std::max(worst, std::fabs(o.sigma()));
    worst_error = std::max(worst_error, o.relative_error());
    seconds += o.measured.seconds;
  }
  const double one = std::erfc(worst / std::sqrt(2.));
  fmt::print(
      "\n{} of {} within {} sigma at a standard error of at most {} %; {:.0f} s of processor "
      "time.\nLargest deviation {:.2f} sigma: chance brings as much in {:.0f} % of such tables. "
      "Largest standard error {:.4f} %.\n",
      within, outcomes.size(), limits.sigma, 100 * limits.error, seconds, worst,
      100 * (1 - std::pow(1 - one, double(outcomes.size()))), 100 * worst_error);
}

std::string markdown(const std::vector<Outcome>& outcomes, const std::vector<Missing>& missing,
                     const Limits& limits) {
  std::string text =
      "| case | computed | expected | s.e. | sigma | samples | s | in print |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const Outcome& o : outcomes)
    text +=
        fmt::format("| {} | {:.6g} | {:.6g} | {:.4f} % | {:.2f}{} | {:.3g} | {:.2f} | {} |\n",
                    o.c->name, o.measured.value, o.known.value, 100 * o.relative_error(), o.sigma(),
                    o.within(limits) ? "" : " ***", double(o.measured.samples), o.measured.seconds,
                    o.c->published ? fmt::format("{:.6g}", *o.c->published) : "");
  for (const Missing& m : missing) text += fmt::format("\nNot in yat: {}: {}.\n", m.name, m.reason);
  return text;
}

nlohmann::ordered_json json_row(const Outcome& o, const Limits& limits) {
  nlohmann::ordered_json row = {{"name", o.c->name},
                                {"what", o.c->what},
                                {"computed", o.measured.value},
                                {"expected", o.known.value},
                                {"expected_error", o.known.error},
                                {"standard_error", o.measured.error},
                                {"sigma", o.sigma()},
                                {"samples", o.measured.samples},
                                {"spp", o.measured.spp},
                                {"cpu_seconds", o.measured.seconds},
                                {"within", o.within(limits)}};
  if (o.c->published) row["published"] = *o.c->published;
  return row;
}

}  // namespace yat::accuracy

#include "accuracy/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/student.h"

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
double Outcome::chance_of(double deviation) const {
  const auto part = [](double error, uint32_t runs) {
    return runs > 1 ? std::pow(error, 4) / (runs - 1) : 0;
  };
  const double rounding = kRounding * known.value;
  const double all =
      measured.error * measured.error + known.error * known.error + rounding * rounding;
  const double parts = part(measured.error, measured.runs) + part(known.error, known.runs);
  deviation = std::fabs(deviation);
  return parts > 0 ? student_two_sided(deviation, all * all / parts)
                   : std::erfc(deviation / std::sqrt(2.));
}
bool Outcome::within(const Limits& limits) const {
  // A NaN is not within.
  return std::fabs(sigma()) <= limits.sigma && relative_error() <= limits.error;
}
bool Verdict::good(const Limits& limits) const {
  return first.within(limits) || (again && again->within(limits));
}

void print_header() {
  fmt::print("{:34} {:>12} {:>12} {:>9} {:>6} {:>5} {:>11} {:>7}  {}\n", "case", "computed",
             "expected", "s.e. %", "sigma", "runs", "samples", "s", "in print");
}

namespace {

void print_outcome(const Outcome& o, const std::string& name, const std::string& more) {
  fmt::print("{:34} {:12.8f} {:12.8f} {:9.5f} {:6.2f} {:5} {:11} {:7.2f}  {}\n", name,
             o.measured.value, o.known.value, 100 * o.relative_error(), o.sigma(), o.measured.runs,
             o.measured.samples, o.measured.seconds, more);
}

std::string mark(const Outcome& o, const Limits& limits) {
  return o.within(limits) ? "" : " ***";
}

}  // namespace

void print_row(const Verdict& verdict, const Limits& limits) {
  const Outcome& o = verdict.first;
  std::string printed;
  if (o.c->published)
    printed =
        fmt::format("{} ({:+.2f} %)", *o.c->published, 100 * (*o.c->published / o.known.value - 1));
  print_outcome(o, o.c->name, printed + mark(o, limits));
  if (verdict.again)
    print_outcome(*verdict.again, "  again, other random numbers", mark(*verdict.again, limits));
  std::fflush(stdout);
}

void print_summary(const std::vector<Verdict>& verdicts, const Limits& limits) {
  size_t good = 0, outside = 0, loose = 0, confirmed = 0;
  double expected = 0, worst = 0, worst_error = 0, seconds = 0, least = 1;
  for (const Verdict& v : verdicts) {
    const Outcome& o = v.first;
    good += v.good(limits);
    loose += !(o.relative_error() <= limits.error);
    outside += !(std::fabs(o.sigma()) <= limits.sigma);
    confirmed += v.again && !(std::fabs(v.again->sigma()) <= limits.sigma);
    expected += o.chance_of(limits.sigma);
    least = std::min(least, o.chance_of(o.sigma()));
    worst = std::max(worst, std::fabs(o.sigma()));
    worst_error = std::max(worst_error, o.relative_error());
    seconds += o.measured.seconds + (v.again ? v.again->measured.seconds : 0);
  }
  const auto cases = double(verdicts.size());
  fmt::print(
      "\n{} of {} cases are good; {:.0f} s of processor time.\n{} have a standard error above {} "
      "%; "
      "the largest is {:.4f} %.\n{} were outside {} standard errors at first, where chance puts "
      "{:.2g}; repeated with other random numbers and {} times the runs, {} are.\nLargest "
      "deviation {:.2f} standard errors; as improbable a one is in {:.0f} % of such tables.\n",
      good, verdicts.size(), seconds, loose, 100 * limits.error, 100 * worst_error, outside,
      limits.sigma, expected, kRepeatedRuns, confirmed, worst,
      100 * (1 - std::pow(1 - least, cases)));
}

std::string markdown(const std::vector<Verdict>& verdicts, const std::vector<Missing>& missing,
                     const Limits& limits) {
  std::string text =
      "| case | computed | expected | s.e. | sigma | runs | samples | s | in print |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  const auto row = [&](const std::string& name, const Outcome& o, const std::string& printed) {
    text += fmt::format(
        "| {} | {:.6g} | {:.6g} | {:.4f} % | {:.2f}{} | {} | {:.3g} | {:.2f} | {} |\n", name,
        o.measured.value, o.known.value, 100 * o.relative_error(), o.sigma(), mark(o, limits),
        o.measured.runs, double(o.measured.samples), o.measured.seconds, printed);
  };
  for (const Verdict& v : verdicts) {
    const Case& c = *v.first.c;
    row(c.name, v.first, c.published ? fmt::format("{:.6g}", *c.published) : "");
    if (v.again) row("the same again, other random numbers", *v.again, "");
  }
  for (const Missing& m : missing) text += fmt::format("\nNot in yat: {}: {}.\n", m.name, m.reason);
  return text;
}

namespace {

nlohmann::ordered_json measured_json(const Outcome& o, const Limits& limits) {
  return {{"computed", o.measured.value},
          {"expected", o.known.value},
          {"expected_error", o.known.error},
          {"standard_error", o.measured.error},
          {"sigma", o.sigma()},
          {"chance", o.chance_of(o.sigma())},
          {"runs", o.measured.runs},
          {"samples", o.measured.samples},
          {"spp", o.measured.spp},
          {"cpu_seconds", o.measured.seconds},
          {"within", o.within(limits)}};
}

}  // namespace

nlohmann::ordered_json json_row(const Verdict& verdict, const Limits& limits) {
  const Outcome& o = verdict.first;
  nlohmann::ordered_json row = {{"name", o.c->name}, {"what", o.c->what}};
  row.update(measured_json(o, limits));
  if (o.c->published) row["published"] = *o.c->published;
  if (verdict.again) row["again"] = measured_json(*verdict.again, limits);
  row["good"] = verdict.good(limits);
  return row;
}

}  // namespace yat::accuracy

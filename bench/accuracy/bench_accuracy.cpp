// Renders scenes whose answers are known, and compares.
//
//   bench_accuracy [--filter TEXT] [--full] [--list] [--json FILE] [--seed N] [--scale X] ...
//
// Cases: closed forms (lights, furnaces, rooms, glass), albedos of rough lobes by quadrature, and
// the analytic cases of CIE 171:2006 with the corrected table of 5.7; and Veach's plates by three
// estimators and the scalar reference. Ends with 0 only if every case is within --sigma standard
// errors of what is expected, at a standard error of at most --error %. What is outside is rendered
// again, with other random numbers and more runs, and stands below; then that counts.

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <string>

#include "accuracy/report.h"
#include "base/error.h"
#include "base/whole_file.h"
#include "kernels/dispatch.h"
#include "measure.h"

namespace yat::accuracy {
namespace {

struct Options {
  std::vector<std::string> filters;
  bool list = false, full = false;
  std::string json, markdown, isa;
  uint32_t threads = 0;
  Effort effort;
  Limits limits;
};

bool wanted(const std::string& name, const std::vector<std::string>& filters) {
  if (filters.empty()) return true;
  for (const std::string& f : filters)
    if (name.find(f) != std::string::npos) return true;
  return false;
}

constexpr uint32_t kRepeatedSeed = 1u << 28;  // --seed is below.

Verdict judge(const Case& c, const Machine& machine, const Limits& limits) {
  if (c.prepare) c.prepare();
  const double begin = bench::process_seconds();
  Verdict verdict{{&c, c.expected(machine), {}}, {}};
  const double expected_seconds = bench::process_seconds() - begin;
  verdict.first.measured = measure(c, verdict.first.known, machine);
  verdict.first.measured.seconds += expected_seconds;
  if (std::fabs(verdict.first.sigma()) <= limits.sigma) return verdict;
  Effort more = machine.effort;
  more.runs *= kRepeatedRuns;
  more.scale *= kRepeatedRuns;  // A run is as long as before.
  more.seed += kRepeatedSeed;
  const Machine again{machine.kernels, machine.pool, more};
  verdict.again = Outcome{&c, c.expected(again), {}};
  verdict.again->measured = measure(c, verdict.again->known, again);
  return verdict;
}

int run(const Options& options) {
  std::vector<Case> all, cases;
  std::vector<Missing> missing;
  add_light_cases(all);
  add_room_cases(all);
  add_glass_cases(all);
  add_lobe_cases(all, missing);
  add_cie_lamp_cases(all, missing);
  add_cie_sky_cases(all, missing);
  add_veach_cases(all);
  for (Case& c : all)
    if ((options.full || !c.extra) && wanted(c.name, options.filters))
      cases.push_back(std::move(c));
  if (options.list) {
    for (const Case& c : cases) std::printf("%-34s %s\n", c.name.c_str(), c.what.c_str());
    return 0;
  }
  if (cases.empty()) throw UsageError("--filter: no case has such a name (see --list)");

  const KernelTable& kernels = select_kernels(options.isa);
  ThreadPool pool(options.threads);
  const Machine machine{kernels, pool, options.effort};
  std::printf("%s, %u threads, %u runs a case, seed %u\n\n", std::string(kernels.isa).c_str(),
              pool.threads(), options.effort.runs, options.effort.seed);
  print_header();
  std::vector<Verdict> verdicts;
  bench::Json rows = bench::Json::array();
  bool good = true;
  for (const Case& c : cases) {
    verdicts.push_back(judge(c, machine, options.limits));
    good = good && verdicts.back().good(options.limits);
    print_row(verdicts.back(), options.limits);
    rows.push_back(json_row(verdicts.back(), options.limits));
  }
  print_summary(verdicts, options.limits);
  bench::Json left_out = bench::Json::array();
  for (const Missing& m : missing) {
    if (!wanted(m.name, options.filters)) continue;
    std::printf("Not in yat: %s: %s.\n", m.name.c_str(), m.reason.c_str());
    left_out.push_back({{"name", m.name}, {"reason", m.reason}});
  }
  if (!options.markdown.empty())
    write_whole_file(options.markdown, markdown(verdicts, missing, options.limits));
  if (!options.json.empty()) {
    bench::Json report = bench::origin("bench_accuracy");
    report["isa"] = kernels.isa;
    report["threads"] = pool.threads();
    report["runs"] = options.effort.runs;
    report["seed"] = options.effort.seed;
    report["scale"] = options.effort.scale;
    report["limits"] = {{"sigma", options.limits.sigma}, {"error", options.limits.error}};
    report["cases"] = rows;
    report["not_in_yat"] = left_out;
    bench::write_json(options.json, report);
  }
  return good ? 0 : 1;
}

int program(int argc, char** argv) {
  Options options;
  double percent = 100 * options.limits.error;
  CLI::App app("Renders scenes whose answers are known, and compares.");
  app.add_option("--filter", options.filters, "cases whose name holds one of these texts")
      ->delimiter(',');
  app.add_flag("--list", options.list, "name the cases and end");
  app.add_flag("--full", options.full, "all points and skies of CIE 171, some hours");
  app.add_option("--json", options.json, "write the results here");
  app.add_option("--markdown", options.markdown, "write the table here");
  app.add_option("--seed", options.effort.seed, "another one gives other random numbers")
      ->check(CLI::Range(0u, kRepeatedSeed - 1));
  app.add_option(
         "--runs", options.effort.runs,
         "independent runs per case; where the standard error is above --error, up to 8 times as "
         "many")
      ->check(CLI::Range(2u, 4096u))
      ->capture_default_str();
  app.add_option("--scale", options.effort.scale, "times the samples that a case needs")
      ->check(CLI::PositiveNumber);
  app.add_option("--sigma", options.limits.sigma, "largest deviation in standard errors")
      ->capture_default_str();
  app.add_option("--error", percent, "largest standard error in percent")->capture_default_str();
  app.add_option("--threads", options.threads, "worker threads; 0: one per processor");
  app.add_option("--isa", options.isa, "instruction set of the kernels");
  CLI11_PARSE(app, argc, argv);
  options.limits.error = options.effort.limit = percent / 100;
  return run(options);
}

}  // namespace
}  // namespace yat::accuracy

int main(int argc, char** argv) {
  return yat::bench::run_program("bench_accuracy", yat::accuracy::program, argc, argv);
}

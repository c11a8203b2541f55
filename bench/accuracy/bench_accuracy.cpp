// Renders scenes whose answers are known, and compares.
//
//   bench_accuracy [--filter TEXT] [--full] [--list] [--json FILE] [--seed N] [--scale X] ...
//
// Cases: closed forms (lights, furnaces, rooms, glass), albedos of rough lobes by quadrature, and
// the analytic cases of CIE 171:2006 with the corrected table of 5.7; and Veach's plates by three
// estimators and the scalar reference. Ends with 0 only if every case is within --sigma standard
// errors of what is expected, at a standard error of at most --error %.

#include <CLI/CLI.hpp>
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
  std::printf("%s, %u threads, %u runs a case, seeds from %u\n\n", std::string(kernels.isa).c_str(),
              pool.threads(), options.effort.runs, options.effort.seed);
  print_header();
  std::vector<Outcome> outcomes;
  bench::Json rows = bench::Json::array();
  bool good = true;
  for (const Case& c : cases) {
    if (c.prepare) c.prepare();
    Outcome outcome{&c, c.expected(machine), {}};
    outcome.measured = measure(c, outcome.known.value, machine);
    good = good && outcome.within(options.limits);
    print_row(outcome, options.limits);
    rows.push_back(json_row(outcome, options.limits));
    outcomes.push_back(outcome);
  }
  print_summary(outcomes, options.limits);
  bench::Json left_out = bench::Json::array();
  for (const Missing& m : missing) {
    if (!wanted(m.name, options.filters)) continue;
    std::printf("Not in yat: %s: %s.\n", m.name.c_str(), m.reason.c_str());
    left_out.push_back({{"name", m.name}, {"reason", m.reason}});
  }
  if (!options.markdown.empty())
    write_whole_file(options.markdown, markdown(outcomes, missing, options.limits));
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
  app.add_option("--seed", options.effort.seed, "first seed; further runs take the following ones")
      ->check(CLI::Range(0u, 0x3fffffffu));
  app.add_option("--runs", options.effort.runs, "independent runs per case")
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
  options.limits.error = percent / 100;
  return run(options);
}

}  // namespace
}  // namespace yat::accuracy

int main(int argc, char** argv) {
  return yat::bench::run_program("bench_accuracy", yat::accuracy::program, argc, argv);
}

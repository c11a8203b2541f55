#include "accuracy/runs.h"

#include <algorithm>
#include <cmath>

#include "converge/hash.h"
#include "film/features.h"
#include "measure.h"
#include "scene/parse.h"
#include "wavefront/pilot.h"
#include "wavefront/reference.h"
#include "wavefront/render.h"

namespace yat::accuracy {

namespace {

struct Prepared {
  Probe probe;
  Scene scene;
};

Prepared prepare(const Probe& probe, const Machine& machine) {
  Diagnostics diagnostics([](Severity severity, std::string_view line) {
    if (severity != Severity::kNote) throw Error(std::string(line));
  });
  const Description description =
      parse_scene(probe.scene, "case.lxs", ".", diagnostics, false, probe.dialect);
  CompileOptions options;
  options.block_width = machine.kernels.lanes;
  options.compensation = probe.compensation;
  options.width = probe.width;
  options.height = probe.height;
  std::copy(probe.crop, probe.crop + 4, options.crop);
  options.crop_given = true;
  return {probe, compile_scene(description, options, machine.pool, diagnostics)};
}

/// Mean over pixels and channels of the radiance per sample.
double mean(const FilmPixel* sums, const FilmPixel* counts, size_t pixels) {
  double sum = 0;
  uint64_t samples = 0;
  for (size_t i = 0; i < pixels; ++i) {
    sum += from_fixed(sums[i].r) + from_fixed(sums[i].g) + from_fixed(sums[i].b);
    samples += counts[i].samples;
  }
  return sum / 3 / double(samples);
}

Plan plan_for(const Prepared& p, const Machine& machine, uint32_t seed) {
  PlanOptions options;
  options.max_depth = p.probe.max_depth;
  options.light_sampling = p.probe.light_sampling;
  options.seed = seed;
  Plan plan = make_plan(p.scene, machine.kernels, options);
  set_shadow_bound(p.scene, plan);
  return plan;
}

double render_mean(const Prepared& p, const Machine& machine, uint32_t seed, uint32_t spp,
                   uint64_t& samples) {
  const Plan plan = plan_for(p, machine, seed);
  const uint32_t width = p.scene.film.crop_width(), height = p.scene.film.crop_height();
  const size_t pixels = size_t(width) * height;
  Film film(width, height);
  FeatureFilm features(width, height, p.probe.indirect ? feature_bit(Feature::kIndirect) : 0);
  RenderOptions options;
  options.end_sample = spp;
  if (p.probe.indirect) options.features = &features;
  const RenderResult result = render(p.scene, plan, options, machine.pool, film);
  if (film.total_samples() != uint64_t(pixels) * spp)
    throw Error("samples were dropped: their light is not finite or negative");
  samples += result.stats.paths;
  const FilmPixel* sums =
      p.probe.indirect ? &features.plane(Feature::kIndirect).at(0) : film.data();
  return mean(sums, film.data(), pixels);
}

/// One run's value of so many samples per pixel.
using Run = std::function<double(uint32_t seed, uint32_t spp)>;

/// Values of runs, and what they say.
struct Values {
  std::vector<double> all;
  void add(const Run& run, uint32_t seed, uint32_t runs, uint32_t spp) {
    for (uint32_t i = 0; i < runs; ++i) all.push_back(run(seed + uint32_t(all.size()), spp));
  }
  Known mean() const {
    const double n = double(all.size());
    double sum = 0, squares = 0;
    for (const double v : all) sum += v;
    for (const double v : all) squares += (v - sum / n) * (v - sum / n);
    return {sum / n, std::sqrt(squares / (n - 1) / n), uint32_t(all.size())};
  }
};

/// Samples per pixel of each of the runs for a standard error of `target`. The error falls at least
/// as 1 / sqrt(samples): a pilot that is an eighth of what this asks for is near enough, and a
/// quarter is added for what the pilot does not know.
uint32_t plan_samples(const Run& run, uint32_t pilot_seed, double target, const Effort& effort) {
  constexpr uint32_t kPilotRuns = 16;
  double needed = 0;
  for (uint32_t pilot = 32;; pilot *= 8) {
    Values values;
    values.add(run, pilot_seed, kPilotRuns, pilot);
    const double ratio = values.mean().error / target;
    needed = 1.25 * effort.scale * pilot * ratio * ratio * kPilotRuns / effort.runs;
    // Of a value that is 0, every sample has to be: there is nothing to plan.
    if (!(needed > 8. * pilot) || pilot >= effort.most_spp / 8) break;
  }
  const double least = effort.scale * effort.least_spp;
  needed = std::isfinite(needed) ? std::max(needed, least) : least;
  needed = std::min(needed, double(effort.most_spp));
  return 1u << uint32_t(std::clamp(std::ceil(std::log2(needed)), 2., 30.));
}

// Of a seed: a bit for what measured values are compared with, one for pilots, the rest for case
// and run.
constexpr uint32_t kOtherBit = 1u << 31, kPilotBit = 1u << 30;

/// Of a case's first run. Cases would all go up and down together if they shared random numbers.
uint32_t first_seed(const std::string& name, uint32_t seed) {
  return (uint32_t(fnv1a_of(name)) + seed) & (kPilotBit - 1);
}

Known run_other(const Run& run, const std::string& name, double target, const Effort& effort) {
  const uint32_t seed = first_seed(name, effort.seed) | kOtherBit;
  const uint32_t spp = plan_samples(run, seed | kPilotBit, target, effort);
  Values values;
  values.add(run, seed, effort.runs, spp);
  return values.mean();
}

}  // namespace

Measured measure(const Case& c, const Known& expected, const Machine& machine) {
  const double begin = bench::process_seconds();
  const Effort& effort = machine.effort;
  std::vector<Prepared> probes;
  for (const Probe& probe : c.probes) probes.push_back(prepare(probe, machine));
  Measured m;
  const Run run = [&](uint32_t seed, uint32_t spp) {
    double value = 0;
    for (const Prepared& p : probes)
      value += p.probe.factor * render_mean(p, machine, seed, spp, m.samples);
    return value;
  };
  const uint32_t seed = first_seed(c.name, effort.seed);
  const double level = std::fabs(expected.value);
  m.spp = plan_samples(run, seed | kPilotBit, c.effort * effort.target * level, effort);
  m.samples = 0;
  Values values;
  values.add(run, seed, effort.runs, m.spp);
  const auto is_loose = [&] {
    return std::hypot(values.mean().error, expected.error) > effort.limit * level;
  };
  while (is_loose() && values.all.size() < size_t(effort.runs) * effort.most)
    values.add(run, seed,
               std::min(uint32_t(values.all.size()),
                        effort.runs * effort.most - uint32_t(values.all.size())),
               m.spp);
  const Known found = values.mean();
  m.value = found.value;
  m.error = found.error;
  m.runs = found.runs;
  m.seconds = bench::process_seconds() - begin;
  return m;
}

Known by_render(const std::string& name, const Probe& probe, double target,
                const Machine& machine) {
  const Prepared p = prepare(probe, machine);
  uint64_t samples = 0;
  const Run run = [&](uint32_t seed, uint32_t spp) {
    return probe.factor * render_mean(p, machine, seed, spp, samples);
  };
  return run_other(run, name, target, machine.effort);
}

Known by_reference(const std::string& name, const Probe& probe, double target,
                   const Machine& machine) {
  const Prepared p = prepare(probe, machine);
  const uint32_t width = p.scene.film.crop_width(), height = p.scene.film.crop_height();
  const Run run = [&](uint32_t seed, uint32_t spp) {
    const Plan plan = plan_for(p, machine, seed);
    // A sum per row of the picture, so that the value does not depend on threads.
    std::vector<double> rows(height);
    machine.pool.for_each(height, [&](uint32_t y, uint32_t) {
      for (uint32_t x = 0; x < width; ++x)
        for (uint32_t sample = 0; sample < spp; ++sample) {
          const glm::dvec3 rgb = reference_sample(p.scene, plan, p.scene.film.crop_x0 + x,
                                                  p.scene.film.crop_y0 + y, sample);
          rows[y] += (rgb.x + rgb.y + rgb.z) / 3;
        }
    });
    double sum = 0;
    for (const double row : rows) sum += row;
    return probe.factor * sum / (double(width) * height * spp);
  };
  Effort effort = machine.effort;
  effort.least_spp = 16;  // ten to a hundred times as slow as the kernels
  return run_other(run, name, target, effort);
}

}  // namespace yat::accuracy

#include "accuracy/runs.h"

#include <algorithm>
#include <cmath>

#include "film/features.h"
#include "measure.h"
#include "scene/parse.h"
#include "wavefront/render.h"

namespace yat::accuracy {

namespace {

struct Prepared {
  Probe probe;
  Scene scene;
};

Prepared prepare(const Probe& probe, const KernelTable& kernels, ThreadPool& pool) {
  Diagnostics diagnostics([](Severity severity, std::string_view line) {
    if (severity != Severity::kNote) throw Error(std::string(line));
  });
  const Description description =
      parse_scene(probe.scene, "case.lxs", ".", diagnostics, false, probe.dialect);
  CompileOptions options;
  options.block_width = kernels.lanes;
  options.compensation = probe.compensation;
  return {probe, compile_scene(description, options, pool, diagnostics)};
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

double render_mean(const Prepared& p, const KernelTable& kernels, ThreadPool& pool, uint32_t seed,
                   uint32_t spp, uint64_t& samples) {
  PlanOptions plan_options;
  plan_options.max_depth = p.probe.max_depth;
  plan_options.seed = seed;
  const Plan plan = make_plan(p.scene, kernels, plan_options);
  const uint32_t width = p.scene.film.crop_width(), height = p.scene.film.crop_height();
  const size_t pixels = size_t(width) * height;
  Film film(width, height);
  FeatureFilm features(width, height, p.probe.indirect ? feature_bit(Feature::kIndirect) : 0);
  RenderOptions options;
  options.end_sample = spp;
  if (p.probe.indirect) options.features = &features;
  const RenderResult result = render(p.scene, plan, options, pool, film);
  if (film.total_samples() != uint64_t(pixels) * spp)
    throw Error("samples were dropped: their light is not finite or negative");
  samples += result.stats.paths;
  const FilmPixel* sums =
      p.probe.indirect ? &features.plane(Feature::kIndirect).at(0) : film.data();
  return mean(sums, film.data(), pixels);
}

struct Estimate {
  double mean = 0, error = 0;
};

Estimate run(const std::vector<Prepared>& probes, const KernelTable& kernels, ThreadPool& pool,
             uint32_t first_seed, uint32_t runs, uint32_t spp, uint64_t& samples) {
  std::vector<double> values;
  for (uint32_t i = 0; i < runs; ++i) {
    double value = 0;
    for (const Prepared& p : probes)
      value += p.probe.factor * render_mean(p, kernels, pool, first_seed + i, spp, samples);
    values.push_back(value);
  }
  double sum = 0, squares = 0;
  for (const double v : values) sum += v;
  for (const double v : values) squares += (v - sum / runs) * (v - sum / runs);
  return {sum / runs, std::sqrt(squares / (runs - 1.) / runs)};
}

}  // namespace

Measured measure(const Case& c, double expected, const KernelTable& kernels, ThreadPool& pool,
                 const Effort& effort) {
  const double begin = bench::process_seconds();
  if (c.prepare) c.prepare();
  std::vector<Prepared> probes;
  for (const Probe& probe : c.probes) probes.push_back(prepare(probe, kernels, pool));

  // The error falls at least as 1 / sqrt(samples): a pilot that is an eighth of what this asks for
  // is near enough, and a quarter is added for what the pilot does not know.
  uint64_t pilot_samples = 0;
  double needed = 0;
  for (uint32_t pilot = 32;; pilot *= 8) {
    const Estimate e =
        run(probes, kernels, pool, effort.seed + 0x40000000u, 16, pilot, pilot_samples);
    const double ratio = e.error / (c.effort * effort.target * std::fabs(expected));
    needed = 1.25 * effort.scale * pilot * ratio * ratio * 16 / effort.runs;
    // Of a value that is 0, every sample has to be: there is nothing to plan.
    if (!(needed > 8. * pilot) || pilot >= effort.most_spp / 8) break;
  }
  const double least = effort.scale * effort.least_spp;
  needed = std::isfinite(needed) ? std::max(needed, least) : least;
  Measured m;
  m.spp = 1u << uint32_t(
              std::clamp(std::ceil(std::log2(std::min(needed, double(effort.most_spp)))), 2., 30.));
  const Estimate e = run(probes, kernels, pool, effort.seed, effort.runs, m.spp, m.samples);
  m.value = e.mean;
  m.error = e.error;
  m.seconds = bench::process_seconds() - begin;
  return m;
}

}  // namespace yat::accuracy

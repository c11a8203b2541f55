#include "wavefront/pilot.h"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <vector>

#include "kernels/rng_scalar.h"
#include "scene/colour_model.h"
#include "wavefront/schedule.h"

namespace yat {

namespace {

constexpr uint32_t kGrid = 8;  ///< cells along an edge of the picture
static_assert(kGrid * kGrid == kPilotWindows);
/// All windows at once: the turns of the batch are well filled.
constexpr uint32_t kBatchRows = 1024;
/// Other than 0, so that a render's own seed is never the pilot's.
constexpr uint32_t kOtherSeed = 0x6a09e667u;
constexpr double kMostOfMedian = 8;

/// The plan of the pilot. Independent numbers, as few as there are of each pixel.
Plan pilot_plan(const Plan& plan) {
  Plan pilot = plan;
  pilot.sampler = SamplerKind::kIndependent;
  pilot.transport.seed ^= kOtherSeed;
  pilot.transport.hide_environment = true;
  pilot.transport.shadow_bound = 0;
  return pilot;
}

/// Window number `window`, somewhere in its cell. Its paths are samples of that number: where
/// windows overlap their paths are different ones.
WorkUnit window_unit(const FilmSettings& film, const Plan& pilot, uint32_t window) {
  // No path has this pixel and sample.
  const auto [u, v] =
      random_pair(pilot.sampler, pilot.draw_key(), Dimension::kFilm, window, kPilotWindows, 0);
  const auto place = [](uint32_t cell, float jitter, uint32_t size, uint32_t edge) {
    const double share = (double(cell) + double(jitter)) / kGrid;
    return std::min(uint32_t(share * double(size - edge + 1)), size - edge);
  };
  const uint32_t width = std::min(kPilotWindowEdge, film.width);
  const uint32_t height = std::min(kPilotWindowEdge, film.height);
  const uint32_t x = place(window % kGrid, u, film.width, width);
  const uint32_t y = place(window / kGrid, v, film.height, height);
  return {x, y, x + width, y + height, window, window + 1, window};
}

/// The windows' paths, in a film with one window below the other.
Film render_windows(const Scene& scene, const Plan& pilot) {
  Film film(kPilotWindowEdge, kPilotWindowEdge * kPilotWindows);
  Worker worker(scene, pilot, kBatchRows, false, film, nullptr);
  WorkCursor cursor;
  for (uint32_t window = 0; window < kPilotWindows; ++window) {
    const WorkUnit unit = window_unit(scene.film, pilot, window);
    cursor.start(unit);
    worker.place_film(unit.x0, unit.y0 - window * kPilotWindowEdge);
    while (!cursor.empty())
      if (worker.free_rows())
        worker.generate(cursor);
      else
        worker.turn();
  }
  while (worker.under_way()) worker.turn();
  return film;
}

/// The largest band of every path, of dropped ones none.
std::vector<double> largest_bands(const Film& film, const BandMatrix& matrix) {
  const glm::dmat3 bands_of = glm::inverse(
      glm::dmat3(to_rgb({1, 0, 0}, matrix), to_rgb({0, 1, 0}, matrix), to_rgb({0, 0, 1}, matrix)));
  std::vector<double> largest;
  largest.reserve(size_t(film.width()) * film.height());
  for (size_t i = 0; i < size_t(film.width()) * film.height(); ++i) {
    const FilmPixel& pixel = film.data()[i];
    if (!pixel.samples) continue;
    const glm::dvec3 bands =
        bands_of * glm::dvec3(from_fixed(pixel.r), from_fixed(pixel.g), from_fixed(pixel.b));
    largest.push_back(std::max({std::fabs(bands.x), std::fabs(bands.y), std::fabs(bands.z)}));
  }
  return largest;
}

/// x >= 0 to 6 bits.
float rounded(double x) {
  constexpr int kBits = 6;
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  return float(std::ldexp(std::round(std::ldexp(mantissa, kBits)), exponent - kBits));
}

}  // namespace

float picture_level(const Scene& scene, const Plan& plan) {
  const Plan pilot = pilot_plan(plan);
  const std::vector<double> largest =
      largest_bands(render_windows(scene, pilot), scene.colour.film);
  std::vector<double> bright;
  std::copy_if(largest.begin(), largest.end(), std::back_inserter(bright),
               [](double v) { return v > 0; });
  if (bright.empty()) return 0;
  const auto middle = bright.begin() + ptrdiff_t(bright.size() / 2);
  std::nth_element(bright.begin(), middle, bright.end());
  const double most = kMostOfMedian * *middle;
  double sum = 0;
  for (const double v : largest) sum += std::min(v, most);
  return rounded(sum / double(largest.size()));
}

void set_shadow_bound(const Scene& scene, Plan& plan) {
  plan.transport.shadow_bound =
      plan.shadow_roulette == kNoShadowRoulette
          ? 0.f
          : float(plan.shadow_roulette * double(picture_level(scene, plan)));
}

}  // namespace yat

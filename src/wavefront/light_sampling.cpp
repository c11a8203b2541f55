#include "wavefront/light_sampling.h"

namespace yat {

// Densities that are not numbers stay as they are: kernels drop and count them (invariant 6).

uint32_t keep_without_density(const float* pdf, const uint32_t* order, uint32_t n,
                              uint32_t* kept) noexcept {
  uint32_t count = 0;
  for (uint32_t i = 0; i < n; ++i)
    if (!(pdf[order[i]] > 0)) kept[count++] = order[i];
  return count;
}

void forget_lights(const float* pdf, uint32_t* light, uint32_t n) noexcept {
  for (uint32_t i = 0; i < n; ++i)
    if (pdf[i] > 0) light[i] = kNone;
}

void count_in_full(const LightSample<Column>& samples, uint32_t n) noexcept {
  for (uint32_t i = 0; i < n; ++i)
    if (samples.pdf[i] > 0) samples.pdf[i] = 0;
}

void empty_met_lights(const LightSample<Column>& samples, uint32_t n) noexcept {
  for (uint32_t i = 0; i < n; ++i)
    if (samples.pdf[i] > 0) samples.weight_r[i] = samples.weight_g[i] = samples.weight_b[i] = 0;
}

}  // namespace yat

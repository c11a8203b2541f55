#pragma once
// Plans by which light is found in one way only (LightSampling). Kernels weight a light sample
// against the chance that the material goes that way, and light met by chance against a light
// sample, by densities that they read from columns; where one says that the other way does not
// exist (0), they count in full. So it is the columns that change, between kernels: no kernel knows
// these plans, and a plan of both ways runs none of this.

#include <cstdint>

#include "soa/records.h"

namespace yat {

/// Keeps the rows of order[0..n) whose direction had no density (camera, mirrors, glass), in order:
/// only these may count what they see. Returns how many; `kept` has room for n.
uint32_t keep_without_density(const float* pdf, const uint32_t* order, uint32_t n,
                              uint32_t* kept) noexcept;

/// The same for surfaces, row for row: to all other paths, light[i] = kNone.
void forget_lights(const float* pdf, uint32_t* light, uint32_t n) noexcept;

/// Makes light samples count in full, as if no ray could meet their lights.
void count_in_full(const LightSample<Column>& samples, uint32_t n) noexcept;

/// Empties the samples of lights that rays can meet.
void empty_met_lights(const LightSample<Column>& samples, uint32_t n) noexcept;

}  // namespace yat

#pragma once
// The oracle: a plain path tracer in double precision over the same scene columns, written for
// clarity and apart from the kernels (brute-force intersection, no SIMD, its own formulas). It
// draws the same random numbers, so that paths can be compared one by one. For tests; not a product
// mode.

#include <cstdint>
#include <glm/vec3.hpp>

#include "wavefront/plan.h"

namespace yat {

/// Radiance of one sample of one pixel (full-image coordinates), linear Rec.709.
glm::dvec3 reference_sample(const Scene& scene, const Plan& plan, uint32_t x, uint32_t y,
                            uint32_t sample);

}  // namespace yat

#pragma once
// What must be known of a picture before it is made: how bright it is.

#include "scene/compile.h"
#include "wavefront/plan.h"

namespace yat {

/// Windows of the picture that the pilot looks at, and pixels along the edge of one.
inline constexpr uint32_t kPilotWindows = 64, kPilotWindowEdge = 4;

/// Mean of the largest band of what a path brings, in magnitude [radiance], to about a tenth: by
/// one path through each pixel of kPilotWindows windows (1024 paths), which are spread over the
/// whole picture, a window in each cell of a grid of 8 x 8. The environment is not shown to the
/// camera, and what is brighter than 8 times the median of all that is not black counts as that:
/// lamps and rare bright paths tell nothing of the others. Rounded to 6 bits, so that instruction
/// sets, whose roundings differ, agree nearly always.
///
/// Returns 0 if no path brings light, and always a finite number. Depends on scene, plan and seed
/// alone; not on the crop window or the sampler (invariant 3). Its random numbers are others than
/// those of the picture, so what is decided by it does not bias the picture. Runs on the calling
/// thread; its rays and drops are counted nowhere.
float picture_level(const Scene& scene, const Plan& plan);

/// Sets plan.transport.shadow_bound to plan.shadow_roulette times the picture's level. Without
/// roulette of shadow rays the bound is 0 and no path is traced (invariant 7).
void set_shadow_bound(const Scene& scene, Plan& plan);

}  // namespace yat

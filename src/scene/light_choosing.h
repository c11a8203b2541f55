#pragma once
// How lights are chosen: an alias table by power, or of equal chances, or the light tree; or none
// is, and surfaces ask all.

#include <vector>

#include "scene/compile.h"

namespace yat {

/// Orders the rows - lights without a place go behind the others, environments to the end, even
/// ones last; rows of surfaces, which come first, keep their numbers - and fills their
/// probabilities and all of the scene that choosing lights needs. scene.radius and scene.colour are
/// set.
void prepare_light_choice(std::vector<LightRow<Value>>& rows, const CompileOptions& options,
                          ThreadPool& pool, Scene& scene);

}  // namespace yat

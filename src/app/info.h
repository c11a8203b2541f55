#pragma once
// `yat info`: what a scene holds and how it would be rendered.

#include <string>

#include "scene/compile.h"
#include "wavefront/plan.h"

namespace yat {

/// Shapes, materials, lights, film, camera; the plan; the tree; memory by table. Ends in a newline.
std::string info_text(const Description& description, const Scene& scene, const Plan& plan);

}  // namespace yat

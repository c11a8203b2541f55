#pragma once
// Autofocus: the focal distance is the depth of what the middle of the picture shows.

#include "scene/compile.h"

namespace yat {

/// Sets the focal distance of a scene that asks for it; where the middle shows nothing, it stays as
/// "focaldistance" says. One ray against every primitive.
void focus_camera(Scene& scene);

}  // namespace yat

#pragma once
// All kinds of analytic shapes.

#include "kernels/shapes/disk.h"
#include "kernels/shapes/quadric.h"
#include "kernels/shapes/torus.h"

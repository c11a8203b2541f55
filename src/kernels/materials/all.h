#pragma once
// The headers of every material in the registry (scene/registry.h): the one list that the
// preprocessor cannot make of it.

#include "kernels/materials/glass.h"
#include "kernels/materials/matte.h"
#include "kernels/materials/matte_translucent.h"
#include "kernels/materials/mirror.h"
#include "kernels/materials/null.h"
#include "kernels/materials/oren_nayar.h"
#include "kernels/materials/scatter.h"
#include "kernels/materials/velvet.h"

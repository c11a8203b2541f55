#pragma once
// The headers of every material in the registry (scene/registry.h): the one list that the
// preprocessor cannot make of it.

#include "kernels/materials/absorbing_glass.h"
#include "kernels/materials/architectural_glass.h"
#include "kernels/materials/cook_torrance.h"
#include "kernels/materials/double_side.h"
#include "kernels/materials/glass.h"
#include "kernels/materials/glass_film.h"
#include "kernels/materials/matte.h"
#include "kernels/materials/matte_translucent.h"
#include "kernels/materials/metal.h"
#include "kernels/materials/metal_colour.h"
#include "kernels/materials/metal_index.h"
#include "kernels/materials/mirror.h"
#include "kernels/materials/mirror_film.h"
#include "kernels/materials/mix.h"
#include "kernels/materials/null.h"
#include "kernels/materials/oren_nayar.h"
#include "kernels/materials/rough_glass.h"
#include "kernels/materials/scatter.h"
#include "kernels/materials/shiny_metal.h"
#include "kernels/materials/velvet.h"

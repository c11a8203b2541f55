#include "wavefront/render.h"

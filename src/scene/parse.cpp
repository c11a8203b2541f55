#include "scene/parse.h"

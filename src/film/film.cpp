#include "film/film.h"

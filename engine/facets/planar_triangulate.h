#pragma once

#include "engine/facets/planar_triangulation.h"

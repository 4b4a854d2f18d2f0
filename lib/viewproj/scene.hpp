// The shapes of a scene: what a ray hits, and what a camera sees of them.
#pragma once

#include "scene/frustum.hpp"
#include "scene/hits.hpp"
#include "scene/segment.hpp"
#include "scene/shapes.hpp"

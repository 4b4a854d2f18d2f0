// World to screen and back: points, pixels, rays, many of them at a time, and how wrong they may be.
#pragma once

#include "projection/batch.hpp"
#include "projection/bounds.hpp"
#include "projection/ray.hpp"
#include "projection/screen.hpp"

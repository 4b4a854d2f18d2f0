// The core of the library: cameras, matrices, worldToScreen, screenToRay.
#pragma once

#include "viewproj/camera.hpp"
#include "viewproj/convention.hpp"
#include "viewproj/lens.hpp"
#include "viewproj/matrices.hpp"
#include "viewproj/screen.hpp"
#include "viewproj/vectors.hpp"
#include "viewproj/version.hpp"

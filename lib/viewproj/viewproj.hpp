// The whole library: cameras, matrices, worldToScreen, screenToRay, hits and culling.
//
// Threads that call it round to the nearest and keep subnormal numbers: numbers/arithmetic.hpp.
#pragma once

#include "viewproj/camera/camera.hpp"
#include "viewproj/camera/error.hpp"
#include "viewproj/camera/geodesy.hpp"
#include "viewproj/numbers/arithmetic.hpp"
#include "viewproj/view/batch.hpp"
#include "viewproj/view/bounds.hpp"
#include "viewproj/view/clip.hpp"
#include "viewproj/view/depth_buffer.hpp"
#include "viewproj/view/frustum.hpp"
#include "viewproj/view/hits.hpp"
#include "viewproj/view/matrices.hpp"
#include "viewproj/view/model.hpp"
#include "viewproj/view/ray.hpp"
#include "viewproj/view/readings.hpp"
#include "viewproj/view/screen.hpp"
#include "viewproj/view/segment.hpp"

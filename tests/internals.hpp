// What lies behind the public headers, for tests of it.
#pragma once

#include "camera/camera.hpp"
#include "camera/depth.hpp"
#include "camera/viewport.hpp"
#include "geodesy/normal.hpp"
#include "lens/inverse.hpp"
#include "numbers/arithmetic.hpp"
#include "numbers/double_double.hpp"
#include "numbers/wide.hpp"
#include "projection/exact_point.hpp"
#include "projection/kernels/error_model.hpp"
#include "scene/frustum_parts.hpp"
#include "viewproj/matrices.hpp"
#include "viewproj/scene.hpp"
#include "viewproj/viewproj.hpp"

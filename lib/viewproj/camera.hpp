// A camera: pose, projection, viewport and convention, and the error where it cannot be built.
#pragma once

#include "camera/camera.hpp"
#include "camera/error.hpp"
#include "camera/pose.hpp"
#include "camera/projection.hpp"
#include "camera/viewport.hpp"
#include "numbers/arithmetic.hpp"

// The angles that a window is seen under, wherever the viewing axis meets it.
#pragma once

#include "numbers/degrees.hpp"

namespace viewproj::cmd {

using detail::degreesAcross, detail::degreesBetween;

}  // namespace viewproj::cmd
